// What a run says of itself while it goes on and at its end.
#include <cmath>

#include "tunica/artifacts/answer.hpp"
#include "tunica/config/units.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/stages/run/run_in_steps.hpp"

namespace tunica::stages {

using coupling::StepReport;

std::string Run::time_text(double t) const {
  if (is_static()) return fmt::format("{:.6g} of the load", t);
  return fmt::format("{:.6g} {}", t / time_unit_, case_.output.units.time);
}

std::string Run::step_line(const StepReport& report, double dt) const {
  const double first = report.iterations.empty() ? report.final_norm : report.iterations[0].norm;
  return fmt::format("step {}/{}  t {}  newton {}  linear {}  norm {:.2e} -> {:.2e}  dt {}  {:.2f} s",
                     grid_.on_grid() ? grid_.steps_done() : grid_.steps_done() + 1, last_step(),
                     time_text(grid_.time()), report.iterations.size(), report.linear_iterations(), first,
                     report.final_norm, time_text(dt), report.timings.total);
}

/// "  tears +12.3 -4.5 ml/s": into the false lumen; empty without tears.
std::string Run::tears_text(const coupling::StepRecord& record) const {
  if (!record.lumens || record.lumens->tear_flows.empty()) return {};
  const std::string& unit = case_.output.units.flow;
  std::string text = "  tears";
  for (const double flow : record.lumens->tear_flows)
    text += fmt::format(" {:+.3g}", flow / config::unit_factor(unit, config::dimension::volume_flow));
  return text + " " + unit;
}

/// "step 40/80  t 0.2 s  3.1 steps/s"
std::string Run::progress_note(std::int64_t end, double seconds, std::int64_t since) const {
  const double rate = seconds > 0 ? static_cast<double>(grid_.steps_done() - since) / seconds : 0;
  const auto speed =
      rate >= 1 || rate <= 0 ? fmt::format("{:.3g} steps/s", rate) : fmt::format("{:.3g} s/step", 1 / rate);
  return fmt::format("step {}/{}  t {}  {}", grid_.steps_done(), end, time_text(grid_.time()), speed);
}

double Run::planned_time() const {
  const auto end = static_cast<double>(end_step());
  return is_static() ? end / static_cast<double>(last_step()) : end * case_.time->step;
}

// Least, mean and largest pressure and flow of each opening over the last cycle, or over the whole run.
void Run::tell_answer() {
  if (!case_.solves_fluid() || is_static()) return;
  const double from = case_.time->cycles ? (grid_.time() - case_.time->cycles->period) / time_unit_ : -HUGE_VAL;
  std::vector<std::string> faces;
  for (const auto& face : mesh_.faces)
    if (mesh_.regions[static_cast<std::size_t>(face.region)].kind == mesh::RegionKind::lumen)
      faces.push_back(face.name);
  on_disk([&] {
    parallel::on_root(comm_, [&] {
      const auto lines = artifacts::answer_lines(folder_ / "faces.csv", openings(case_, faces), from);
      if (lines.empty()) return;
      log_->heading(case_.time->cycles ? "last cycle: least, mean, largest" : "whole run: least, mean, largest");
      for (const auto& line : lines) log_->info(line);
    });
  });
}

void Run::tell_dissipation(double from, double until) {
  if (!case_.solves_fluid()) return;
  told_dissipation_ = true;
  on_disk([&] {
    parallel::on_root(comm_, [&] {
      progress_.dissipation = artifacts::read_dissipation(folder_, from, until, case_.elements);
      if (!progress_.dissipation) return;
      log_->info(artifacts::describe(*progress_.dissipation));
      if (const auto warning = artifacts::warning_of(*progress_.dissipation)) log_->warning(*warning);
    });
  });
}

void Run::tell_dissipation_of_run() {
  if (is_static() || told_dissipation_) return;
  const auto per_cycle = case_.time->cycles ? case_.time->steps_per_cycle() : 0;
  const auto cycle = per_cycle > 0 ? grid_.steps_done() / per_cycle : 0;
  if (cycle == 0) return tell_dissipation(-HUGE_VAL, grid_.time());
  const double period = case_.time->cycles->period;
  tell_dissipation(static_cast<double>(cycle - 1) * period, static_cast<double>(cycle) * period);
}

}  // namespace tunica::stages
