#include "tunica/flow_imaging/corrections.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"

namespace tunica::flow_imaging {

namespace {

/// Mean over the frames and summed squares about it.
struct Course {
  double mean[3] = {}, squares[3] = {};
};

Course course_of(const VelocitySeries& series, std::size_t voxel) {
  Course c;
  for (const auto& v : series.velocity)
    for (int d = 0; d < 3; ++d)
      c.mean[d] += static_cast<double>(v[static_cast<std::size_t>(d)][voxel]) / static_cast<double>(series.frames());
  for (const auto& v : series.velocity)
    for (int d = 0; d < 3; ++d) {
      const double off = static_cast<double>(v[static_cast<std::size_t>(d)][voxel]) - c.mean[d];
      c.squares[d] += off * off;
    }
  return c;
}

/// The value that a share of them does not exceed.
template <class T>
T quantile(std::vector<T> values, double share) {
  const auto at = std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

/// Monomials of x, y, z up to the order, at a voxel with its place scaled to [-1, 1].
std::vector<double> monomials(const ImageFrame& frame, std::int64_t voxel, int order) {
  const auto at = frame.voxel(voxel);
  double x[3];
  for (std::size_t d = 0; d < 3; ++d)
    x[d] = 2 * static_cast<double>(at[d]) / static_cast<double>(frame.size[d] - 1) - 1;
  std::vector<double> terms;
  for (int i = 0; i <= order; ++i)
    for (int j = 0; i + j <= order; ++j)
      for (int k = 0; i + j + k <= order; ++k)
        terms.push_back(std::pow(x[0], i) * std::pow(x[1], j) * std::pow(x[2], k));
  return terms;
}

double sum_of_products(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Least squares of one component on the voxels that are kept.
std::vector<double> least_squares(const std::vector<std::vector<double>>& terms, const std::vector<double>& values,
                                  const std::vector<char>& kept) {
  const auto n = terms.front().size();
  const auto size = static_cast<Eigen::Index>(n);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (!kept[v]) continue;
    const Eigen::Map<const Eigen::VectorXd> row(terms[v].data(), size);
    right += values[v] * row;
    normal += row * row.transpose();
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(normal);
  if (factor.info() != Eigen::Success)
    throw SolverError(fmt::format("offset of the velocities: the voxels do not determine its {} coefficients", n));
  const Eigen::VectorXd found = factor.solve(right);
  return {found.begin(), found.end()};
}

}  // namespace

std::vector<std::int64_t> static_tissue(const VelocitySeries& series, const std::vector<std::uint8_t>& not_static) {
  constexpr double bright = 0.2, usual = 0.25, restless = 1.5;
  const float least = series.magnitude.empty() ? 0.0F : static_cast<float>(bright) * quantile(series.magnitude, 0.98);
  std::vector<std::int64_t> candidates;
  std::vector<double> motion;
  for (std::size_t v = 0; v < not_static.size(); ++v) {
    if (not_static[v] || (!series.magnitude.empty() && series.magnitude[v] < least)) continue;
    const auto c = course_of(series, v);
    candidates.push_back(static_cast<std::int64_t>(v));
    motion.push_back(c.squares[0] + c.squares[1] + c.squares[2]);
  }
  if (candidates.empty()) return {};
  const double limit = restless * restless * quantile(motion, usual);
  std::vector<std::int64_t> at_rest;
  for (std::size_t k = 0; k < candidates.size(); ++k)
    if (motion[k] <= limit) at_rest.push_back(candidates[k]);
  return at_rest;
}

Offset fit_offset(const VelocitySeries& series, const std::vector<std::int64_t>& at_rest, int order) {
  constexpr std::size_t least_for_each = 20, most = 50000;
  const auto count = monomials(series.frame, 0, order).size();
  if (at_rest.size() < least_for_each * count)
    throw InputError("background",
                     fmt::format("{} voxels of static tissue are too few for the {} coefficients of order {}",
                                 at_rest.size(), count, order),
                     "leave tissue around the vessel in the images, take a lower order, or `background: none`");
  std::vector<std::vector<double>> terms;
  std::array<std::vector<double>, 3> means;
  const auto stride = std::max<std::size_t>(1, at_rest.size() / most);
  for (std::size_t k = 0; k < at_rest.size(); k += stride) {
    terms.push_back(monomials(series.frame, at_rest[k], order));
    const auto c = course_of(series, static_cast<std::size_t>(at_rest[k]));
    for (std::size_t d = 0; d < 3; ++d) means[d].push_back(c.mean[d]);
  }
  Offset offset{.order = order, .coefficients = {}, .largest = 0};
  for (std::size_t d = 0; d < 3; ++d) {
    std::vector<char> kept(terms.size(), 1);
    auto& found = offset.coefficients[d] = least_squares(terms, means[d], kept);
    std::vector<double> misfit;
    for (std::size_t v = 0; v < terms.size(); ++v)
      misfit.push_back(std::abs(means[d][v] - sum_of_products(terms[v], found)));
    const double limit = 3 * 1.4826 * quantile(misfit, 0.5);
    for (std::size_t v = 0; v < terms.size(); ++v) kept[v] = misfit[v] <= limit;
    if (limit > 0) found = least_squares(terms, means[d], kept);
  }
  for (int corner = 0; corner < 8; ++corner) {
    imaging::Size3 at;
    for (std::size_t a = 0; a < 3; ++a) at[a] = (corner >> a & 1) != 0 ? series.frame.size[a] - 1 : 0;
    const auto m = monomials(series.frame, series.frame.index(at[0], at[1], at[2]), order);
    for (const auto& c : offset.coefficients)
      offset.largest = std::max(offset.largest, std::abs(sum_of_products(m, c)));
  }
  return offset;
}

void subtract(VelocitySeries& series, const Offset& offset) {
  for (std::int64_t v = 0; v < series.voxels(); ++v) {
    const auto terms = monomials(series.frame, v, offset.order);
    float away[3];
    for (std::size_t d = 0; d < 3; ++d) away[d] = static_cast<float>(sum_of_products(terms, offset.coefficients[d]));
    for (auto& of_frame : series.velocity)
      for (std::size_t d = 0; d < 3; ++d) of_frame[d][static_cast<std::size_t>(v)] -= away[d];
  }
}

Noise measure_noise(const VelocitySeries& series, const std::vector<std::int64_t>& at_rest) {
  if (series.frames() < 2 || at_rest.size() < 100)
    throw InputError("velocity",
                     fmt::format("{} voxels of static tissue over {} frames do not tell how noisy the velocities are",
                                 at_rest.size(), series.frames()),
                     "leave tissue around the vessel in the images, or give `noise`");
  double squares = 0;
  Noise noise;
  for (const auto v : at_rest) {
    const auto c = course_of(series, static_cast<std::size_t>(v));
    squares += c.squares[0] + c.squares[1] + c.squares[2];
    if (!series.magnitude.empty())
      noise.magnitude +=
          static_cast<double>(series.magnitude[static_cast<std::size_t>(v)]) / static_cast<double>(at_rest.size());
  }
  noise.deviation =
      std::sqrt(squares / (3.0 * static_cast<double>(at_rest.size()) * static_cast<double>(series.frames() - 1)));
  return noise;
}

}  // namespace tunica::flow_imaging
