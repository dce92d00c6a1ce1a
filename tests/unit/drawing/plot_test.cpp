#include "tunica/drawing/plot.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "tunica/base/error.hpp"

namespace tunica::drawing {
namespace {

int count(const std::string& text, const std::string& part) {
  int n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(AxisTicks, AreRoundAndWithinTheAxis) {
  EXPECT_EQ(axis_ticks(0.0, 1.0, false), (std::vector<double>{0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0}));
  for (const double scale : {1e-9, 0.03, 7.0, 1e12}) {
    const auto ticks = axis_ticks(-scale, 0.73 * scale, false);
    EXPECT_GE(ticks.size(), 3U);
    EXPECT_LE(ticks.size(), 9U);
    EXPECT_GE(ticks.front(), -scale * (1 + 1e-9));
    EXPECT_LE(ticks.back(), 0.73 * scale);
    EXPECT_NE(std::find(ticks.begin(), ticks.end(), 0.0), ticks.end());
  }
}

TEST(AxisTicks, ArePowersOfTenOnLongLogarithmicAxes) {
  const auto ticks = axis_ticks(2e-5, 3.0, true);
  ASSERT_EQ(ticks.size(), 5U);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(ticks[static_cast<std::size_t>(i)] / std::pow(10.0, i - 4), 1.0, 1e-12);
}

TEST(AxisTicks, AreAtLeastThreeOnShortLogarithmicAxes) {
  for (const double ratio : {1.05, 1.5, 4.0, 12.0, 90.0}) EXPECT_GE(axis_ticks(0.4, 0.4 * ratio, true).size(), 3U);
}

TEST(Plot, ValuesThatDifferByRoundingShareARoundAxis) {
  const std::string svg = draw_plot({{.name = "p", .x = {0.0, 1.0}, .y = {5.0, 5.0 + 2e-15}}}, {});
  EXPECT_LT(svg.size(), 10000U);
  EXPECT_NE(svg.find(">5<"), std::string::npos) << svg;
}

TEST(Plot, PutsPointsWhereTheAxesSay) {
  PlotOptions options;
  options.width = 200 + 98;   // 200 pixels between the side margins of 78 and 20
  options.height = 100 + 96;  // 100 pixels between the margins of 40 above and 56 below
  const auto svg = draw_plot({{"", {0.0, 1.0, 2.0}, {0.0, 8.0, 2.0}}}, options);
  EXPECT_NE(svg.find("M78.00 140.00L178.00 40.00L278.00 115.00"), std::string::npos) << svg;
}

TEST(Plot, InterruptsTheLineAtValuesThatCannotBeDrawn) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Series series{"a", {1.0, 2.0, 3.0, 4.0, 5.0}, {1.0, 2.0, nan, 3.0, 4.0}};
  series.markers = true;
  PlotOptions options;
  const auto linear = draw_plot({series}, options);
  const auto start = linear.find("<path d=\"") + 9;
  EXPECT_EQ(count(linear.substr(start, linear.find('"', start) - start), "M"), 2);
  EXPECT_EQ(count(linear, "<circle"), 4 + 1);  // and one in the legend
  options.log_y = true;
  series.y[0] = -1.0;
  EXPECT_EQ(count(draw_plot({series}, options), "<circle"), 3 + 1);
}

TEST(Plot, EscapesMarkupAndKeepsConstantSeriesInSight) {
  const auto svg = draw_plot({{"p < q & r", {0.0, 1.0}, {5.0, 5.0}}}, {});
  EXPECT_NE(svg.find("p &lt; q &amp; r"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(Plot, RefusesWhatCannotBeDrawn) {
  EXPECT_THROW(draw_plot({}, {}), InputError);
  EXPECT_THROW(draw_plot({{"a", {1.0, 2.0}, {1.0}}}, {}), InputError);
  PlotOptions options;
  options.log_x = true;
  EXPECT_THROW(draw_plot({{"a", {0.0, -2.0}, {1.0, 1.0}}}, options), InputError);
  for (const char* file : {"plot.pdf", "plot"})
    EXPECT_THROW(write_plot(file, {{"a", {1.0}, {1.0}}}, {}), InputError) << file;
  for (const char* file : {"no/such/folder/plot.svg", "no/such/folder/plot.png"})
    EXPECT_THROW(write_plot(file, {{"a", {1.0}, {1.0}}}, {}), SolverError) << file;
  EXPECT_FALSE(std::filesystem::exists("plot.pdf"));
}

TEST(Plot, IsRenderedAsPng) {
  const std::string file = testing::TempDir() + "plot.png";
  std::filesystem::remove(file);
  PlotOptions options;
  options.width = 300;
  options.height = 200;
  options.title = "a title";
  write_plot(file, {{"line", {0.0, 1.0}, {0.0, 1.0}}}, options);
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkImageData& image = *reader->GetOutput();
  ASSERT_EQ(image.GetDimensions()[0], 300 * png_scale);
  ASSERT_EQ(image.GetDimensions()[1], 200 * png_scale);
  ASSERT_EQ(image.GetNumberOfScalarComponents(), 3);
  int white = 0, line = 0, title = 0;
  for (int y = 0; y < 200 * png_scale; ++y)
    for (int x = 0; x < 300 * png_scale; ++x) {
      const auto* c = static_cast<const unsigned char*>(image.GetScalarPointer(x, y, 0));
      const std::array<int, 3> rgb{c[0], c[1], c[2]};
      if (rgb == std::array{255, 255, 255}) ++white;
      if (rgb == std::array{0x00, 0x72, 0xb2}) ++line;
      if (y > 165 * png_scale && c[0] < 100) ++title;
    }
  EXPECT_GT(white, 160 * 300 * png_scale * png_scale);
  // The curve crosses the frame of 202 x 104 pixels: 227 long, 1.5 wide, in the first colour; and once in the legend.
  EXPECT_GT(line, 200 * png_scale * png_scale);
  EXPECT_LT(line, 500 * png_scale * png_scale);
  EXPECT_GT(title, 50) << "letters above the frame";
}

TEST(Plot, DrawsRingsInTheColourOfAnotherSeries) {
  Series line{"curve", {0.0, 1.0}, {0.0, 1.0}}, rings = line, dots = line;
  rings.line = dots.line = false;
  rings.markers = dots.markers = rings.hollow = true;
  rings.colour = 0;
  const auto svg = draw_plot({line, rings, dots}, {});
  EXPECT_EQ(count(svg, "fill=\"none\" stroke=\"#0072b2\" stroke-width=\"1.5\""), 2 + 1) << "and one in the legend";
  EXPECT_EQ(count(svg, "r=\"3.2\" fill=\"#009e73\""), 2 + 1) << "the third colour of the palette";
}

TEST(Plot, TellsManySeriesApartAndListsThemBesideThePlot) {
  std::vector<Series> series;
  for (int k = 0; k < 30; ++k) series.push_back({fmt::format("series {}", k), {0.0, 1.0}, {1.0 * k, 1.0 * k}});
  const auto svg = draw_plot(series, {});
  EXPECT_EQ(svg.find("width=\"720\""), std::string::npos);
  std::set<std::string> looks;
  for (std::size_t at = svg.find("<path"); at != std::string::npos; at = svg.find("<path", at + 1)) {
    const auto from = svg.find("stroke=", at), to = svg.find("stroke-linejoin", at);
    looks.insert(svg.substr(from, to - from));
  }
  EXPECT_EQ(looks.size(), 28U) << "seven colours by four kinds of dashes";
  for (int k = 0; k < 30; ++k) {
    const auto label = svg.find(fmt::format(">series {}<", k));
    ASSERT_NE(label, std::string::npos);
    const auto x = svg.rfind("x=\"", label);
    EXPECT_GT(std::stod(svg.substr(x + 3)), 720 - 20) << k;
  }
  series.resize(8);
  EXPECT_NE(draw_plot(series, {}).find("width=\"720\""), std::string::npos);
}

TEST(Plot, KeepsTheLegendAwayFromTheCurve) {
  // The curve ends in the upper right corner, beside a legend that would be there.
  const auto svg = draw_plot({{"law", {0.0, 1.0}, {0.0, 1.0}}}, {});
  const auto box = svg.find("fill-opacity");
  ASSERT_NE(box, std::string::npos);
  const auto rectangle = svg.substr(svg.rfind("<rect", box), 40);
  EXPECT_GT(std::stod(rectangle.substr(rectangle.find("y=\"") + 3)), 220.0) << rectangle;
}

}  // namespace
}  // namespace tunica::drawing
