// The page of a study.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tunica/analysis/sensitivity.hpp"
#include "tunica/pipeline/study_results.hpp"

namespace tunica::pipeline {

/// A figure over all points.
struct Quantity {
  std::string path;
  std::vector<double> values;              ///< one for each point; NaN where there is none
  std::vector<double> rank_correlation{};  ///< with each key, for sampled designs; else empty
  std::optional<analysis::SobolIndices> indices{};
};

/// "Latin hypercube of 16 points, seed 1".
std::string design_text(const case_file::Design& design);

/// HTML: the points in a table, what each quantity follows most, and a plot of each over each key.
std::string study_page(const StudyPlan& plan, const std::vector<Quantity>& quantities,
                       const std::vector<PointResult>& results);

}  // namespace tunica::pipeline
