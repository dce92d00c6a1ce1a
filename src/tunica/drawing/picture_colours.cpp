#include "tunica/drawing/picture_colours.hpp"

#include <fmt/format.h>
#include <vtkDoubleArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkStdString.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "tunica/drawing/plot.hpp"

namespace tunica::drawing {
namespace {

constexpr std::size_t most_categories = 12;
constexpr double letter_width = 0.56;  ///< of a letter of the usual width, in its size
using Rgb = std::array<int, 3>;

/// Perceptually even, from dark blue over green to yellow (anchor colours of "viridis", released as CC0).
const std::vector<Rgb> even = {{68, 1, 84},    {72, 40, 120},  {62, 74, 137},  {49, 104, 142}, {38, 130, 142},
                               {31, 158, 137}, {53, 183, 121}, {109, 205, 89}, {180, 222, 44}, {253, 231, 37}};
/// Blue, grey, red (Moreland 2009), for values of both signs.
const std::vector<Rgb> diverging = {{59, 76, 192},   {104, 138, 239}, {153, 186, 255}, {201, 216, 240}, {221, 221, 221},
                                    {247, 197, 174}, {246, 146, 116}, {222, 86, 72},   {180, 4, 38}};
/// Told apart by the colour-blind (Okabe & Ito 2008), then four more.
const std::vector<Rgb> distinct = {{0, 114, 178},  {230, 159, 0}, {0, 158, 115},  {204, 121, 167},
                                   {86, 180, 233}, {213, 94, 0},  {240, 228, 66}, {120, 120, 120},
                                   {122, 81, 149}, {90, 60, 20},  {150, 200, 60}, {30, 30, 30}};

bool is_signed(double low, double high) { return low < 0 && high > 0 && -low > 0.1 * high && high > -0.1 * low; }

/// The value below which `percentile` per cent of all lie.
double cut_of(std::vector<double>& values, double percentile) {
  const auto below = static_cast<std::ptrdiff_t>(percentile / 100 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + below, values.end());
  return values[static_cast<std::size_t>(below)];
}

/// Round-off about zero is zero.
double cleaned(double value, double size) { return std::abs(value) < 1e-9 * size ? 0.0 : value; }

void cut_limits(std::vector<double>& values, double low, double high, const PictureOptions& options,
                ColourScale& scale) {
  const double size = std::max(std::abs(low), std::abs(high));
  if (is_signed(low, high)) {
    scale.kind = ColourKind::diverging;
    for (double& v : values) v = std::abs(v);
    const double end = cut_of(values, options.percentile);
    scale.limits = {-end, end};
    if (end < size) scale.beyond = fmt::format("all values:\n{:.3g} to {:.3g}", low, high);
    return;
  }
  const double end = cut_of(values, options.percentile);
  scale.limits = {cleaned(low, high - low), cleaned(end, high - low)};
  if (end < high) scale.beyond = fmt::format("{:.3g} % lie above,\nlargest {:.3g}", 100 - options.percentile, high);
}

std::string wrapped(const std::string& text, std::size_t letters) {
  std::istringstream words(text);
  std::string word, lines, line;
  while (words >> word) {
    if (!line.empty() && line.size() + 1 + word.size() > letters) {
      lines += line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return lines + line;
}

std::size_t longest_line(const std::string& text) {
  std::size_t most = 0, begin = 0;
  while (begin <= text.size()) {
    const auto end = std::min(text.find('\n', begin), text.size());
    most = std::max(most, end - begin);
    begin = end + 1;
  }
  return most;
}

void style_text(vtkTextProperty* text, int size) {
  text->SetFontFamilyToArial();
  text->SetColor(0.1, 0.1, 0.1);
  text->SetFontSize(size);
  text->BoldOff();
  text->ItalicOff();
  text->ShadowOff();
}

/// Letters grow with the picture; one that stands upright is narrow where they are.
int letters(const PictureOptions& options, int share) {
  return std::min(options.height, 3 * options.width / 4) / share;
}

/// Text whose top left corner is at a place of the picture, no wider than the room that is left of the right border.
void add_text(vtkRenderer& frame, const std::string& text, double x, double y, int size,
              const PictureOptions& options) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  actor->SetPosition(x, y);
  const double room = (0.99 - x) * options.width;
  const auto fits =
      static_cast<int>(room / (letter_width * static_cast<double>(std::max<std::size_t>(longest_line(text), 1))));
  style_text(actor->GetTextProperty(), std::max(8, std::min(size, fits)));
  actor->GetTextProperty()->SetVerticalJustificationToTop();
  frame.AddActor2D(actor);
}

}  // namespace

std::string with_readable_unit(const std::string& name) {
  const auto begin = name.rfind(" ["), end = name.rfind(']');
  if (begin == std::string::npos || end != name.size() - 1 || end < begin) return name;
  std::istringstream factors(name.substr(begin + 2, end - begin - 2));
  std::string factor, above, below;
  while (factors >> factor) {
    const auto hat = factor.find('^');
    std::string power = hat == std::string::npos ? "1" : factor.substr(hat + 1);
    const bool divides = power.starts_with('-');
    if (divides) power.erase(0, 1);
    const std::string raised = power == "1" ? "" : power == "2" ? "²" : power == "3" ? "³" : fmt::format("^{}", power);
    auto& side = divides ? below : above;
    side = fmt::format("{}{}{}{}", side, divides ? "/" : side.empty() ? "" : " ", factor.substr(0, hat), raised);
  }
  return fmt::format("{} [{}{}]", name.substr(0, begin), above.empty() ? "1" : above, below);
}

ColourScale colour_scale(std::vector<double> values, bool whole_numbers, const PictureOptions& options) {
  ColourScale scale;
  if (options.limits) {
    scale.limits = *options.limits;
    scale.kind = is_signed(scale.limits[0], scale.limits[1]) ? ColourKind::diverging : ColourKind::even;
  } else if (!values.empty()) {
    const std::set<double> all(values.begin(), values.end());
    const double low = *all.begin(), high = *all.rbegin();
    if (whole_numbers && all.size() <= most_categories) {
      scale.kind = ColourKind::categories;
      scale.limits = {low, high};
      scale.marks.assign(all.begin(), all.end());
      return scale;
    }
    cut_limits(values, low, high, options, scale);
  }
  if (scale.limits[1] > scale.limits[0])
    scale.marks = axis_ticks(scale.limits[0], scale.limits[1], false);
  else
    scale.marks = {scale.limits[0]};
  return scale;
}

void fill_table(vtkLookupTable& table, const ColourScale& scale) {
  if (scale.kind == ColourKind::categories) {
    table.SetNumberOfTableValues(static_cast<vtkIdType>(scale.marks.size()));
    table.IndexedLookupOn();
    for (std::size_t i = 0; i < scale.marks.size(); ++i) {
      const auto& c = distinct[i % distinct.size()];
      table.SetTableValue(static_cast<vtkIdType>(i), c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
      table.SetAnnotation(vtkVariant(scale.marks[i]), vtkStdString(fmt::format("{:g}", scale.marks[i])));
    }
    return;
  }
  const auto& anchors = scale.kind == ColourKind::diverging ? diverging : even;
  const int intervals = static_cast<int>(anchors.size()) - 1, colours = 256;
  table.SetNumberOfTableValues(colours);
  table.SetTableRange(scale.limits[0], scale.limits[1]);
  for (int i = 0; i < colours; ++i) {
    const double at = static_cast<double>(i) * intervals / (colours - 1);
    const int low = std::min(static_cast<int>(at), intervals - 1);
    const auto &a = anchors[static_cast<std::size_t>(low)], &b = anchors[static_cast<std::size_t>(low) + 1];
    double rgb[3];
    for (std::size_t c = 0; c < 3; ++c) rgb[c] = (a[c] + (at - low) * (b[c] - a[c])) / 255.0;
    table.SetTableValue(i, rgb[0], rgb[1], rgb[2]);
  }
}

void add_colour_key(vtkRenderer& frame, const ColourScale& scale, vtkLookupTable& table, const std::string& array,
                    const PictureOptions& options) {
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(&table);
  if (scale.kind == ColourKind::categories) {
    bar->SetNumberOfLabels(0);
    bar->AnnotationTextScalingOff();
    style_text(bar->GetAnnotationTextProperty(), std::max(10, letters(options, 32)));
  } else {
    vtkNew<vtkDoubleArray> marks;
    for (const double mark : scale.marks) marks->InsertNextValue(mark);
    bar->SetCustomLabels(marks);
    bar->UseCustomLabelsOn();
    bar->SetLabelFormat("%.6g");
    bar->SetMaximumNumberOfColors(256);
  }
  bar->UnconstrainedFontSizeOn();
  bar->SetTitle("");
  bar->SetPosition(bar_begin + 0.01, 0.14);
  bar->SetPosition2(1.0 - bar_begin - 0.02, 0.66);
  bar->SetBarRatio(0.25);
  bar->SetTextPad(4);
  style_text(bar->GetLabelTextProperty(), std::max(10, letters(options, 32)));
  frame.AddActor2D(bar);
  const int size = std::max(11, letters(options, 30));
  const double room = (0.98 - bar_begin) * options.width / (letter_width * size);
  const std::string name = options.label.empty() ? with_readable_unit(array) : options.label;
  add_text(frame, wrapped(name, static_cast<std::size_t>(std::max(6.0, room))), bar_begin + 0.01, title_begin - 0.01,
           size, options);
  if (!scale.beyond.empty())
    add_text(frame, scale.beyond, bar_begin + 0.01, 0.12, std::max(10, letters(options, 36)), options);
}

void add_title(vtkRenderer& frame, const std::string& title, const PictureOptions& options) {
  if (title.empty()) return;
  const int size = std::max(13, letters(options, 28));
  const auto room = static_cast<std::size_t>(0.96 * options.width / (letter_width * size));
  const bool is_long = title.size() > room;
  add_text(frame, is_long ? wrapped(title, std::max(room, title.size() / 2 + 8)) : title, 0.02, 0.985,
           is_long ? 2 * size / 3 : size, options);
}

}  // namespace tunica::drawing
