// What passes the tears and what the false lumen gains over the window: as the run has written it, or from cuts through
// the fields where it has not.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/analysis/figure_table.hpp"
#include "tunica/analysis/lumens.hpp"
#include "tunica/analysis/vessel.hpp"
#include "tunica/artifacts/lumen_histories.hpp"

namespace tunica::stages::post {

struct LumenFlows {
  enum class Source { run, cuts };
  struct Tear {
    analysis::TearPlace place;
    double distance = 0;       ///< of the nearest station along the centreline [m]; 0 without stations
    std::vector<double> flow;  ///< into the false lumen [m^3/s]
  };
  Source source = Source::run;
  std::vector<double> times;  ///< s
  std::vector<Tear> tears;    ///< by their distance from the inlet
  /// Flow by its openings, leakage of its wall (zero of cuts), dV/dt [m^3/s] and volume [m^3] of the false lumen,
  /// volume of the true one.
  std::vector<double> outflow, leakage, volume_rate, volume, true_volume;

  /// The tear with the largest volume into the false lumen.
  std::size_t entry() const;
  /// Eq. (10.6) at each time: what goes in, less what goes out, less what stays [m^3/s].
  std::vector<double> residual() const;
};

/// From every step of the window, its ends included. Of lines beside the window those next to its ends are needed, or
/// else the ends go on as the last two lines do.
LumenFlows flows_of_run(const artifacts::LumenSeries& series, const analysis::Vessel& vessel, double from,
                        double until);
/// From the frames of the window.
LumenFlows flows_of_cuts(const analysis::FigureTable& figures, const analysis::Vessel& vessel,
                         const std::vector<double>& times);

/// Gives the tears of the vessel the names and the order of those of the run. False, and nothing is changed, where they
/// are not the same ones.
bool name_as_in_run(const std::vector<analysis::TearPlace>& tears, analysis::Vessel& vessel);

}  // namespace tunica::stages::post
