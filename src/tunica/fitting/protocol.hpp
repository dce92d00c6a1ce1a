// What was measured on a specimen, as values, and what a law says in its place.
//
// A protocol is one loading path of one specimen: rows of a measured deformation and of the stresses beside it. The
// deformation is imposed on the law and the stress compared, whichever of the two the machine has controlled.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tunica/wall/material_paths.hpp"

namespace tunica::fitting {

enum class Loading {
  uniaxial,      ///< stretched along a1, the other faces free
  biaxial,       ///< stretched along a1 and a2, the face across a3 free
  planar,        ///< stretched along a1 at constant width along a2, the face across a3 free
  simple_shear,  ///< F = I + shear a1 (x) a2
  gradients,     ///< F of the sheet measured, in the fibre frame; the face across e3 free
};

struct Row {
  int line = 0;                     ///< in the file
  double along = 1.0;               ///< stretch along a1, or the amount of shear
  std::optional<double> across{};   ///< stretch along a2, if measured
  std::array<double, 2> stress{};   ///< along a1 (or in shear), along a2 [Pa]
  std::optional<Mat3<double>> F{};  ///< if measured
};

struct Protocol {
  std::string specimen;
  std::string name;  ///< of the test, with the number of the protocol
  std::string file;
  Loading loading = Loading::uniaxial;
  wall::FibreFrame axes{};  ///< a1, a2, a3 of the specimen
  wall::StressMeasure measure = wall::StressMeasure::first_piola_kirchhoff;
  bool second_stress = false;          ///< is the stress along a2 measured?
  std::optional<double> load_ratio{};  ///< P22 / P11, where the stretch along a2 is not measured
  double weight = 1.0;                 ///< of its squared residuals
  std::vector<Row> rows{};
  std::string test{};  ///< that this is a protocol of; protocols of one test are taken to have noise of one kind

  std::size_t components() const { return second_stress ? 2 : 1; }
  std::size_t values() const { return rows.size() * components(); }
};

/// Stresses of the law at the rows, as measured [Pa]: along and, if measured, across of each row in turn. The volume is
/// kept where K is infinite, with the face across a3 free of traction. Throws SolverError where the law finds no
/// equilibrium, InputError for measured F of a law whose volume may change.
std::vector<double> predicted(const wall::Law& law, const wall::Volumetric& volumetric, const Protocol& protocol);

/// The measured ones in the same order.
std::vector<double> measured(const Protocol& protocol);

/// "biaxial".
const char* name_of(Loading loading);

}  // namespace tunica::fitting
