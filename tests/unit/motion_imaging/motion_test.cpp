// The wall of a tube is moved in a known way and found again: in exact boundaries, in labels, on surfaces.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tunica/base/error.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/motion_imaging/extension.hpp"
#include "tunica/motion_imaging/surface_motion.hpp"
#include "tunica/motion_imaging/synthetic_phases.hpp"

namespace tunica::motion_imaging {
namespace {

constexpr double radius = 10e-3, length = 60e-3, pi = std::numbers::pi;

/// The wall of a round tube along z, its normals pointing outwards.
WallSurface tube_wall(int around = 48, int along = 40) {
  WallSurface wall;
  auto& s = wall.surface;
  for (int k = 0; k <= along; ++k)
    for (int i = 0; i < around; ++i) {
      const double a = 2 * pi * i / around;
      s.points.push_back({{radius * std::cos(a), radius * std::sin(a), length * k / along}});
    }
  for (int k = 0; k < along; ++k)
    for (int i = 0; i < around; ++i) {
      const std::int64_t a = k * around + i, b = k * around + (i + 1) % around;
      s.triangles.push_back({a, b, b + around});
      s.triangles.push_back({a, b + around, a + around});
    }
  wall.sides.assign(s.triangles.size(), Side::true_lumen);
  return wall;
}

/// A tube that was moved and widened as a whole, and bulges in the middle of its length.
struct MovedTube {
  Vec3<double> shift{};
  double wider = 0, bulge = 0;  ///< m

  double radius_at(double z) const {
    const double s = (z - 0.5 * length) / 12e-3;
    return radius + wider + bulge * std::exp(-0.5 * s * s);
  }
  Vec3<double> displacement(const Point& x) const {
    const double r = std::hypot(x[0], x[1]), more = radius_at(x[2]) / r - 1;
    return shift + Vec3<double>{{more * x[0], more * x[1], 0}};
  }
  bool holds(const Point& x) const { return std::hypot(x[0] - shift[0], x[1] - shift[1]) < radius_at(x[2] - shift[2]); }
};

/// Known without error: what a line meets is found by bisection.
class ExactTube : public LumenBoundary {
 public:
  explicit ExactTube(MovedTube tube) : tube_(tube) {}
  std::optional<double> ahead(const Point& place, const Vec3<double>& out, Side, double reach) const override {
    double low = -reach, high = reach;
    if (!tube_.holds(place + low * out) || tube_.holds(place + high * out)) return std::nullopt;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (low + high);
      (tube_.holds(place + middle * out) ? low : high) = middle;
    }
    return low;
  }
  double grain() const override { return 1e-3; }

 private:
  MovedTube tube_;
};

/// Cubic voxels of an edge length, each of which is lumen when its middle lies in the tube after the noise is added.
imaging::LabelImage voxels_of(const MovedTube& tube, double voxel, double noise, unsigned seed) {
  const auto wall = tube_wall(8, 2);
  imaging::LabelImage image{imaging::frame_about(wall.surface.points, voxel, 8e-3, 0.3), {}};
  std::mt19937 random(seed);
  std::normal_distribution<double> jitter(0, noise);
  for (std::int64_t n = 0; n < image.frame.count(); ++n) {
    const auto x = image.frame.place(image.frame.voxel(n));
    const double out = std::hypot(x[0] - tube.shift[0], x[1] - tube.shift[1]) - tube.radius_at(x[2] - tube.shift[2]);
    image.labels.push_back(out + (noise > 0 ? jitter(random) : 0) < 0 ? 1 : 0);
  }
  return image;
}

/// Root mean square of what is off across the wall, and along it, away from the ends of the tube.
std::array<double, 2> errors(const WallSurface& wall, const WallMotion& motion, const MovedTube& tube) {
  double across = 0, along = 0, count = 0;
  for (std::size_t n = 0; n < wall.surface.points.size(); ++n) {
    const auto& x = wall.surface.points[n];
    if (x[2] < 5e-3 || x[2] > length - 5e-3) continue;
    const auto off = motion.displacement[n] - tube.displacement(x);
    const Vec3<double> normal{{x[0] / radius, x[1] / radius, 0}};
    across += std::pow(dot(off, normal), 2);
    along += dot(off, off) - std::pow(dot(off, normal), 2);
    count += 1;
  }
  return {std::sqrt(across / count), std::sqrt(along / count)};
}

TEST(WallTracker, FindsAnExactMotion) {
  const auto wall = tube_wall();
  const WallTracker tracker(wall, {});
  for (const auto& tube : {MovedTube{.shift = {{1.5e-3, -0.5e-3, 0}}}, MovedTube{.wider = 1e-3},
                           MovedTube{.shift = {{0.5e-3, 0, 0}}, .wider = -0.4e-3, .bulge = 1e-3}}) {
    // The corners of the wall lie on a circle and its triangles within: the difference knows nothing of that.
    const auto motion = difference(tracker.track(ExactTube(tube), {}), tracker.track(ExactTube({}), {}));
    EXPECT_DOUBLE_EQ(motion.seen, 1);
    const auto [across, along] = errors(wall, motion, tube);
    // Smoothing takes something of the bulge, whose length is three times that of the smoothing.
    EXPECT_LT(across, tube.bulge > 0 ? 0.03e-3 : 0.01e-3);
    EXPECT_LT(along, 0.15e-3);
  }
}

TEST(WallTracker, TakesALongStepFromWhereItWas) {
  const auto wall = tube_wall();
  const WallTracker tracker(wall, {.reach = 2e-3});
  const auto half = tracker.track(ExactTube({.wider = 1.5e-3}), {});
  const auto whole = tracker.track(ExactTube({.wider = 3e-3}), half.displacement);
  EXPECT_DOUBLE_EQ(whole.seen, 1);
  EXPECT_LT(errors(wall, whole, {.wider = 3e-3})[0], 0.05e-3);
  // Without a start it is out of reach.
  EXPECT_EQ(tracker.track(ExactTube({.wider = 3e-3}), {}).seen, 0);
}

TEST(WallTracker, FindsMotionInNoisyLabelsToATenthOfAVoxel) {
  const double voxel = 0.7e-3;
  const auto wall = tube_wall();
  const WallTracker tracker(wall, {});
  const MovedTube rest{}, moved{.shift = {{0.6e-3, 0.3e-3, 0}}, .wider = 0.5e-3, .bulge = 0.5e-3};
  const auto find = [&](const MovedTube& tube, unsigned seed) {
    const auto image = voxels_of(tube, voxel, 0.3 * voxel, seed);
    return tracker.track(*boundary_in_labels(image, {.true_lumen = 1}, wall.surface.points, 11e-3, "labels"), {});
  };
  const auto at_rest = find(rest, 1);
  const auto motion = difference(find(moved, 2), at_rest);
  const auto [across, along] = errors(wall, motion, moved);
  EXPECT_LT(across, 0.1 * voxel);
  EXPECT_LT(std::hypot(across, along), 0.3 * voxel);
  // The deviation that is told is that by noise.
  const auto by_noise = difference(find(rest, 2), at_rest);
  double told = 0;
  for (const double d : by_noise.deviation) told += d * d / static_cast<double>(by_noise.deviation.size());
  EXPECT_NEAR(std::sqrt(told) / errors(wall, by_noise, rest)[0], 1, 0.5);
}

TEST(WallTracker, FindsTheWideningOfANarrowVessel) {
  // A third of the size, and the same smoothing: it is bounded by the radius.
  auto wall = tube_wall();
  for (auto& x : wall.surface.points) x = (1.0 / 3) * x;
  const double r = radius / 3, wider = 0.6e-3;
  class Narrow : public LumenBoundary {
   public:
    explicit Narrow(double r) : radius_(r) {}
    std::optional<double> ahead(const Point& place, const Vec3<double>&, Side, double) const override {
      return radius_ - std::hypot(place[0], place[1]);
    }
    double grain() const override { return 1e-3; }

   private:
    double radius_;
  };
  const WallTracker tracker(wall, {.smoothing = 4e-3});
  const auto motion = difference(tracker.track(Narrow(r + wider), {}), tracker.track(Narrow(r), {}));
  for (std::size_t n = 0; n < wall.surface.points.size(); ++n) {
    const auto& x = wall.surface.points[n];
    if (x[2] < 3e-3 || x[2] > length / 3 - 3e-3) continue;
    const auto& u = motion.displacement[n];
    EXPECT_NEAR((u[0] * x[0] + u[1] * x[1]) / r, wider, 0.05 * wider);
  }
}

TEST(WallTracker, SeesNothingBeyondTheImage) {
  const auto wall = tube_wall();
  auto image = voxels_of({.wider = 1e-3}, 0.7e-3, 0, 1);
  // Axes are turned, so half of the slices are about half of the tube.
  image.frame.size[2] /= 2;
  image.labels.resize(static_cast<std::size_t>(image.frame.count()));
  const WallTracker tracker(wall, {});
  const auto motion = tracker.track(*boundary_in_labels(image, {.true_lumen = 1}, wall.surface.points, 11e-3, ""), {});
  EXPECT_NEAR(motion.seen, 0.5, 0.1);
  // What is not seen is told to be known less.
  EXPECT_GT(motion.deviation.back(), 3 * motion.deviation.front());
}

TEST(WallTracker, FindsMotionOnSurfacesOfEitherSense) {
  const auto wall = tube_wall();
  const MovedTube moved{.shift = {{0.8e-3, 0, 0}}, .wider = 0.4e-3};
  auto there = tube_wall(60, 55).surface;
  for (auto& x : there.points) x = x + moved.displacement(x);
  std::vector<Point> places;
  std::vector<Vec3<double>> outward;
  for (const auto& t : wall.surface.triangles) {
    places.push_back(wall.surface.points[static_cast<std::size_t>(t[0])]);
    outward.push_back(geometry::area_vector(wall.surface, t));
  }
  auto turned = there;
  for (auto& t : turned.triangles) std::swap(t[1], t[2]);
  for (const auto& surface : {there, turned}) {
    const WallTracker tracker(wall, {});
    const auto motion = tracker.track(*boundary_on_surface(surface, places, outward), {});
    EXPECT_GT(motion.seen, 0.99);
    EXPECT_LT(errors(wall, motion, moved)[0], 0.03e-3);
  }
}

TEST(BoundaryInLabels, RefusesALabelThatIsNotThere) {
  const auto image = voxels_of({}, 1e-3, 0, 1);
  const auto wall = tube_wall(8, 2);
  try {
    boundary_in_labels(image, {.true_lumen = 1, .false_lumen = 7}, wall.surface.points, 5e-3, "labels_000.nrrd");
    FAIL() << "label 7 has no voxel";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("labels_000.nrrd"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("label 7"), std::string::npos) << error.what();
  }
}

TEST(BoundaryInLabels, SeesEachLumenThroughAThinFlap) {
  // Two half spaces, x < 0 true and x > 1.4 mm false lumen, with a flap of two voxels between them.
  imaging::LabelImage image{};
  image.frame.size = {40, 20, 20};
  for (int d = 0; d < 3; ++d) image.frame.steps[static_cast<std::size_t>(d)][d] = 0.7e-3;
  image.frame.origin = {{-13.65e-3, -7e-3, -7e-3}};
  for (std::int64_t n = 0; n < image.frame.count(); ++n) {
    const double x = image.frame.place(image.frame.voxel(n))[0];
    image.labels.push_back(x < 0 ? 1 : x > 1.4e-3 ? 2 : 0);
  }
  const std::vector<Point> places{{{-8e-3, -3e-3, -3e-3}}, {{8e-3, 3e-3, 3e-3}}};
  const auto boundary = boundary_in_labels(image, {1, 2}, places, 4e-3, "");
  const auto from_true = boundary->ahead({{-1e-3, 0, 0}}, {{1, 0, 0}}, Side::true_lumen, 5e-3);
  const auto from_false = boundary->ahead({{1.0e-3, 0, 0}}, {{-1, 0, 0}}, Side::false_lumen, 5e-3);
  ASSERT_TRUE(from_true && from_false);
  EXPECT_NEAR(*from_true, 1e-3, 0.05e-3);
  EXPECT_NEAR(*from_false, -0.4e-3, 0.05e-3);
  EXPECT_FALSE(boundary->ahead({{-3e-3, 0, 0}}, {{1, 0, 0}}, Side::true_lumen, 1e-3)) << "out of reach";
}

TEST(PhaseImage, HasTheVolumeOfTheMovedLumen) {
  mesh::TubeSizes sizes;
  sizes.radius = radius;
  sizes.length = 30e-3;
  sizes.cells_around = 32;
  sizes.cells_radial = 3;
  sizes.cells_along = 12;
  const auto data = mesh::tube(sizes);
  const auto frame = imaging::frame_about(data.points, 0.7e-3, 5e-3, 0.2);
  imaging::ScanSettings scan{.voxel = 0.7e-3, .blur = 0.8e-3, .noise = 0.1};
  auto points = data.points;
  for (auto& x : points) x[0] *= 1.1;
  std::vector<double> side;
  for (const auto& x : data.points) side.push_back(x[1]);
  double ones = 0, twos = 0;
  for (const auto label : phase_image(data, points, side, frame, scan, 0).labels)
    ones += label == 1, twos += label == 2;
  const double half = 0.5 * 1.1 * pi * radius * radius * sizes.length / frame.voxel_volume();
  EXPECT_NEAR(ones / half, 1, 0.02);
  EXPECT_NEAR(twos / half, 1, 0.02);
  EXPECT_NE(phase_image(data, points, side, frame, scan, 1).labels,
            phase_image(data, points, side, frame, scan, 2).labels)
      << "each phase has noise of its own";
}

TEST(Extension, CarriesTheMotionOfTheWallEverywhere) {
  mesh::TubeSizes sizes;
  sizes.radius = radius;
  sizes.length = 20e-3;
  sizes.wall_thickness = 2e-3;
  const auto data = mesh::tube(sizes);
  std::vector<std::int64_t> given;
  for (const auto& face : data.faces)
    if (face.name == "lumen_wall")
      for (const auto& t : face.triangles) given.insert(given.end(), t.begin(), t.end());
  const std::vector<Vec3<double>> displacements(given.size(), Vec3<double>{{1e-3, -2e-3, 3e-3}});
  const auto moved = Extension(data, given).of(displacements);
  for (std::size_t n = 0; n < data.points.size(); ++n) {
    EXPECT_NEAR(moved[3 * n], 1e-3, 1e-8);
    EXPECT_NEAR(moved[3 * n + 1], -2e-3, 1e-8);
    EXPECT_NEAR(moved[3 * n + 2], 3e-3, 1e-8);
  }
}

TEST(Extension, LeavesWhatHangsTogetherWithNothingAtRest) {
  const auto box = mesh::box(2, 2, 2, {{1e-2, 1e-2, 1e-2}}, mesh::RegionKind::lumen);
  for (const double u : Extension(box, {}).of({})) EXPECT_EQ(u, 0);
}

}  // namespace
}  // namespace tunica::motion_imaging
