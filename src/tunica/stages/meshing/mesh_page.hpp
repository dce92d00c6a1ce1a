// The report of a mesh as a page with pictures and plots.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tunica/meshing/patient_complex.hpp"
#include "tunica/meshing/tears.hpp"
#include "tunica/meshing/wall_regions.hpp"

namespace tunica::stages {

struct MeshPageInput {
  std::string title;
  const geometry::Tetrahedra& mesh;
  const meshing::WallRegions& regions;
  const std::vector<meshing::Tear>& tears;
  const meshing::PreparedSurfaces& prepared;
  const nlohmann::json& report;  ///< of mesh_report()
};

/// One HTML file that needs no other: regions from outside and from within, thickness of wall and flap, cuts through
/// the flap and the tears, histograms of dihedral angle and radius ratio, tables of regions, openings and tears.
std::string mesh_page(const MeshPageInput& input);

}  // namespace tunica::stages
