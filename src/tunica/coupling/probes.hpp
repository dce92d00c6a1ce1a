// Values at places in the mesh, which move with it.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "tunica/coupling/state.hpp"
#include "tunica/distributed/distributed_mesh.hpp"

namespace tunica::coupling {

struct ProbePlace {
  std::string name;  ///< for messages
  Vec3<double> place{};
  mesh::RegionKind region = mesh::RegionKind::lumen;
};

struct ProbeRecord {
  Vec3<double> displacement{};  ///< [m], in the lumen of the mesh
  Vec3<double> velocity{};      ///< [m/s]
  double pressure = 0;          ///< [Pa], at t_{n-1+alpha_f} like all pressures; of a wall's displacement element 0
};

class Probes {
 public:
  /// Throws InputError for a place outside of the regions of its kind by more than a twentieth of an element, on all
  /// ranks. Collective.
  Probes(const distributed::DistributedMesh& mesh, std::span<const ProbePlace> places);

  /// Interpolated as the element does, in the order of the places; the same on all ranks. Collective.
  std::vector<ProbeRecord> evaluate(const State& state) const;

 private:
  struct Found {
    std::size_t probe;
    std::vector<std::int32_t> nodes;  ///< local, of its element: corners, then edges
    std::vector<double> shares;       ///< shape functions there
    std::array<double, 4> corners;    ///< barycentric coordinates: of the pressure
  };
  const distributed::DistributedMesh& mesh_;
  std::size_t probes_;
  std::vector<Found> found_;  ///< those in elements that this rank counts
};

}  // namespace tunica::coupling
