// Fields of a run for the time series.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tunica/case/case.hpp"
#include "tunica/coupling/problem.hpp"
#include "tunica/distributed/results_writer.hpp"
#include "tunica/quantities/quantity.hpp"

namespace tunica::artifacts {

/// Prepares a state for the ResultsWriter: the quantities that the case asks for, in its units, as far as the problem
/// has them. Pressures and stresses of the wall are those of the instant that the case chooses, t_{n-1+alpha_f} or t_n,
/// all else belongs to t_n.
class OutputFields {
 public:
  /// `problem` must outlive this.
  OutputFields(const coupling::Problem& problem, const case_file::Case& c);

  /// Collective. Throws as ResultsWriter::write.
  void write(distributed::ResultsWriter& writer, std::int64_t step, double time, const coupling::State& state);

  /// A quantity [SI] of `state` in a region, by its key, whether or not the case asks for it. Throws InputError for a
  /// key or region that there is not, and where the region has no such quantity. Collective.
  quantities::Table table(const std::string& key, const std::string& region, const coupling::State& state);

 private:
  /// Calls see(state, wall) with fields of the instant that results show.
  template <class See>
  auto at_instant(const coupling::State& state, const See& see) const;
  void write_instant(distributed::ResultsWriter& writer, std::int64_t step, double time, const coupling::State& state,
                     const coupling::FieldsView& wall);

  const coupling::Problem& problem_;
  case_file::OutputUnits units_;
  bool at_end_ = false, moves_ = true;
  std::vector<quantities::InsideTriangle> inside_;
  std::vector<const quantities::Quantity*> chosen_;
};

}  // namespace tunica::artifacts
