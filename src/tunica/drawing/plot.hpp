// Line plots as SVG text, or PNG rendered from it: histories of a run, curves of a verification.
#pragma once

#include <string>
#include <vector>

namespace tunica::drawing {

/// One curve. Points that are not finite (or not positive on a logarithmic axis) interrupt it.
struct Series {
  std::string name{};  ///< in the legend; empty: not listed
  std::vector<double> x{}, y{};
  bool line = true;
  bool markers = false;
  bool dashed = false;
  bool hollow = false;  ///< markers are rings
  int colour = -1;      ///< number in the palette of seven; -1: by the place in the list, from the eighth on with
                        ///< dashes
};

struct PlotOptions {
  std::string title;
  std::string x_label, y_label;  ///< with the unit, as in "flow [ml/s]"
  bool log_x = false, log_y = false;
  int width = 720, height = 440;  ///< pixels; a legend of more than eight series stands to the right of them
};

inline constexpr int png_scale = 2;

/// The plot as an SVG document. Axes span all finite points, widened to round numbers in y. Throws InputError if a
/// series has x and y of different length or there is no point to draw.
std::string draw_plot(const std::vector<Series>& series, const PlotOptions& options);

/// Writes `draw_plot` to a file: ending in .svg as it is, in .png rendered with `png_scale` pixels for one of the
/// options. Throws InputError if the name ends in something else or the file cannot be written.
void write_plot(const std::string& file, const std::vector<Series>& series, const PlotOptions& options);

/// Positions of labels on an axis within [low, high]: three to nine multiples of 1, 2 or 5 times a power of ten; on a
/// logarithmic axis powers of ten, with round numbers between them if those are few. Needs low < high, and low > 0 if
/// logarithmic.
std::vector<double> axis_ticks(double low, double high, bool logarithmic);

}  // namespace tunica::drawing
