#include "tunica/flow_imaging/lumen_samples.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::flow_imaging {

namespace {

using imaging::ImageFrame;

/// Barycentric coordinates in one tetrahedron, as a linear map of places in voxels.
struct Coordinates {
  Mat3<double> rows;
  Vec3<double> first;
  bool sound = false;

  explicit Coordinates(const Vec3<double> (&x)[4]) : first(x[0]) {
    Mat3<double> edges;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) edges(r, c) = x[c + 1][r] - x[0][r];
    const double size = determinant(edges);
    sound = std::abs(size) > 0;
    if (sound) rows = inverse(edges);
  }
  std::array<double, 4> at(const Vec3<double>& x) const {
    const Vec3<double> b = rows * (x - first);
    return {1 - b[0] - b[1] - b[2], b[0], b[1], b[2]};
  }
};

}  // namespace

std::vector<LumenSample> lumen_samples(const ImageFrame& frame, std::span<const Vec3<double>> points,
                                       std::span<const std::array<std::int64_t, 4>> tetrahedra) {
  const auto to_voxels = inverse(frame.matrix());
  const double step = 1.0 / samples_along;
  // Sample n along an axis lies at (n + 1/2) / samples_along - 1/2 voxels.
  const auto place = [&](std::int64_t n) { return (static_cast<double>(n) + 0.5) * step - 0.5; };
  struct Found {
    std::int64_t sample;
    LumenSample in;
  };
  std::vector<Found> found;
  for (std::size_t e = 0; e < tetrahedra.size(); ++e) {
    Vec3<double> x[4];
    for (int a = 0; a < 4; ++a)
      x[a] = to_voxels * (points[static_cast<std::size_t>(tetrahedra[e][static_cast<std::size_t>(a)])] - frame.origin);
    const Coordinates coordinates(x);
    if (!coordinates.sound) continue;
    std::int64_t low[3], high[3];
    for (int d = 0; d < 3; ++d) {
      const auto [least, most] = std::minmax({x[0][d], x[1][d], x[2][d], x[3][d]});
      const auto last = samples_along * frame.size[static_cast<std::size_t>(d)] - 1;
      low[d] = std::max<std::int64_t>(0, static_cast<std::int64_t>(std::ceil((least + 0.5) * samples_along - 0.5)));
      high[d] = std::min<std::int64_t>(last, static_cast<std::int64_t>(std::floor((most + 0.5) * samples_along - 0.5)));
    }
    for (auto k = low[2]; k <= high[2]; ++k)
      for (auto j = low[1]; j <= high[1]; ++j)
        for (auto i = low[0]; i <= high[0]; ++i) {
          const auto b = coordinates.at({{place(i), place(j), place(k)}});
          if (*std::min_element(b.begin(), b.end()) < -1e-9) continue;
          const auto voxel = frame.index(i / samples_along, j / samples_along, k / samples_along);
          const auto within =
              i % samples_along + samples_along * (j % samples_along + samples_along * (k % samples_along));
          found.push_back({samples_in_voxel * voxel + within, {voxel, static_cast<std::int64_t>(e), b}});
        }
  }
  // A sample on a face belongs to one of its elements.
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.sample < b.sample; });
  std::vector<LumenSample> samples;
  for (std::size_t n = 0; n < found.size(); ++n)
    if (n == 0 || found[n].sample != found[n - 1].sample) samples.push_back(found[n].in);
  return samples;
}

std::vector<float> lumen_shares(const ImageFrame& frame, const std::vector<LumenSample>& samples) {
  std::vector<float> shares(static_cast<std::size_t>(frame.count()), 0.0F);
  for (const auto& sample : samples) shares[static_cast<std::size_t>(sample.voxel)] += 1.0F / samples_in_voxel;
  return shares;
}

std::vector<std::uint8_t> near_lumen(const ImageFrame& frame, const std::vector<float>& shares, int steps) {
  std::vector<std::uint8_t> near(shares.size(), 0);
  std::vector<std::int64_t> front, next;
  for (std::size_t v = 0; v < shares.size(); ++v)
    if (shares[v] > 0) near[v] = 1, front.push_back(static_cast<std::int64_t>(v));
  for (int s = 0; s < steps; ++s) {
    for (const auto v : front)
      imaging::for_each_face_neighbour(frame, v, [&](std::int64_t other) {
        if (near[static_cast<std::size_t>(other)]) return;
        near[static_cast<std::size_t>(other)] = 1;
        next.push_back(other);
      });
    front.swap(next);
    next.clear();
  }
  return near;
}

}  // namespace tunica::flow_imaging
