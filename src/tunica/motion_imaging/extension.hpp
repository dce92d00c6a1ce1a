// Motion of the wall of the lumen carried into everything that is meshed.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tunica/mesh/mesh_data.hpp"

namespace tunica::motion_imaging {

/// Displacements of all nodes of a mesh of linear elements from those of some: each other node has the mean of its
/// neighbours along edges. A wall node moves with its twin; nodes without a way to a given one stay. Figures of
/// sections, volumes and thin walls depend on what is given alone.
class Extension {
 public:
  /// `given`: nodes whose displacements will be known.
  Extension(const mesh::MeshData& data, std::vector<std::int64_t> given);
  ~Extension();
  Extension(const Extension&) = delete;
  Extension& operator=(const Extension&) = delete;

  /// From the displacements of the given nodes [m]. Returns [node][3]. Throws SolverError when the linear system is not
  /// solved.
  std::vector<double> of(std::span<const Vec3<double>> displacements) const;

 private:
  struct System;
  std::vector<std::int64_t> given_;
  std::unique_ptr<System> system_;
};

}  // namespace tunica::motion_imaging
