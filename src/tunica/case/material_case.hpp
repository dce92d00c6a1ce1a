// The file of `tunica material`: a wall law and the tests that a specimen of it is put through.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tunica/config/schema.hpp"
#include "tunica/wall/material_paths.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::case_file {

// --- loading ------------------------------------------------------------------------------------------------------

/// A direction in the fibre frame.
template <int axis>
struct Axis {};
using Direction = std::variant<Axis<0>, Axis<1>, Axis<2>, double, Vec3<double>>;  ///< angle in the plane, vector
Vec3<double> vector_of(const Direction& direction);
config::Schema<Direction> direction_schema();

/// Values of the load in equal steps.
struct LoadPath {
  double from = 0.0, to = 0.0;
  int steps = 20;

  double at(int step) const { return step == steps ? to : from + (to - from) * step / steps; }
};

struct Uniaxial {
  Direction along;
  LoadPath stretch;
};
/// Edges of a sheet.
struct SheetAxes {
  Direction along, across = Axis<1>{};
};
void check_perpendicular(const SheetAxes& axes, config::Problems& problems);

struct Sheet : SheetAxes {
  LoadPath load;
};
struct Equibiaxial : Sheet {};
struct Planar : Sheet {};
struct SimpleShear : Sheet {};
struct Biaxial : Sheet {
  std::optional<double> to_across;  ///< stretch across when `load` has come to its end; or the next
  std::optional<double> ratio;      ///< (stretch across - 1) / (stretch along - 1)

  double across_at(double stretch) const;
};
struct Gradient {
  std::array<double, 9> F{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< by rows
};
struct Gradients {
  std::optional<std::filesystem::path> file;
  std::vector<Gradient> list;
};
using Loading = std::variant<Uniaxial, Equibiaxial, Biaxial, Planar, SimpleShear, Gradients>;

/// The keys `along` and `across` of whatever has edges.
template <class T>
config::Schema<T> sheet_axes_schema(const char* name, const char* help, const char* along, const char* across) {
  return config::Schema<T>(name, help)
      .section("along", &SheetAxes::along, direction_schema(), along)
      .by_default("e1")
      .section("across", &SheetAxes::across, direction_schema(), across)
      .by_default("e2")
      .check(check_perpendicular);
}

// --- tests --------------------------------------------------------------------------------------------------------

using wall::StressMeasure;

struct MeasuredData {
  std::filesystem::path file;
  std::string load, stress;  ///< headers
  std::optional<std::string> stress_across;
  double unit = 1.0;  ///< Pa
};

struct MaterialTest {
  Loading loading;
  StressMeasure measure = StressMeasure::cauchy;
  std::optional<MeasuredData> data;
};

enum class PlotFormat { svg, png };

struct MaterialOutput {
  std::filesystem::path directory;
  std::string stress = "kPa";
  PlotFormat plots = PlotFormat::svg;

  /// The ending of the files of plots.
  const char* plot_ending() const { return plots == PlotFormat::png ? ".png" : ".svg"; }
};

struct MaterialCase {
  std::string title;
  wall::LawParameters material;
  wall::VolumetricEnergy volumetric_energy = wall::VolumetricEnergy::simo_taylor;
  std::optional<bool> incompressible;  ///< none: as the law's bulk modulus says
  std::vector<std::pair<std::string, MaterialTest>> tests;
  MaterialOutput output;

  wall::Volumetric volumetric() const;
  static config::Schema<MaterialCase> schema();
};

/// Throws InputError with all problems.
config::Parsed<MaterialCase> read_material_case(const std::filesystem::path& file);

}  // namespace tunica::case_file
