// From the file of a study to a case file for each of its points.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/case/study_case.hpp"
#include "tunica/pipeline/point.hpp"

namespace tunica::pipeline {

struct StudyPlan {
  case_file::StudyCase study;
  std::filesystem::path file;    ///< of the study
  std::filesystem::path output;  ///< folder of results
  std::vector<case_file::VariedAxis> axes;
  std::vector<case_file::StudyPoint> points;
  std::vector<PointCase> cases;  ///< one for each point

  std::string name_of(std::size_t point) const;  ///< "point 3 (wall.density = 1100 kg/m^3)"
};

/// `output`: instead of the folder that the file names. Stages up to `outlets` whose settings are the same in several
/// points lie in one folder, shared/<stage>_<first point>. Writes nothing. Throws InputError with all that is wrong in
/// the file and in the cases of all points, as far as their keys and values tell. Not collective, as all here.
StudyPlan plan_study(const std::filesystem::path& file, const std::optional<std::filesystem::path>& output);

/// Writes the case files of these points (numbers from 0) and looks at each as `tunica run` would before its first
/// stage. Throws InputError with the problems of all.
void write_and_check_cases(const StudyPlan& plan, const std::vector<std::size_t>& points, CaseFiles& cases);

}  // namespace tunica::pipeline
