#include "tunica/pipeline/side_by_side.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tunica/drawing/page.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/pipeline/figures.hpp"

namespace tunica::pipeline {

namespace page = drawing::page;

void write_compared_csv(const std::filesystem::path& file, const std::vector<std::string>& names,
                        const std::vector<ComparedLine>& lines) {
  std::string csv = "what,unit";
  for (const auto& name : names) csv += "," + name;
  csv += "\n";
  for (const auto& line : lines) {
    csv += line.what + "," + line.unit;
    for (const double v : line.values) csv += fmt::format(",{:.10g}", v);
    csv += "\n";
  }
  files::write_atomically(file, csv);
}

std::string compared_table(const std::vector<std::string>& names, const std::vector<ComparedLine>& lines) {
  std::vector<std::string> head = {"", "unit"};
  for (std::size_t k = 0; k < names.size(); ++k) head.push_back(fmt::format("{}: {}", k + 1, page::escaped(names[k])));
  std::vector<std::vector<std::string>> rows;
  for (const auto& line : lines) {
    auto& cells = rows.emplace_back(std::vector<std::string>{page::escaped(line.what), line.unit});
    for (const double v : line.values) cells.push_back(figure_text(v));
  }
  return page::table(head, rows);
}

}  // namespace tunica::pipeline
