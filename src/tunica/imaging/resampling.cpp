#include "tunica/imaging/resampling.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/imaging/distance.hpp"

namespace tunica::imaging {

namespace {

constexpr double largest_voxel = 1.2e-3;  // m

VoxelSet lumen_of(const std::vector<Kind>& kinds) {
  VoxelSet set(kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) set[i] = kinds[i] != Kind::tissue;
  return set;
}

/// Distances from both lumens together, and from each: both together have no gap in a tear.
struct Distances {
  std::vector<float> lumen, true_lumen, false_lumen;
};

Distances distances_in_slices(const ImageFrame& frame, const std::vector<Kind>& kinds, int axis) {
  return {signed_distance_in_slices(frame, lumen_of(kinds), axis),
          signed_distance_in_slices(frame, voxels_of(kinds, Kind::true_lumen), axis),
          signed_distance_in_slices(frame, voxels_of(kinds, Kind::false_lumen), axis)};
}

/// `mixed` interpolates one of the distances.
template <class Mixed>
Kind kind_from(const Mixed& mixed) {
  if (mixed(&Distances::lumen) >= 0) return Kind::tissue;
  return mixed(&Distances::true_lumen) <= mixed(&Distances::false_lumen) ? Kind::true_lumen : Kind::false_lumen;
}

/// Between two distances. A vessel that the other slice does not have ends halfway: the next outline there, or none, is
/// no nearer than the depth in this one, if that is more than `far`.
float interpolated(float a, float b, float share, float far) {
  constexpr float unknown = 1;  // m; of a slice that is all lumen or has none
  a = std::clamp(a, -unknown, unknown);
  b = std::clamp(b, -unknown, unknown);
  if (a < 0) b = std::min(b, std::max(far, -a));
  if (b < 0) a = std::min(a, std::max(far, -b));
  const float mixed = (1 - share) * a + share * b;
  // Distances are whole multiples of half a voxel, so that they often cancel: then the nearer slice decides, or all
  // such voxels would be tissue.
  constexpr float tie = 1e-7F;  // m
  return std::abs(mixed) < tie ? std::copysign(tie, share < 0.5F ? a : b) : mixed;
}

/// `parts` slices in place of each along an axis; distances are interpolated between the middles of the old ones.
LumenMask divided(const LumenMask& mask, int axis, std::int64_t parts) {
  const auto& old = mask.frame;
  LumenMask result = mask;
  auto& frame = result.frame;
  frame.size[axis] *= parts;
  frame.steps[axis] = (1.0 / static_cast<double>(parts)) * old.steps[axis];
  frame.origin = old.origin - (0.5 * static_cast<double>(parts - 1)) * frame.steps[axis];
  result.image_low[axis] *= parts;
  result.image_high[axis] = (mask.image_high[axis] + 1) * parts - 1;
  result.kinds.assign(frame.count(), Kind::tissue);
  const auto far = static_cast<float>(norm(old.steps[axis]));
  const auto distances = distances_in_slices(old, mask.kinds, axis);
  const std::int64_t strides[3] = {1, old.size[0], old.size[0] * old.size[1]};
  for (std::int64_t i = 0; i < frame.count(); ++i) {
    auto v = frame.voxel(i);
    const double at = (static_cast<double>(v[axis]) + 0.5) / static_cast<double>(parts) - 0.5;
    const auto before = std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(at)), 0, old.size[axis] - 2);
    const auto share = static_cast<float>(std::clamp(at - static_cast<double>(before), 0.0, 1.0));
    v[axis] = before;
    const auto a = old.index(v[0], v[1], v[2]), b = a + strides[axis];
    result.kinds[i] = kind_from([&](std::vector<float> Distances::*of) {
      return interpolated((distances.*of)[a], (distances.*of)[b], share, far);
    });
  }
  return result;
}

/// Eight voxels in place of each, of the same kind: outlines between slices would make a flap of a voxel thinner.
LumenMask halved(const LumenMask& mask) {
  const auto& old = mask.frame;
  LumenMask result = mask;
  auto& frame = result.frame;
  for (int d = 0; d < 3; ++d) {
    frame.size[d] *= 2;
    frame.steps[d] = 0.5 * old.steps[d];
    frame.origin = frame.origin - 0.5 * frame.steps[d];
    result.image_low[d] *= 2;
    result.image_high[d] = 2 * mask.image_high[d] + 1;
  }
  result.kinds.assign(frame.count(), Kind::tissue);
  for (std::int64_t i = 0; i < frame.count(); ++i) {
    const auto v = frame.voxel(i);
    result.kinds[i] = mask.kinds[old.index(v[0] / 2, v[1] / 2, v[2] / 2)];
  }
  return result;
}

}  // namespace

LumenMask with_even_voxels(LumenMask mask) {
  double spacing[3], smallest = 1;
  for (int d = 0; d < 3; ++d) {
    spacing[d] = norm(mask.frame.steps[d]);
    smallest = std::min(smallest, spacing[d]);
  }
  // Across the longest voxels first, since the outlines lie in the other slices.
  int axes[3] = {0, 1, 2};
  std::sort(axes, axes + 3, [&](int a, int b) { return spacing[a] > spacing[b]; });
  for (const int d : axes)
    if (spacing[d] > 4.0 / 3 * smallest) mask = divided(mask, d, std::lround(spacing[d] / smallest));
  return smallest > largest_voxel ? halved(mask) : mask;
}

std::vector<Kind> between_slices(const ImageFrame& slice, const std::vector<Kind>& first,
                                 const std::vector<Kind>& second, int axis, double share) {
  const auto a = distances_in_slices(slice, first, axis), b = distances_in_slices(slice, second, axis);
  const auto far = static_cast<float>(norm(slice.steps[axis]));
  std::vector<Kind> result;
  for (std::size_t i = 0; i < first.size(); ++i)
    result.push_back(kind_from([&](std::vector<float> Distances::*of) {
      return interpolated((a.*of)[i], (b.*of)[i], static_cast<float>(share), far);
    }));
  return result;
}

}  // namespace tunica::imaging
