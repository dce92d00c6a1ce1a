#include "tunica/motion_imaging/lumen_boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tunica/base/error.hpp"
#include "tunica/geometry/triangle_tree.hpp"
#include "tunica/imaging/gaussian.hpp"

namespace tunica::motion_imaging {

namespace {

using imaging::ImageFrame;
using imaging::LabelImage;
using imaging::Size3;

constexpr double blur_of_labels = 1.0;                 ///< standard deviation [voxels]: the steps of the voxels vanish
constexpr double unknown_border = 2 * blur_of_labels;  ///< voxels: blurred labels see what is beyond the image as none
constexpr double step_of_search = 0.25;                ///< voxels
constexpr double least_agreement = 0.5;                ///< of two normals: cosine

/// A part of an image, and how far places in it can be believed [voxels]: along the borders that are those of the image
/// itself nobody knows what lies behind them.
struct Part {
  LabelImage image;
  Point lowest{}, highest{};
};

/// The part that holds all places with a margin.
Part cropped(const LabelImage& image, std::span<const Point> places, double margin) {
  const auto to_voxels = inverse(image.frame.matrix());
  Point low{{1e300, 1e300, 1e300}}, high{{-1e300, -1e300, -1e300}};
  for (const auto& x : places) {
    const Point v = to_voxels * (x - image.frame.origin);
    for (int d = 0; d < 3; ++d) low[d] = std::min(low[d], v[d]), high[d] = std::max(high[d], v[d]);
  }
  Size3 first{}, size{};
  for (int d = 0; d < 3; ++d) {
    const auto a = static_cast<std::size_t>(d);
    const double more = margin / norm(image.frame.steps[a]);
    const auto last = static_cast<double>(image.frame.size[a] - 1);
    first[a] = static_cast<std::int64_t>(std::clamp(std::floor(low[d] - more), 0.0, last));
    size[a] = static_cast<std::int64_t>(std::clamp(std::ceil(high[d] + more), 0.0, last)) - first[a] + 1;
  }
  Part part{{image.frame, {}}};
  auto& [frame, labels] = part.image;
  frame.size = size;
  frame.origin = image.frame.place(first);
  labels.reserve(static_cast<std::size_t>(frame.count()));
  for (std::int64_t n = 0; n < frame.count(); ++n) {
    const auto v = frame.voxel(n);
    const auto at = image.frame.index(v[0] + first[0], v[1] + first[1], v[2] + first[2]);
    labels.push_back(image.labels[static_cast<std::size_t>(at)]);
  }
  for (int d = 0; d < 3; ++d) {
    const auto a = static_cast<std::size_t>(d);
    const bool at_low = first[a] == 0, at_high = first[a] + size[a] == image.frame.size[a];
    part.lowest[d] = at_low ? unknown_border : 0;
    part.highest[d] = static_cast<double>(size[a] - 1) - (at_high ? unknown_border : 0);
  }
  return part;
}

class InLabels : public LumenBoundary {
 public:
  InLabels(const Part& part, std::vector<float> true_lumen, std::vector<float> false_lumen)
      : frame_(part.image.frame),
        lowest_(part.lowest),
        highest_(part.highest),
        to_voxels_(inverse(frame_.matrix())),
        of_true_(std::move(true_lumen)),
        of_false_(std::move(false_lumen)) {
    spacing_ = std::min({norm(frame_.steps[0]), norm(frame_.steps[1]), norm(frame_.steps[2])});
  }

  /// Of white noise behind the blur: the square root of the area of its correlation.
  double grain() const override { return 2 * std::sqrt(M_PI) * blur_of_labels * frame_.largest_spacing(); }

  std::optional<double> ahead(const Point& place, const Vec3<double>& out, Side side, double reach) const override {
    const double step = step_of_search * spacing_;
    const Point start = to_voxels_ * (place - frame_.origin);
    const Vec3<double> along = step * (to_voxels_ * out);
    const auto count = static_cast<int>(reach / step);
    const auto at = [&](int k) {
      const Point v = start + static_cast<double>(k) * along;
      return known(v) ? share(v, side) - 0.5 : std::numeric_limits<double>::quiet_NaN();
    };
    // Outwards and inwards in turn: the first place where the lumen ends is the nearest one. Comparisons with what is
    // not known are false.
    double beyond = at(0), within = beyond;
    for (int k = 1; k <= count; ++k) {
      const double next = at(k);
      if (beyond >= 0 && next < 0) return step * (k - 1 + beyond / (beyond - next));
      beyond = next;
      const double previous = at(-k);
      if (previous >= 0 && within < 0) return -step * (k - previous / (previous - within));
      within = previous;
    }
    return std::nullopt;
  }

 private:
  bool known(const Point& v) const {
    for (int d = 0; d < 3; ++d)
      if (v[d] < lowest_[d] || v[d] > highest_[d]) return false;
    return true;
  }
  /// Of the lumen at a place in voxels, between voxels linearly.
  double share(const Point& v, Side side) const {
    std::int64_t low[3];
    double part[3];
    for (int d = 0; d < 3; ++d) {
      const auto last = frame_.size[static_cast<std::size_t>(d)] - 1;
      const double clamped = std::clamp(v[d], 0.0, static_cast<double>(last));
      low[d] = std::min(static_cast<std::int64_t>(clamped), std::max<std::int64_t>(last - 1, 0));
      part[d] = clamped - static_cast<double>(low[d]);
    }
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1;
      std::int64_t at[3];
      for (int d = 0; d < 3; ++d) {
        const bool upper = (corner >> d & 1) != 0;
        weight *= upper ? part[d] : 1 - part[d];
        at[d] = low[d] + (upper ? 1 : 0);
      }
      if (weight == 0) continue;
      const auto n = static_cast<std::size_t>(frame_.index(at[0], at[1], at[2]));
      if (side != Side::false_lumen) sum += weight * static_cast<double>(of_true_[n]);
      if (side != Side::true_lumen && !of_false_.empty()) sum += weight * static_cast<double>(of_false_[n]);
    }
    return sum;
  }

  ImageFrame frame_;
  Point lowest_, highest_;
  Mat3<double> to_voxels_;
  std::vector<float> of_true_, of_false_;
  double spacing_;
};

class OnSurface : public LumenBoundary {
 public:
  OnSurface(geometry::TriangleSurface surface, double sign) : tree_(std::move(surface)), sign_(sign) {
    const auto& s = tree_.surface();
    grain_ = std::sqrt(2 * geometry::area(s) / static_cast<double>(std::max<std::size_t>(1, s.triangles.size())));
  }

  double grain() const override { return grain_; }

  std::optional<double> ahead(const Point& place, const Vec3<double>& out, Side, double reach) const override {
    const auto point = tree_.nearest_if(place, reach, [&](const geometry::SurfacePoint& at) {
      return sign_ * dot(tree_.normal(at.triangle), out) > least_agreement;
    });
    if (!point) return std::nullopt;
    // To the plane of that triangle: the nearest point may lie aside.
    const auto normal = tree_.normal(point.triangle);
    const double distance = dot(point.place - place, normal) / dot(out, normal);
    if (std::abs(distance) > reach) return std::nullopt;
    return distance;
  }

 private:
  geometry::TriangleTree tree_;
  double sign_, grain_ = 0;
};

}  // namespace

std::unique_ptr<LumenBoundary> boundary_in_labels(const LabelImage& image, const LumenLabels& labels,
                                                  std::span<const Point> places, double margin,
                                                  const std::string& where) {
  const auto part = cropped(image, places, margin);
  const auto blurred = [&](std::int16_t label) {
    std::vector<float> values;
    values.reserve(part.image.labels.size());
    for (const auto l : part.image.labels) values.push_back(l == label ? 1.0F : 0.0F);
    if (std::find(values.begin(), values.end(), 1.0F) == values.end())
      throw InputError(where, fmt::format("has no voxel of label {} about the lumen of the mesh", label),
                       "name the labels that the lumens have, and bring mesh and images into the same coordinates");
    imaging::blur(part.image.frame, blur_of_labels, values);
    return values;
  };
  auto of_true = blurred(labels.true_lumen);
  auto of_false = labels.false_lumen ? blurred(*labels.false_lumen) : std::vector<float>{};
  return std::make_unique<InLabels>(part, std::move(of_true), std::move(of_false));
}

std::unique_ptr<LumenBoundary> boundary_on_surface(geometry::TriangleSurface surface, std::span<const Point> places,
                                                   std::span<const Vec3<double>> outward) {
  const geometry::TriangleTree tree(surface);
  double agreement = 0;
  for (std::size_t n = 0; n < places.size(); ++n)
    if (const auto at = tree.nearest(places[n])) agreement += dot(tree.normal(at.triangle), outward[n]);
  return std::make_unique<OnSurface>(std::move(surface), agreement < 0 ? -1.0 : 1.0);
}

}  // namespace tunica::motion_imaging
