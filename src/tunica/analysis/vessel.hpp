// What is where in the vessel: openings, true and false lumen, tears, stations along the aorta. Found once, in the
// reference mesh: docs/theory.md, section 10.
#pragma once

#include <mpi.h>

#include <array>
#include <string>
#include <vector>

#include "tunica/analysis/cuts.hpp"
#include "tunica/analysis/description.hpp"
#include "tunica/analysis/settings.hpp"
#include "tunica/mesh/mesh_data.hpp"

namespace tunica::analysis {

/// A part of the figures that this case has nothing for.
struct LeftOut {
  std::string part, why;
};

/// A face of the lumen through which blood flows.
struct LumenOpening {
  std::string name;
  std::size_t face;  ///< of MeshData
  bool in_false_lumen = false;
};

inline constexpr std::array<const char*, 2> lumen_names = {"true", "false"};

/// A cross-section of the aorta at one distance from the inlet, facing downstream.
struct Station {
  double distance = 0;                               ///< along the centreline from the inlet [m]
  Vec3<double> centre{{0, 0, 0}};                    ///< m
  std::array<std::vector<CutTriangle>, 2> sections;  ///< of the true lumen (or the only one), of the false lumen
};

/// A surface across a tear, facing the false lumen.
struct Tear {
  std::string name;
  std::vector<CutTriangle> surface;
  Vec3<double> centre{{0, 0, 0}};  ///< m
  double area = 0;                 ///< m^2
  double distance = 0;             ///< of the nearest station along the centreline [m]; 0 without stations
};

struct Vessel {
  std::vector<LumenOpening> openings;
  std::vector<std::array<std::int64_t, 3>> inside;  ///< triangles at which the flow sticks to the wall
  std::vector<double> side;  ///< of each node: > 0 in the true lumen, else false; empty where lumens are not told apart
  std::vector<double> along;        ///< of each node: from the inlet along the aorta [m]; empty without a lumen
  std::vector<double> towards_end;  ///< of each node: potential that rises towards `end` alone
  std::size_t inlet = 0, end = 0;   ///< faces of MeshData where the centreline begins and ends
  std::vector<Station> stations;
  std::vector<Tear> tears;          ///< by their distance from the inlet
  std::vector<double> false_share;  ///< of each element of the lumen region, in its order; empty as `side`
  std::vector<LeftOut> left_out;
};

/// Face where the blood enters the aorta: that of the settings, else the only one with a flow, else lumen_inlet.
std::string inlet_name(const RunDescription& run, const PostSettings& settings);

/// Throws InputError for openings and regions of the settings that the mesh does not have. Not collective.
void check_ends(const RunDescription& run, const PostSettings& settings, const mesh::MeshData& data);

/// Gives the nodes mesh::lumen_side, by the walls of both lumens where there are any (frames/tears.hpp), which come
/// before the field that the mesh may have already. `data`: corners of the elements only, the same on all ranks. What
/// nodes on edges are given later is the mean of their ends, so that lumens and tears are those of the run. Throws
/// InputError for faces and regions that the mesh does not have. Collective.
void tell_lumens_apart(const RunDescription& run, const PostSettings& settings, mesh::MeshData& data, MPI_Comm comm);

/// `data`: the same on all ranks, with the field of `tell_lumens_apart` where there are two lumens. Distances along the
/// aorta are those of mesh::distance_along where it is there, else of a centreline of this mesh. Throws InputError for
/// faces and regions that the mesh does not have, and distances that cannot be. Collective.
Vessel make_vessel(const RunDescription& run, const PostSettings& settings, const mesh::MeshData& data, MPI_Comm comm);

/// Distance of the nearest station along the centreline [m]; 0 without stations.
double distance_along(const Vessel& vessel, const Vec3<double>& place);

/// The lumen region of a mesh, null without.
const mesh::RegionData* lumen_region(const mesh::MeshData& data);

}  // namespace tunica::analysis
