// Elements of the wall and their neighbours across faces, over all wall regions and ranks.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/parallel/halo.hpp"

namespace tunica::frames {

/// Elements are numbered from 0: those that this rank owns, region after region, then ghosts, which are neighbours of
/// owned ones on other ranks. A mesh's own ghost elements do not suffice: an owned element may have one face whose
/// nodes all belong to other ranks.
class ElementGraph {
 public:
  /// `mesh` must outlive the graph. Collective.
  explicit ElementGraph(const distributed::DistributedMesh& mesh);

  std::int32_t owned() const { return static_cast<std::int32_t>(nodes_.size()); }
  std::int32_t size() const { return size_; }
  const distributed::DistributedMesh& mesh() const { return mesh_; }
  /// Of an owned element: local nodes, region, position in MeshData::tetrahedra.
  const std::array<std::int32_t, 4>& nodes(std::int32_t e) const { return nodes_[e]; }
  std::int32_t region(std::int32_t e) const { return region_[e]; }
  std::int64_t id(std::int32_t e) const { return ids_[e]; }

  /// Of an owned element, in the order of their numbers in MeshData: what is summed over them does not depend on the
  /// ranks.
  std::span<const std::int32_t> neighbours(std::int32_t e) const {
    return {neighbours_.data() + begin_[e], static_cast<std::size_t>(begin_[e + 1] - begin_[e])};
  }
  /// Index in mesh().faces of the face that side `side` (mesh::tetrahedron_faces) of an owned element lies in; -1 for
  /// one inside the wall.
  std::int32_t face(std::int32_t e, int side) const { return face_[4 * static_cast<std::size_t>(e) + side]; }
  /// Half the product of two edges of a side, outwards from the element [m^2].
  Vec3<double> area_vector(std::int32_t e, int side) const;

  /// Fills the ghosts of `values`, [element][components]. Collective.
  void update(std::span<double> values, int components) const { halo_.update(values, components); }

 private:
  void connect();
  /// Makes the halo; `wanted`: numbers in MeshData of ghosts by owner. Returns the numbers of the ghosts here.
  std::map<std::int64_t, std::int32_t> number_ghosts(std::vector<std::vector<std::int64_t>> wanted);

  const distributed::DistributedMesh& mesh_;
  std::int32_t size_ = 0;
  std::vector<std::array<std::int32_t, 4>> nodes_;
  std::vector<std::int32_t> region_;
  std::vector<std::int64_t> ids_;
  std::vector<std::int32_t> begin_, neighbours_, face_;
  parallel::Halo halo_;
};

}  // namespace tunica::frames
