#include "tunica/stages/vessel_of_case.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/analysis/vessel.hpp"
#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/base/error.hpp"
#include "tunica/case/mesh_settings.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/mesh/edge_nodes.hpp"

namespace tunica::stages {

namespace {

namespace fs = std::filesystem;

/// Of the mesh that the stage `mesh` of this case has made.
case_file::MeshSettings made_meshes(const case_file::Case& c, const fs::path& case_file) {
  const fs::path folder = c.mesh->output.empty() ? c.output.directory / "mesh" : c.mesh->output;
  const fs::path file = folder / "meshes.yaml";
  if (!fs::is_regular_file(file))
    throw InputError(file.string(), "is not there: the mesh of this case has yet to be made",
                     fmt::format("make it first: tunica run {} --until mesh", case_file.string()));
  const auto section = config::Document(config::read_text(file), file.string()).part("meshes");
  return config::parse_document(case_file::MeshSettings::schema(), section,
                                {.name = file.string(), .folder = folder, .check_files = true})
      .value;
}

}  // namespace

analysis::PostSettings post_settings(const case_file::Case& c) {
  return c.post ? *c.post : config::parse_text(analysis::PostSettings::schema(), "{}").value;
}

const mesh::FaceData& VesselOfCase::face(const std::string& name) const {
  return *std::find_if(mesh.faces.begin(), mesh.faces.end(), [&](const auto& f) { return f.name == name; });
}

VesselOfCase vessel_with_corners(const fs::path& case_file) {
  VesselOfCase vessel;
  vessel.settings = case_file::parse_case(config::read_text(case_file), case_file);
  auto& c = vessel.settings;
  if (!c.solves_fluid())
    throw InputError(case_file.string(), "is a case without blood", "give a case of `analysis: fsi` or `flow`");
  if (c.mesh) {
    c.meshes = made_meshes(c, case_file);
    if (!c.solves_wall()) c.meshes.wall.reset(), c.meshes.interface.reset();
  }
  vessel.mesh = artifacts::load_meshes(c.meshes, {}).data;
  std::vector<std::string> of_lumen;
  for (const auto& face : vessel.mesh.faces)
    if (vessel.mesh.regions[static_cast<std::size_t>(face.region)].kind == mesh::RegionKind::lumen)
      of_lumen.push_back(face.name);
  const auto sticks = case_file::sticking_faces(c, of_lumen);
  const auto run = case_file::describe(c);
  vessel.inlet = analysis::inlet_name(run, post_settings(c));
  for (const auto& name : of_lumen)
    if (std::find(sticks.begin(), sticks.end(), name) == sticks.end()) vessel.openings.push_back(name);
  const auto at = std::find(vessel.openings.begin(), vessel.openings.end(), vessel.inlet);
  if (at == vessel.openings.end())
    throw InputError("post.inlet", fmt::format("the lumen has no opening '{}'", vessel.inlet),
                     "name one of: " + files::listed(vessel.openings));
  std::rotate(vessel.openings.begin(), at, at + 1);
  return vessel;
}

VesselOfCase vessel_of_case(const fs::path& case_file) {
  auto vessel = vessel_with_corners(case_file);
  if (vessel.settings.elements == case_file::Elements::quadratic) mesh::add_edge_nodes(vessel.mesh);
  return vessel;
}

}  // namespace tunica::stages
