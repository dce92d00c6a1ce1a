#include "tunica/viewer/view_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tunica/drawing/page.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/viewer/assets.hpp"

namespace tunica::viewer {

namespace page = drawing::page;
using nlohmann::json;

namespace {

/// 'sha256-...' of a script for the policy of a page.
std::string source_of(const Asset& asset) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < asset.sha256.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(std::string(asset.sha256.substr(i, 2)), nullptr, 16)));
  return fmt::format("'sha256-{}'", page::base64(bytes));
}

std::string script(const Asset& asset) { return fmt::format("<script>{}</script>\n", asset.text); }

/// JSON within a script element: no text in it may end the element.
std::string data_element(const std::string& id, std::string text, const char* type) {
  for (std::size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3) text.replace(at, 2, "<\\/");
  for (std::size_t at = 0; (at = text.find("<!", at)) != std::string::npos; at += 7) text.replace(at, 2, "\\u003c!");
  return fmt::format("<script type=\"{}\" id=\"{}\">{}</script>\n", type, id, text);
}

/// Numbers with as many digits as a screen can show.
json rounded(const std::vector<double>& values) {
  json list = json::array();
  for (const double v : values) {
    if (!std::isfinite(v))
      list.push_back(nullptr);
    else
      list.push_back(v == 0 ? 0.0 : std::stod(fmt::format("{:.7g}", v)));
  }
  return list;
}

json data_of(const Plot& plot) {
  json curves = json::array();
  for (const auto& c : plot.curves)
    curves.push_back(
        {{"name", c.name}, {"x", rounded(c.x)}, {"y", rounded(c.y)}, {"style", c.style}, {"role", c.role}});
  return {{"title", plot.title},
          {"x_label", plot.x_label},
          {"y_label", plot.y_label},
          {"in_time", plot.in_time},
          {"curves", curves}};
}

std::string percent(double share) { return share == 0 ? "0" : fmt::format("{:.2g}", 100 * share); }

}  // namespace

std::string begin_page(const std::string& title) {
  std::string scripts;
  for (const auto& asset :
       {assets::three(), assets::beat(), assets::scene(), assets::still(), assets::panel(), assets::plots()})
    scripts.append(" ").append(source_of(asset));
  page::Head head;
  head.policy = fmt::format(
      "default-src 'none'; script-src{}; style-src 'unsafe-inline'; img-src data: blob:; media-src blob:; base-uri "
      "'none'; form-action 'none'",
      scripts);
  head.style = assets::style().text;
  return page::begin(title, head);
}

std::string view() { return std::string(assets::markup().text); }

std::string accuracy(const PackedBeat& beat) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& q : beat.quantities)
    rows.push_back({page::escaped(q.name), q.body, std::to_string(q.modes), percent(q.compression.most),
                    percent(q.compression.largest), percent(q.simplification.most),
                    fmt::format("{:.3g} {}", q.compression.range, page::escaped(q.unit))});
  std::string text = page::table(
      {"quantity", "on", "modes", "99.9 % within [%]", "all within [%]", "simplified, 99.9 % within [%]", "range"},
      rows,
      "Errors of the modes and whole numbers, and of simplified surfaces, in per cent of the range of all values");
  text += fmt::format("<p>Coordinates are rounded to {:.2g} mm.", 1e3 * beat.place_step);
  for (const auto& s : beat.simplifications)
    if (s.triangles < s.triangles_before)
      text += fmt::format(" {} of {} triangles are shown, which lie within {:.2g} mm of the points that are left out.",
                          s.triangles, s.triangles_before, 1e3 * s.distance);
  return text + "</p>\n";
}

std::string plot(const std::vector<Plot>& plots, std::size_t index, const std::string& caption) {
  std::vector<drawing::Series> series;
  for (const auto& c : plots[index].curves)
    series.push_back({.name = c.name, .x = c.x, .y = c.y, .dashed = c.role == "target", .colour = c.style % 7});
  const std::string svg = drawing::draw_plot(
      series,
      {.title = plots[index].title, .x_label = plots[index].x_label, .y_label = plots[index].y_label, .width = 560});
  return fmt::format("<figure data-plot=\"{}\">{}<figcaption>{}</figcaption></figure>\n", index, svg, caption);
}

std::string end_page(const std::vector<Plot>& plots, const PackedBeat* shown) {
  json data = json::array();
  for (const auto& p : plots) data.push_back(data_of(p));
  std::string text = plots.empty() ? "" : data_element("plots", data.dump(), "application/json");
  text += script(assets::plots());
  if (shown != nullptr) {
    text += data_element("beat-head", shown->head, "application/json") +
            data_element("beat-data", shown->data, "text/plain");
    for (const auto& asset : {assets::three(), assets::beat(), assets::scene(), assets::still(), assets::panel()})
      text += script(asset);
  }
  return text + page::end();
}

}  // namespace tunica::viewer
