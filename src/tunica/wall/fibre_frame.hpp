// The local axes in which wall laws state their directions: e1 circumferential, e2 longitudinal, e3 radial, outwards.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "tunica/base/tensor.hpp"
#include "tunica/config/schema.hpp"

namespace tunica::wall {

/// Orthonormal and right-handed, e3 = e1 x e2.
struct FibreFrame {
  Vec3<double> e1, e2, e3;
};

/// e1 along the first vector, e2 in the plane of both (Gram-Schmidt). Throws InputError, with `where`, when they are
/// not finite, or within 1e-3 rad of parallel.
FibreFrame orthonormal_frame(const Vec3<double>& e1, const Vec3<double>& e2, const std::string& where);

/// The same frame everywhere.
struct ConstantFrame {
  Vec3<double> e1{{1, 0, 0}}, e2{{0, 1, 0}};
  FibreFrame frame() const;
  static config::Schema<ConstantFrame> schema();
};

/// About a straight axis: e2 along it, e3 away from it.
struct CylindricalFrame {
  Vec3<double> origin{{0, 0, 0}};  ///< a point of the axis [m]
  Vec3<double> axis{{0, 0, 1}};    ///< of any length but 0
  /// Throws InputError for a point on the axis.
  FibreFrame at(const Vec3<double>& point) const;
  static config::Schema<CylindricalFrame> schema();
};

/// Vectors that come with the elements of the mesh.
struct MeshFrame {
  std::string e1, e2;  ///< names of arrays of three components
  static config::Schema<MeshFrame> schema();
};

using FrameSource = std::variant<ConstantFrame, CylindricalFrame, MeshFrame>;

config::Schema<FrameSource> frame_schema();

/// Arrays that the reader of the wall mesh must keep.
std::vector<std::string> frame_arrays(const FrameSource& source);

}  // namespace tunica::wall
