// From a case to the problem that it poses.
#pragma once

#include "tunica/coupling/problem.hpp"
#include "tunica/stages/case.hpp"

namespace tunica::stages {

coupling::ProblemInput problem_input(const Case& c);

}  // namespace tunica::stages
