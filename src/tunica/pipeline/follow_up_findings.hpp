// What a follow-up has found, as values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tunica/analysis/growth.hpp"
#include "tunica/analysis/sensitivity.hpp"
#include "tunica/pipeline/follow_up_plan.hpp"
#include "tunica/pipeline/scan_anatomy.hpp"

namespace tunica::pipeline {

/// Between a scan and the next one.
struct Interval {
  std::size_t from = 0, to = 0;  ///< scans
  double years = 0;
  std::string name{};                         ///< "baseline to year_1"
  std::vector<double> diameter{};             ///< growth at the stations [m]
  std::array<std::vector<double>, 2> area{};  ///< of true and false lumen [m^2]
  analysis::Folds folds{};                    ///< of the map from the one to the other
};

/// How growth follows what was computed on the scan before it.
struct GrowthCorrelation {
  std::string interval, growth, load;
  analysis::RankCorrelation rank;
};

struct FollowUpFindings {
  const FollowUpPlan& plan;
  std::vector<const ScanAnatomy*> scans;
  analysis::Growth growth;
  std::vector<Interval> intervals;                 ///< one for each scan but the last
  std::vector<std::optional<StationLoads>> loads;  ///< of each scan; none: it was not computed
  std::vector<GrowthCorrelation> correlations;
  std::size_t block = 1;  ///< stations that the bootstrap takes together

  std::vector<const analysis::Anatomy*> anatomies() const;
};

/// `chains`: of the scans. `with_loads`: their beats have been computed. Throws as find_growth() and station_loads().
/// Not collective.
FollowUpFindings find_follow_up(const FollowUpPlan& plan, const std::vector<const ScanAnatomy*>& scans,
                                const std::vector<Chain>& chains, bool with_loads);

/// Writes follow_up.html, follow_up.json, tables and maps into the folder of results. Throws SolverError where that
/// fails. Returns lines for the terminal. Not collective.
std::vector<std::string> write_follow_up(const FollowUpFindings& findings);

/// Names of what is written there.
std::vector<std::filesystem::path> follow_up_files(const FollowUpPlan& plan);

/// HTML that needs no other file.
std::string follow_up_page(const FollowUpFindings& findings);

/// growth.vtp on the edge of the lumens of the first scan, and map_<a>_to_<b>.vtp on that of each scan but the last.
void write_growth_maps(const FollowUpFindings& findings);

}  // namespace tunica::pipeline
