// A label image from the lumen surface of a patient, to hold the way back to a mesh against it.
//
//   voxelise_surface LUMEN.vtp LUMEN_MESH VOXEL_MM NOISE IMAGE [SEED]
//
// LUMEN.vtp in mm, open at the vessel ends. LUMEN_MESH: the folder lumen/ that `tunica mesh` wrote for the same
// surface, whose nodes say which side is the true lumen (1) and which the false one (2); `-` for one label. NOISE: of
// the border, in voxels, correlated over one voxel.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <unordered_map>

#include "closed_surface.hpp"
#include "tunica/geometry/nearby_search.hpp"
#include "tunica/geometry/surface_file.hpp"
#include "tunica/geometry/triangle_tree.hpp"
#include "tunica/imaging/distance.hpp"
#include "tunica/imaging/gaussian.hpp"
#include "tunica/imaging/label_image.hpp"
#include "tunica/mesh/lumen_fields.hpp"
#include "tunica/mesh_io/simvascular.hpp"

namespace tunica::imaging::trials {
namespace {

using geometry::Point;

using test::closed;

ImageFrame frame_around(const geometry::TriangleSurface& surface, double voxel) {
  Point low = surface.points.front(), high = low;
  for (const auto& p : surface.points)
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  constexpr std::int64_t margin = 4;
  ImageFrame frame{{}, low - Vec3<double>{{margin * voxel, margin * voxel, margin * voxel}}, {}};
  for (int d = 0; d < 3; ++d) {
    frame.size[d] = static_cast<std::int64_t>((high[d] - low[d]) / voxel) + 2 * margin + 1;
    frame.steps[d][d] = voxel;
  }
  return frame;
}

VoxelSet voxels_within(const geometry::TriangleTree& tree, const ImageFrame& frame) {
  VoxelSet set(frame.count(), 0);
  const double voxel = frame.largest_spacing();
  std::int64_t near = -1;
  for (std::int64_t k = 0; k < frame.size[2]; ++k)
    for (std::int64_t j = 0; j < frame.size[1]; ++j)
      for (std::int64_t i = 0; i < frame.size[0];) {
        const auto x = frame.place(Size3{i, j, k});
        const auto found = geometry::nearest_from(tree, x, near);
        const bool inside = tree.is_behind(x, found);
        const auto end = std::min(frame.size[0], i + 1 + static_cast<std::int64_t>(found.distance / voxel));
        for (; i < end; ++i) set[frame.index(i, j, k)] = inside;
      }
  return set;
}

void add_noise(const ImageFrame& frame, double deviation, unsigned seed, VoxelSet& set) {
  const auto distance = signed_distance(frame, set);
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  std::vector<float> noise(set.size());
  for (auto& n : noise) n = normal(random);
  blur(frame, 1, noise);
  double square = 0;
  for (const auto n : noise) square += double{n} * n;
  const double scale = deviation * frame.largest_spacing() / std::sqrt(square / static_cast<double>(noise.size()));
  for (std::size_t i = 0; i < set.size(); ++i) set[i] = distance[i] + scale * noise[i] < 0;
}

/// Nodes of a lumen mesh by cells of some millimetres, with the sign of their side.
class Sides {
 public:
  explicit Sides(const std::filesystem::path& folder)
      : mesh_(mesh_io::read_simvascular(folder, mesh::RegionKind::lumen, "lumen", {.metres_per_unit = 1e-3}).data) {
    for (const auto& field : mesh_.node_fields)
      if (field.name == mesh::lumen_side) side_ = field.values;
    for (std::int64_t p = 0; p < std::ssize(mesh_.points); ++p) cells_[cell(mesh_.points[p], {0, 0, 0})].push_back(p);
  }
  bool is_true(const Point& x) const {
    double least = 1;
    std::int64_t best = 0;
    for (std::int64_t k = -1; k <= 1; ++k)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t i = -1; i <= 1; ++i) {
          const auto found = cells_.find(cell(x, {i, j, k}));
          if (found == cells_.end()) continue;
          for (const auto p : found->second)
            if (const double d = norm(mesh_.points[p] - x); d < least) {
              least = d;
              best = p;
            }
        }
    return side_.at(best) >= 0;
  }

 private:
  static std::int64_t cell(const Point& x, const Size3& step) {
    constexpr double size = 6e-3;
    std::int64_t key = 0;
    for (int d = 0; d < 3; ++d) key = key * 4096 + 2048 + static_cast<std::int64_t>(std::floor(x[d] / size)) + step[d];
    return key;
  }
  mesh::MeshData mesh_;
  std::vector<double> side_;
  std::unordered_map<std::int64_t, std::vector<std::int64_t>> cells_;
};

int voxelise(const std::vector<std::string>& words) {
  if (words.size() < 5) {
    std::puts("voxelise_surface LUMEN.vtp LUMEN_MESH|- VOXEL_MM NOISE IMAGE [SEED]");
    return 2;
  }
  auto surface = closed(geometry::read_surface(words[0], 1e-3));
  if (geometry::enclosed_volume(surface) < 0)
    for (auto& t : surface.triangles) std::swap(t[1], t[2]);
  const geometry::TriangleTree tree(std::move(surface));
  const double voxel = 1e-3 * std::stod(words[2]);
  LabelImage image{frame_around(tree.surface(), voxel), {}};
  auto set = voxels_within(tree, image.frame);
  if (const double noise = std::stod(words[3]); noise > 0)
    add_noise(image.frame, noise, words.size() > 5 ? static_cast<unsigned>(std::stoi(words[5])) : 1U, set);
  std::optional<Sides> sides;
  if (words[1] != "-") sides.emplace(words[1]);
  image.labels.assign(set.size(), 0);
  for (std::int64_t i = 0; i < std::ssize(set); ++i)
    if (set[i]) image.labels[i] = !sides || sides->is_true(image.frame.place(image.frame.voxel(i))) ? 1 : 2;
  write_label_image(image, words[4]);
  std::printf("lumen of the surface %.3f ml, of the image %.3f ml, %lld voxels\n",
              1e6 * geometry::enclosed_volume(tree.surface()),
              1e6 * image.frame.voxel_volume() * static_cast<double>(std::count(set.begin(), set.end(), 1)),
              static_cast<long long>(image.frame.count()));
  return 0;
}

}  // namespace
}  // namespace tunica::imaging::trials

int main(int count, char** values) {
  return tunica::imaging::trials::voxelise(std::vector<std::string>(values + 1, values + count));
}
