// The page of an identification.
#pragma once

#include <string>

#include "tunica/pipeline/identify_results.hpp"

namespace tunica::pipeline {

/// HTML: the values with their intervals, what is not determined, misfits, measured curves with those of the first and
/// the best run, and all runs.
std::string identify_page(const IdentifyPlan& plan, const Identified& found);

}  // namespace tunica::pipeline
