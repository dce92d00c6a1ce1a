#include "tunica/bc/inflow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "text.hpp"
#include "tunica/base/error.hpp"

namespace {

using tunica::test::contains;
using namespace tunica;
using namespace tunica::bc;
using std::numbers::pi;

struct Disc {
  std::vector<Vec3<double>> points;
  std::vector<Triangle> triangles;
  FaceMesh face() const { return {"inlet", points, triangles}; }
};

/// Rings of 6, 12, 18, ... nodes around a centre, stretched to an ellipse in a tilted plane, normal `e3`.
Disc ellipse(int rings, double a, double b, double bulge = 0.0) {
  const Vec3<double> e1{{0.6, 0.0, 0.8}}, e2{{0.0, 1.0, 0.0}}, e3 = cross(e1, e2), centre{{0.1, -0.2, 0.3}};
  Disc disc;
  const auto first = [](int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
  for (int ring = 0; ring <= rings; ++ring)
    for (int i = 0; i < std::max(1, 6 * ring); ++i) {
      const double angle = 2 * pi * i / std::max(1, 6 * ring), r = static_cast<double>(ring) / rings;
      disc.points.push_back(centre + (a * r * std::cos(angle)) * e1 + (b * r * std::sin(angle)) * e2 +
                            (bulge * (1 - r * r)) * e3);
    }
  for (int ring = 1; ring <= rings; ++ring)
    for (int sector = 0; sector < 6; ++sector)
      for (int i = 0; i < ring; ++i) {
        const int outer = 6 * ring, inner = std::max(1, 6 * (ring - 1));
        const int o = sector * ring + i, in = sector * (ring - 1) + i;
        const std::int32_t p = first(ring) + o, q = first(ring) + (o + 1) % outer;
        const std::int32_t s = first(ring - 1) + in % inner, t = first(ring - 1) + (in + 1) % inner;
        disc.triangles.push_back({p, q, s});
        if (i + 1 < ring) disc.triangles.push_back({s, q, t});
      }
  return disc;
}

/// Flow into the region of the nodal velocities at inflow q: -sum over triangles of mean velocity . area vector.
double flow_in(const Disc& disc, const InflowProfile& profile, double q) {
  double sum = 0.0;
  for (const auto& t : disc.triangles) {
    const auto &a = disc.points[t[0]], &b = disc.points[t[1]], &c = disc.points[t[2]];
    const Vec3<double> v = profile.velocity(t[0], q) + profile.velocity(t[1], q) + profile.velocity(t[2], q);
    sum -= dot(v, cross(b - a, c - a)) / 6.0;
  }
  return sum;
}

double paraboloid_error(int rings, double a, double b) {
  const auto disc = ellipse(rings, a, b);
  const auto profile = inflow_profile(disc.face(), Profile::parabolic);
  double error = 0.0;
  for (std::size_t i = 0; i < disc.points.size(); ++i) {
    const auto d = disc.points[i] - disc.points[0];
    const double x = dot(d, Vec3<double>{{0.6, 0.0, 0.8}}) / a, y = d[1] / b;
    const double exact = 2 / (pi * a * b) * (1 - x * x - y * y);
    error = std::max(error, std::abs(profile.phi[i] - exact) * pi * a * b / 2);
  }
  return error;
}

TEST(Inflow, EqualsTheParaboloidOnACircleAndAnEllipseAtOrderTwo) {
  for (const double b : {0.012, 0.007}) {
    const double coarse = paraboloid_error(8, 0.012, b), fine = paraboloid_error(16, 0.012, b),
                 finest = paraboloid_error(32, 0.012, b);
    printf("b/a %.3f: largest error over peak %.2e %.2e %.2e, order %.2f\n", b / 0.012, coarse, fine, finest,
           std::log2(fine / finest));
    EXPECT_LT(fine, 0.02);
    EXPECT_GT(std::log2(coarse / fine), 1.8);
    EXPECT_GT(std::log2(fine / finest), 1.8);
  }
}

TEST(Inflow, CarriesTheFlowExactlyInwardWithZeroRim) {
  for (const double bulge : {0.0, 4e-4})
    for (const auto kind : {Profile::parabolic, Profile::flat}) {
      const auto disc = ellipse(10, 0.012, 0.009, bulge);
      const auto profile = inflow_profile(disc.face(), kind);
      EXPECT_NEAR(flow_in(disc, profile, 1e-4), 1e-4, 1e-4 * 1e-14);
      EXPECT_NEAR(dot(profile.normal, cross(Vec3<double>{{0.6, 0, 0.8}}, Vec3<double>{{0, 1, 0}})), 1.0, 1e-9);
      EXPECT_LT(dot(profile.velocity(0, 1e-4), profile.normal), 0.0);
      const auto rim = rim_nodes(disc.face());
      int count = 0;
      for (std::size_t i = 0; i < rim.size(); ++i)
        if (rim[i]) {
          EXPECT_EQ(profile.phi[i], 0.0);
          ++count;
        } else {
          EXPECT_GT(profile.phi[i], 0.0);
        }
      EXPECT_EQ(count, 60);
    }
}

TEST(Inflow, FlatIsConstantInside) {
  const auto disc = ellipse(6, 0.01, 0.01);
  const auto profile = inflow_profile(disc.face(), Profile::flat);
  const auto rim = rim_nodes(disc.face());
  for (std::size_t i = 0; i < rim.size(); ++i) EXPECT_EQ(profile.phi[i], rim[i] ? 0.0 : profile.phi[0]);
}

TEST(Inflow, SlightlyBulgingFaceStaysClose) {
  const auto plane = ellipse(12, 0.012, 0.012), bulging = ellipse(12, 0.012, 0.012, 3e-4);
  const auto a = inflow_profile(plane.face(), Profile::parabolic),
             b = inflow_profile(bulging.face(), Profile::parabolic);
  for (std::size_t i = 0; i < a.phi.size(); ++i) EXPECT_NEAR(a.phi[i], b.phi[i], 5e-3 * a.phi[0]);
}

std::string message(const Disc& disc) {
  try {
    inflow_profile(disc.face(), Profile::parabolic);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Inflow, RefusesFacesThatCannotCarryAProfile) {
  EXPECT_TRUE(contains(message(ellipse(1, 1.0, 1.0)), "no error"));  // the centre is free
  Disc coarse{{{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}}, {{0, 1, 2}}};
  EXPECT_TRUE(contains(message(coarse), "lie on the rim"));
  auto flipped = ellipse(3, 1.0, 1.0);
  std::swap(flipped.triangles[4][0], flipped.triangles[4][1]);
  EXPECT_TRUE(contains(message(flipped), "oriented against")) << message(flipped);
  auto sliver = ellipse(3, 1.0, 1.0);
  sliver.points[1] = sliver.points[0];
  EXPECT_TRUE(contains(message(sliver), "has no area"));
  auto twice = ellipse(3, 1.0, 1.0);
  const auto n = static_cast<std::int32_t>(twice.points.size());
  for (auto t : ellipse(3, 1.0, 1.0).triangles) twice.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  for (auto p : ellipse(3, 1.0, 1.0).points) twice.points.push_back(p + Vec3<double>{{5, 0, 0}});
  EXPECT_TRUE(contains(message(twice), "2 separate patches"));
  EXPECT_TRUE(contains(message(Disc{}), "0 triangles"));
  Disc closed{{{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  EXPECT_TRUE(contains(message(closed), "no meaningful mean normal"));
}

TEST(FaceShape, AreaNormalCentroidAndPlanarity) {
  const auto disc = ellipse(40, 0.02, 0.01);
  const auto shape = face_shape(disc.face());
  EXPECT_NEAR(shape.area, pi * 0.02 * 0.01, 1e-3 * shape.area);
  EXPECT_NEAR(shape.planarity, 1.0, 1e-14);
  EXPECT_NEAR(shape.out_of_plane, 0.0, 1e-12);
  EXPECT_NEAR(norm(shape.centroid - disc.points[0]), 0.0, 1e-14);
  EXPECT_FALSE(planarity_warning("inlet", shape));
  const auto dome = ellipse(20, 0.01, 0.01, 0.004);
  const auto warning = planarity_warning("inlet", face_shape(dome.face()));
  ASSERT_TRUE(warning);
  EXPECT_TRUE(contains(*warning, "inlet"));
}

TEST(FaceShape, ATubesSideHasNoMeanNormal) {
  Disc tube;
  for (int i = 0; i < 24; ++i)
    for (double z : {0.0, 1.0}) tube.points.push_back({{std::cos(2 * pi * i / 24), std::sin(2 * pi * i / 24), z}});
  for (std::int32_t i = 0; i < 24; ++i) {
    const std::int32_t a = 2 * i, b = 2 * ((i + 1) % 24);
    tube.triangles.push_back({a, b, b + 1});
    tube.triangles.push_back({a, b + 1, a + 1});
  }
  EXPECT_THROW((void)mean_normal("side", face_shape(tube.face())), InputError);
  const auto rim = rim_nodes(tube.face());
  EXPECT_EQ(std::count(rim.begin(), rim.end(), true), 48);
}

}  // namespace
