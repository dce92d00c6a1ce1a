#include "tunica/artifacts/load_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tunica/artifacts/plausible_faces.hpp"
#include "tunica/artifacts/prestress_file.hpp"
#include "tunica/artifacts/resolution.hpp"
#include "tunica/case/face_patterns.hpp"
#include "tunica/coupling/wall_prestress.hpp"
#include "tunica/files/hash.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/edge_nodes.hpp"
#include "tunica/mesh/interface.hpp"
#include "tunica/mesh/plausible_size.hpp"
#include "tunica/mesh/quality.hpp"
#include "tunica/mesh_io/gmsh.hpp"
#include "tunica/mesh_io/simvascular.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::artifacts {

namespace {

namespace fs = std::filesystem;
using mesh::LoadedMesh;
using mesh::RegionKind;

/// Runs `action` and keeps what is wrong, so that the problems of all meshes are reported at once.
template <class Action>
void collect(std::vector<Problem>& problems, Action action) {
  try {
    action();
  } catch (const InputError& error) {
    problems.insert(problems.end(), error.problems().begin(), error.problems().end());
  }
}

/// What the wall needs of its mesh besides the shape.
struct WallArrays {
  std::vector<std::string> fields;                                      ///< of the elements
  std::map<std::string, std::vector<std::string>> face_arrays{};        ///< of the nodes of faces
  std::map<std::string, std::vector<mesh_io::OtherFile>> face_files{};  ///< likewise, in files of their own
};

/// With the point arrays that the supports of the case want, by face.
WallArrays wall_arrays(const case_file::Case& c) {
  WallArrays arrays{c.wall_arrays()};
  for (const auto& [face, condition] : c.boundary) {
    const auto* support = std::get_if<bc::Support>(&condition);
    if (support == nullptr) continue;
    for (const bc::FaceArray& array : support->arrays()) {
      if (array.file)
        arrays.face_files[face].push_back({array.name, *array.file, array.name});
      else
        arrays.face_arrays[face].push_back(array.name);
    }
  }
  return arrays;
}

mesh_io::SimVascularOptions wall_options(const case_file::WallMesh& wall, mesh_io::SimVascularOptions options,
                                         const WallArrays& arrays) {
  options.fields = arrays.fields;
  options.face_arrays = arrays.face_arrays;
  options.other_face_files = arrays.face_files;
  for (const auto& [name, other] : wall.arrays)
    options.other_files.push_back({name, other.file, other.array.value_or(name)});
  if (!wall.region_array) return options;
  options.regions.emplace().array = *wall.region_array;
  for (const auto& [name, number] : wall.regions) options.regions->names.emplace(number, name);
  return options;
}

/// A folder, or files of their own.
LoadedMesh read_region(const fs::path& folder, const case_file::NamedFiles& files, RegionKind kind,
                       const std::string& name, const mesh_io::SimVascularOptions& options) {
  if (files.volume.empty()) return mesh_io::read_simvascular(folder, kind, name, options);
  return mesh_io::read_mesh_files({files.volume, {files.faces.begin(), files.faces.end()}, files.rest}, kind, name,
                                  options);
}

LoadedMesh read_regions(const case_file::MeshSettings& m, const WallArrays& arrays) {
  std::vector<LoadedMesh> parts;
  std::vector<Problem> problems;
  const mesh_io::SimVascularOptions options{.metres_per_unit = m.metres(), .specimen = !m.lumen};
  if (m.lumen)
    collect(problems, [&] {
      parts.push_back(read_region(m.lumen->simvascular, m.lumen->files, RegionKind::lumen, "lumen", options));
    });
  if (m.wall)
    collect(problems, [&] {
      parts.push_back(read_region(m.wall->simvascular, m.wall->files, RegionKind::wall, "wall",
                                  wall_options(*m.wall, options, arrays)));
    });
  if (!problems.empty()) throw InputError(std::move(problems));
  if (!m.interface) return mesh::join(parts, {}, {});
  const mesh::Interface interface { m.interface->lumen_faces, m.interface->wall_faces };
  return mesh::join(parts, std::span(&interface, 1), {.tolerance = m.interface->tolerance});
}

/// The sizes for which the polygons of mesh::tube() have the areas of the circles of `sizes`: their corners lie outside
/// of the circles. What corners on the circle take from the area, they would add twice over to the resistance.
mesh::TubeSizes with_areas_of_circles(mesh::TubeSizes sizes) {
  const double factor = mesh::polygon_radius(sizes.cells_around);
  sizes.radius *= factor;
  sizes.wall_thickness *= factor;
  return sizes;
}

LoadedMesh read_or_generate(const case_file::MeshSettings& m, const WallArrays& arrays) {
  if ((m.tube || m.gmsh) && !(arrays.face_arrays.empty() && arrays.face_files.empty()))
    throw InputError("boundary." + (arrays.face_arrays.empty() ? arrays.face_files.begin()->first
                                                               : arrays.face_arrays.begin()->first),
                     "names a point array, which Gmsh's meshes and generated tubes do not bring",
                     "give a constant, or the wall in SimVascular's files (`simvascular`, or `volume` and `faces`)");
  if (m.tube) return {mesh::tube(with_areas_of_circles(*m.tube)), {}};
  if (!m.gmsh) return read_regions(m, arrays);
  mesh_io::GmshOptions options{.metres_per_unit = m.metres(), .regions = {}, .fields = arrays.fields};
  for (const auto& [name, kind] : m.gmsh->regions) options.regions.push_back({name, kind});
  return mesh_io::read_gmsh(m.gmsh->file, options);
}

bc::BoundaryCase boundary_case(const case_file::Case& c, const std::vector<bc::BoundaryFace>& faces) {
  bc::BoundaryCase boundary;
  boundary.faces = faces;
  boundary.interfaces = case_file::interface_pairs(c.meshes);
  boundary.conditions = c.boundary;
  boundary.rigid_wall = std::holds_alternative<case_file::RigidFlow>(c.analysis);
  boundary.pressure_point = c.pressure_point.has_value();
  boundary.static_wall = std::holds_alternative<case_file::StaticWall>(c.analysis);
  return boundary;
}

/// Names of the faces that may have a condition.
std::vector<std::string> free_faces(const case_file::MeshSettings& meshes, std::vector<std::string> names) {
  for (const auto& [lumen, wall] : case_file::interface_pairs(meshes))
    std::erase_if(names, [&](const auto& name) { return name == lumen || name == wall; });
  return names;
}

std::vector<std::string> names_of(const std::vector<bc::BoundaryFace>& faces) {
  std::vector<std::string> names;
  for (const auto& face : faces) names.push_back(face.name);
  return names;
}

void report_quality(CheckedMesh& mesh, std::vector<Problem>& problems) {
  for (std::size_t r = 0; r < mesh.data.regions.size(); ++r) {
    const auto& region = mesh.data.regions[r];
    collect(problems, [&] {
      const auto quality = mesh::check_quality(mesh.data, static_cast<std::int32_t>(r), {}, region.name);
      mesh.report.push_back(fmt::format("{}: {}", region.name, quality.summary));
      mesh.warnings.insert(mesh.warnings.end(), quality.warnings.begin(), quality.warnings.end());
    });
  }
}

/// The meshes with what is to be said of their elements; what is wrong with these is added to `problems`.
CheckedMesh read_and_measure(const case_file::MeshSettings& m, const WallArrays& arrays,
                             std::vector<Problem>& problems) {
  LoadedMesh loaded = read_or_generate(m, arrays);
  CheckedMesh mesh{std::move(loaded.data), std::move(loaded.report), std::move(loaded.warnings), loaded.ten_node};
  report_quality(mesh, problems);
  if (const auto odd = mesh::implausible_size(mesh.data, m.metres_per_unit ? std::optional(m.metres()) : std::nullopt))
    mesh.warnings.push_back(format(*odd));
  return mesh;
}

}  // namespace

CheckedMesh load_meshes(const case_file::MeshSettings& meshes, const std::vector<std::string>& fields) {
  std::vector<Problem> problems;
  CheckedMesh mesh = read_and_measure(meshes, {fields}, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  return mesh;
}

std::vector<bc::BoundaryFace> faces_of(const mesh::MeshData& data) {
  std::vector<bc::BoundaryFace> faces;
  for (const auto& face : data.faces)
    faces.push_back(
        {face.name, data.regions[face.region].kind == RegionKind::lumen ? bc::Field::lumen : bc::Field::wall});
  return faces;
}

std::vector<std::string> wall_regions(const mesh::MeshData& data) {
  std::vector<std::string> names;
  for (const auto& region : data.regions)
    if (region.kind == RegionKind::wall) names.push_back(region.name);
  return names;
}

std::vector<Problem> check_faces(const case_file::Case& c, const std::vector<bc::BoundaryFace>& faces) {
  std::vector<Problem> problems;
  auto boundary = boundary_case(c, faces);
  boundary.conditions = case_file::without_patterns(c.boundary, free_faces(c.meshes, names_of(faces)), problems);
  const auto wrong = bc::check_boundary(boundary);
  problems.insert(problems.end(), wrong.begin(), wrong.end());
  return problems;
}

void name_faces(case_file::Case& c, const CheckedMesh& mesh, MPI_Comm comm) {
  auto names = parallel::on_root(comm, [&] { return names_of(faces_of(mesh.data)); });
  parallel::broadcast(comm, names);
  std::vector<Problem> problems;
  c.boundary = case_file::without_patterns(c.boundary, free_faces(c.meshes, std::move(names)), problems);
  if (!problems.empty()) throw InputError(std::move(problems));
}

CheckedMesh load_corner_mesh(const case_file::Case& c) {
  if (c.mesh || c.fibres)
    throw InputError(c.mesh ? "mesh" : "fibres", "is a stage to be done first, which `tunica run` alone does",
                     "use `tunica run`, or the case file in the folder of a stage that it has made");
  std::vector<Problem> problems;
  CheckedMesh mesh = read_and_measure(c.meshes, wall_arrays(c), problems);
  const auto wrong = check_faces(c, faces_of(mesh.data));
  problems.insert(problems.end(), wrong.begin(), wrong.end());
  // The wall's nodes of the interface were moved onto the lumen's, a prestress of the wall alone knows them where they
  // were.
  const double moved = c.meshes.interface ? c.meshes.interface->tolerance : 0.0;
  if (const auto prestress = c.prestress_file())
    collect(problems, [&] {
      const int points = coupling::prestress_points(c.elements == case_file::Elements::quadratic);
      read_prestress(*prestress, mesh.data, points, std::max(0.01, 2 * moved));
    });
  if (!problems.empty()) throw InputError(std::move(problems));
  // A mesh in the wrong unit makes every flow through it unusual: one warning is enough.
  if (!mesh::implausible_size(mesh.data, {}))
    for (const auto& odd : implausible_on_faces(c, mesh.data)) mesh.warnings.push_back(format(odd));
  std::vector<Problem> known;  // have been thrown
  auto named = c;
  named.boundary = case_file::without_patterns(c.boundary, free_faces(c.meshes, names_of(faces_of(mesh.data))), known);
  mesh.across = resolution(named, mesh.data);
  if (const auto few = too_few_across(named, mesh.across)) mesh.warnings.push_back(format(*few));
  return mesh;
}

CheckedMesh load_mesh(const case_file::Case& c) {
  CheckedMesh mesh = load_corner_mesh(c);
  if (c.elements == case_file::Elements::quadratic) mesh::add_edge_nodes(mesh.data);
  return mesh;
}

std::string meshes_section(const std::vector<std::string>& wall_regions,
                           const std::optional<case_file::InterfaceSettings>& interface) {
  std::string numbers;
  for (std::size_t r = 0; r < wall_regions.size(); ++r)
    numbers += fmt::format("{}{}: {}", r == 0 ? "" : ", ", wall_regions[r], r + 1);
  const auto names = [](const std::vector<std::string>& faces) {
    return faces.size() == 1 ? faces[0] : fmt::format("[{}]", mesh::list_names(faces));
  };
  return fmt::format(
             "# For a case file in this folder; put the folder before the paths for one elsewhere.\n"
             "meshes:\n"
             "  length_unit: mm\n") +
         (interface ? "  lumen: {simvascular: lumen}\n" : "") +
         fmt::format(
             "  wall:\n"
             "    simvascular: wall\n"
             "    region_array: region\n"
             "    regions: {{{}}}\n",
             numbers) +
         (interface ? fmt::format("  interface: {{lumen: {}, wall: {}}}\n", names(interface->lumen_faces),
                                  names(interface->wall_faces))
                    : "");
}

std::uint64_t mesh_hash(const mesh::MeshData& data) {
  files::Hash hash;
  for (const auto& x : data.points) hash.add(&x, sizeof x);
  for (const auto& t : data.tetrahedra) hash.add(&t, sizeof t);
  for (const auto& region : data.regions) {
    hash.add(region.name.data(), region.name.size());
    hash.add(&region.kind, sizeof region.kind);
    hash.add(&region.first_element, sizeof region.first_element);
    hash.add(&region.end_element, sizeof region.end_element);
  }
  for (const auto& face : data.faces) {
    hash.add(face.name.data(), face.name.size());
    hash.add(&face.region, sizeof face.region);
    for (const auto& t : face.triangles) hash.add(&t, sizeof t);
  }
  for (const auto& field : data.fields) {
    if (field.name == wall::prestress_array) continue;
    hash.add(field.name.data(), field.name.size());
    hash.add(field.values.data(), field.values.size() * sizeof(double));
  }
  for (const auto& field : data.node_fields) {
    hash.add(field.name.data(), field.name.size());
    hash.add(field.values.data(), field.values.size() * sizeof(double));
  }
  for (const auto& twin : data.twins) hash.add(&twin, sizeof twin);
  return hash.value();
}

}  // namespace tunica::artifacts
