#include "tunica/drawing/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "tunica/base/text.hpp"

namespace tunica::drawing::page {

namespace {

// Colours are named once, for light and dark; print is light, with everything open and nothing torn apart.
constexpr const char* style =
    ":root{--ink:#1d2733;--soft:#55606c;--page:#fff;--panel:#f6f8fa;--line:#d5dbe1;--accent:#0b63b0;--bad:#b3261e;"
    "--good:#1b6e3c;color-scheme:light dark}"
    "@media(prefers-color-scheme:dark){:root{--ink:#e3e8ee;--soft:#a3afbb;--page:#14181d;--panel:#1c2229;"
    "--line:#39424c;--accent:#6db3f2;--bad:#ff8a80;--good:#7fd6a0}}"
    "body{font:15px/1.5 system-ui,sans-serif;max-width:1180px;margin:1.6em auto;padding:0 1em;color:var(--ink);"
    "background:var(--page)}h1{font-size:1.55rem;margin:.2em 0}h2{font-size:1.2rem;border-bottom:2px solid "
    "var(--line);margin-top:1.8em}h3{font-size:1rem;margin-bottom:.3em}a{color:var(--accent)}"
    "figure{display:inline-block;margin:1.4em 1.4em .6em 0;vertical-align:top;max-width:100%}"
    "figcaption{color:var(--soft);max-width:34em;font-size:.9rem}figure img,figure svg{max-width:min(100%,545px);"
    "height:auto}.wide{overflow-x:auto;max-width:100%}"
    "table{border-collapse:collapse;margin-bottom:1em;font-variant-numeric:tabular-nums}caption{text-align:left;"
    "color:var(--soft);padding-bottom:.2em}td,th{padding:.2em .8em;border-bottom:1px solid var(--line);"
    "text-align:right;vertical-align:top}thead th{font-weight:600}td:first-child,th:first-child{text-align:left;"
    "padding-left:0}td,th{white-space:nowrap}td:first-child,th,caption{white-space:normal}.aside{display:block;"
    "text-align:left;white-space:normal;max-width:34em;min-width:12em}tbody th{font-weight:400}.legend "
    "i{display:inline-block;width:1em;height:1em;margin-right:.4em;"
    "vertical-align:-.15em}.legend span{margin-right:1.2em;white-space:nowrap;display:inline-block}"
    ".missing{color:var(--soft);background:var(--panel);padding:.4em .8em;border-radius:4px}"
    ".bad{color:var(--bad);font-weight:600}.good{color:var(--good)}.soft{color:var(--soft)}"
    "pre{background:var(--panel);padding:.8em;overflow-x:auto;font-size:13px}nav a{margin-right:1em}"
    "summary{cursor:pointer}"
    "@media(max-width:600px){body{margin:.6em auto;padding:0 .6em}table{font-size:.87rem}td,th{padding:.2em .3em}"
    ".aside{min-width:7em}}"
    "@media print{:root{--ink:#000;--soft:#333;--page:#fff;--panel:#fff;--line:#bbb}@page{size:A4;margin:11mm 12mm}"
    "body{font-size:7.5pt;line-height:1.3;max-width:none;margin:0;padding:0}nav,.screen{display:none}"
    "h1{font-size:14pt}h2{font-size:10.5pt;margin:2.5mm 0 1mm;border-bottom-width:1px}h3{font-size:8.5pt;margin:2mm 0 "
    ".6mm}p,ul{margin:.8mm 0}ul{padding-left:4mm}details{margin:.6mm 0}"
    ".columns{columns:2;column-gap:6mm;orphans:1;widows:1}p,li{orphans:2;widows:2}"
    ".wide:has(th:nth-child(8)),h3:has(+.wide th:nth-child(8)){column-span:all}.wide:has(th:nth-child(8)) "
    "td:first-child{white-space:nowrap}"
    "figure,tr,.missing,.legend,.wide:not(:has(tr:nth-child(15))){break-inside:avoid}#answer+.columns "
    ".wide{break-inside:auto}h2,h3,caption,summary,thead,."
    "legend{break-after:avoid}"
    "figure{display:block;width:100%;margin:0 0 "
    "1.5mm}figure:not([data-plot]){display:inline-block;width:48.5%;margin-right:1%}"
    "figure img,figure "
    "svg{width:100%;max-width:100%}figcaption{font-size:6.5pt;line-height:1.2}.wide{overflow:visible}.missing{padding:."
    "2em .5em}"
    "table{width:100%;font-size:6.3pt;line-height:1.15;margin-bottom:1.2mm}td,th{padding:.06em "
    ".35em}.aside{min-width:0;max-width:none}"
    "tbody tr:first-child{break-after:avoid}tbody tr:last-child{break-before:avoid}"
    "pre{white-space:pre-wrap;orphans:6;widows:6;font-size:5pt;line-height:1.15;margin:.5mm 0;padding:0}"
    ".fine{font-size:5pt}.fine .wide{columns:2;column-gap:3mm;break-inside:auto}.fine "
    "table{font-size:5pt;line-height:1.1}.fine td{white-space:normal;overflow-wrap:anywhere;text-align:left}}";
constexpr const char* replacement = "\xEF\xBF\xBD";  // for a byte of a file name that is no UTF-8
constexpr const char *heading_end = "</h1>\n", *page_end = "</main></body></html>\n";

}  // namespace

std::string prose(const std::string& text) {
  std::string result;
  bool code = false;
  for (const char c : escaped(text)) {
    if (c != '`') {
      result += c;
      continue;
    }
    result += code ? "</code>" : "<code>";
    code = !code;
  }
  return code ? result + "</code>" : result;
}

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

std::string begin(const std::string& title, const Head& head) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\"><meta http-equiv=\"Content-Security-Policy\" content=\"{3}\">"
      "<title>{0}</title><style>{1}{4}</style></head>\n<body>\n<main>\n<h1>{0}{2}",
      escaped(title), style, heading_end, head.policy, head.style);
}

std::string end() { return page_end; }

std::string body(const std::string& page) {
  const auto start = page.find(heading_end), stop = page.rfind(page_end);
  if (start == std::string::npos || stop == std::string::npos) return {};
  const auto from = start + std::string(heading_end).size();
  return page.substr(from, stop - from);
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(bytes.size() / 3 * 4 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) { return i + k < bytes.size() ? bytes[i + k] : 0u; };
    const std::uint32_t three = (byte(0) << 16) | (byte(1) << 8) | byte(2);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[(three >> (18 - 6 * k)) & 63];
  }
  return text;
}

std::string data_url(const std::vector<std::uint8_t>& bytes, const std::string& type) {
  return fmt::format("data:image/{};base64,", type) + base64(bytes);
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

std::string table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
                  const std::string& caption) {
  const bool has_head = std::any_of(head.begin(), head.end(), [](const auto& cell) { return !cell.empty(); });
  std::string text = "<div class=\"wide\"><table class=\"sorts\">\n";
  if (!caption.empty()) text += fmt::format("<caption>{}</caption>\n", caption);
  if (has_head) {
    text += "<thead><tr>";
    for (const auto& cell : head) text += fmt::format("<th scope=\"col\">{}</th>", cell);
    text += "</tr></thead>\n";
  }
  text += "<tbody>\n";
  for (const auto& cells : rows) text += row(cells);
  return text + "</tbody></table></div>\n";
}

}  // namespace tunica::drawing::page
