// The section `meshes` of a case file.
#include <fmt/format.h>

#include <algorithm>

#include "tunica/case/case.hpp"
#include "tunica/case/compared_law.hpp"
#include "tunica/case/keys.hpp"
#include "tunica/case/mesh_settings.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::case_file {

using config::Problems;
using config::Schema;
namespace dimension = config::dimension;

namespace {

Schema<std::filesystem::path> face_file_schema() {
  return Schema<std::filesystem::path>("face_file", "File of a face.")
      .file(
          "file", [](std::filesystem::path& file) -> std::filesystem::path& { return file; }, ".vtp of its triangles")
      .shorthand("file");
}

Schema<NamedFiles> named_files_schema() {
  return Schema<NamedFiles>("named_files", "Files of a mesh that are no folder of SimVascular's.")
      .file("volume", &NamedFiles::volume, ".vtu of linear tetrahedra; in place of `simvascular`")
      .optional()
      .map("faces", &NamedFiles::faces, face_file_schema(), ".vtp file of each face, by its name; with `volume`")
      .by_default()
      .text("rest", &NamedFiles::rest, "Face of the boundary that no file holds; when left out, there must be none");
}

void check_files(const std::filesystem::path& folder, const NamedFiles& files, Problems& problems) {
  if (folder.empty() == files.volume.empty())
    problems.add("", folder.empty() ? "no mesh is given" : "`simvascular` and `volume` are both given",
                 "give `simvascular`, a folder, or `volume` and `faces`, files");
  if (files.volume.empty() && (!files.faces.empty() || files.rest))
    problems.add(files.rest ? "rest" : "faces", "is given without `volume`", "give the file of the volume");
  if (!files.volume.empty() && files.faces.empty() && !files.rest)
    problems.add("faces", "is missing", "name the files of all faces: `faces: {inlet: inlet.vtp, ...}`");
  check_keys("faces", files.faces, "face", problems);
}

Schema<RegionMesh> region_mesh_schema() {
  return Schema<RegionMesh>("mesh", "Mesh of one region.")
      .folder("simvascular", &RegionMesh::simvascular, "`mesh-complete` folder as exported by SimVascular")
      .optional()
      .include(&RegionMesh::files, named_files_schema())
      .check([](const RegionMesh& m, Problems& problems) { check_files(m.simvascular, m.files, problems); });
}

Schema<ArrayFile> array_file_schema() {
  return Schema<ArrayFile>("array_file", "A cell array in a file of its own, with the same cells in the same order.")
      .file("file", &ArrayFile::file, ".vtu")
      .text("array", &ArrayFile::array, "Its name in that file; the key itself when left out")
      .shorthand("file");
}

Schema<int> region_number_schema() {
  return Schema<int>("region_number", "Number of a region in the cell array.")
      .integer(
          "number", [](int& number) -> int& { return number; }, config::range(-1000000, 1000000), "Number")
      .shorthand("number");
}

Schema<WallMesh> wall_mesh_schema() {
  return Schema<WallMesh>("wall_mesh", "Mesh of the wall, one region called wall or several.")
      .folder("simvascular", &WallMesh::simvascular, "`mesh-complete` folder as exported by SimVascular")
      .optional()
      .include(&WallMesh::files, named_files_schema())
      .map("arrays", &WallMesh::arrays, array_file_schema(),
           "Cell arrays that do not stand in the volume, by the names that they get: regions, directions of fibres")
      .by_default()
      .text("region_array", &WallMesh::region_array,
            "Cell array of integers that tells regions apart, such as ModelRegionID")
      .map("regions", &WallMesh::regions, region_number_schema(),
           "Every number of that array: `true_lumen_wall: 1`, `flap: 2`")
      .by_default()
      .check([](const WallMesh& m, Problems& problems) {
        check_files(m.simvascular, m.files, problems);
        if (m.region_array.has_value() == m.regions.empty())
          problems.add("regions",
                       m.region_array ? "is empty, but region_array is given" : "is given without region_array",
                       "give both, or neither for a wall of one region");
        std::map<int, std::string> known;
        for (const auto& [name, number] : m.regions)
          if (const auto [other, is_new] = known.emplace(number, name); !is_new)
            problems.add("regions." + name, fmt::format("is {}, as is {}", number, other->second),
                         "give every region its own number");
        check_keys("regions", m.regions, "region", problems);
      });
}

Schema<mesh::RegionKind> region_kind_schema() {
  return Schema<mesh::RegionKind>("region", "A region of the mesh.")
      .choice(
          "kind", [](mesh::RegionKind& kind) -> mesh::RegionKind& { return kind; },
          {{"lumen", mesh::RegionKind::lumen}, {"wall", mesh::RegionKind::wall}}, "Filled with blood, or solid")
      .shorthand("kind");
}

Schema<GmshMesh> gmsh_schema() {
  return Schema<GmshMesh>("gmsh", "Gmsh file, version 4.1.")
      .file("file", &GmshMesh::file, "The .msh file; volumes and boundary surfaces belong to named physical groups")
      .map("regions", &GmshMesh::regions, region_kind_schema(), "Every physical volume, by its name")
      .check([](const GmshMesh& gmsh, Problems& problems) {
        if (gmsh.regions.empty())
          problems.add("regions", "names no region", "write `<physical volume>: lumen` or `wall`");
        const auto lumens = std::count_if(gmsh.regions.begin(), gmsh.regions.end(),
                                          [](const auto& r) { return r.second == mesh::RegionKind::lumen; });
        if (lumens > 1)
          problems.add("regions", fmt::format("names {} lumens", lumens), "join them to one physical volume");
        check_keys("regions", gmsh.regions, "region", problems);
      });
}

Schema<mesh::TubeSizes> tube_schema() {
  using mesh::TubeSizes;
  return Schema<TubeSizes>(
             "tube",
             "Straight round tube along z that tunica meshes itself: faces lumen_inlet, lumen_outlet, "
             "lumen_wall, and with a wall wall_inlet, wall_outlet, wall_inner, wall_outer. Its polygons have "
             "the areas of the circles.")
      .quantity("radius", &TubeSizes::radius, dimension::length, config::above(0), "Radius of the lumen")
      .quantity("length", &TubeSizes::length, dimension::length, config::above(0), "Length")
      .quantity("wall_thickness", &TubeSizes::wall_thickness, dimension::length, config::at_least(0), "0: no wall")
      .by_default()
      .integer("cells_around", &TubeSizes::cells_around, config::range(4, 10000), "Multiple of 4")
      .by_default()
      .integer("cells_radial", &TubeSizes::cells_radial, config::range(1, 10000),
               "Between the square core and the wall")
      .by_default()
      .integer("cells_along", &TubeSizes::cells_along, config::range(1, 100000), "Along the tube")
      .by_default()
      .integer("cells_through_wall", &TubeSizes::cells_through_wall, config::range(1, 1000), "Through the wall")
      .by_default()
      .check([](const TubeSizes& tube, Problems& problems) {
        if (tube.cells_around % 4 != 0)
          problems.add("cells_around", fmt::format("is {}, no multiple of 4", tube.cells_around),
                       fmt::format("write {}", tube.cells_around / 4 * 4 + 4));
        if (auto what = mesh::objection_to_counts(tube); !what.empty())
          problems.add("", what, "take fewer cells: the mesh has the product of their numbers");
      });
}

Schema<InterfaceSettings> interface_schema() {
  return Schema<InterfaceSettings>("interface", "Surface that lumen and wall have in common.")
      .texts("lumen", &InterfaceSettings::lumen_faces, "Face or faces of the lumen")
      .texts("wall", &InterfaceSettings::wall_faces, "Face or faces of the wall that coincide with them")
      .number("tolerance", &InterfaceSettings::tolerance, config::between(0, 0.5),
              "Largest distance of two nodes that are taken as one, as a share of the shortest edge there")
      .by_default();
}

void check_meshes(const MeshSettings& m, Problems& problems) {
  const int sources = (m.lumen || m.wall) + m.gmsh.has_value() + m.tube.has_value();
  if (sources != 1) {
    problems.add("", sources == 0 ? "no mesh is given" : "meshes from more than one source are given",
                 "give `lumen` and/or `wall`, or `gmsh`, or `tube`");
  }
  const bool files = m.lumen || m.wall || m.gmsh;
  if (files && !m.metres_per_unit)
    problems.add("", "`length_unit` is missing: unit of the coordinates in the mesh files",
                 "add `length_unit: mm`, cm or m");
  if (!files && (m.metres_per_unit || m.scale != 1.0))
    problems.add(m.metres_per_unit ? "length_unit" : "scale", "is given, but no mesh is read from a file",
                 "remove it: the sizes have their own units");
}

}  // namespace

bool MeshSettings::has_lumen() const {
  if (!gmsh) return lumen || tube;
  return std::any_of(gmsh->regions.begin(), gmsh->regions.end(),
                     [](const auto& region) { return region.second == mesh::RegionKind::lumen; });
}

bool MeshSettings::has_wall() const {
  if (!gmsh) return wall || (tube && tube->wall_thickness > 0);
  return std::any_of(gmsh->regions.begin(), gmsh->regions.end(),
                     [](const auto& region) { return region.second == mesh::RegionKind::wall; });
}

Schema<MeshSettings> MeshSettings::schema() {
  return Schema<MeshSettings>("meshes",
                              "Meshes of the regions: `lumen` and/or `wall`, each in its own files, or `gmsh` with all "
                              "regions in one file, or `tube`.")
      .unit("length_unit", &MeshSettings::metres_per_unit, dimension::length,
            "Unit of the coordinates in the mesh files; needed when there are any")
      .number("scale", &MeshSettings::scale, config::above(0), "Factor on the coordinates in files, besides their unit")
      .by_default()
      .section("lumen", &MeshSettings::lumen, region_mesh_schema(), "Region filled with blood")
      .section("wall", &MeshSettings::wall, wall_mesh_schema(), "Solid region")
      .section("gmsh", &MeshSettings::gmsh, gmsh_schema(), "All regions in one file")
      .section("tube", &MeshSettings::tube, tube_schema(), "A tube without files")
      .section("interface", &MeshSettings::interface, interface_schema(),
               "Where lumen and wall meet; needed for fluid-structure interaction")
      .check(check_meshes);
}

}  // namespace tunica::case_file
