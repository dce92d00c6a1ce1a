#include "tunica/artifacts/outlets_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/case/plausible.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::artifacts {

namespace fs = std::filesystem;
using config::Schema;

namespace {

struct OutletsFile {
  double systolic = 0, diastolic = 0, distal_share = 0, distal_pressure = 0;
  std::vector<std::pair<std::string, double>> fractions;
  std::vector<std::pair<std::string, bc::Condition>> boundary;
};

Schema<OutletsFile> outlets_file_schema() {
  const auto share = Schema<double>("fraction", "Share of the mean outflow.")
                         .number(
                             "share", [](double& s) -> double& { return s; }, config::range(1e-6, 1), "Share")
                         .shorthand("share");
  return Schema<OutletsFile>("outlets", "Tuned outlets.")
      .quantity("systolic", &OutletsFile::systolic, config::dimension::pressure, config::above(0), "Target")
      .quantity("diastolic", &OutletsFile::diastolic, config::dimension::pressure, config::above(0), "Target")
      .number("distal_share", &OutletsFile::distal_share, config::between(0, 1), "R_d / (R_p + R_d)")
      .quantity("distal_pressure", &OutletsFile::distal_pressure, config::dimension::pressure, config::at_least(0),
                "Behind all outlets")
      .map("fractions", &OutletsFile::fractions, share, "Shares of the mean outflow")
      .map("boundary", &OutletsFile::boundary, bc::condition_schema(), "The outlets");
}

constexpr const char* tune_again = "find the outlets anew: `tunica tune case.yaml --overwrite`";

bool differ(double a, double b) { return std::abs(a - b) > 1e-6 * std::max(std::abs(a), std::abs(b)); }

std::vector<Problem> check_targets(const OutletsFile& found, const fs::path& file, const case_file::TuningCase& asked) {
  std::vector<Problem> problems;
  const auto compare = [&](const char* what, double in_file, double in_case, double unit, const char* unit_name) {
    if (differ(in_file, in_case))
      problems.push_back({file.string(),
                          fmt::format("was tuned for {} {:.6g}{}, the case asks for {:.6g}{}", what, in_file / unit,
                                      unit_name, in_case / unit, unit_name),
                          tune_again});
  };
  const double mmHg = config::unit_factor("mmHg", config::dimension::pressure);
  compare("a systolic pressure of", found.systolic, asked.systolic, mmHg, " mmHg");
  compare("a diastolic pressure of", found.diastolic, asked.diastolic, mmHg, " mmHg");
  compare("a distal_share of", found.distal_share, asked.distal_share, 1, "");
  compare("a distal_pressure of", found.distal_pressure, asked.distal_pressure, mmHg, " mmHg");
  std::vector<std::string> in_file, in_case;
  for (const auto& [face, share] : found.fractions) in_file.push_back(face);
  for (const auto& [face, share] : asked.fractions) in_case.push_back(face);
  if (in_file != in_case)
    problems.push_back(
        {file.string(),
         fmt::format("has the outlets {}, the case has {}", files::listed(in_file), files::listed(in_case)),
         tune_again});
  else
    for (std::size_t k = 0; k < in_case.size(); ++k)
      compare(("a fraction at " + in_case[k] + " of").c_str(), found.fractions[k].second, asked.fractions[k].second, 1,
              "");
  return problems;
}

}  // namespace

void write_outlets(const fs::path& file, const case_file::TuningCase& outlets, const TunedOutlets& found) {
  std::string text =
      "# Outlets found by `tunica tune`, for `tunica run`: what they were tuned for, and the conditions.\n";
  text +=
      fmt::format("systolic: {:.12g} Pa\ndiastolic: {:.12g} Pa\ndistal_share: {:.12g}\ndistal_pressure: {:.12g} Pa\n",
                  outlets.systolic, outlets.diastolic, outlets.distal_share, outlets.distal_pressure);
  text += "fractions:\n";
  for (const auto& [face, share] : outlets.fractions) text += fmt::format("  {}: {:.12g}\n", face, share);
  text += "boundary:\n";
  for (const auto& [face, rcr] : found)
    text += fmt::format(
        "  {}: {{rcr: {{proximal: {:.12g} Pa s/m^3, capacitance: {:.12g} m^3/Pa, distal: {:.12g} Pa s/m^3, "
        "distal_pressure: {:.12g} Pa, initial_pressure: {:.12g} Pa}}}}\n",
        face, rcr.proximal, rcr.capacitance, rcr.distal, rcr.distal_pressure,
        rcr.initial_pressure.value_or(rcr.distal_pressure));
  files::write_atomically(file, text);
}

TunedOutlets parse_outlets(const std::string& text, const fs::path& file, const case_file::TuningCase& outlets,
                           std::vector<Problem>* warnings) {
  const config::Origin origin{.name = file.string(), .folder = file.parent_path(), .check_files = false};
  const auto parsed = config::parse_text(outlets_file_schema(), text, origin);
  const OutletsFile& found = parsed.value;
  if (warnings) warnings->insert(warnings->end(), parsed.warnings.begin(), parsed.warnings.end());
  std::vector<Problem> problems = check_targets(found, file, outlets);
  TunedOutlets tuned;
  for (const auto& [face, share] : outlets.fractions) {
    const auto entry =
        std::find_if(found.boundary.begin(), found.boundary.end(), [&](const auto& b) { return b.first == face; });
    const auto* rcr = entry == found.boundary.end() ? nullptr : std::get_if<bc::Rcr>(&entry->second);
    if (rcr)
      tuned.emplace_back(face, *rcr);
    else if (problems.empty())
      problems.push_back({file.string() + ": boundary." + face, "is no rcr condition", tune_again});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return tuned;
}

void set_outlets(case_file::Case& c, const TunedOutlets& tuned) {
  for (const auto& [face, rcr] : tuned)
    for (auto& [name, condition] : c.boundary)
      if (name == face) condition = rcr;
}

std::vector<Problem> unusual_outlets(case_file::Case c) {
  std::vector<Problem> warnings;
  if (!c.outlets || !fs::exists(c.outlets->file())) return warnings;
  const fs::path file = c.outlets->file();
  set_outlets(c, parse_outlets(config::read_text(file), file, *c.outlets, &warnings));
  for (auto& odd : case_file::implausible_outlets(c)) {
    odd.where = fmt::format("{}: {}", file.string(), odd.where);
    warnings.push_back(std::move(odd));
  }
  return warnings;
}

std::string take_tuned_outlets(MPI_Comm comm, case_file::Case& c) {
  std::string text;
  if (!c.outlets) return text;
  const fs::path file = c.outlets->file();
  text = parallel::on_root(comm, [&] {
    if (!fs::exists(file))
      throw InputError(file.string(), "the tuned outlets are missing", "find them first: `tunica tune case.yaml`");
    return config::read_text(file);
  });
  parallel::broadcast(comm, text);
  set_outlets(c, parse_outlets(text, file, *c.outlets));
  return text;
}

}  // namespace tunica::artifacts
