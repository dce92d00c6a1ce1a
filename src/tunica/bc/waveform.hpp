// Waveforms: the time course of a boundary value (flow, pressure, velocity, traction), in SI units.
//
// A `WaveformInput` says what the case file asks for; `make_waveform` turns it into a `Waveform` that is evaluated.
// Reading a file and evaluating are apart, so that one rank can read the table and others be sent its numbers.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace tunica::bc {

enum class Interpolation {
  automatic,  ///< as the readers of the format do: fourier for periodic .flow tables, else linear
  linear,     ///< straight lines between the points
  spline,     ///< cubic spline, twice continuously differentiable: periodic, or natural when the table is not periodic
  fourier,    ///< the first modes of the Fourier series of the straight-line table; periodic tables only
  ramp        ///< one straight line from the first value to the last, which hold before and after
};

/// `value` for start < t <= end, zero before and after. Times that differ from `start` or `end` by less than 1e-9 of
/// them count as equal, so that a step that ends at t sees the value of the interval it has crossed.
struct Step {
  double value = 0.0;
  double start = 0.0;              ///< s
  std::optional<double> end = {};  ///< s; none: for ever
};

enum class TableFormat {
  automatic,    ///< by the extension: .csv, .flow
  csv,          ///< comments (#), one header line, then numbers separated by commas
  simvascular,  ///< first line "points modes", then "t value" lines
  fourier       ///< .fcs: start, period, value and slope of the trend, number of modes, then re and im of each
};

/// Where a table stands and how its columns become SI.
struct TableFile {
  std::filesystem::path path;
  TableFormat format = TableFormat::automatic;
  std::string time_column = {};   ///< CSV only; empty: the first column
  std::string value_column = {};  ///< CSV only; empty: the second one, if there are just two
  double time_unit = 1.0;         ///< s per unit of the time column; for a phase 0..1, the period
  double value_unit = 1.0;        ///< SI per unit of the value column
};

/// Points of a time course, t strictly increasing.
struct Table {
  std::vector<double> times;   ///< s
  std::vector<double> values;  ///< SI
  int modes = 0;               ///< Fourier modes named in the file (the mean counts as the first); 0: none named
};

/// A Fourier series about a straight line: with h the time since the start of the period,
/// value + slope h + sum of cosine[k] cos(2 pi k h / period) + sine[k] sin(2 pi k h / period).
struct FourierSeries {
  double start = 0.0, period = 0.0;  ///< s
  std::vector<double> cosine, sine;
  double value = 0.0, slope = 0.0;  ///< SI, SI/s
};

/// Reads the coefficients of the series of each component; those of the file are of exp(i k omega h). Throws InputError
/// with file and line.
std::vector<FourierSeries> read_fourier_series(const TableFile& file, std::size_t components = 1);
bool is_fourier_series(const TableFile& file);  ///< by format, or by the extension .fcs

/// Reads a table; of the coefficients of a series, values over a period. Throws InputError with file and line: missing
/// file or column, not a number, a line with too few columns, time that does not increase, fewer than two points,
/// another number of points than the file says.
Table read_table(const TableFile& file);

bool is_simvascular(const TableFile& file);  ///< by format, or by the extension .flow or .fcs: SimVascular's signs

struct TableOptions {
  Interpolation interpolation = Interpolation::automatic;
  bool periodic = true;
  bool hold = false;  ///< not periodic only: the last value holds after the table
  /// s; must not be shorter than the table. None: the table spans one period, and its last value must repeat the
  /// first one within 0.1 % of the range. Given: the curve returns to the first value one period after the first time.
  std::optional<double> period = {};
  int modes = 0;  ///< Fourier only, the mean included; 0: as many as the file says
  /// Fourier only: the straight line from the first to the last value is no part of the series, but added to it; the
  /// table is one period and need not close. Of `automatic` so whenever no period is given.
  bool trend = false;
};

struct TableSource {
  TableFile file;
  TableOptions options;
};

/// What the case file says about a time course.
struct WaveformInput {
  std::variant<double, Step, TableSource> source = 0.0;  ///< constant (SI), step, or table
  double scale = 1.0;
  double ramp_time = 0.0;  ///< s; grows from 0 to the full value as (1 - cos(pi t / ramp_time)) / 2
};

/// A function of time. Copyable value without any reference to files.
class Waveform {
 public:
  static Waveform constant(double value);
  static Waveform step(const Step& step);
  /// `where` names the table in messages. Throws InputError: period that does not close or is shorter than the
  /// table, Fourier of a table that is not periodic or without a number of modes, `hold` of one that is, fewer than 3
  /// points for a spline.
  static Waveform table(const Table& table, const TableOptions& options, const std::string& where = "table");

  /// `where` as in table(). Throws InputError for a period that is not positive and coefficients that are not finite.
  static Waveform fourier_series(FourierSeries series, const std::string& where = "series");

  Waveform scaled(double factor) const;
  /// Multiplied by (1 - cos(pi t / ramp_time)) / 2 until t = ramp_time; 0 leaves it as it is.
  Waveform ramped(double ramp_time) const;

  /// Value at time t [s]. Throws InputError outside the table of a waveform that is not periodic and does not hold;
  /// continues a periodic one in both directions.
  double value(double t) const;
  /// Time average over one period (exact for the chosen interpolation), over the table when it is not periodic, the
  /// value itself of a constant, the plateau of a step. Without the ramp.
  double mean() const;
  std::optional<double> period() const;         ///< s; none when not periodic
  std::optional<FourierSeries> series() const;  ///< where the whole course is one

 private:
  struct Constant {
    double value;
  };
  struct Polynomial {  // on [times[i], times[i+1]]: c0 + c1 h + c2 h^2 + c3 h^3, h = t - times[i]
    std::vector<double> times;
    std::vector<double> coefficients;
    bool periodic;
    bool holds_before = false, holds_after = false;  // the first and the last value
  };
  using Shape = std::variant<Constant, Step, Polynomial, FourierSeries>;

  template <class S>  // in place: g++ 12 with sanitizers warns of moved variants
  Waveform(S shape, std::string where) : shape_(std::in_place_type<S>, std::move(shape)), where_(std::move(where)) {}
  static FourierSeries fourier(const std::vector<double>& times, const std::vector<double>& values, int modes);
  double evaluate(const Polynomial& polynomial, double t) const;

  Shape shape_;
  std::string where_;
  double scale_ = 1.0;
  double ramp_time_ = 0.0;
};

/// Reads what has to be read and builds the waveform. Throws InputError as read_table and Waveform::table do.
Waveform make_waveform(const WaveformInput& input);

}  // namespace tunica::bc
