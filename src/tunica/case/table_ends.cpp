#include "tunica/case/table_ends.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/case/face_patterns.hpp"

namespace tunica::case_file {

namespace {

constexpr double round_off = 1e-9;  ///< of the span of a table, which its evaluation allows as well

/// The table of a condition that ends; none for another one.
const bc::TableSource* ending_table(const bc::Condition& condition) {
  const bc::WaveformInput* course = nullptr;
  if (const auto* flow = std::get_if<bc::Flow>(&condition)) course = &flow->course;
  if (const auto* pressure = std::get_if<bc::Pressure>(&condition)) course = &pressure->pressure;
  if (const auto* velocity = std::get_if<bc::Velocity>(&condition)) course = &velocity->course;
  if (const auto* profile = std::get_if<bc::VelocityProfile>(&condition)) course = &profile->course;
  if (const auto* traction = std::get_if<bc::Traction>(&condition)) course = &traction->course;
  if (const auto* moved = std::get_if<bc::Displacement>(&condition)) course = &moved->course;
  const auto* table = course != nullptr ? std::get_if<bc::TableSource>(&course->source) : nullptr;
  return table != nullptr && !table->options.periodic ? table : nullptr;
}

void check_table(const std::string& where, const bc::TableSource& source, const AskedTime& asked,
                 std::vector<Problem>& problems) {
  const auto times = bc::read_table(source.file).times;
  const double begin = times.front(), end = times.back(), slack = round_off * (end - begin);
  const std::string table = source.file.path.string();
  if (end + slack < asked.end && !source.options.hold)
    problems.push_back({where,
                        fmt::format("the table {} ends at {:.9g} s, {} at {:.9g} s", table, end, asked.by, asked.end),
                        "give a table that spans the whole time, end earlier, or set `periodic: true` (it repeats) or "
                        "`hold: true` (its "
                        "last value holds)"});
  if (begin - slack > asked.first)
    problems.push_back(
        {where, fmt::format("the table {} begins at {:.9g} s, {} at {:.9g} s", table, begin, asked.by, asked.begin),
         "give a table that spans the whole time, or set `periodic: true`"});
}

}  // namespace

AskedTime asked_by_run(const Case& c) {
  if (const auto* statics = std::get_if<StaticWall>(&c.analysis))
    return {statics->load_time, statics->load_time, statics->load_time, "the load is that"};
  const auto steps = c.time->most_steps();
  const std::string by =
      c.time->cycles ? fmt::format("the run ({} cycles of {:.9g} s)", c.time->cycles->most, c.time->cycles->period)
                     : fmt::format("the run ({} steps of {:.9g} s)", steps, c.time->step);
  // Loads of a step belong to its middle or later.
  return {0.0, static_cast<double>(steps) * c.time->step, 0.5 * c.time->step, by};
}

AskedTime asked_by_prestress(const Case& c) {
  const double time = c.prestress.value().load_time;
  return {time, time, time, "the prestress asks for its value (load_time)"};
}

std::vector<Problem> check_table_ends(const std::vector<std::pair<std::string, bc::Condition>>& conditions,
                                      const AskedTime& asked) {
  std::vector<Problem> problems;
  for (const auto& [face, condition] : conditions) {
    const bc::TableSource* table = ending_table(condition);
    if (table == nullptr) continue;
    try {
      check_table("boundary." + face, *table, asked, problems);
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  return problems;
}

std::vector<std::pair<std::string, bc::Condition>> conditions_on(
    const std::vector<std::pair<std::string, bc::Condition>>& conditions, const std::vector<std::string>& faces) {
  std::vector<std::pair<std::string, bc::Condition>> found;
  for (const auto& condition : conditions)
    if (std::any_of(faces.begin(), faces.end(), [&](const auto& face) { return matches(condition.first, face); }))
      found.push_back(condition);
  return found;
}

}  // namespace tunica::case_file
