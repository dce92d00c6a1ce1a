#include "tunica/stages/vessel_plane.hpp"

#include <algorithm>

namespace tunica::stages {

namespace {}  // namespace

// By power iteration on the matrix that turns the order of the eigenvalues of the spread round.
std::optional<VesselPlane> plane_of(const std::vector<Vec3<double>>& stations) {
  if (stations.size() < 3) return std::nullopt;
  Vec3<double> middle{};
  for (const auto& p : stations) middle = middle + (1.0 / static_cast<double>(stations.size())) * p;
  Mat3<double> spread{};
  double trace = 0;
  for (const auto& p : stations) {
    const auto d = p - middle;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) spread(i, j) -= d[i] * d[j];
    trace += dot(d, d);
  }
  for (int i = 0; i < 3; ++i) spread(i, i) += trace;
  Vec3<double> normal = normalised(Vec3<double>{{0.6, 0.7, 0.4}});
  for (int k = 0; k < 200; ++k) normal = normalised(spread * normal);
  return VesselPlane{middle, normal};
}

Vec3<double> direction_at(const std::vector<Vec3<double>>& stations, std::size_t station) {
  const std::size_t from = station == 0 ? 0 : station - 1, to = std::min(stations.size() - 1, station + 1);
  return normalised(stations[to] - stations[from]);
}

}  // namespace tunica::stages
