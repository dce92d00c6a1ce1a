// What a benchmark is: a case, the figures that are taken from its results, and what they are held against.
#pragma once

#include <complex>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/case/case.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/mesh/mesh_data.hpp"

namespace tunica::stages::validate {

/// How a benchmark is computed.
struct Variant {
  bool full = false;  ///< with a mesh that resolves it; else in seconds, to less
  case_file::Elements elements = case_file::Elements::quadratic;
};

/// Tolerance of a run that is too short or coarse for its figures: it only has to come to its end.
inline constexpr double not_judged = std::numeric_limits<double>::infinity();

/// A figure with its reference. Deviations are relative to `scale`, or to the value itself where that is 0.
struct Reference {
  std::string name, unit;
  double value, scale;
  double quick, full;  ///< largest deviation of the two variants
  /// A measurement beside a computed value: what lies between the two does not deviate.
  std::optional<double> measured{};
};

/// A case as `tunica run` takes it, with the files that it names. Where these have a mesh.yaml, `tunica mesh` makes its
/// mesh first, in the folder `mesh`.
struct Posed {
  std::string case_text;
  std::optional<mesh::MeshData> mesh{};                      ///< written as the folders lumen and wall
  std::vector<std::pair<std::string, std::string>> files{};  ///< name, content
};

/// The histories of a run.
class Results {
 public:
  explicit Results(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// Column of a history: history("points", "A displacement x [m]"). Throws InputError where it is not there.
  std::vector<double> history(const std::string& file, const std::string& column) const {
    return files::read_csv(folder_ / (file + ".csv"), "compute the benchmark anew", files::Gaps::allowed)
        .column(column);
  }
  double last(const std::string& file, const std::string& column) const { return history(file, column).back(); }

 private:
  std::filesystem::path folder_;
};

struct Plot {
  drawing::PlotOptions options;
  std::vector<drawing::Series> series;
};

struct Benchmark {
  std::string name, title;
  std::string source;  ///< of the references
  std::vector<Reference> references;
  std::function<Posed(const Variant&)> pose;
  std::function<std::vector<double>(const Results&)> measure;  ///< in the order of the references
  std::function<Plot(const Results&)> plot{};                  ///< may be empty
  bool long_run = false;                                       ///< many minutes or hours: only done when it is named
};

/// All of them, in the order of the page.
std::vector<Benchmark> benchmarks();

std::vector<Benchmark> flow_benchmarks();  ///< blood in rigid walls
std::vector<Benchmark> jet_benchmarks();   ///< orifice and nozzle, on meshes of `tunica mesh`
std::vector<Benchmark> wave_benchmarks();  ///< pulse waves in elastic tubes
std::vector<Benchmark> wall_benchmarks();  ///< walls alone
std::vector<Benchmark> flag_benchmarks();  ///< Turek & Hron (2006)

/// "elements: quadratic\n".
std::string elements_line(const Variant& variant);
/// The section `fluid` [kg/m^3, Pa s].
std::string fluid_section(double density, double viscosity);
/// The lines that all sections `output` begin with: no fields, SI.
extern const char* const output_section;

/// J_0 and J_1 by their series.
std::complex<double> bessel(int order, std::complex<double> z);
/// Amplitude of what has the period `period` in the last whole period: value = Re(amplitude e^(i omega t)).
std::complex<double> harmonic(const std::vector<double>& time, const std::vector<double>& value, double period);

}  // namespace tunica::stages::validate
