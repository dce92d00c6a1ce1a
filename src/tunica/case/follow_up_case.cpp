#include "tunica/case/follow_up_case.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>

#include "tunica/case/descriptions.hpp"
#include "tunica/case/keys.hpp"

namespace tunica::case_file {

namespace {

using config::Problems;
using config::Schema;

Schema<Scan> scan_schema() {
  return Schema<Scan>("scan", "What one scan shows, and when it was taken.")
      .text("date", &Scan::date, "Day, as in 2024-05-31")
      .file("case", &Scan::case_file,
            "Case file of this scan, whose results stay where they are; in place of `geometry`")
      .section("geometry", &Scan::geometry, meshing::geometry_schema(),
               "Surfaces, labels or parameters in the place of those of the common `case`")
      .check([](const Scan& s, Problems& problems) {
        if (!day_of(s.date))
          problems.add("date", fmt::format("`{}` is no day", s.date), "write year, month and day, as in 2024-05-31");
        if (s.case_file.has_value() == s.geometry.has_value())
          problems.add("", s.case_file ? "has both `case` and `geometry`" : "has neither `case` nor `geometry`",
                       "give one of them");
      });
}

void check_scans(const FollowUpCase& f, Problems& problems) {
  check_keys("scans", f.scans, "scan", problems);
  if (f.scans.size() < 2) problems.add("scans", "are fewer than two", "add a scan with its date");
  for (std::size_t k = 0; k < f.scans.size(); ++k) {
    const auto& [name, scan] = f.scans[k];
    if (scan.geometry && !f.case_file)
      problems.add("scans." + name, "has a geometry, but there is no `case` that says how it is meshed",
                   "add `case`, a case file with the section `mesh`");
    const auto day = day_of(scan.date), before = k > 0 ? day_of(f.scans[k - 1].second.date) : std::nullopt;
    if (day && before && *day <= *before)
      problems.add(fmt::format("scans.{}.date", name),
                   fmt::format("{} is not after {}, the date of {}", scan.date, f.scans[k - 1].second.date,
                               f.scans[k - 1].first),
                   "give the scans in order of time; are two dates swapped?");
  }
}

}  // namespace

std::optional<int> day_of(const std::string& date) {
  int year = 0, month = 0, day = 0, length = 0;
  if (date.size() != 10 || std::sscanf(date.c_str(), "%4d-%2d-%2d%n", &year, &month, &day, &length) != 3 ||
      length != 10 || month < 1 || day < 1)
    return std::nullopt;
  const std::chrono::year_month_day found(std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                          std::chrono::day(static_cast<unsigned>(day)));
  if (!found.ok()) return std::nullopt;
  return static_cast<int>(std::chrono::sys_days(found).time_since_epoch().count());
}

Schema<FollowUpCase> FollowUpCase::schema() {
  return Schema<FollowUpCase>("follow_up", "Scans of one patient over the years.")
      .text("title", &FollowUpCase::title, "Of the page of results")
      .by_default()
      .file("case", &FollowUpCase::case_file,
            "The case file that scans with a `geometry` share: its `mesh` says how finely they are meshed, all of it "
            "what is computed with --run")
      .map("scans", &FollowUpCase::scans, scan_schema(), "Scans by name, in order of their dates")
      .quantity("spacing", &FollowUpCase::spacing, config::dimension::length, config::range(1e-3, 30e-3),
                "Of the sections along the aorta")
      .by_default()
      .path("output", &FollowUpCase::output, "Folder of the results, relative to that of the file")
      .by_default("follow_up")
      .check(check_scans);
}

config::Parsed<FollowUpCase> read_follow_up_case(const std::filesystem::path& file) {
  return config::parse_file(FollowUpCase::schema(), file);
}

std::shared_ptr<const config::Description> follow_up_description() { return FollowUpCase::schema().description(); }

}  // namespace tunica::case_file
