// What the parts of an export share.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/case/case.hpp"
#include "tunica/config/units.hpp"
#include "tunica/mesh/mesh_data.hpp"
#include "tunica/mesh_io/volume_arrays.hpp"
#include "tunica/peer_cases/unit_system.hpp"
#include "tunica/peer_cases/xml_writer.hpp"
#include "tunica/wall/material.hpp"

namespace tunica::stages {

/// A number as solver.xml has it.
inline std::string number(double value) { return fmt::format("{:.12g}", value); }

/// The case, and what becomes of it. Nothing is written before it is known to be whole.
struct Exported {
  const case_file::Case& c;  ///< with the faces of the mesh in the place of patterns
  const mesh::MeshData& data;
  const peer_cases::UnitSystem& units;
  std::vector<std::pair<std::string, std::string>> tables = {};                ///< name, text
  std::vector<std::pair<std::string, mesh_io::VolumeArray>> wall_arrays = {};  ///< name of the file, array
  std::vector<Problem> problems = {};
  std::vector<std::string> changed = {};

  /// An SI value in a unit of the system.
  std::string in(const char* unit, const config::Dimension& dimension, double value) const {
    return number(value / config::unit_factor(unit, dimension));
  }
  std::string pressure(double value) const { return in(units.pressure, config::dimension::pressure, value); }
  std::string length(double value) const { return in(units.length, config::dimension::length, value); }

  void missing(std::string where, const std::string& what, std::string remedy) {
    problems.push_back({std::move(where), "is what svMultiPhysics does not have: " + what, std::move(remedy)});
  }
  void change(const std::string& where, const std::string& what) { changed.push_back(where + ": " + what); }
  /// The end of the run [s]; 0 of a static wall.
  double end() const;
};

/// Add_BC of all faces but the interface.
void export_conditions(Exported& exported, peer_cases::Entry& equation);
/// Density, viscosity and stabilisation of the blood.
void export_blood(Exported& exported, peer_cases::Entry& domain);
/// Density, law and penalty of one material of the wall; `where`: its place in the case.
void export_material(Exported& exported, const wall::LawParameters& material, double density, const std::string& where,
                     peer_cases::Entry& domain);
/// Fibre directions of the wall, as keys of its Add_mesh: files where they differ from element to element.
void export_fibres(Exported& exported, peer_cases::Entry& mesh);

}  // namespace tunica::stages
