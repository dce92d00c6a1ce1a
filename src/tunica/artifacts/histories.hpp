// Histories of a run: tables in CSV files that gain a line with every step.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tunica/bc/outlets.hpp"
#include "tunica/case/case.hpp"
#include "tunica/config/units.hpp"
#include "tunica/coupling/monitors.hpp"
#include "tunica/coupling/probes.hpp"
#include "tunica/files/csv_file.hpp"

namespace tunica::artifacts {

/// What to do where a history does not read.
inline constexpr const char* history_remedy = "it is a history of the run: put it back, or begin anew with --overwrite";

/// A place where the steps of a history do not follow each other.
struct HistoryBreak {
  std::size_t line;  ///< number of the line of numbers after it, from 0
  std::string what;  ///< "the lines of steps 4 to 6 are missing"
};
/// Lost and doubled lines of a history that has one for every step.
std::vector<HistoryBreak> breaks_of(const files::CsvColumns& history);

/// Column "name [unit]" of a history in SI. Throws InputError where there is none.
std::vector<double> si_column(const files::CsvColumns& table, const std::string& name, const config::Dimension& due);

/// One CSV file. The first column is the number of the step, an integer. Not collective: for one rank.
class CsvTable {
 public:
  enum class Lines { for_every_step, for_some_steps };

  /// Begins the file anew, or with `continue_from` keeps the lines up to that step; those that are no numbers or repeat
  /// a step are dropped. `columns` after the first one, with their units. Throws InputError when the file cannot be
  /// written or is to be continued and has other columns.
  CsvTable(const std::filesystem::path& file, std::vector<std::string> columns,
           std::optional<std::int64_t> continue_from, Lines lines = Lines::for_some_steps);

  /// What was found wrong with the lines that are kept: one damaged, repeated or missing, with its place.
  const std::vector<std::string>& damage() const { return damage_; }
  /// Of the lines that are kept; none when there is no line.
  std::optional<std::int64_t> first_step() const { return first_step_; }
  std::optional<std::int64_t> last_step() const { return last_step_; }
  const std::filesystem::path& file() const { return file_; }

  /// Adds a line, whole or not at all. Throws SolverError when that fails: also when the file was moved or removed
  /// meanwhile.
  void append(std::int64_t step, std::span<const double> values);

  /// Brings all lines to the disk. Throws SolverError when that fails.
  void sync() const;

 private:
  std::vector<std::string> damage_;
  std::optional<std::int64_t> first_step_, last_step_;
  std::filesystem::path file_;
  std::size_t columns_;
};

/// A history with a line for every step. The folder of a version that did not write it is continued: it begins with
/// the restart then, which `told` says. Throws as CsvTable.
CsvTable later_history(const std::filesystem::path& file, std::vector<std::string> columns,
                       std::optional<std::int64_t> continue_from, std::vector<std::string>& told);

/// What one accepted step leaves in the histories.
struct StepHistory {
  std::int64_t step = 0;  ///< accepted steps so far, parts of steps counted
  double time = 0;        ///< at the end of the step [s]
  double dt = 0;          ///< [s]
  double evaluated = 0;   ///< time that `record` belongs to [s]
  coupling::StepRecord record;
  coupling::StepReport report;
  std::vector<coupling::ProbeRecord> points{};  ///< at the end of the step, in the order of the case
  std::optional<std::vector<coupling::FaceRecord>> faces_at_end{};  ///< for faces.csv, in the place of `record.faces`
};

/// The histories of a run, in the units of the case:
/// - faces.csv: flow, mean pressure and area of each lumen face, at the instant that the case chooses;
/// - inflows.csv: prescribed and actual flow of each face with a `flow`;
/// - outlets.csv: flow, pressure and stored pressure of each resistance and RCR outlet, at the end of the step;
/// - balance.csv: volumes, energies, powers, and what is left of the balances of mass and interface power;
/// - points.csv: displacement, velocity and pressure at the points of the case, at the end of the step;
/// - forces.csv: force of the blood on the faces that it sticks to, where the case wants it;
/// - steps.csv: iterations, norms and seconds of each step.
/// Files that the analysis has nothing for are not made. In statics the load factor stands for the time.
class Histories {
 public:
  /// Not collective; `faces`: lumen faces in the order of the mesh. Throws as CsvTable.
  Histories(const std::filesystem::path& folder, const case_file::Case& c, const std::vector<std::string>& faces,
            const std::vector<bc::Outlet>& outlets, std::optional<std::int64_t> continue_from);

  void append(const StepHistory& step, const std::vector<bc::Outlet>& outlets);
  /// As CsvTable::sync, for all of them.
  void sync() const;

  /// What was found wrong with the histories that are continued.
  std::vector<std::string> damage() const;

  /// All files of histories that a run may write, those of other classes included.
  static std::vector<std::string> files() {
    return {"faces.csv",  "outlets.csv", "balance.csv",     "steps.csv",   "cycles.csv", "points.csv",
            "forces.csv", "lumens.csv",  "dissipation.csv", "lumens.json", "inflows.csv"};
  }

 private:
  struct Factors {
    double time, area, volume, flow, pressure, length, velocity;
  };
  std::vector<double> balance_line(const StepHistory& step) const;
  void open_points_and_forces(const std::filesystem::path& folder, const case_file::Case& c,
                              const std::vector<std::string>& faces, std::optional<std::int64_t> continue_from);
  void append_points_and_forces(const StepHistory& step);
  void open_inflows(const std::filesystem::path& folder, const case_file::Case& c,
                    const std::vector<std::string>& faces, std::optional<std::int64_t> continue_from);
  void append_inflows(const StepHistory& step);

  Factors per_si_;
  std::optional<CsvTable> faces_, outlets_, balance_, steps_, points_, forces_, inflows_;
  std::vector<std::string> begun_;  ///< what a continued run lacks
};

}  // namespace tunica::artifacts
