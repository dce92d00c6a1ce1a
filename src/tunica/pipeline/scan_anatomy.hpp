// A scan of a follow-up as its chain has meshed, and perhaps computed it.
#pragma once

#include <mpi.h>

#include <optional>
#include <string>
#include <vector>

#include "tunica/analysis/anatomy.hpp"
#include "tunica/mesh/mesh_data.hpp"
#include "tunica/pipeline/stage.hpp"

namespace tunica::pipeline {

struct ScanAnatomy {
  mesh::MeshData data;  ///< with mesh::distance_along, that of stage `post`
  std::string end;      ///< opening where the aorta ends
  std::vector<std::array<std::int64_t, 3>>
      edge;  ///< triangles of the lumens at the wall, in the aorta, not at the flap
  analysis::Anatomy anatomy;
};

/// The section `meshes` of what the stage `mesh` has made, or that of the case. Throws InputError where it does not
/// read.
case_file::MeshSettings meshes_of(const Chain& chain);

/// The mesh that the stages of the chain have made, or that the case names, and the shape of its aorta. The value is
/// of rank 0 alone, none elsewhere. Throws InputError where the mesh has no lumen, or openings of `post` that it does
/// not have. Collective.
std::optional<ScanAnatomy> scan_anatomy(const Chain& chain, double spacing, MPI_Comm comm);

/// What the blood and the wall were like at stations along the aorta, NaN where the results do not say [station].
struct StationLoads {
  std::vector<double> tawss;                ///< mean over the edge of the lumens [Pa]
  std::vector<double> stress;               ///< largest von Mises stress over the beat, mean over the wall [Pa]
  std::vector<double> pressure_difference;  ///< true less false lumen, mean over the beat [Pa]
};

/// From the folder of the stage `post`. `stations`: rising arc lengths, at least two [m]. Throws InputError where a
/// file of that stage does not read. Not collective.
StationLoads station_loads(const Chain& chain, const ScanAnatomy& scan, const std::vector<double>& stations);

}  // namespace tunica::pipeline
