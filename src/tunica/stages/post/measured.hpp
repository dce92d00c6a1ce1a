// What was measured beside what is computed: the section `measured` of a case.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tunica/analysis/field_series.hpp"
#include "tunica/analysis/figure_table.hpp"
#include "tunica/case/measured_settings.hpp"
#include "tunica/flow_imaging/cross_section.hpp"
#include "tunica/stages/post/findings.hpp"

namespace tunica::stages::post {

/// Sections of the planes that measurements name, each with the name of its measurement.
using MeasuredSections = std::vector<std::pair<std::string, flow_imaging::CrossSection>>;

/// Throws InputError with all openings that the lumen does not have and all planes that miss it.
MeasuredSections find_measured_sections(const case_file::MeasuredCase& measured, const case_file::Case& c,
                                        const mesh::MeshData& data);

/// Area, flow and pressure of the sections in one frame, for the table of figures.
void add_sections(const MeasuredSections& sections, const analysis::FieldFrame& frame,
                  const std::vector<double>& mesh_velocity, analysis::FigureTable::Row& row);

/// Compares each measurement with what is computed in the window. Writes measured_<name>.csv and .svg into the folder
/// and adds their names to `files`. Returns the list `measured` of post.json. A measured time t is that of the window t
/// after its start, round its length. Throws InputError when points.csv of the run lacks a point.
nlohmann::ordered_json compare_measured(const Findings& f, const case_file::MeasuredCase& measured,
                                        const std::filesystem::path& folder, nlohmann::ordered_json& files);

/// The list as lines of text.
std::string measured_text(const nlohmann::ordered_json& list);

}  // namespace tunica::stages::post
