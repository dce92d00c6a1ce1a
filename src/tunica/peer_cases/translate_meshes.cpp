// meshes: volumes, faces, domains, interface.
#include <fmt/format.h>

#include <algorithm>

#include "tunica/base/text.hpp"
#include "tunica/peer_cases/problem.hpp"
#include "tunica/peer_cases/values.hpp"

namespace tunica::peer_cases {

namespace {

void translate_faces(Context& context, const Entry& mesh, bool lumen, CaseKey& section) {
  auto& faces = section.section("faces", "");
  for (const Entry* face : mesh.all("Add_face")) {
    const Entry* file = face->find("Face_file_path");
    if (file == nullptr)
      context.refuse(*face, "has no Face_file_path", "give the file of the face");
    else
      faces.add(face->label, context.path(*file), file->where());
  }
  if (lumen ? context.findings.lumen_rest : context.findings.wall_rest)
    section.add("rest", rest_face(lumen), mesh.where() + ": boundary that no Add_face names");
}

/// The regions of the wall, told apart by an array of another file.
void translate_regions(Context& context, const PosedProblem& problem, const Entry& mesh, CaseKey& section) {
  const WallParts parts = wall_parts(context, problem);
  if (parts.regions.empty()) return;
  const Entry* domains = mesh.find("Domain_file_path");
  const std::string where =
      domains != nullptr ? domains->where() : mesh.all("Fiber_direction_file_path").back()->where();
  const std::string name = parts.made ? "REGION" : "DOMAIN_ID";
  auto& array = section.section("arrays", "").section(name, where);
  if (parts.made) {
    WallRegions made{.domains = domains != nullptr ? context.located(*domains) : std::filesystem::path(),
                     .known = {},
                     .where = where,
                     .file = context.file.path.stem().string() + "_regions.vtu"};
    for (const DomainPart& part : problem.walls)
      if (part.id) made.known.push_back(*part.id);
    if (domains != nullptr) context.path(*domains);  // warns when it is not there
    array.add("file", yaml_text(made.file), "made of it");
    context.remarks.changed.push_back(where + ": the regions of the elements belong in the file " + made.file +
                                      ", which is written where the mesh is there");
    context.regions = std::move(made);
  } else {
    array.add("file", context.path(*domains), where);
  }
  section.add("region_array", name, where);
  auto& regions = section.section("regions", "");
  for (const WallRegion& region : parts.regions)
    regions.add(region.name, std::to_string(region.number), region.part->properties->where());
}

/// Directions of fibres, which the peers keep in files of their own.
void translate_fibre_files(Context& context, const Entry& mesh, CaseKey& section) {
  const auto files = mesh.all("Fiber_direction_file_path");
  if (files.empty()) return;
  CaseKey* arrays = nullptr;
  for (CaseKey& key : section.below)
    if (key.key == "arrays") arrays = &key;
  if (arrays == nullptr) arrays = &section.section("arrays", "");
  for (std::size_t n = 0; n < files.size(); ++n) {
    auto& array = arrays->section(fmt::format("fibre_{}", n + 1), files[n]->where());
    array.add("file", context.path(*files[n]), files[n]->where());
    array.add("array", "FIB_DIR", fmt::format("the name that {} reads", context.peer()));
  }
}

void translate_mesh(Context& context, const PosedProblem& problem, const Entry& mesh, bool lumen, CaseKey& meshes) {
  auto& section = meshes.section(lumen ? "lumen" : "wall", mesh.where() + " " + mesh.label);
  const Entry* file = mesh.find("Mesh_file_path");
  if (file == nullptr)
    context.refuse(mesh, "has no Mesh_file_path", "give the file of the volume");
  else
    section.add("volume", context.path(*file), file->where());
  translate_faces(context, mesh, lumen, section);
  if (lumen) return;
  translate_regions(context, problem, mesh, section);
  if (mesh.find("Domain_file_path") == nullptr && problem.walls.size() > 1)
    context.refuse(mesh, fmt::format("has one Domain, the equation has {} of walls", problem.walls.size()),
                   "give the mesh a Domain_file_path, or leave Domains out");
  translate_fibre_files(context, mesh, section);
}

void translate_scale(Context& context, const PosedProblem& problem, CaseKey& meshes) {
  const Entry* parts[] = {problem.lumen, problem.wall};
  std::optional<double> scale;
  std::string source;
  for (const Entry* mesh : parts) {
    if (mesh == nullptr) continue;
    const double own = context.number(*mesh, "Mesh_scale_factor").value_or(1.0);
    source = context.source(*mesh, "Mesh_scale_factor", fmt::format("--units {}", context.units.name));
    if (scale && *scale != own)
      context.missing(*mesh, "meshes of blood and wall in different units", "scale one of the meshes");
    scale = own;
  }
  if (!scale) return;
  const auto unit = scaled_length_unit(context.units, *scale);
  meshes.add("length_unit", unit.value_or(context.units.length), source);
  if (!unit) meshes.add("scale", number_text(*scale), source);
}

}  // namespace

void translate_meshes(Context& context, const PosedProblem& problem, CaseKey& top) {
  auto& meshes = top.section("meshes", "");
  translate_scale(context, problem, meshes);
  if (problem.solves_fluid() && problem.lumen != nullptr)
    translate_mesh(context, problem, *problem.lumen, true, meshes);
  if (problem.solves_wall() && problem.wall != nullptr) translate_mesh(context, problem, *problem.wall, false, meshes);
  if (!problem.coupled()) return;
  auto& interface = meshes.section("interface", "");
  std::string lumen, wall, source;
  for (const Entry* projection : problem.projections) {
    const FacePart* sides[] = {problem.face(projection->label),
                               problem.face(context.text(*projection, "Project_from_face"))};
    for (const FacePart* side : sides)
      if (side != nullptr) {
        auto& names = side->lumen ? lumen : wall;
        names += (names.empty() ? "" : ", ") + yaml_text(side->face->label);
      }
    source += (source.empty() ? "" : ", ") + projection->where();
  }
  interface.add("lumen", "[" + lumen + "]", source);
  interface.add("wall", "[" + wall + "]", source);
}

}  // namespace tunica::peer_cases
