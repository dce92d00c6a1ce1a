#include "tunica/stages/report/measured_part.hpp"

#include <fmt/format.h>

#include "tunica/drawing/page.hpp"

namespace tunica::stages::report {

std::string measured_part(const Results& r) {
  if (!r.post.is_object() || !r.post.contains("measured")) return "";
  using drawing::page::escaped;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::pair<std::string, std::string>> plots;
  for (const auto& m : r.post["measured"]) {
    const auto name = escaped(m.value("name", "")), unit = escaped(m.value("unit", ""));
    for (const auto& row : m["rows"])
      rows.push_back(
          {fmt::format("{}, {} {} [{}]", name, escaped(m.value("quantity", "")), escaped(row.value("what", "")), unit),
           escaped(m.value("place", "")), figure(row["measured"]), figure(row["deviation"], 2), figure(row["computed"]),
           figure(row["difference"], 3), figure(row["difference_in_deviations"], 2),
           escaped(row.value("verdict", ""))});
    plots.emplace_back(m.value("plot", ""), fmt::format("{} ({}): measured, with one standard deviation, and computed",
                                                        name, escaped(m.value("place", ""))));
  }
  return "<h2 id=\"measured\">Held against measurements</h2>\n" +
         drawing::page::table(
             {"quantity", "place", "measured", "± one deviation", "computed", "difference", "in deviations", "verdict"},
             rows,
             "agrees: within two standard deviations of the measurement; doubtful: within three; "
             "differs: beyond") +
         drawings(r.folder("post"), plots);
}

}  // namespace tunica::stages::report
