// What a mesh is like: sizes, shapes, topology.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tunica/geometry/elements_across.hpp"
#include "tunica/mesh/mesh_data.hpp"
#include "tunica/meshing/fidelity.hpp"
#include "tunica/meshing/tears.hpp"

namespace tunica::meshing {

struct Shapes {
  geometry::Index elements = 0;
  double smallest_dihedral = 0, dihedral_quantile = 0;  ///< the worst element, and the worst but 0.01 % [degrees]
  std::vector<geometry::Index> dihedral_histogram,
      radius_ratio_histogram;  ///< smallest angle in bins of 5 degrees, ratio of 0.1
  double smallest_radius_ratio = 0;
  double shortest_edge = 0, mean_edge = 0, longest_edge = 0;  ///< m
};
Shapes shapes(const mesh::MeshData& data, geometry::Index first_element, geometry::Index end_element);

/// A closed surface: connected parts and the sum of their genera. Handles of the lumen: every communication between the
/// lumens beyond the first makes one.
struct Topology {
  geometry::Index parts = 0, genus = 0;
  bool manifold = true;  ///< exactly two triangles at every edge
};
Topology topology(const std::vector<std::array<geometry::Index, 3>>& triangles);

/// How thick the wall is in elements: edges of wall elements that reach from one side of the wall to the other.
struct WallLayers {
  geometry::Index surface_nodes = 0;  ///< on the interface or the outer surface
  geometry::Index bridged_nodes = 0;  ///< of these, ends of an edge that crosses the wall: one element there
  std::vector<std::array<geometry::Index, 2>> bridges;
};
/// `sides`: triangles of the interface and of the outer surface; rings at openings are no side.
WallLayers wall_layers(const geometry::Tetrahedra& mesh, const std::vector<std::array<geometry::Index, 3>>& sides);

struct ReportInput {
  const mesh::MeshData& data;
  const WallLayers& layers;
  const Fidelity& fidelity;
  const geometry::Thickness& thickness;
  const std::vector<Tear>& tears;
  std::vector<std::pair<std::string, double>> seconds;  ///< of each phase
  double peak_memory = 0;                               ///< byte
  std::string size{};                                   ///< what was asked for, in words
  std::vector<geometry::AcrossPart> across{};           ///< `resolution`
};
nlohmann::json mesh_report(const ReportInput& input);
/// The same for the terminal.
std::string report_text(const nlohmann::json& report);

}  // namespace tunica::meshing
