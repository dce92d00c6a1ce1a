// What the points of a study have found, and its table.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tunica/pipeline/study_plan.hpp"

namespace tunica::pipeline {

/// A line of the table.
struct PointResult {
  PointState state;
  double seconds = 0;                       ///< of all its stages, shared ones included
  std::map<std::string, double> figures{};  ///< by path in post.json; of points that are done
};
/// Not collective, as what follows.
std::vector<PointResult> read_results(const StudyPlan& plan);

/// Writes study.csv, study.json and study.html into the folder of results. Returns lines on what was found: how many
/// points ended how, errors of those that failed, patterns that fit no figure.
std::vector<std::string> write_study(const StudyPlan& plan, const std::vector<PointResult>& results);

}  // namespace tunica::pipeline
