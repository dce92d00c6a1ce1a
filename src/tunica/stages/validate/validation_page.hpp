// What came of the benchmarks, as a page and as tables.
#pragma once

#include "tunica/stages/validate/benchmark.hpp"

namespace tunica::stages::validate {

struct Finding {
  Benchmark benchmark;
  Variant variant;
  std::vector<double> values{};  ///< in the order of the references, on rank 0; empty: the run failed
  std::optional<Plot> plot{};
  std::string failure{};
  bool reused = false;  ///< results were there already
  double seconds = 0;
  std::int64_t nodes = 0, elements = 0, steps = 0;
  double step = 0;  ///< s; 0: static

  /// Deviation of a figure, relative as its reference says.
  double deviation(std::size_t figure) const;
  double tolerance(std::size_t figure) const;
  bool judged(std::size_t figure) const;
  bool passed(std::size_t figure) const;  ///< within its tolerance, or not judged
  bool passed() const;
  std::string verdict() const;  ///< "passed", "missed" or "not judged"
};

/// "u_x of the tip: 2.27e-05 m, reference 2.27e-05, 0.12 % (1 % allowed): passed".
std::string line(const Finding& finding, std::size_t figure);

/// Writes validation.html, validation.csv and validation.json. Throws SolverError when a file cannot be written. Not
/// collective.
void write_page(const std::filesystem::path& folder, const std::vector<Finding>& findings);

}  // namespace tunica::stages::validate
