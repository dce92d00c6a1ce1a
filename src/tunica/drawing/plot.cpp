#include "tunica/drawing/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tunica/base/error.hpp"
#include "tunica/drawing/page.hpp"
#include "tunica/drawing/svg_image.hpp"
#include "tunica/files/atomic_file.hpp"

namespace tunica::drawing {
namespace {

// Distinguishable with colour-blindness too (palette of Okabe and Ito).
constexpr std::array<const char*, 7> colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                "#e69f00", "#56b4e9", "#000000"};
constexpr double margin_left = 78.0, margin_right = 20.0, margin_top = 40.0, margin_bottom = 56.0;
constexpr double character_width = 7.0, legend_line = 18.0;
constexpr std::size_t most_within = 8;  ///< entries of a legend that stands among the curves

/// Maps values to pixels along one axis.
struct Axis {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  bool logarithmic = false;
  double begin = 0.0, end = 0.0;  ///< pixels of low and high

  bool accepts(double value) const { return std::isfinite(value) && (!logarithmic || value > 0.0); }
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double position(double value) const {
    const double t = logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
    return begin + t * (end - begin);
  }
  /// Gives a single value some room on both sides.
  /// Values that differ by rounding alone are one value: steps between them would be lost in it.
  void open_up() {
    const double size = std::max(std::abs(low), std::abs(high));
    if (high - low > 1e-9 * size) return;
    const double room = size == 0.0 ? 1.0 : 0.1 * size;
    low -= room;
    high += room;
  }
};

std::string text_at(double x, double y, const char* anchor, const std::string& text, const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                     page::escaped(text));
}

std::string line_at(double x1, double y1, double x2, double y2, const std::string& stroke) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1, y1, x2, y2, stroke);
}

/// The smallest of 1, 2, 5 times a power of ten that is at least `raw`.
double round_step(double raw) {
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw * (1.0 - 1e-12)) return factor * power;
  }
  return 10.0 * power;
}

/// Moves the ends out to the next round number, or by 5 % on a logarithmic axis.
void widen(Axis& axis) {
  if (axis.logarithmic) {
    const double factor = std::pow(axis.high / axis.low, 0.05);
    axis.low /= factor;
    axis.high *= factor;
    return;
  }
  const double step = round_step((axis.high - axis.low) / 8.0);
  axis.low = step * std::floor(axis.low / step + 1e-9);
  axis.high = step * std::ceil(axis.high / step - 1e-9);
}

std::pair<Axis, Axis> make_axes(const std::vector<Series>& series, const PlotOptions& options) {
  Axis x, y;
  x.logarithmic = options.log_x;
  y.logarithmic = options.log_y;
  bool any = false;
  for (const auto& s : series) {
    if (s.x.size() != s.y.size())
      throw InputError("plot '" + options.title + "'",
                       fmt::format("series '{}' has {} x and {} y values", s.name, s.x.size(), s.y.size()),
                       "give one y for each x");
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      if (!x.accepts(s.x[i]) || !y.accepts(s.y[i])) continue;
      x.include(s.x[i]);
      y.include(s.y[i]);
      any = true;
    }
  }
  if (!any)
    throw InputError("plot '" + options.title + "'", "there is no point to draw",
                     "give finite values, positive ones on logarithmic axes");
  x.open_up();
  y.open_up();
  widen(y);
  if (x.logarithmic) widen(x);
  x.begin = margin_left;
  x.end = options.width - margin_right;
  y.begin = options.height - margin_bottom;  // SVG counts downwards
  y.end = margin_top;
  return {x, y};
}

std::string draw_frame(const Axis& x, const Axis& y, const PlotOptions& options) {
  const std::string grid = "stroke=\"#dddddd\"", tick = "stroke=\"#333333\"";
  std::string svg;
  for (const double value : axis_ticks(x.low, x.high, x.logarithmic)) {
    const double at = x.position(value);
    svg += line_at(at, y.begin, at, y.end, grid) + line_at(at, y.begin, at, y.begin + 5.0, tick);
    svg += text_at(at, y.begin + 19.0, "middle", fmt::format("{:.6g}", value));
  }
  for (const double value : axis_ticks(y.low, y.high, y.logarithmic)) {
    const double at = y.position(value);
    svg += line_at(x.begin, at, x.end, at, grid) + line_at(x.begin - 5.0, at, x.begin, at, tick);
    svg += text_at(x.begin - 8.0, at + 4.0, "end", fmt::format("{:.6g}", value));
  }
  svg += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#333333\"/>\n",
      x.begin, y.end, x.end - x.begin, y.begin - y.end);
  const double middle = 0.5 * (x.begin + x.end), side = 0.5 * (y.begin + y.end);
  svg += text_at(middle, 25.0, "middle", options.title, " font-size=\"15\"");
  svg += text_at(middle, options.height - 14.0, "middle", options.x_label);
  svg += text_at(18.0, side, "middle", options.y_label, fmt::format(" transform=\"rotate(-90 18 {:.1f})\"", side));
  return svg;
}

/// Series that have a colour of an earlier one, by their place in the list, differ from it in their dashes.
std::string stroke_of(const Series& series, const char* colour, std::size_t place) {
  constexpr std::array<const char*, 4> dashes = {"", "2 3", "10 4", "10 3 2 3"};
  const std::size_t round = series.colour < 0 ? place / colours.size() % dashes.size() : 0;
  const std::string dash = series.dashed ? "6 4" : dashes[round];
  return fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.7\"{}", colour,
                     dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", dash));
}

std::string draw_marker(double x, double y, const char* colour, bool hollow) {
  const std::string look = hollow ? fmt::format("r=\"4.5\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"", colour)
                                  : fmt::format("r=\"3.2\" fill=\"{}\"", colour);
  return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" {}/>\n", x, y, look);
}

const char* colour_of(const Series& series, std::size_t place) {
  return colours[(series.colour < 0 ? place : static_cast<std::size_t>(series.colour)) % colours.size()];
}

std::string draw_series(const Series& series, const Axis& x, const Axis& y, std::size_t place) {
  const char* colour = colour_of(series, place);
  std::string path, markers;
  bool pen_down = false;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!x.accepts(series.x[i]) || !y.accepts(series.y[i])) {
      pen_down = false;
      continue;
    }
    const double px = x.position(series.x[i]), py = y.position(series.y[i]);
    path += fmt::format("{}{:.2f} {:.2f}", pen_down ? "L" : "M", px, py);
    if (series.markers) markers += draw_marker(px, py, colour, series.hollow);
    pen_down = true;
  }
  if (!series.line) return markers;
  return fmt::format("<path d=\"{}\" {} stroke-linejoin=\"round\"/>\n", path, stroke_of(series, colour, place)) +
         markers;
}

/// How many drawn points lie in a rectangle, such as that of a legend.
int points_within(const std::vector<Series>& series, const Axis& x, const Axis& y, double left, double top,
                  double width, double height) {
  int count = 0;
  for (const auto& s : series)
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      if (!x.accepts(s.x[i]) || !y.accepts(s.y[i])) continue;
      const double px = x.position(s.x[i]) - left, py = y.position(s.y[i]) - top;
      count += px > 0.0 && px < width && py > 0.0 && py < height;
    }
  return count;
}

/// Size of a legend: one of few entries stands among the curves, one of many beside the plot, in columns.
struct Legend {
  std::size_t entries = 0, rows = 0;
  double column = 0, width = 0, height = 0;

  Legend(const std::vector<Series>& series, const PlotOptions& options) {
    std::size_t longest = 0;
    for (const auto& s : series) {
      if (s.name.empty()) continue;
      ++entries;
      longest = std::max(longest, s.name.size());
    }
    if (entries == 0) return;
    const double room = options.height - margin_top - margin_bottom - 8.0;
    rows = beside() ? std::min(entries, static_cast<std::size_t>(std::max(1.0, room / legend_line))) : entries;
    column = 48.0 + character_width * static_cast<double>(longest);
    width = column * static_cast<double>((entries + rows - 1) / rows);
    height = 8.0 + legend_line * static_cast<double>(rows);
  }
  bool beside() const { return entries > most_within; }
  /// That the plot is wider than it would be without [pixels].
  int more_width() const { return beside() ? static_cast<int>(std::ceil(width)) : 0; }
};

/// Left upper corner of a legend among the curves: that of the plot where it hides least.
std::pair<double, double> place_within(const Legend& legend, const std::vector<Series>& series, const Axis& x,
                                       const Axis& y) {
  const double width = legend.width, height = legend.height;
  double left = 0.0, top = 0.0;
  int fewest = std::numeric_limits<int>::max();
  for (const double at_x : {x.end - width - 8.0, x.begin + 8.0})
    for (const double at_y : {y.end + 8.0, y.begin - height - 8.0}) {
      const int hidden = points_within(series, x, y, at_x - 12.0, at_y - 12.0, width + 24.0, height + 24.0);
      if (hidden >= fewest) continue;
      fewest = hidden;
      left = at_x;
      top = at_y;
    }
  return {left, top};
}

std::string draw_legend(const Legend& legend, const std::vector<Series>& series, const Axis& x, const Axis& y) {
  if (legend.entries == 0) return "";
  const auto [left, top] =
      legend.beside() ? std::pair(x.end + margin_right, y.end) : place_within(legend, series, x, y);
  std::string svg = fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#ffffff\" fill-opacity=\"0.85\" "
      "stroke=\"#bbbbbb\"/>\n",
      left, top, legend.width - (legend.beside() ? 8.0 : 0.0), legend.height);
  std::size_t entry = 0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (series[i].name.empty()) continue;
    const char* colour = colour_of(series[i], i);
    const double from = left + legend.column * static_cast<double>(entry / legend.rows),
                 at = top + 4.0 + legend_line * (0.5 + static_cast<double>(entry % legend.rows));
    if (series[i].line) svg += line_at(from + 8.0, at, from + 34.0, at, stroke_of(series[i], colour, i));
    if (series[i].markers) svg += draw_marker(from + 21.0, at, colour, series[i].hollow);
    svg += text_at(from + 40.0, at + 4.0, "start", series[i].name);
    ++entry;
  }
  return svg;
}

}  // namespace

std::vector<double> axis_ticks(double low, double high, bool logarithmic) {
  std::vector<double> ticks;
  if (!logarithmic) {
    const double step = round_step((high - low) / 8.0);
    const double slack = 1e-9 * step;
    for (double i = std::ceil((low - slack) / step); i * step <= high + slack; ++i)
      ticks.push_back(i == 0.0 ? 0.0 : i * step);
    return ticks;
  }
  const double decades = std::log10(high / low);
  const int stride = std::max(1, static_cast<int>(decades / 8.0));
  const std::vector<double> factors = decades < 1.2   ? std::vector{1.0, 2.0, 3.0, 5.0, 7.0}
                                      : decades < 3.0 ? std::vector{1.0, 2.0, 5.0}
                                                      : std::vector{1.0};
  for (int exponent = static_cast<int>(std::floor(std::log10(low))); exponent <= std::log10(high); ++exponent) {
    if (exponent % stride != 0) continue;
    for (const double factor : factors) {
      const double tick = factor * std::pow(10.0, exponent);
      if (tick >= low && tick <= high) ticks.push_back(tick);
    }
  }
  return ticks.size() < 3 ? axis_ticks(low, high, false) : ticks;
}

std::string draw_plot(const std::vector<Series>& series, const PlotOptions& options) {
  const auto [x, y] = make_axes(series, options);
  const Legend legend(series, options);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"DejaVu Sans, Arial, sans-serif\" font-size=\"12\" fill=\"#222222\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      options.width + legend.more_width(), options.height);
  svg += draw_frame(x, y, options);
  for (std::size_t i = 0; i < series.size(); ++i) svg += draw_series(series[i], x, y, i);
  return svg + draw_legend(legend, series, x, y) + "</svg>\n";
}

void write_plot(const std::string& file, const std::vector<Series>& series, const PlotOptions& options) {
  const std::string svg = draw_plot(series, options);
  if (file.ends_with(".png")) return write_png(file, svg, png_scale);
  if (!file.ends_with(".svg")) throw InputError(file, "is no name of a plot", "let it end in .svg or .png");
  files::write_atomically(file, svg);
}

}  // namespace tunica::drawing
