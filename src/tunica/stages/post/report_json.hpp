// Findings as JSON and as text for the screen. docs/post.md describes the layout.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tunica/stages/post/findings.hpp"

namespace tunica::stages::post {

nlohmann::ordered_json report_json(const Findings& f);

/// A summary of that report.
std::string report_text(const nlohmann::ordered_json& report);

/// Units of the report and of the tables, in SI: they do not depend on those of the case.
namespace unit {
inline constexpr double mm = 1e-3, mm2 = 1e-6, ml = 1e-6, mmHg = 133.322387415, kPa = 1e3;
}

}  // namespace tunica::stages::post
