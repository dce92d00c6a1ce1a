// The file of `tunica fit`: what was measured on which specimens, and the laws that are fitted to it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tunica/case/material_case.hpp"
#include "tunica/config/document.hpp"
#include "tunica/fitting/standard_laws.hpp"

namespace tunica::case_file {

/// A strip.
struct PulledStrip {
  Direction along;
};
struct BiaxialTest : SheetAxes {
  std::optional<double> load_ratio;  ///< P across / P along, where the stretch across is not measured
};
struct PlanarTest : SheetAxes {};
struct ShearTest : SheetAxes {};
/// A sheet in the plane of e1 and e2 whose F was measured.
struct MeasuredGradients {
  double volume_tolerance = 0.02;  ///< of det F
};
using TestedSpecimen = std::variant<PulledStrip, BiaxialTest, PlanarTest, ShearTest, MeasuredGradients>;

enum class MeasuredDeformation { stretch, engineering_strain, green_lagrange_strain };
enum class MeasuredStress { cauchy, first_piola_kirchhoff, second_piola_kirchhoff, force };
enum class Branch { loading, unloading, both };

/// Which of the cycles of a test are kept.
struct Cycles {
  std::optional<std::string> column;  ///< header of their numbers; none: told apart where the stretch turns round
  int drop = 0;                       ///< so many first ones are preconditioning
  bool last_only = false;
  Branch branch = Branch::both;
};

struct FitTest {
  TestedSpecimen loading;
  std::filesystem::path file;
  std::optional<std::string> load;  ///< header of the deformation along the first axis, or of the shear
  std::optional<std::string> load_across;
  std::string stress;  ///< header
  std::optional<std::string> stress_across;
  std::optional<std::string> protocol;  ///< header of the numbers that tell protocols apart
  MeasuredDeformation deformation = MeasuredDeformation::stretch;
  MeasuredStress measure = MeasuredStress::first_piola_kirchhoff;
  std::string unit;                               ///< of the stresses, or of the forces
  std::optional<double> section, section_across;  ///< at rest, that the force acts on [m^2]
  double weight = 1.0;
  std::optional<Cycles> cycles;

  /// SI value of the unit.
  double factor() const;
};

struct FitSpecimen {
  std::vector<std::pair<std::string, FitTest>> tests;
};

/// One of the laws that are fitted. Its section is checked as the law that it is at the starting values.
struct FittedLaw {
  std::optional<std::string> standard;  ///< of fitting::standard_laws()
  std::optional<wall::LawParameters> material;
  std::vector<std::pair<std::string, fitting::ParameterSettings>> parameters;
};

struct FitSettings {
  int starts = 8;
  int replicates = 200;
  int seed = 1;
};

/// Cauchy stress of the wall in the body [Pa].
struct InVivoStress {
  double circumferential = 80e3, longitudinal = 40e3;
};

struct FitOutput {
  std::filesystem::path directory;
  std::string stress = "kPa";
};

struct FitCase {
  std::string title;
  std::vector<std::pair<std::string, FitSpecimen>> specimens;
  std::vector<std::pair<std::string, FittedLaw>> laws;
  std::optional<bool> incompressible;  ///< none: as the law's bulk modulus says
  wall::VolumetricEnergy volumetric_energy = wall::VolumetricEnergy::simo_taylor;
  FitSettings fit;
  FitOutput output;
  InVivoStress in_vivo;

  static config::Schema<FitCase> schema();
};

/// A fit with its laws, in the order of FitCase::laws.
struct ReadFitCase {
  FitCase value;
  std::vector<fitting::LawTemplate> laws;
  std::vector<Problem> warnings;
};

/// Throws InputError with all problems.
ReadFitCase read_fit_case(const std::filesystem::path& file);

}  // namespace tunica::case_file
