// Velocities at the nodes of a face in the forms of the peers, as a table of points.
#include "tunica/stages/import/nodal_values.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/bc/velocity_profile.hpp"
#include "tunica/mesh/generate.hpp"

namespace tunica::stages {

namespace {

using peer_cases::NodalValues;

class NodalValuesOf : public testing::Test {
 protected:
  void write(const std::string& text) const { std::ofstream(folder.path() / "values.dat") << text; }
  NodalTable read(NodalValues::Kind kind, const char* name = "values.dat") const {
    NodalValues wanted{.kind = kind,
                       .file = folder.path() / name,
                       .face = "x_min",
                       .where = "solver.xml:1 Bct_file_path",
                       .table = "x_min_velocities.csv"};
    wanted.first_node = first_node;
    wanted.zero_rim = zero_rim;
    wanted.unit_flow = unit_flow;
    return read_nodal_values(wanted, box, 0.01, peer_cases::unit_system("cgs"));
  }
  std::string message(NodalValues::Kind kind) const {
    return test::message_of<InputError>([&] { read(kind); });
  }
  /// The nodes of the face, numbered from 1.
  std::vector<int> numbers() const {
    std::vector<int> numbers;
    for (std::size_t n = 0; n < box.points.size(); ++n)
      if (box.points[n][0] < 1e-9) numbers.push_back(static_cast<int>(n) + 1);
    return numbers;
  }
  /// v = (10 k, node, -1) cm/s at time k / 10.
  std::string in_time(int times) const {
    std::string text = "3 " + std::to_string(times) + " " + std::to_string(numbers().size()) + "\n";
    for (int k = 0; k < times; ++k) text += std::to_string(0.1 * k) + "\n";
    for (const int node : numbers()) {
      text += std::to_string(node) + "\n";
      for (int k = 0; k < times; ++k) text += std::to_string(10 * k) + " " + std::to_string(node) + " -1\n";
    }
    return text;
  }

  test::TemporaryFolder folder;
  mesh::MeshData box = mesh::box(2, 2, 2, {{0.02, 0.04, 0.03}}, mesh::RegionKind::lumen);
  int first_node = 1;
  bool zero_rim = false, unit_flow = false;
};

TEST_F(NodalValuesOf, ATextInTimeAreThoseOfItsNodes) {
  write(in_time(3));
  const auto table = read(NodalValues::Kind::in_time);
  ASSERT_EQ(table.times.size(), 3u);
  EXPECT_DOUBLE_EQ(table.times.back(), 0.2);
  write_nodal_table(table, {.kind = NodalValues::Kind::in_time, .face = "x_min"}, box, false,
                    folder.path() / "table.csv");
  bc::VelocityProfile profile;
  profile.table = folder.path() / "table.csv";
  profile.interpolation = bc::VelocityProfile::Interpolation::nearest;
  profile.period = table.times.back();
  const bc::PointTable points(profile.over_face(), bc::velocity_columns);
  for (const int node : numbers()) {
    const auto& x = box.points[static_cast<std::size_t>(node - 1)];
    EXPECT_LT(norm(points.value(x, 0.15) - Vec3<double>{{0.15, 0.01 * node, -0.01}}), 1e-9) << node;
    EXPECT_LT(norm(points.value(x, 0.35) - Vec3<double>{{0.15, 0.01 * node, -0.01}}), 1e-9) << node;
  }
}

TEST_F(NodalValuesOf, ATextSayWhatIsWrongWithIt) {
  const auto kind = NodalValues::Kind::in_time;
  write("2 1 1\n0\n1\n1 1\n");
  EXPECT_NE(message(kind).find("values.dat:1"), std::string::npos) << message(kind);
  EXPECT_NE(message(kind).find("3 are expected"), std::string::npos) << message(kind);
  std::string text = in_time(2);
  write(text.substr(0, text.size() - 10));
  EXPECT_NE(message(kind).find("ends where"), std::string::npos) << message(kind);
  write(text + "7\n");
  EXPECT_NE(message(kind).find("behind those of its last node"), std::string::npos) << message(kind);
  text.replace(text.find("0.100000"), 8, "0.000000");
  write(text);
  EXPECT_NE(message(kind).find("behind 0"), std::string::npos) << message(kind);
  first_node = 2;
  write(in_time(2));
  EXPECT_NE(message(kind).find("not on the face"), std::string::npos) << message(kind);
}

TEST_F(NodalValuesOf, AShapeGoAlongTheNormalAndCarryTheFlow) {
  std::string text;
  for (const int node : numbers()) text += std::to_string(node - 1) + " 2.5\n";
  write(text);
  first_node = 0;
  const auto flat = read(NodalValues::Kind::user);
  for (const auto& v : flat.values.at(0))
    EXPECT_LT(norm(v - Vec3<double>{{-0.025, 0, 0}}), 1e-12);  // outward along -x, cm/s
  unit_flow = zero_rim = true;
  const auto table = read(NodalValues::Kind::user);
  // One node inside, with a pyramid of a third of its height in the mean over the triangles around it.
  double flow = 0;
  for (const auto& face : box.faces)
    if (face.name == "x_min")
      for (const auto& t : face.triangles) {
        const auto& x0 = box.points[static_cast<std::size_t>(t[0])];
        const Vec3<double> area = 0.5 * cross(box.points[static_cast<std::size_t>(t[1])] - x0,
                                              box.points[static_cast<std::size_t>(t[2])] - x0);
        for (const auto node : t) {
          const auto place = std::lower_bound(table.nodes.begin(), table.nodes.end(), node) - table.nodes.begin();
          flow += dot(area, table.values[0][static_cast<std::size_t>(place)]) / 3;
        }
      }
  EXPECT_NEAR(flow, 1e-6, 1e-15);  // 1 cm^3/s
}

TEST_F(NodalValuesOf, ABctAreFoundByPlace) {
  // Two triangles of four points, in cm, of the corners of the face; its other nodes have none.
  std::ofstream(folder.path() / "bct.vtp")
      << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>"
         "<Piece NumberOfPoints=\"4\" NumberOfPolys=\"2\"><PointData>"
         "<DataArray type=\"Float64\" Name=\"velocity_0.0\" NumberOfComponents=\"3\" format=\"ascii\">"
         "1 0 0 2 0 0 3 0 0 4 0 0</DataArray>"
         "<DataArray type=\"Float64\" Name=\"velocity_0.5\" NumberOfComponents=\"3\" format=\"ascii\">"
         "0 1 0 0 2 0 0 3 0 0 4 0</DataArray></PointData><Points>"
         "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 4 3 0 0 3 0 0 0 0 4 0</DataArray>"
         "</Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 0 2 3</DataArray>"
         "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 6</DataArray></Polys></Piece></PolyData>"
         "</VTKFile>\n";
  EXPECT_NE(test::message_of<InputError>([&] { read(NodalValues::Kind::bct, "bct.vtp"); }).find("has no point at"),
            std::string::npos);
  box = mesh::box(1, 1, 1, {{0.02, 0.04, 0.03}}, mesh::RegionKind::lumen);
  const auto table = read(NodalValues::Kind::bct, "bct.vtp");
  ASSERT_EQ(table.times, (std::vector<double>{0.0, 0.5}));
  for (std::size_t n = 0; n < table.nodes.size(); ++n) {
    const auto& x = box.points[static_cast<std::size_t>(table.nodes[n])];
    const double number = x[2] > 0.02 ? (x[1] > 0.02 ? 1 : 2) : (x[1] > 0.02 ? 4 : 3);
    EXPECT_LT(norm(table.values[0][n] - Vec3<double>{{0.01 * number, 0, 0}}), 1e-12);
    EXPECT_LT(norm(table.values[1][n] - Vec3<double>{{0, 0.01 * number, 0}}), 1e-12);
  }
}

TEST_F(NodalValuesOf, AParabolaHasItsTopInTheMiddleAndIsZeroOnTheRim) {
  zero_rim = true;
  const auto table = read(NodalValues::Kind::parabolic);
  double middle = 0;
  for (std::size_t n = 0; n < table.nodes.size(); ++n) {
    const auto& x = box.points[static_cast<std::size_t>(table.nodes[n])];
    const bool inside = x[1] > 1e-9 && x[1] < 0.04 - 1e-9 && x[2] > 1e-9 && x[2] < 0.03 - 1e-9;
    const Vec3<double> d = x - Vec3<double>{{0, 0.02, 0.015}};
    if (inside && norm(d) < 1e-9) middle = table.values[0][n][0];
    EXPECT_TRUE(inside || norm(table.values[0][n]) == 0.0);
  }
  EXPECT_NEAR(middle, -0.01, 1e-12);  // 1 cm/s, outward
}

TEST_F(NodalValuesOf, AlongAxesAllHaveOneSize) {
  const auto table = read_nodal_values({.kind = NodalValues::Kind::flat,
                                        .quantity = NodalValues::Quantity::displacement,
                                        .face = "x_min",
                                        .zero_rim = true,
                                        .axes = {1, 2},
                                        .scale = 3.0},
                                       box, 0.01, peer_cases::unit_system("mmgs"));
  int inside = 0;
  for (const auto& u : table.values.at(0)) {
    if (norm(u) == 0) continue;
    EXPECT_LT(norm(u - Vec3<double>{{0, 0.003, 0.003}}), 1e-15);
    ++inside;
  }
  EXPECT_EQ(inside, 1);
}

TEST_F(NodalValuesOf, ALoadInTimeHasOneNumberForEachNode) {
  std::string text = "1 2 " + std::to_string(numbers().size()) + "\n0\n0.5\n";
  for (const int node : numbers()) text += std::to_string(node) + " 2 " + std::to_string(node) + "\n";
  write(text);
  const NodalValues wanted{.kind = NodalValues::Kind::in_time,
                           .quantity = NodalValues::Quantity::factor,
                           .file = folder.path() / "values.dat",
                           .face = "x_min",
                           .scale = -1.0};
  const auto table = read_nodal_values(wanted, box, 0.01, peer_cases::unit_system("cgs"));
  EXPECT_EQ(table.period, 0.5);
  for (std::size_t n = 0; n < table.nodes.size(); ++n) {
    EXPECT_EQ(table.values[0][n][0], -2);
    EXPECT_EQ(table.values[1][n][0], -1 - table.nodes[n]);
  }
  write_nodal_table(table, wanted, box, true, folder.path() / "table.csv");
  const bc::PointTable points(
      {.table = folder.path() / "table.csv", .period = 0.5, .interpolation = bc::OverFace::Interpolation::nearest},
      bc::factor_column);
  const auto middle = [&](std::size_t a, std::size_t b) {
    return 0.5 * (box.points[static_cast<std::size_t>(table.nodes[a])] +
                  box.points[static_cast<std::size_t>(table.nodes[b])]);
  };
  const auto face = std::find_if(box.faces.begin(), box.faces.end(), [](const auto& f) { return f.name == "x_min"; });
  ASSERT_NE(face, box.faces.end());
  const auto& t = face->triangles.at(0);
  const auto place = [&](std::int64_t node) {
    return static_cast<std::size_t>(std::lower_bound(table.nodes.begin(), table.nodes.end(), node) -
                                    table.nodes.begin());
  };
  // Nodes on edges take the mean of the ends.
  EXPECT_NEAR(points.value(middle(place(t[0]), place(t[1])), 0.25)[0],
              0.5 * (-2 - 1 - 0.5 * static_cast<double>(t[0] + t[1])), 1e-9);
}

TEST_F(NodalValuesOf, ACourseOfThreeComponentsIsTheSameOnTheWholeFace) {
  write("3 2\n0 0 1 2\n1 4 1 2\n2 8 1 0\n");
  NodalValues wanted{.kind = NodalValues::Kind::course,
                     .quantity = NodalValues::Quantity::traction,
                     .file = folder.path() / "values.dat",
                     .face = "x_min",
                     .ramp = true};
  const auto ramp = read_nodal_values(wanted, box, 0.01, peer_cases::unit_system("cgs"));
  EXPECT_EQ(ramp.nodes.size(), 1u);
  EXPECT_EQ(ramp.times, (std::vector<double>{0, 2}));
  EXPECT_LT(norm(ramp.values.at(1).at(0) - Vec3<double>{{0.8, 0.1, 0}}), 1e-12);
  wanted.ramp = false;
  EXPECT_THROW(read_nodal_values(wanted, box, 0.01, peer_cases::unit_system("cgs")), InputError);
  wanted.step = 0.5, wanted.steps = 4;
  const auto series = read_nodal_values(wanted, box, 0.01, peer_cases::unit_system("cgs"));
  ASSERT_EQ(series.times.size(), 5u);
  // The line from the first to the last value is no part of the series: 4 t, of which nothing is left to expand.
  EXPECT_LT(norm(series.values.at(1).at(0) - Vec3<double>{{0.2, 0.1, series.values[1][0][2]}}), 1e-9);
}

TEST_F(NodalValuesOf, TractionsStandInAnArrayOfTheirName) {
  std::ofstream(folder.path() / "t.vtp")
      << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>"
         "<Piece NumberOfPoints=\"4\" NumberOfPolys=\"2\"><PointData>"
         "<DataArray type=\"Float64\" Name=\"Traction\" NumberOfComponents=\"3\" format=\"ascii\">"
         "1 0 0 2 0 0 3 0 0 4 0 0</DataArray></PointData><Points>"
         "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 4 3 0 0 3 0 0 0 0 4 0</DataArray>"
         "</Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 0 2 3</DataArray>"
         "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 6</DataArray></Polys></Piece></PolyData>"
         "</VTKFile>\n";
  box = mesh::box(1, 1, 1, {{0.02, 0.04, 0.03}}, mesh::RegionKind::wall);
  NodalValues wanted{.kind = NodalValues::Kind::traction,
                     .quantity = NodalValues::Quantity::traction,
                     .file = folder.path() / "t.vtp",
                     .face = "x_min",
                     .scale = 2.0};
  const auto table = read_nodal_values(wanted, box, 0.01, peer_cases::unit_system("cgs"));
  for (std::size_t n = 0; n < table.nodes.size(); ++n) {
    const auto& x = box.points[static_cast<std::size_t>(table.nodes[n])];
    const double number = x[2] > 0.02 ? (x[1] > 0.02 ? 1 : 2) : (x[1] > 0.02 ? 4 : 3);
    EXPECT_LT(norm(table.values.at(0)[n] - Vec3<double>{{0.2 * number, 0, 0}}), 1e-12);
  }
  wanted.kind = NodalValues::Kind::pressure;
  EXPECT_NE(test::message_of<InputError>([&] {
              read_nodal_values(wanted, box, 0.01, peer_cases::unit_system("cgs"));
            }).find("no point array Pressure"),
            std::string::npos);
}

}  // namespace

}  // namespace tunica::stages
