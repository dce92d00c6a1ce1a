// Numbers of several computations in one table: laws of `tunica compare`, variants of `tunica what-if`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tunica::pipeline {

/// A line of the table.
struct ComparedLine {
  std::string what, unit;
  std::vector<double> values;  ///< one for each computation; NaN where there is none
};

/// `stem`.csv: what, unit, a column for each computation. Throws SolverError where it cannot be written. Not
/// collective, as all here.
void write_compared_csv(const std::filesystem::path& file, const std::vector<std::string>& names,
                        const std::vector<ComparedLine>& lines);
/// The same as HTML, computations numbered from 1.
std::string compared_table(const std::vector<std::string>& names, const std::vector<ComparedLine>& lines);

}  // namespace tunica::pipeline
