#include "tunica/flow_imaging/plane_series.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "tube_flow.hpp"
#include "tunica/base/error.hpp"
#include "tunica/flow_imaging/disk_map.hpp"

namespace tunica::flow_imaging {
namespace {

/// The end of a tube, stretched, turned and moved.
OpeningMesh stretched_inlet(double stretch, const Vec3<double>& shift) {
  const TubeFlow tube;
  auto opening = opening_mesh(tube.mesh, tube.mesh.faces.front());
  for (auto& x : opening.points) x = Vec3<double>{{stretch * x[0] + 0.2 * x[1], x[2], x[1]}} + shift;  // normal along y
  for (auto& t : opening.triangles) std::swap(t[1], t[2]);  // the exchange of y and z is a mirror
  return opening;
}

TEST(DiskMap, FoldsNothing) {
  const auto opening = stretched_inlet(3, {{1, 2, 3}});
  const Vec3<double> normal = bc::face_shape(opening.face()).normal;
  const auto disk = disk_map(opening.points, opening.triangles, normal, {{1, 0, 0}}, "inlet");
  double area = 0;
  for (const auto& t : opening.triangles) {
    const auto &a = disk[static_cast<std::size_t>(t[0])], &b = disk[static_cast<std::size_t>(t[1])],
               &c = disk[static_cast<std::size_t>(t[2])];
    const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    EXPECT_GT(twice, 0);
    area += 0.5 * twice;
  }
  EXPECT_NEAR(area, M_PI, 0.05);
}

TEST(DiskMap, RefusesAClosedSurface) {
  const std::vector<Vec3<double>> points{{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  const std::vector<std::array<std::int32_t, 3>> triangles{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  EXPECT_THROW(disk_map(points, triangles, {{0, 0, 1}}, {{1, 0, 0}}, "closed"), InputError);
}

class Planes : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("tunica_planes_" + std::to_string(::getpid()) +
                                                        testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  /// A round plane in mm with velocities in cm/s along -z: (1 - r^2) times 100 (1 + frame).
  void write(int frame, int first_point = 0) const {
    const TubeFlow tube;
    const auto opening = opening_mesh(tube.mesh, tube.mesh.faces.front());
    std::ofstream file(folder_ / ("profile_" + std::to_string(frame) + ".vtp"));
    file << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
            "byte_order=\"LittleEndian\">\n<PolyData>\n"
         << "<Piece NumberOfPoints=\"" << opening.points.size() << "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
         << "NumberOfStrips=\"0\" NumberOfPolys=\"" << opening.triangles.size() << "\">\n<PointData>\n"
         << "<DataArray type=\"Float64\" Name=\"Velocity\" NumberOfComponents=\"3\" format=\"ascii\">\n";
    for (const auto& x : opening.points) {
      const double r = std::hypot(x[0], x[1]) / tube.radius;
      file << "0 0 " << -100 * (1 + frame) * std::max(0.0, 1 - r * r) << "\n";
    }
    file << "</DataArray>\n</PointData>\n<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" "
            "format=\"ascii\">\n";
    for (const auto& x : opening.points)
      file << 1e3 * x[0] + first_point << " " << 1e3 * x[1] << " " << 1e3 * x[2] << "\n";
    file << "</DataArray>\n</Points>\n<Polys>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
    for (const auto& t : opening.triangles) file << t[0] << " " << t[1] << " " << t[2] << "\n";
    file << "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
    for (std::size_t k = 1; k <= opening.triangles.size(); ++k) file << 3 * k << "\n";
    file << "</DataArray>\n</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  }
  PlaneFiles files() const {
    PlaneFiles f;
    f.files = folder_ / "profile_*.vtp";
    f.unit = 0.01;
    f.length_unit = 1e-3;
    f.period = 1;
    return f;
  }
  std::filesystem::path folder_;
};

TEST_F(Planes, AreLaidOntoAnOpeningOfAnotherShape) {
  for (int k = 0; k < 4; ++k) write(k);
  const auto plane = read_plane_series(files(), "plane");
  ASSERT_EQ(plane.times.size(), 4U);
  EXPECT_NEAR(plane.times[1], 0.25, 1e-12);
  EXPECT_NEAR(plane.normal[2], -1, 1e-9);  // along the flow
  EXPECT_NEAR(plane.flow(1), 0.5 * 2 * M_PI * 1e-4, 0.03 * M_PI * 1e-4);
  const auto opening = stretched_inlet(2, {{0.3, 0, 0}});
  const auto course = plane_at_nodes(plane, opening, 0);
  const auto normal = bc::face_shape(opening.face()).normal;
  const auto rim = bc::rim_nodes(opening.face());
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(opening.outflow(course.values[k]), -plane.flow(k), 1e-9 * plane.flow(k));
    for (std::size_t n = 0; n < rim.size(); ++n) {
      const auto& v = course.values[k][n];
      if (rim[n]) {
        EXPECT_EQ(norm(v), 0);
      }
      EXPECT_LE(dot(v, normal), 1e-6);                     // into the vessel
      EXPECT_LT(norm(v - dot(v, normal) * normal), 1e-9);  // and along its axis
    }
  }
}

TEST_F(Planes, SameShapeGetsTheSameVelocities) {
  for (int k = 0; k < 3; ++k) write(k);
  const auto plane = read_plane_series(files(), "plane");
  const TubeFlow tube;
  const auto opening = opening_mesh(tube.mesh, tube.mesh.faces.front());  // blood enters along +z: turned round
  const auto course = plane_at_nodes(plane, opening, 0);
  for (std::size_t n = 0; n < opening.points.size(); ++n) {
    const double r = std::hypot(opening.points[n][0], opening.points[n][1]) / tube.radius;
    EXPECT_NEAR(course.values[0][n][2], std::max(0.0, 1 - r * r), 0.03);
  }
}

TEST_F(Planes, MissingFramesOtherPointsAndUnitsAreTold) {
  const auto message = [&](const PlaneFiles& f) {
    try {
      read_plane_series(f, "plane");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const int k : {0, 1, 3}) write(k);
  EXPECT_NE(message(files()).find("after frame 1"), std::string::npos) << message(files());
  write(2, 5);
  EXPECT_NE(message(files()).find("other points"), std::string::npos) << message(files());
  write(2);
  auto f = files();
  f.unit = 1;
  EXPECT_NE(message(f).find("plane.unit"), std::string::npos) << message(f);
  f = files();
  f.array = "U";
  EXPECT_NE(message(f).find("no point array U"), std::string::npos) << message(f);
}

}  // namespace
}  // namespace tunica::flow_imaging
