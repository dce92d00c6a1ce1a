#include "tunica/stages/import/early_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "tunica/base/text.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/csv_file.hpp"

namespace tunica::stages {

void write_early_table(const std::filesystem::path& from, double seconds, const std::filesystem::path& target) {
  const auto lines = files::read_lines(from, "give a table of times and values");
  const bool series = text::lower(from.extension().string()) == ".fcs";
  std::string text;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    std::istringstream words{std::string(lines[n].text)};
    std::string word;
    for (int k = 0; words >> word; ++k) {
      word = text::decimal_exponent(word);
      if (k == 0 && (series ? n == 0 : n > 0))
        word = fmt::format(
            "{}", files::parse_number(word, fmt::format("{}:{}", from.string(), lines[n].number), "") - seconds);
      text += (k == 0 ? "" : " ") + word;
    }
    text += "\n";
  }
  files::write_atomically(target, text);
}

}  // namespace tunica::stages
