// The table and the page of a what-if.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tunica/pipeline/what_if_plan.hpp"

namespace tunica::pipeline {

/// Writes what_if.csv and what_if.html into the folder of results, from the figures of the case and of its variants;
/// returns a line for the terminal. `remarks`: what was done to the mesh of a variant, by its name. Throws SolverError
/// where figures do not read. Not collective.
std::string write_what_if(const WhatIfPlan& plan, const Chain& chain,
                          const std::map<std::string, std::vector<std::string>>& remarks);

}  // namespace tunica::pipeline
