// From a case to the problem that it poses.
#pragma once

#include "tunica/case/case.hpp"
#include "tunica/coupling/probes.hpp"
#include "tunica/coupling/problem.hpp"

namespace tunica::artifacts {

coupling::ProblemInput problem_input(const case_file::Case& c);

/// The points whose values the case wants recorded.
std::vector<coupling::ProbePlace> probe_places(const case_file::Case& c);

}  // namespace tunica::artifacts
