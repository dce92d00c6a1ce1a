// Findings as JSON and as text for the screen. docs/post.md describes the layout.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tunica/base/units.hpp"
#include "tunica/stages/post/findings.hpp"

namespace tunica::stages::post {

nlohmann::ordered_json report_json(const Findings& f);

/// A summary of that report.
std::string report_text(const nlohmann::ordered_json& report);

}  // namespace tunica::stages::post
