// Is a run periodic? Cycle by cycle comparison of the histories of its openings (docs/theory.md, section 7).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/artifacts/histories.hpp"
#include "tunica/case/case.hpp"

namespace tunica::stages {

/// How a cycle differs from the one before; relative to the largest pressure and flow of the opening in it.
struct CycleChange {
  int cycle = 0;  ///< the first is 1, and differs from none
  double pressure =
      0;  ///< largest change of mean, largest and smallest value; infinite where the histories begin later
  double flow = 0;

  bool below(double tolerance) const { return cycle > 1 && pressure < tolerance && flow < tolerance; }
};

/// A line for the log.
std::string describe(const CycleChange& change, const coupling::CycleSettings& settings);

/// Lumen faces that blood passes: neither interface nor no-slip.
std::vector<std::string> openings(const case_file::Case& c, const std::vector<std::string>& lumen_faces);

/// cycles.csv: mean, largest and smallest pressure and flow of every opening in each cycle, and how they change. All of
/// it comes from faces.csv and steps.csv, so that a restart needs nothing else. Not collective: for one rank.
class Cycles {
 public:
  /// Throws as CsvTable.
  Cycles(const std::filesystem::path& folder, const case_file::Case& c, std::vector<std::string> openings,
         std::optional<std::int64_t> continue_from);

  /// What the histories say of a cycle that has ended. Throws InputError when they cannot be read.
  CycleChange compare(int cycle) const;
  /// The same, and adds it to the table; `step`: accepted steps so far.
  CycleChange append(int cycle, std::int64_t step);
  /// Does the table that is continued hold the cycle that ended with this step?
  bool has(std::int64_t step) const { return table_.last_step() == step; }
  /// What was found wrong with the table that is continued.
  const std::vector<std::string>& damage() const { return table_.damage(); }

 private:
  struct Range {
    double mean = 0, high = 0, low = 0;
    double largest() const;
  };
  struct Opening {
    Range pressure, flow;
  };
  /// Empty when the histories do not hold the whole cycle.
  std::vector<Opening> measure(int cycle) const;
  CycleChange compare(int cycle, const std::vector<Opening>& present) const;

  std::filesystem::path folder_;
  std::vector<std::string> openings_;
  case_file::OutputUnits units_;
  double period_;  ///< in the unit of the histories
  artifacts::CsvTable table_;
};

}  // namespace tunica::stages
