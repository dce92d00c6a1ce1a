#include "tunica/flow_imaging/profile_fit.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "tunica/base/error.hpp"

namespace tunica::flow_imaging {

namespace {

constexpr double stretch = 3;           ///< correlation length along the normal over that in the plane
constexpr double of_steady = 10;        ///< variance of the steady profile's share over that of what is left
constexpr double radii_along = 4;       ///< correlation length of that share along the normal [radii]
constexpr double most_elsewhere = 0.1;  ///< of a voxel that is lumen outside the column
constexpr double least_share = 0.5;     ///< of a voxel that lies in the section's column
constexpr std::size_t least_voxels = 6, most_voxels = 1500;
constexpr double least_noise = 1e-6;     ///< variance over that of the profile
constexpr double least_variance = 1e-2;  ///< of a course over that of the noise
constexpr double held = 1e-3;            ///< deviation of the velocity on the rim over that of the profile

/// Matern's function of smoothness 5/2.
double matern(double distance, double length) {
  const double a = std::sqrt(5.0) * distance / length;
  return (1 + a + a * a / 3) * std::exp(-a);
}

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }
Eigen::Map<const Eigen::VectorXd> vector(const std::vector<double>& v) { return {v.data(), index(v.size())}; }

}  // namespace

/// What stands out of the noise: courses over the beat, each with the profile of a Gaussian process.
struct ProfileFit::Courses {
  Eigen::MatrixXd shapes;                              ///< [frame][course], orthonormal
  std::vector<double> variances;                       ///< of the voxels' amplitudes without their noise [m^2/s^2]
  std::vector<Eigen::MatrixXd> amplitudes{};           ///< of each component [voxel][course] [m/s]
  std::vector<Eigen::LLT<Eigen::MatrixXd>> factors{};  ///< of each course, voxels and places on the rim

  /// Principal components over the beat of voxels [component][voxel][frame] that move along so many `directions`. Noise
  /// of variance s^2 in n samples and F frames has eigenvalues up to s^2 (1 + sqrt(F/n))^2 (Marchenko & Pastur 1967);
  /// the largest one is kept in any case.
  static Courses of(const std::vector<Eigen::MatrixXd>& components, int directions, double noise) {
    const Eigen::Index frames = components.front().cols();
    const auto samples = directions * static_cast<double>(components.front().rows());
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(frames, frames);
    for (const auto& c : components) squares += c.transpose() * c / samples;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> principal(squares);  // eigenvalues rise
    const double edge = noise * std::pow(1 + std::sqrt(static_cast<double>(frames) / samples), 2);
    Eigen::Index count = 1;
    while (count < frames && principal.eigenvalues()[frames - 1 - count] > edge) ++count;
    Courses result{.shapes = principal.eigenvectors().rightCols(count).rowwise().reverse(), .variances = {}};
    for (Eigen::Index m = 0; m < count; ++m)
      result.variances.push_back(
          std::max({principal.eigenvalues()[frames - 1 - m] - noise, least_variance * noise, 1e-12}));
    for (const auto& c : components) result.amplitudes.push_back(c * result.shapes);
    return result;
  }

  /// Factors of the systems: correlations [observation][observation], their lower triangle, noise in units of the
  /// variance of a course. False where one cannot be factorised.
  bool factorise(const Eigen::MatrixXd& correlated, std::span<const double> noise) {
    for (const double variance : variances) {
      Eigen::MatrixXd system = correlated;
      for (Eigen::Index i = 0; i < system.rows(); ++i)
        system(i, i) += i < index(noise.size()) ? std::max(noise[static_cast<std::size_t>(i)] / variance, least_noise)
                                                : held * held;
      if (factors.emplace_back(system).info() != Eigen::Success) return false;
    }
    return true;
  }

  /// Weights of the voxels of a course for what correlates with them as `right` says. On the rim the velocity is zero.
  Eigen::VectorXd weights(std::size_t course, const std::vector<double>& right) const {
    return factors[course].solve(vector(right)).head(amplitudes.front().rows());
  }

  /// What correlates with the voxels as `right` says, in each frame [component][frame].
  std::vector<Eigen::VectorXd> values(const std::vector<double>& right) const {
    std::vector<Eigen::VectorXd> result(amplitudes.size(), Eigen::VectorXd::Zero(shapes.rows()));
    for (std::size_t m = 0; m < factors.size(); ++m) {
      const Eigen::VectorXd w = weights(m, right);
      for (std::size_t c = 0; c < result.size(); ++c)
        result[c] += w.dot(amplitudes[c].col(index(m))) * shapes.col(index(m));
    }
    return result;
  }
};

LumenVoxels lumen_voxels(const VelocitySeries& series, const mesh::MeshData& data, double tissue_magnitude) {
  LumenVoxels lumen;
  for (const auto& region : data.regions) {
    if (region.kind != mesh::RegionKind::lumen) continue;
    const auto elements = std::span(data.tetrahedra)
                              .subspan(static_cast<std::size_t>(region.first_element),
                                       static_cast<std::size_t>(region.end_element - region.first_element));
    lumen.samples = lumen_samples(series.frame, data.points, elements);
    for (const auto& sample : lumen.samples) {
      Vec3<double> x{};
      const auto& nodes = elements[static_cast<std::size_t>(sample.element)];
      for (std::size_t a = 0; a < 4; ++a)
        x = x + sample.barycentric[a] * data.points[static_cast<std::size_t>(nodes[a])];
      lumen.places.push_back(x);
    }
  }
  lumen.shares = lumen_shares(series.frame, lumen.samples);
  if (series.magnitude.empty()) return lumen;
  double sum = 0, count = 0;
  for (std::size_t v = 0; v < lumen.shares.size(); ++v)
    if (lumen.shares[v] > 0.99F) sum += static_cast<double>(series.magnitude[v]), count += 1;
  if (count == 0 || !(sum > 0)) return lumen;
  lumen.blood_magnitude = sum / count;
  if (tissue_magnitude > 0) lumen.tissue_signal = tissue_magnitude / lumen.blood_magnitude;
  return lumen;
}

ProfileFit::ProfileFit(const VelocitySeries& series, const LumenVoxels& lumen, const CrossSection& section,
                       const Noise& noise, const FitSettings& settings)
    : series_(series),
      section_(section),
      column_(section),
      noise_(noise),
      length_(settings.length.value_or(0.5 * std::sqrt(section.area / M_PI))) {
  find_radius();
  const double spacing = series.frame.largest_spacing();
  double slab = settings.slab;
  gather(lumen, slab * spacing, settings.at_end);
  while (observations_.size() > most_voxels && slab > 0.5) {
    slab *= 0.7;
    gather(lumen, slab * spacing, settings.at_end);
  }
  if (observations_.size() < least_voxels)
    throw InputError(
        section.name,
        fmt::format("has {} voxels of at least half lumen about its centre ({:.1f}, {:.1f}, {:.1f}) mm, {} are needed",
                    observations_.size(), 1e3 * section.centre[0], 1e3 * section.centre[1], 1e3 * section.centre[2],
                    least_voxels),
        "leave it out: it is too narrow for these images, or lies beyond them; or bring mesh and images "
        "into the same coordinates");
  place_rim();
  find_courses();
  find_flow();
}

/// Voxels of which at least half lies in the column over the section, and next to nothing in another part of the lumen.
void ProfileFit::gather(const LumenVoxels& lumen, double slab, bool at_end) {
  observations_.clear();
  double reach_of_voxel = 0;  // along the normal, from its middle
  for (const auto& step : series_.frame.steps) reach_of_voxel += 0.5 * std::abs(dot(step, section_.normal));
  for (std::size_t begin = 0; begin < lumen.samples.size();) {
    const auto voxel = lumen.samples[begin].voxel;
    auto end = begin;
    while (end < lumen.samples.size() && lumen.samples[end].voxel == voxel) ++end;
    const auto middle = series_.frame.place(series_.frame.voxel(voxel));
    const double reach = slab + series_.frame.largest_spacing();
    const double height = std::abs(column_.height(middle));
    if (static_cast<double>(end - begin) < least_share * samples_in_voxel || height > slab ||
        (at_end && height < reach_of_voxel) || norm(middle - section_.centre) > reach + 3 * std::sqrt(section_.area)) {
      begin = end;
      continue;
    }
    struct Sum {
      std::array<double, 3> at{};
      double count = 0;
    };
    std::map<int, Sum> octants;
    double inside = 0, elsewhere = 0;
    for (auto k = begin; k < end; ++k) {
      const auto& x = lumen.places[k];
      if (!column_.holds(x)) {
        elsewhere += 1;
        continue;
      }
      const auto in_plane = column_.plane(x);
      const Vec3<double> d = x - middle;
      int octant = 0;
      for (std::size_t a = 0; a < 3; ++a)
        if (dot(d, series_.frame.steps[a]) > 0) octant |= 1 << a;
      auto& sum = octants[octant];
      sum.at[0] += in_plane[0], sum.at[1] += in_plane[1], sum.at[2] += column_.height(x);
      sum.count += 1;
      inside += 1;
    }
    begin = end;
    if (inside < least_share * samples_in_voxel || elsewhere > most_elsewhere * samples_in_voxel) continue;
    Observation o{.voxel = voxel, .parts = {}, .deviation = 0};
    const double total = inside + (samples_in_voxel - inside) * lumen.tissue_signal;
    for (const auto& [octant, sum] : octants)
      o.parts.push_back(
          {place({sum.at[0] / sum.count, sum.at[1] / sum.count}, sum.at[2] / sum.count), sum.count / total});
    o.deviation = noise_.at(lumen.blood_magnitude * total / samples_in_voxel);
    observations_.push_back(std::move(o));
  }
}

namespace {

double distance_to_rim(const CrossSection& section, const SectionColumn& column, const std::array<double, 2>& at) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& edge : section.rim) {
    const auto a = column.plane(section.points[static_cast<std::size_t>(edge[0])]),
               b = column.plane(section.points[static_cast<std::size_t>(edge[1])]);
    const double u = b[0] - a[0], v = b[1] - a[1], square = u * u + v * v;
    const double share = square > 0 ? std::clamp(((at[0] - a[0]) * u + (at[1] - a[1]) * v) / square, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, std::hypot(at[0] - a[0] - share * u, at[1] - a[1] - share * v));
  }
  return nearest;
}

}  // namespace

void ProfileFit::find_radius() {
  for (const auto& [x, area] : quadrature(section_))
    radius_ = std::max(radius_, distance_to_rim(section_, column_, column_.plane(x)));
}

ProfileFit::Place ProfileFit::place(const std::array<double, 2>& in_plane, double height) const {
  const double depth = std::min(1.0, distance_to_rim(section_, column_, in_plane) / radius_);
  return {in_plane[0], in_plane[1], height, depth * (2 - depth)};
}

/// A share of steady flow that is hardly known beforehand, and what is left of it. Without the former the flow would be
/// drawn towards zero where voxels are few: it was a quarter to a half too small in branches of four to six voxels.
double ProfileFit::correlation(const Place& a, const Place& b) const {
  const double x = a.x - b.x, y = a.y - b.y, z = (a.z - b.z) / (stretch * length_),
               w = (a.z - b.z) / (radii_along * radius_);
  return matern(std::sqrt(x * x + y * y), length_) * std::exp(-0.5 * z * z) +
         of_steady * a.steady * b.steady * std::exp(-0.5 * w * w);
}

double ProfileFit::correlation(const Observation& o, const Place& at) const {
  double result = 0;
  for (const auto& part : o.parts) result += part.weight * correlation(part.at, at);
  return result;
}

/// With all observations, and with the rim after them.
std::vector<double> ProfileFit::correlations(const Place& at) const {
  std::vector<double> result;
  for (const auto& o : observations_) result.push_back(correlation(o, at));
  for (const auto& r : rim_) result.push_back(correlation(r, at));
  return result;
}

/// Places on the rim a fifth of the correlation length apart.
void ProfileFit::place_rim() {
  for (const auto& edge : section_.rim) {
    const auto a = section_.points[static_cast<std::size_t>(edge[0])],
               b = section_.points[static_cast<std::size_t>(edge[1])];
    const int parts = 1 + static_cast<int>(3 * norm(b - a) / length_);
    for (int k = 0; k < parts; ++k) {
      const auto p = column_.plane(a + (static_cast<double>(k) / parts) * (b - a));
      const bool near = std::any_of(rim_.begin(), rim_.end(),
                                    [&](const auto& r) { return std::hypot(r.x - p[0], r.y - p[1]) < 0.2 * length_; });
      if (!near) rim_.push_back({p[0], p[1], 0.0, 0.0});
    }
  }
}

void ProfileFit::find_courses() {
  const auto n = observations_.size(), all = n + rim_.size();
  Eigen::MatrixXd correlated = Eigen::MatrixXd::Zero(index(all), index(all));  // its lower triangle
  for (std::size_t i = 0; i < all; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double c = 0;
      if (i < n)
        for (const auto& part : observations_[i].parts) c += part.weight * correlation(observations_[j], part.at);
      else
        c = j < n ? correlation(observations_[j], rim_[i - n]) : correlation(rim_[i - n], rim_[j - n]);
      correlated(index(i), index(j)) = c;
    }
  const Eigen::MatrixXd empty(index(n), index(series_.frames()));
  std::vector<Eigen::MatrixXd> along(1, empty), across(3, empty);
  std::vector<double> noise;
  double mean_noise = 0;
  for (std::size_t i = 0; i < n; ++i) {
    noise.push_back(observations_[i].deviation * observations_[i].deviation);
    mean_noise += noise.back() / static_cast<double>(n);
    for (std::size_t frame = 0; frame < series_.frames(); ++frame) {
      Vec3<double> v{};
      for (int d = 0; d < 3; ++d)
        v[d] = static_cast<double>(
            series_.velocity[frame][static_cast<std::size_t>(d)][static_cast<std::size_t>(observations_[i].voxel)]);
      const double axial = dot(section_.normal, v);
      along[0](index(i), index(frame)) = axial;
      const Vec3<double> rest = v - axial * section_.normal;
      for (std::size_t d = 0; d < 3; ++d) across[d](index(i), index(frame)) = rest[static_cast<int>(d)];
    }
  }
  const auto fitted = [&](Courses courses) {
    if (!courses.factorise(correlated, noise))
      throw SolverError(fmt::format("profile of {}: its {} voxels do not determine it", section_.name, n));
    return std::make_shared<const Courses>(std::move(courses));
  };
  along_ = fitted(Courses::of(along, 1, mean_noise));
  across_ = fitted(Courses::of(across, 2, mean_noise));
}

void ProfileFit::find_flow() {
  std::vector<double> right(observations_.size() + rim_.size(), 0.0);
  for (const auto& [x, area] : quadrature(section_)) {
    const auto c = correlations(place(column_.plane(x), 0.0));
    for (std::size_t i = 0; i < right.size(); ++i) right[i] += area * c[i];
  }
  const auto flow = along_->values(right).front();
  flow_.assign(flow.begin(), flow.end());
  for (std::size_t m = 0; m < along_->factors.size(); ++m) {
    const auto weights = along_->weights(m, right);
    double variance = 0;
    for (std::size_t i = 0; i < observations_.size(); ++i)
      variance += std::pow(weights[index(i)] * observations_[i].deviation, 2);
    flow_variances_.push_back(variance);
  }
}

double ProfileFit::flow_deviation(std::span<const double> of_frames) const {
  double variance = 0;
  for (std::size_t m = 0; m < flow_variances_.size(); ++m)
    variance += std::pow(along_->shapes.col(index(m)).dot(
                             Eigen::Map<const Eigen::VectorXd>(of_frames.data(), index(of_frames.size()))),
                         2) *
                flow_variances_[m];
  return std::sqrt(variance);
}

std::vector<Vec3<double>> ProfileFit::velocities(const Vec3<double>& at) const {
  const auto right = correlations(place(column_.plane(at), 0.0));
  const auto along = along_->values(right), across = across_->values(right);
  std::vector<Vec3<double>> result;
  for (Eigen::Index k = 0; k < index(series_.frames()); ++k)
    result.push_back(along[0][k] * section_.normal + Vec3<double>{{across[0][k], across[1][k], across[2][k]}});
  return result;
}

}  // namespace tunica::flow_imaging
