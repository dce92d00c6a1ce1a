#include "tunica/bc/waveform.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "folders.hpp"
#include "text.hpp"
#include "tunica/base/error.hpp"

namespace {

using tunica::test::contains;
using namespace tunica::bc;
using tunica::InputError;
namespace fs = std::filesystem;
using std::numbers::pi;

Table sampled(int intervals, double period, double (*f)(double)) {
  Table table;
  for (int i = 0; i <= intervals; ++i) {
    table.times.push_back(period * i / intervals);
    table.values.push_back(f(2 * pi * i / intervals));
  }
  return table;
}

double wave(double phase) { return 3.0 + std::cos(phase) - 0.5 * std::sin(2 * phase); }

double largest_error(const Waveform& waveform, double period) {
  double error = 0.0;
  for (int i = 0; i < 1000; ++i)
    error = std::max(error, std::abs(waveform.value(period * i / 1000) - wave(2 * pi * i / 1000)));
  return error;
}

/// A file that lives as long as the test.
class Temporary {
 public:
  Temporary(const std::string& name, const std::string& text)
      : path(fs::temp_directory_path() /
             (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + "_" + name)) {
    std::ofstream(path) << text;
  }
  ~Temporary() { fs::remove(path); }
  fs::path path;
};

std::string message(const TableFile& file) {
  try {
    read_table(file);
  } catch (const InputError& error) {
    EXPECT_FALSE(error.problems().at(0).remedy.empty());
    return error.what();
  }
  return "no error";
}

std::string message(const Table& table, const TableOptions& options) {
  try {
    (void)Waveform::table(table, options);
  } catch (const InputError& error) {
    EXPECT_FALSE(error.problems().at(0).remedy.empty());
    return error.what();
  }
  return "no error";
}

TEST(Waveform, ConstantStepAndRamp) {
  EXPECT_EQ(Waveform::constant(7.0).value(-3.0), 7.0);
  EXPECT_EQ(Waveform::constant(7.0).mean(), 7.0);
  const auto step = Waveform::step({.value = 2.0, .start = 0.0, .end = 3e-3});
  EXPECT_EQ(step.value(0.0), 0.0);
  EXPECT_EQ(step.value(1e-6), 2.0);
  EXPECT_EQ(step.value(std::nextafter(3e-3, 1.0)), 2.0);  // round-off of the time must not lose the last step
  EXPECT_EQ(step.value(3.01e-3), 0.0);
  const auto ramped = Waveform::constant(4.0).scaled(0.5).ramped(2.0);
  EXPECT_EQ(ramped.value(0.0), 0.0);
  EXPECT_NEAR(ramped.value(1.0), 1.0, 1e-15);
  EXPECT_EQ(ramped.value(2.0), 2.0);
  EXPECT_EQ(ramped.value(20.0), 2.0);
  EXPECT_EQ(Waveform::constant(4.0).ramped(0.0).value(-1.0), 4.0);
}

TEST(Waveform, LinearOrderTwo) {
  const TableOptions options{.interpolation = Interpolation::linear};
  const double coarse = largest_error(Waveform::table(sampled(20, 0.8, wave), options), 0.8);
  const double fine = largest_error(Waveform::table(sampled(40, 0.8, wave), options), 0.8);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.2);
}

TEST(Waveform, PeriodicSplineOrderFourAndSmoothAcrossThePeriod) {
  const TableOptions options{.interpolation = Interpolation::spline};
  const double coarse = largest_error(Waveform::table(sampled(20, 0.8, wave), options), 0.8);
  const auto waveform = Waveform::table(sampled(40, 0.8, wave), options);
  EXPECT_NEAR(std::log2(coarse / largest_error(waveform, 0.8)), 4.0, 0.3);
  const double h = 1e-4;
  for (double t : {0.0, 0.8}) {  // second differences from both sides agree with each other
    const double left = (waveform.value(t) - 2 * waveform.value(t - h) + waveform.value(t - 2 * h)) / (h * h);
    const double right = (waveform.value(t) - 2 * waveform.value(t + h) + waveform.value(t + 2 * h)) / (h * h);
    EXPECT_NEAR(left, right, 0.01 * std::abs(left) + 0.5);
  }
}

TEST(Waveform, UnevenSplineReproducesItsPointsAndALine) {
  const Table line{.times = {0.0, 0.1, 0.5, 0.6, 2.0}, .values = {1.0, 1.2, 2.0, 2.2, 5.0}};
  const auto natural = Waveform::table(line, {.interpolation = Interpolation::spline, .periodic = false});
  for (double t : {0.0, 0.05, 0.3, 0.55, 1.3, 2.0}) EXPECT_NEAR(natural.value(t), 1.0 + 2.0 * t, 1e-14);
  const Table closed{.times = {0.0, 0.1, 0.5, 0.6, 2.0}, .values = {1.0, 1.2, -2.0, 2.2, 1.0}};
  const auto periodic = Waveform::table(closed, {.interpolation = Interpolation::spline});
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(periodic.value(closed.times[i]), closed.values[i], 1e-13);
}

TEST(Waveform, FourierKeepsTheNumberOfModesAndTheMean) {
  const auto table = sampled(400, 0.8, wave);
  const auto all = Waveform::table(table, {.interpolation = Interpolation::fourier, .modes = 3});
  EXPECT_LT(largest_error(all, 0.8), 2e-4);  // the table's straight lines lose (pi k / n)^2 / 3 of harmonic k
  const auto two = Waveform::table(table, {.interpolation = Interpolation::fourier, .modes = 2});
  for (double t : {0.1, 0.33, 0.7}) EXPECT_NEAR(two.value(t), 3.0 + std::cos(2 * pi * t / 0.8), 2e-4);
  const auto one = Waveform::table(table, {.interpolation = Interpolation::fourier, .modes = 1});
  EXPECT_NEAR(one.value(0.123), 3.0, 1e-12);
  EXPECT_NEAR(all.mean(), 3.0, 1e-12);
}

TEST(Waveform, FourierOfATriangleHasTheKnownCoefficients) {
  const Table triangle{.times = {0.0, 0.5, 1.0}, .values = {1.0, -1.0, 1.0}};  // 8/pi^2 sum_odd cos(k w t) / k^2
  const auto series = Waveform::table(triangle, {.interpolation = Interpolation::fourier, .modes = 2});
  for (double t : {0.0, 0.2, 0.6}) EXPECT_NEAR(series.value(t), 8 / (pi * pi) * std::cos(2 * pi * t), 1e-14);
}

TEST(Waveform, RampHoldsItsEnds) {
  const auto ramp = Waveform::table({{1, 2, 3}, {10, 99, 30}}, {.interpolation = Interpolation::ramp});
  EXPECT_DOUBLE_EQ(ramp.value(0), 10);
  EXPECT_DOUBLE_EQ(ramp.value(2), 20);
  EXPECT_DOUBLE_EQ(ramp.value(3), 30);
  EXPECT_DOUBLE_EQ(ramp.value(100), 30);
  EXPECT_FALSE(ramp.period());
}

// The straight line is exact, and the series is that of what is left.
TEST(Waveform, FourierWithTrendNeedNotClose) {
  Table table = sampled(512, 2.0, wave);
  const auto closed = Waveform::table(table, {.interpolation = Interpolation::fourier, .modes = 4});
  for (std::size_t i = 0; i < table.times.size(); ++i) table.values[i] += 5 * table.times[i];
  EXPECT_THROW(Waveform::table(table, {.interpolation = Interpolation::fourier, .modes = 4}), InputError);
  const auto drifting = Waveform::table(table, {.interpolation = Interpolation::fourier, .modes = 4, .trend = true});
  for (const double t : {0.1, 0.7, 1.9}) EXPECT_NEAR(drifting.value(t), closed.value(t) + 5 * t, 1e-12);
  EXPECT_NEAR(drifting.value(2.7), drifting.value(0.7), 1e-12);
  EXPECT_NEAR(drifting.mean(), closed.mean() + 5, 1e-12);
}

TEST(Waveform, PeriodicInBothDirectionsAndMeanOfEachInterpolation) {
  const auto table = sampled(50, 0.8, wave);
  for (const auto kind : {Interpolation::linear, Interpolation::spline, Interpolation::fourier}) {
    const auto waveform = Waveform::table(table, {.interpolation = kind, .modes = 3}).scaled(-2.0);
    EXPECT_EQ(waveform.period().value(), 0.8);
    EXPECT_NEAR(waveform.value(0.3), waveform.value(0.3 + 80.0), 1e-11);
    EXPECT_NEAR(waveform.value(0.3), waveform.value(0.3 - 1.6), 1e-12);
    double sum = 0.0;
    const int n = 200000;
    for (int i = 0; i < n; ++i) sum += waveform.value(0.8 * (i + 0.5) / n) / n;
    EXPECT_NEAR(waveform.mean(), sum, 1e-7);
  }
}

TEST(Waveform, MeanOfAnUnevenSpline) {
  const Table table{.times = {0.0, 0.1, 0.5, 0.6, 2.0}, .values = {1.0, 1.2, -2.0, 2.2, 1.0}};
  const auto waveform = Waveform::table(table, {.interpolation = Interpolation::spline});
  double sum = 0.0;
  const int n = 200000;
  for (int i = 0; i < n; ++i) sum += waveform.value(2.0 * (i + 0.5) / n) / n;
  EXPECT_NEAR(waveform.mean(), sum, 1e-8 * std::abs(sum));
}

TEST(Waveform, NonPeriodicRefusesTimesOutsideTheTable) {
  const Table table{.times = {0.0, 1.0}, .values = {1.0, 2.0}};
  const auto waveform = Waveform::table(table, {.periodic = false}, "inlet.csv");
  EXPECT_NEAR(waveform.value(0.25), 1.25, 1e-15);
  EXPECT_EQ(waveform.value(1.0 + 1e-13), 2.0);
  EXPECT_NEAR(waveform.mean(), 1.5, 1e-15);
  EXPECT_FALSE(waveform.period());
  EXPECT_THROW((void)waveform.value(1.1), InputError);
  EXPECT_THROW((void)waveform.value(-0.1), InputError);
  EXPECT_THROW((void)waveform.value(std::nan("")), InputError);
}

TEST(Waveform, PeriodMayExceedTheTableButMustClose) {
  const Table open{.times = {0.0, 0.5, 0.9}, .values = {1.0, 3.0, 2.0}};
  EXPECT_TRUE(contains(message(open, {}), "does not close"));
  EXPECT_TRUE(contains(message(open, {.period = 0.8}), "shorter"));
  EXPECT_TRUE(contains(message(open, {.periodic = false, .period = 1.0}), "not periodic"));
  const auto waveform = Waveform::table(open, {.period = 1.0});
  EXPECT_NEAR(waveform.value(0.95), 1.5, 1e-14);
  EXPECT_NEAR(waveform.value(1.25), 2.0, 1e-14);
}

TEST(Waveform, TheLastValueHoldsWhereAsked) {
  const Table table{.times = {0.0, 0.5, 0.9}, .values = {1.0, 3.0, 2.0}};
  const auto held = Waveform::table(table, {.periodic = false, .hold = true});
  EXPECT_EQ(held.value(0.9), 2.0);
  EXPECT_EQ(held.value(7.0), 2.0);
  EXPECT_NEAR(held.value(0.25), 2.0, 1e-14);
  EXPECT_THROW((void)held.value(-0.1), InputError) << "there is nothing before the first value";
  EXPECT_THROW((void)Waveform::table(table, {.periodic = false}).value(1.0), InputError);
  EXPECT_TRUE(contains(message({{0.0, 1.0}, {1.0, 1.0}}, {.hold = true}), "periodic"));
}

TEST(Waveform, RefusesUnusableOptions) {
  const auto table = sampled(10, 1.0, wave);
  EXPECT_TRUE(contains(message(table, {.interpolation = Interpolation::fourier}), "modes"));
  EXPECT_TRUE(contains(message(table, {.interpolation = Interpolation::fourier, .modes = 99}), "1 .. 11"));
  EXPECT_TRUE(
      contains(message(table, {.interpolation = Interpolation::fourier, .periodic = false, .modes = 3}), "periodic"));
  EXPECT_TRUE(contains(message({{0.0, 1.0}, {1.0, 1.0}}, {.interpolation = Interpolation::spline}), "4 points"));
  EXPECT_TRUE(contains(message({{0.0, 0.0}, {1.0, 1.0}}, {}), "does not increase"));
  EXPECT_TRUE(contains(message({{0.0}, {1.0}}, {}), "at least 2"));
  EXPECT_THROW((void)Waveform::step({.value = 1.0, .start = 1.0, .end = 0.5}), InputError);
  EXPECT_THROW((void)Waveform::constant(1.0).ramped(-1.0), InputError);
}

TEST(WaveformFile, CsvWithColumnsUnitsAndComments) {
  const Temporary file("a.csv", "# comment\r\nt_ms,p,\"Q ml/s\"\r\n0,1,+2\r\n\r\n# more\r\n5,1,4e0\r\n10,1,2\r\n");
  const auto table = read_table({.path = file.path, .value_column = "Q ml/s", .time_unit = 1e-3, .value_unit = 1e-6});
  ASSERT_EQ(table.times.size(), 3u);
  EXPECT_NEAR(table.times[1], 5e-3, 1e-18);
  EXPECT_NEAR(table.values[1], 4e-6, 1e-20);
  WaveformInput input{.source = TableSource{{.path = file.path, .value_column = "Q ml/s"}, {}}, .scale = 10.0};
  EXPECT_NEAR(make_waveform(input).value(7.5), 30.0, 1e-13);
  const Temporary two("b.CSV", "t,Q\n0,1\n1,2\n");
  EXPECT_EQ(read_table({.path = two.path}).values[1], 2.0);
}

TEST(WaveformFile, ErrorsNameFileAndLine) {
  EXPECT_TRUE(contains(message(TableFile{.path = "/nowhere/q.csv"}), "/nowhere/q.csv: cannot be read: No such file"));
  EXPECT_TRUE(contains(message(TableFile{.path = "/nowhere/q.txt"}), "format"));
  const struct {
    const char *text, *expected;
  } cases[] = {{"t,Q\n0,1\n1,x\n", "a.csv:3: 'x' under 'Q' is not a number"},
               {"t,Q\n0,1\n1,nan\n", "a.csv:3: 'nan'"},
               {"t,Q\n0,1\n1,\n", "a.csv:3: '' under 'Q'"},
               {"t,Q\n0,1\n0,2\n", "a.csv:3: time 0 s does not increase"},
               {"t,Q\n0,1\n1\n", "a.csv:3: has 1 columns, the header 2"},
               {"0,1\n1,2\n", "a.csv:1: the first line holds numbers"},
               {"t,Q,p\n0,1,1\n", "value_column` to one of: t, Q, p"},
               {"t\n0\n", "one column"},
               {"t,Q\n0,1\n", "at least 2"},
               {"t;Q\n0;1,5\n1;2\n", "'1,5' under 'Q' is not a number"},
               {"t,Q\n0,1\n1,\xFC\n", "line 3, column 3: holds the byte 0xfc"},
               {"# only\n", "empty"}};
  for (const auto& c : cases) {
    const Temporary file("a.csv", c.text);
    const auto text = message(TableFile{.path = file.path});
    EXPECT_TRUE(contains(text, c.expected)) << text;
  }
  const Temporary file("a.csv", "t,Q,p\n0,1,1\n1,1,1\n");
  EXPECT_TRUE(contains(message(TableFile{.path = file.path, .value_column = "flow"}), "no column is called 'flow'"));
}

TEST(WaveformFile, SimVascular) {
  const Temporary good("a.flow", "3 2\n0 0\n0.5\t-1\n 1.0   0 \n");
  const auto table = read_table({.path = good.path, .value_unit = -1e-6});
  EXPECT_EQ(table.modes, 2);
  EXPECT_NEAR(table.values[1], 1e-6, 1e-20);
  const struct {
    const char *text, *expected;
  } cases[] = {{"3 2\n0 0\n1 0\n", "2 points follow, the first line says 3"},
               {"3\n0 0\n", "a.flow:1: the first line has 1 entries"},
               {"2.5 2\n0 0\n1 0\n", "'2.5' is not a whole number"},
               {"2 2\n0 0\n1 zero\n", "a.flow:3: 'zero'"},
               {"2 2\n0 0 0\n1 0\n", "a.flow:2: 3 entries"}};
  for (const auto& c : cases) {
    const Temporary file("a.flow", c.text);
    const auto text = message(TableFile{.path = file.path});
    EXPECT_TRUE(contains(text, c.expected)) << text;
  }
}

TEST(WaveformFile, SimVascularTablesAreSeriesByDefault) {
  const Temporary file("a.flow", "5 3\n0 0\n0.25 2\n0.5 1\n0.75 -1\n1 0.5\n");  // does not close
  const auto automatic = make_waveform({.source = TableSource{{.path = file.path}, {}}});
  const TableOptions options{.interpolation = Interpolation::fourier, .trend = true};
  const auto series = make_waveform({.source = TableSource{{.path = file.path}, options}});
  for (double t = 0; t < 2; t += 0.1) EXPECT_EQ(automatic.value(t), series.value(t));
  EXPECT_NEAR(automatic.period().value(), 1.0, 1e-15);
  const Temporary bare("b.flow", "0 0\n0.25 2\n0.5 1\n0.75 -1\n1 0.5\n");  // names no modes
  EXPECT_EQ(make_waveform({.source = TableSource{{.path = bare.path}, {.modes = 3}}}).value(0.3), series.value(0.3));
  const TableOptions once{.periodic = false};
  EXPECT_NEAR(make_waveform({.source = TableSource{{.path = file.path}, once}}).value(0.125), 1.0, 1e-14);
  const Temporary csv("a.csv", "t,q\n0,0\n0.25,2\n1,0\n");
  EXPECT_NEAR(make_waveform({.source = TableSource{{.path = csv.path}, {}}}).value(0.125), 1.0, 1e-14);
}

// --- real files -------------------------------------------------------------------------------------------------

fs::path shared(const char* name) { return fs::path(TUNICA_SHARED_DATA) / name; }

TEST(WaveformFile, FourierCoefficients) {
  const Temporary file("series.fcs", "1.0 2.0\n3.0 0.5\n2\n-1.0 0\n0.25 -0.75\n");
  const TableSource source{{.path = file.path, .value_unit = 10}, {}};
  const Waveform waveform = make_waveform({.source = source});
  const double h = 0.3, angle = pi * h;
  EXPECT_NEAR(waveform.value(1 + h), 10 * (3 + 0.5 * h - 1 + 0.25 * std::cos(angle) + 0.75 * std::sin(angle)), 1e-12);
  EXPECT_NEAR(*waveform.period(), 2, 1e-15);
  EXPECT_NEAR(waveform.mean(), 10 * (3 + 0.5 - 1), 1e-12);
  EXPECT_EQ(read_table(source.file).times.size(), 16u);
  // As svFSI's own files have them, number under number.
  const Temporary column("column.fcs", "  1.0\n  2.0D0\n 3.0\n 0.5\n 2\n -1.0 0\n 0.25 -0.75\n");
  EXPECT_EQ(make_waveform({.source = TableSource{{.path = column.path, .value_unit = 10}, {}}}).value(1 + h),
            waveform.value(1 + h));
  const Temporary wrong("wrong.fcs", "0 1\n0 0\n3\n1 0\n");
  EXPECT_THROW(make_waveform({.source = TableSource{{.path = wrong.path}, {}}}), InputError);
}

TEST(WaveformFile, FourierCoefficientsOfThreeComponents) {
  const Temporary pairs("pairs.fcs", "0 2\n1 0.1\n2 0.2\n3 0.3\n1\n4 5 6 7 8 9\n");
  const Temporary columns("columns.fcs", "0\n2\n1 2 3\n0.1 0.2 0.3\n1\n4 5 6 7 8 9\n");
  for (const auto* file : {&pairs, &columns}) {
    const auto series = read_fourier_series({.path = file->path}, 3);
    ASSERT_EQ(series.size(), 3u);
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(series[static_cast<std::size_t>(i)].value, 1 + i);
      EXPECT_DOUBLE_EQ(series[static_cast<std::size_t>(i)].slope, 0.1 * (1 + i));
      EXPECT_EQ(series[static_cast<std::size_t>(i)].cosine, std::vector<double>{4.0 + i});
      EXPECT_EQ(series[static_cast<std::size_t>(i)].sine, std::vector<double>{-7.0 - i});
    }
  }
  EXPECT_THROW(read_fourier_series({.path = pairs.path}, 1), InputError);
}

TEST(WaveformFile, RealSimVascularInflow) {
  const auto path = shared("pipe_fluid/lumen_inlet.flow");
  if (!fs::exists(path)) GTEST_SKIP() << path << " is absent";
  const auto table = read_table({.path = path, .value_unit = -1e-6});
  EXPECT_EQ(table.modes, 16);
  const auto series = Waveform::table(table, {.interpolation = Interpolation::fourier});
  const auto lines = Waveform::table(table, {.interpolation = Interpolation::linear});
  EXPECT_EQ(series.period().value(), 1.0);
  EXPECT_NEAR(series.mean(), lines.mean(), 1e-18);
  EXPECT_GT(series.mean(), 0.0);
  double peak = 0.0, difference = 0.0;
  for (int i = 0; i <= 32; ++i) {
    peak = std::max(peak, std::abs(lines.value(i / 32.0)));
    difference = std::max(difference, std::abs(lines.value(i / 32.0) - series.value(i / 32.0)));
  }
  EXPECT_LT(difference, 0.01 * peak);
}

TEST(WaveformFile, RealCsvFiles) {
  const auto aorta = shared("waveforms/ascending_aorta_inflow.csv");
  if (!fs::exists(aorta)) GTEST_SKIP() << aorta << " is absent";
  const double period = 0.7;  // phase and ratio to the mean: the period and the scale come from the case
  const WaveformInput input{
      .source = TableSource{{.path = aorta, .value_column = "flow_ratio", .time_unit = period}, {.period = period}},
      .scale = 1.7e-4};
  EXPECT_NEAR(make_waveform(input).mean(), 1.7e-4, 1.7e-6);
  for (const char* name : {"waveforms/boileau_uta_inflow.csv", "waveforms/boileau_adan56_inflow.csv"}) {
    const auto waveform = make_waveform(
        {.source = TableSource{{.path = shared(name), .value_unit = 1e-6}, {.interpolation = Interpolation::spline}}});
    EXPECT_GT(waveform.mean(), 1e-6);
    EXPECT_LT(waveform.mean(), 2e-4);
  }
}

}  // namespace
