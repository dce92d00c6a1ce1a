// The figures that post.json holds, by path: what computations are compared by.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace tunica::pipeline {

/// Patterns of the figures that are looked at unless others are asked for, as paths in post.json with names in place of
/// numbers of a list.
const std::vector<std::string>& default_quantities();

/// Does a path fit one of the patterns?
bool fits_any(const std::vector<std::string>& patterns, const std::string& path);

/// Throws SolverError where a file of a stage does not read. Not collective, as all here.
nlohmann::json read_json(const std::filesystem::path& file);

/// The number, or null where it is not finite, for which JSON has no word.
nlohmann::ordered_json finite_or_null(double value);

/// For readers, with four significant digits; "–" for one that is not finite.
std::string figure_text(double value);

/// A text as a cell of a table: in one line, and in quotes where spreadsheets need them.
std::string csv_cell(std::string text);

/// Every number of post.json by its path, entries of lists by their name or their number from 1.
std::map<std::string, double> figures_in(const nlohmann::json& post);
std::map<std::string, double> read_figures(const std::filesystem::path& post_json);

}  // namespace tunica::pipeline
