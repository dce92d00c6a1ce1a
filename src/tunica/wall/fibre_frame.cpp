#include "tunica/wall/fibre_frame.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tunica/base/error.hpp"

namespace tunica::wall {

namespace {

std::string text(const Vec3<double>& v) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", v[0], v[1], v[2]); }

}  // namespace

FibreFrame orthonormal_frame(const Vec3<double>& e1, const Vec3<double>& e2, const std::string& where) {
  const double area = norm(cross(e1, e2)), size = norm(e1) * norm(e2);
  if (!(area > 1e-3 * size) || !std::isfinite(size))
    throw InputError(where, fmt::format("e1 = {} and e2 = {} span no plane", text(e1), text(e2)),
                     "give two vectors that are not parallel: e1 circumferential, e2 longitudinal");
  const Vec3<double> first = normalised(e1), second = normalised(e2 - dot(first, e2) * first);
  return {first, second, cross(first, second)};
}

FibreFrame ConstantFrame::frame() const { return orthonormal_frame(e1, e2, "wall.fibre_frame.constant"); }

FibreFrame CylindricalFrame::at(const Vec3<double>& point) const {
  const Vec3<double> along = normalised(axis), from = point - origin, away = from - dot(along, from) * along;
  if (!(norm(away) > 1e-9 * norm(from)))
    throw InputError("wall.fibre_frame.cylindrical",
                     fmt::format("the point {} m lies on the axis, where no direction is radial", text(point)),
                     "choose origin and axis along the middle of the vessel");
  const Vec3<double> radial = normalised(away);
  return {cross(along, radial), along, radial};
}

config::Schema<ConstantFrame> ConstantFrame::schema() {
  return config::Schema<ConstantFrame>("constant", "The same frame everywhere.")
      .quantities("e1", &ConstantFrame::e1, config::dimension::none, config::anything(), "Circumferential direction")
      .quantities("e2", &ConstantFrame::e2, config::dimension::none, config::anything(),
                  "Longitudinal direction; its part along e1 is taken off")
      .check([](const ConstantFrame& f, config::Problems& problems) {
        if (!(norm(cross(f.e1, f.e2)) > 1e-3 * norm(f.e1) * norm(f.e2)))
          problems.add("", "e1 and e2 span no plane", "give two vectors that are not parallel");
      });
}

config::Schema<CylindricalFrame> CylindricalFrame::schema() {
  return config::Schema<CylindricalFrame>("cylindrical", "About a straight axis.")
      .quantities("origin", &CylindricalFrame::origin, config::dimension::length, config::anything(),
                  "A point of the axis")
      .by_default()
      .quantities("axis", &CylindricalFrame::axis, config::dimension::none, config::anything(),
                  "Direction of the axis, which is the longitudinal one")
      .by_default()
      .check([](const CylindricalFrame& f, config::Problems& problems) {
        if (!(norm(f.axis) > 0.0)) problems.add("axis", "has length zero", "give a direction, such as [0, 0, 1]");
      });
}

config::Schema<MeshFrame> MeshFrame::schema() {
  return config::Schema<MeshFrame>("mesh", "Vectors given with the elements of the wall mesh.")
      .text("e1", &MeshFrame::e1, "Cell array of the circumferential direction, three components")
      .text("e2", &MeshFrame::e2, "Cell array of the longitudinal direction, three components");
}

config::Schema<FrameSource> frame_schema() {
  return config::Schema<FrameSource>("fibre_frame", "Circumferential, longitudinal and radial direction.")
      .one_of()
      .alternative(ConstantFrame::schema())
      .alternative(CylindricalFrame::schema())
      .alternative(MeshFrame::schema());
}

std::vector<std::string> frame_arrays(const FrameSource& source) {
  const auto* mesh = std::get_if<MeshFrame>(&source);
  return mesh ? std::vector{mesh->e1, mesh->e2} : std::vector<std::string>{};
}

}  // namespace tunica::wall
