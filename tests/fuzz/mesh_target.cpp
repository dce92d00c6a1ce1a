// Meshes from Gmsh files and SimVascular folders, and fields on them.
#include "fuzz/target.hpp"
#include "tunica/mesh_io/gmsh.hpp"
#include "tunica/mesh_io/simvascular.hpp"
#include "tunica/mesh_io/vtk_files.hpp"

namespace tunica::fuzz {

namespace fs = std::filesystem;
using mesh::RegionKind;

const char* const target_name = "mesh";

/// Folders whose volume, or whose inlet, the inputs replace.
void start_target() {
  fs::copy("sv", "volume", fs::copy_options::recursive);
  fs::copy("sv", "face", fs::copy_options::recursive);
}

void read_one(const fs::path& file, const std::string& kind) {
  mesh_io::GmshOptions gmsh{.metres_per_unit = 1e-2,
                            .regions = {{"lumen", RegionKind::lumen}, {"wall", RegionKind::wall}}};
  mesh_io::SimVascularOptions folder{.metres_per_unit = 1e-2};
  if (kind == "gmsh_fields") gmsh.fields = {"e1"};
  if (kind.starts_with("gmsh")) {
    mesh_io::read_gmsh(file, gmsh);
  } else if (kind == "volume") {
    fs::copy_file(file, "volume/mesh-complete.mesh.vtu", fs::copy_options::overwrite_existing);
    folder.regions = mesh_io::NamedRegions{"region", {{1, "first"}, {2, "second"}}};
    mesh_io::read_simvascular("volume", RegionKind::wall, "wall", folder);
  } else if (kind == "results") {
    mesh_io::read_vtk_volume(file, {"von Mises stress [kPa]"}, {"displacement [mm]"});
  } else if (kind == "pieces") {
    mesh_io::read_vtk_pieces(file);
  } else {
    fs::copy_file(file, "face/mesh-surfaces/inlet.vtp", fs::copy_options::overwrite_existing);
    folder.face_arrays = {{"inlet", {"thickness"}}};
    mesh_io::read_simvascular("face", RegionKind::lumen, "lumen", folder);
  }
}

}  // namespace tunica::fuzz
