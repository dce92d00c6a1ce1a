// From a mesh to the same mesh with material directions.
#pragma once

#include <mpi.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/case/fibres_case.hpp"
#include "tunica/files/phases.hpp"
#include "tunica/frames/frames.hpp"

namespace tunica::stages::fibres {

/// Cell arrays of the result, by which a case names them. Vectors have no unit.
inline constexpr const char *array_e1 = "e1", *array_e2 = "e2", *array_e3 = "e3", *array_m4 = "m4", *array_m6 = "m6",
                            *array_jump = "jump [deg]", *array_confidence = "confidence", *array_depth = "depth",
                            *array_tear = "tear distance [mm]";

/// What the faces of a mesh are to the frames. Throws InputError for names of faces or regions that do not exist.
frames::FrameFaces face_roles(const case_file::FibresCase& c, const mesh::MeshData& data);

struct MadeFibres {
  mesh::MeshData data;                   ///< with the arrays above on the wall, NaN in the lumen; on rank 0
  std::string report_json, report_text;  ///< on rank 0
};
/// `loaded`: significant on rank 0. `say` is called on all ranks. Collective.
MadeFibres make_fibres(const case_file::FibresCase& c, artifacts::CheckedMesh loaded, MPI_Comm comm,
                       const files::Say& say);

struct FibresRequest {
  std::filesystem::path file;
  std::optional<std::string> text{};              ///< where it does not stand in that file
  std::optional<std::filesystem::path> output{};  ///< instead of the one in the file
  bool overwrite = false;
  std::function<void()> before_work = [] {};  ///< called on rank 0 once nothing stands in the way of the result
};
/// Reads the file, makes the directions and writes wall/ and lumen/ (SimVascular's layout, mm), meshes.yaml (sections
/// for a case) and report.json. Returns the report as text (rank 0). Throws InputError when there is a result already
/// and `overwrite` is false. Collective.
std::string fibres_to_files(const FibresRequest& request, MPI_Comm comm, const files::Say& say);

}  // namespace tunica::stages::fibres
