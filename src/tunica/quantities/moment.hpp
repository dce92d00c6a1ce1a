// One instant of a computation that quantities are taken of: what several of them need is computed once.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "tunica/coupling/problem.hpp"
#include "tunica/quantities/inside.hpp"
#include "tunica/wall/symmetric.hpp"

namespace tunica::quantities {

/// The middle of an element of the wall.
struct WallPoint {
  Mat3<double> F;                 ///< deformation from the stress-free state; columns: images of the material axes
  wall::Symmetric<double> sigma;  ///< Cauchy stress [Pa], global axes, Voigt 11 22 33 12 23 13
};

class Moment {
 public:
  /// All must outlive this. `wall`: displacement and pressure at the instant of stresses.
  Moment(const coupling::Problem& problem, const std::vector<InsideTriangle>& inside, const coupling::State& state,
         const coupling::FieldsView& wall)
      : problem_(problem), inside_(inside), state_(state), wall_(wall) {}

  const coupling::Problem& problem() const { return problem_; }
  const distributed::DistributedMesh& mesh() const { return problem_.mesh(); }
  const coupling::State& state() const { return state_; }
  const std::vector<InsideTriangle>& inside() const { return inside_; }

  /// Of the owned elements of a wall region.
  const std::vector<WallPoint>& wall_points(std::size_t region);

  /// grad v [1/s] at the nodes of the lumen, [local node][9], (i, j) = dv_i / dx_j: mean over the elements at the node,
  /// weighted with their volumes. Collective at the first call.
  const std::vector<double>& velocity_gradients();

  /// What the flow does along the wall [Pa] at the nodes of the vessel's inside, [local node][3], zero elsewhere: mean
  /// over the triangles at the node, weighted with their areas. Collective at the first call.
  const std::vector<double>& wall_shear_stresses();

  /// Unit normals of the vessel's inside, out of the lumen, [local node][3]: likewise.
  const std::vector<double>& inside_normals();

  /// Where a node is now [m].
  Vec3<double> position(std::int32_t node) const;

 private:
  const coupling::Problem& problem_;
  const std::vector<InsideTriangle>& inside_;
  const coupling::State& state_;
  const coupling::FieldsView& wall_;
  std::map<std::size_t, std::vector<WallPoint>> wall_points_;
  std::vector<double> velocity_gradients_, wall_shear_, normals_;
};

}  // namespace tunica::quantities
