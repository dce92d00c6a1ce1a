#include "tunica/peer_cases/case_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tunica::peer_cases {

namespace {

constexpr std::size_t comment_column = 48;

struct Line {
  std::string text, comment;
};

void add_lines(const std::vector<CaseKey>& keys, std::size_t depth, std::vector<Line>& lines) {
  for (const CaseKey& key : keys) {
    const std::string indent(2 * depth, ' ');
    const std::string start = key.key.empty() ? "-" : yaml_text(key.key) + ":";
    lines.push_back({indent + start + (key.value.empty() ? "" : " " + key.value), key.source});
    add_lines(key.below, depth + 1, lines);
  }
}

}  // namespace

std::string yaml_text(const std::string& text) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+-";
  const bool letter = !text.empty() && (std::isalpha(static_cast<unsigned char>(text[0])) || text[0] == '.' ||
                                        text[0] == '/' || text[0] == '_');
  constexpr const char* words[] = {"true", "false", "null", "yes", "no", "on", "off", "y", "n", "."};
  std::string lower = text;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  const bool word = std::find(std::begin(words), std::end(words), lower) != std::end(words);
  if (letter && !word && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      quoted += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    else
      quoted += c;
  }
  return quoted + '"';
}

std::string yaml(const CaseKey& top) {
  std::vector<Line> lines;
  add_lines(top.below, 0, lines);
  std::string text;
  for (const Line& line : lines) {
    text += line.text;
    if (!line.comment.empty()) {
      const auto width = line.text.size();
      text += std::string(width + 2 < comment_column ? comment_column - width : 2, ' ') + "# " + line.comment;
    }
    text += '\n';
  }
  return text;
}

}  // namespace tunica::peer_cases
