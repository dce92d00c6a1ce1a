#include "tunica/wall/fibre_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tunica/base/error.hpp"

namespace tunica::wall {
namespace {

void expect_near(const Vec3<double>& a, const Vec3<double>& b) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-14);
}

void expect_right_handed(const FibreFrame& f) {
  EXPECT_NEAR(norm(f.e1), 1.0, 1e-14);
  EXPECT_NEAR(norm(f.e2), 1.0, 1e-14);
  EXPECT_NEAR(dot(f.e1, f.e2), 0.0, 1e-14);
  expect_near(cross(f.e1, f.e2), f.e3);
}

TEST(FibreFrame, KeepsTheFirstVectorAndThePlaneOfBoth) {
  const Vec3<double> a{{1, 2, -2}}, b{{0.3, -1, 4}};
  const auto f = orthonormal_frame(a, b, "here");
  expect_right_handed(f);
  expect_near(f.e1, (1.0 / 3.0) * a);
  EXPECT_NEAR(dot(f.e3, b), 0.0, 1e-14);
  EXPECT_GT(dot(f.e2, b), 0.0);
}

TEST(FibreFrame, RefusesVectorsThatSpanNoPlane) {
  const Vec3<double> x{{1, 0, 0}};
  EXPECT_NO_THROW(orthonormal_frame(x, {{1, 2e-3, 0}}, "here"));
  EXPECT_THROW(orthonormal_frame(x, {{1, 5e-4, 0}}, "here"), InputError);
  EXPECT_THROW(orthonormal_frame(x, {{0, 0, 0}}, "here"), InputError);
  EXPECT_THROW(orthonormal_frame(x, {{0, std::nan(""), 0}}, "here"), InputError);
  EXPECT_THROW(orthonormal_frame(x, {{0, INFINITY, 0}}, "here"), InputError);
}

TEST(FibreFrame, CylinderIsCircumferentialLongitudinalRadial) {
  const CylindricalFrame cylinder{{{1, 2, 3}}, {{0, 0, 5}}};
  const auto f = cylinder.at({{1, 2.5, 7}});
  expect_right_handed(f);
  expect_near(f.e1, {{-1, 0, 0}});
  expect_near(f.e2, {{0, 0, 1}});
  expect_near(f.e3, {{0, 1, 0}});
  EXPECT_THROW(cylinder.at({{1, 2, 4}}), InputError);
  EXPECT_THROW(cylinder.at(cylinder.origin), InputError);
}

TEST(FibreFrame, OnlyAMeshFrameNeedsArrays) {
  EXPECT_TRUE(frame_arrays(ConstantFrame{}).empty());
  EXPECT_TRUE(frame_arrays(CylindricalFrame{}).empty());
  EXPECT_EQ(frame_arrays(MeshFrame{"c", "l"}), (std::vector<std::string>{"c", "l"}));
}

}  // namespace
}  // namespace tunica::wall
