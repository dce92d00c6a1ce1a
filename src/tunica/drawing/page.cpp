#include "tunica/drawing/page.hpp"

#include <fmt/format.h>

#include <string_view>

#include "tunica/base/text.hpp"

namespace tunica::drawing::page {

namespace {

constexpr const char* style =
    "body{font:15px/1.5 system-ui,sans-serif;max-width:1180px;margin:2em auto;padding:0 1em;color:#222}"
    "figure{display:inline-block;margin:0 1em 1em 0;vertical-align:top}figcaption{color:#555;max-width:34em}"
    "table{border-collapse:collapse;margin-bottom:1em}td,th{padding:.2em .8em;border-bottom:1px solid #ddd;"
    "text-align:right}td:first-child,th:first-child{text-align:left}.legend i{display:inline-block;width:1em;"
    "height:1em;margin-right:.4em;vertical-align:-.15em}.legend span{margin-right:1.2em}figure img{max-width:545px}"
    "td{white-space:nowrap}"
    "h2{border-bottom:2px solid #ddd;margin-top:1.6em}.missing{color:#666;background:#f5f5f5;padding:.4em .8em}"
    "pre{background:#f5f5f5;padding:.8em;overflow-x:auto;font-size:13px}nav a{margin-right:1em}";
constexpr const char* replacement = "\xEF\xBF\xBD";  // for a byte of a file name that is no UTF-8
constexpr const char *heading_end = "</h1>\n", *page_end = "</body></html>\n";

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  std::string_view rest(text);
  while (!rest.empty()) {
    const std::size_t valid = text::valid_utf8(rest);
    for (const char c : rest.substr(0, valid)) {
      if (c == '&')
        result += "&amp;";
      else if (c == '<')
        result += "&lt;";
      else if (c == '>')
        result += "&gt;";
      else if (c == '"')
        result += "&quot;";
      else if (c == '\'')
        result += "&#39;";
      else
        result += c;
    }
    rest.remove_prefix(valid);
    if (rest.empty()) break;
    result += replacement;
    rest.remove_prefix(1);
  }
  return result;
}

std::string begin(const std::string& title) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title><style>{1}</style>"
      "</head>\n<body>\n<h1>{0}{2}",
      escaped(title), style, heading_end);
}

std::string end() { return page_end; }

std::string body(const std::string& page) {
  const auto start = page.find(heading_end), stop = page.rfind(page_end);
  if (start == std::string::npos || stop == std::string::npos) return {};
  const auto from = start + std::string(heading_end).size();
  return page.substr(from, stop - from);
}

std::string data_url(const std::vector<std::uint8_t>& bytes, const std::string& type) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text = fmt::format("data:image/{};base64,", type);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) { return i + k < bytes.size() ? bytes[i + k] : 0u; };
    const std::uint32_t three = (byte(0) << 16) | (byte(1) << 8) | byte(2);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[(three >> (18 - 6 * k)) & 63];
  }
  return text;
}

std::string picture(const std::string& url, const std::string& caption) {
  return fmt::format("<figure><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n", url, escaped(caption),
                     escaped(caption));
}

std::string drawing(const std::string& svg) { return fmt::format("<figure>{}</figure>\n", svg); }

std::string row(const std::vector<std::string>& cells, const char* tag) {
  std::string text = "<tr>";
  for (const auto& c : cells) text += fmt::format("<{0}>{1}</{0}>", tag, c);
  return text + "</tr>\n";
}

std::string table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows) {
  std::string text = "<table>\n" + row(head, "th");
  for (const auto& cells : rows) text += row(cells);
  return text + "</table>\n";
}

}  // namespace tunica::drawing::page
