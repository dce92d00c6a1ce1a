// The mesh of one rank: nodes it owns, a halo, and every element that touches an owned node.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tunica/base/tensor.hpp"
#include "tunica/mesh/mesh_data.hpp"
#include "tunica/parallel/halo.hpp"

namespace tunica::distributed {

/// Elements of one region on this rank. The first `owned_elements` are counted by this rank in global sums, the others
/// are ghost copies: each element is owned by exactly one rank.
struct Region {
  std::string name;
  mesh::RegionKind kind;
  std::int32_t owned_elements = 0;
  std::vector<std::array<std::int32_t, 4>> elements;  ///< corners, local nodes
  std::vector<std::array<std::int32_t, 6>> edges{};   ///< nodes on their edges (fe::edge_ends); or empty
  std::vector<std::int64_t> element_ids;              ///< position in MeshData::tetrahedra
  std::vector<mesh::ElementField> fields;             ///< of these elements

  const mesh::ElementField& field(const std::string& name) const;  ///< throws InputError listing the names that exist
};

/// Triangles of a named face that touch an owned node; owned ones first, as in Region.
struct Face {
  std::string name;
  std::int32_t region = 0;
  std::int32_t owned_triangles = 0;
  std::int64_t global_triangles = 0;
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< corners, local nodes, counter-clockwise from outside
  std::vector<std::array<std::int32_t, 3>> edges{};    ///< nodes on their edges 01 12 20; empty for linear elements
};

/// Local nodes: [0, owned_nodes) owned, [owned_nodes, nodes()) ghosts. Owned nodes of rank r have the contiguous
/// global numbers first_global .. first_global + owned_nodes - 1. A twin lives on the rank of its host, and wherever a
/// twin is present its host is present too.
struct DistributedMesh {
  MPI_Comm comm = MPI_COMM_NULL;
  std::int32_t owned_nodes = 0;
  std::int64_t first_global = 0, global_nodes = 0, global_elements = 0;
  std::vector<Vec3<double>> points;          ///< reference coordinates [m] of all local nodes
  std::vector<std::int64_t> global_ids;      ///< of all local nodes
  std::vector<std::int64_t> original_ids;    ///< position in MeshData::points, the order that checkpoints keep
  std::vector<std::int32_t> host;            ///< local node that carries the motion: itself, or the lumen twin
  std::vector<mesh::NodeField> node_fields;  ///< of all local nodes
  std::vector<Region> regions;
  std::vector<Face> faces;
  parallel::Halo halo;

  bool quadratic = false;  ///< elements have nodes on their edges

  std::int32_t nodes() const { return static_cast<std::int32_t>(points.size()); }
  const Face& face(const std::string& name) const;                   ///< throws InputError listing the names that exist
  const mesh::NodeField& node_field(const std::string& name) const;  ///< the same
};

/// Distributes `data` (significant on rank 0 only) over `comm`: partition of the nodes by METIS (twins stay together),
/// reverse Cuthill-McKee order inside each rank, elements sorted by their lowest node. Deterministic. Collective.
DistributedMesh distribute(const mesh::MeshData& data, MPI_Comm comm);

}  // namespace tunica::distributed
