#include "tunica/coupling/fibre_frames.hpp"

#include <fmt/format.h>

#include "tunica/base/error.hpp"
#include "tunica/distributed/element_shape.hpp"

namespace tunica::coupling {

namespace {

using wall::FibreFrame;

FibreFrame frame_of(const distributed::DistributedMesh&, const distributed::Region&, std::size_t,
                    const wall::ConstantFrame& source) {
  return source.frame();
}

FibreFrame frame_of(const distributed::DistributedMesh& mesh, const distributed::Region& region, std::size_t element,
                    const wall::CylindricalFrame& source) {
  return source.at(distributed::centroid(mesh, region.elements[element]));
}

FibreFrame frame_of(const distributed::DistributedMesh&, const distributed::Region& region, std::size_t element,
                    const wall::MeshFrame& source) {
  const auto vector = [&](const std::string& name) {
    const mesh::ElementField& field = region.field(name);
    if (field.components != 3)
      throw InputError("wall.fibre_frame.mesh", fmt::format("cell array {} has {} components", name, field.components),
                       "use a vector array");
    const double* v = field.values.data() + 3 * element;
    return Vec3<double>{{v[0], v[1], v[2]}};
  };
  return wall::orthonormal_frame(
      vector(source.e1), vector(source.e2),
      fmt::format("fibre frame of element {} of region {}", region.element_ids[element] + 1, region.name));
}

}  // namespace

std::vector<double> fibre_frames(const distributed::DistributedMesh& mesh, const distributed::Region& region,
                                 const wall::FrameSource& source) {
  std::vector<double> frames;
  frames.reserve(6 * region.elements.size());
  std::visit(
      [&](const auto& s) {
        for (std::size_t e = 0; e < region.elements.size(); ++e) {
          const FibreFrame frame = frame_of(mesh, region, e, s);
          frames.insert(frames.end(), {frame.e1[0], frame.e1[1], frame.e1[2], frame.e2[0], frame.e2[1], frame.e2[2]});
        }
      },
      source);
  return frames;
}

}  // namespace tunica::coupling
