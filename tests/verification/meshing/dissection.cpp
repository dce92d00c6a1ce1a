// Meshes of the idealised dissection against the body they are made of, and of random ones.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "tunica/base/error.hpp"
#include "tunica/geometry/dissection_model.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/meshing/geometry.hpp"
#include "tunica/stages/meshing/mesh_case.hpp"

namespace tunica::stages {
namespace {

void silent(const std::string&) {}

struct Volumes {
  double lumen = 0, wall = 0;  ///< ml
};

/// Of the body itself, by counting points of a fine grid.
Volumes count_volumes(const geometry::DissectionModel& model) {
  const double h = 0.8e-3;
  const geometry::Box box = model.box();
  Volumes v;
  for (double x = box.low[0] + 0.37 * h; x < box.high[0]; x += h)
    for (double y = box.low[1] + 0.61 * h; y < box.high[1]; y += h)
      for (double z = box.low[2] + 0.13 * h; z < box.high[2]; z += h) {
        const int label = model.label({{x, y, z}});
        (label == geometry::lumen_label ? v.lumen : v.wall) += label == geometry::outside_label ? 0 : h * h * h * 1e6;
      }
  return v;
}

struct Result {
  mesh::MeshData data;
  nlohmann::json report;
  Volumes volumes;
};

Result make(const geometry::ParametricDissection& shape, const case_file::Size& size, int elements_through_wall = 1) {
  case_file::MeshCase mesh_case;
  mesh_case.geometry = meshing::Geometry(shape);
  mesh_case.size = size;
  mesh_case.elements_through_wall = elements_through_wall;
  auto made = make_mesh(mesh_case, silent);
  Result r{std::move(made.data), nlohmann::json::parse(made.report_json), {}};
  for (const auto& region : r.report["regions"])
    (region["name"] == "lumen" ? r.volumes.lumen : r.volumes.wall) += region["volume_ml"].get<double>();
  return r;
}

/// What holds for every mesh of a dissection with two tears.
void expect_sound(const Result& r, const geometry::DissectionModel& model) {
  EXPECT_GE(r.report["shapes"]["smallest_dihedral_deg"].get<double>(), 3);
  EXPECT_GE(r.report["shapes"]["dihedral_of_worst_0.01_percent_deg"].get<double>(), 8);
  EXPECT_EQ(r.report["lumen_boundary"]["parts"], 1);
  EXPECT_EQ(r.report["lumen_boundary"]["genus"], 1);  // two tears: one way round
  EXPECT_EQ(r.report["lumen_boundary"]["manifold"], true);
  EXPECT_EQ(r.report["wall_boundary"]["parts"], 1);
  EXPECT_EQ(r.report["wall_boundary"]["manifold"], true);
  auto data = r.data;
  EXPECT_NO_THROW(
      mesh::orient_and_check_faces(data, mesh::Boundary(data.tetrahedra, std::ssize(data.points), "mesh"), "mesh"));
  std::map<std::string, double> areas;
  for (const auto& face : r.report["faces"]) areas[face["name"]] = face["area_mm2"];
  for (const auto& o : model.openings()) {
    const double lumen = std::numbers::pi * o.lumen_radius * o.lumen_radius * 1e6;
    EXPECT_NEAR(areas["lumen_" + o.name] / lumen, 1, 0.03) << o.name;
    EXPECT_NEAR(areas["wall_" + o.name] / (std::numbers::pi * o.outer_radius * o.outer_radius * 1e6 - lumen), 1, 0.05)
        << o.name;
  }
  EXPECT_EQ(areas["lumen_wall"], areas["wall_inner"]);
  // lumen, true_lumen_wall, false_lumen_wall, flap, branches
  EXPECT_EQ(r.data.regions.size(), 5U);
}

/// Share of the volume of a wall region whose place agrees with the body's own functions.
double agreement(const Result& r, const geometry::DissectionModel& model, const std::string& name,
                 const std::function<bool(const geometry::DissectionModel::Values&)>& belongs) {
  double right = 0, all = 0;
  for (const auto& region : r.data.regions) {
    if (region.name != name) continue;
    for (auto e = region.first_element; e < region.end_element; ++e) {
      const auto& t = r.data.tetrahedra[e];
      const geometry::Point& a = r.data.points[t[0]];
      const double volume = dot(r.data.points[t[1]] - a, cross(r.data.points[t[2]] - a, r.data.points[t[3]] - a)) / 6;
      all += volume;
      if (belongs(model.at(mesh::centroid(r.data.points, t)))) right += volume;
    }
  }
  return right / all;
}

void expect_right_regions(const Result& r, const geometry::DissectionModel& model) {
  // The flap is near the sheet; walls are on their side of it, but for what lies about its edges and its tips.
  EXPECT_GT(agreement(r, model, "flap", [](const auto& v) { return v.flap < 0.3e-3; }), 0.97);
  EXPECT_GT(agreement(r, model, "false_lumen_wall", [](const auto& v) { return v.side < 2e-3; }), 0.97);
  EXPECT_GT(agreement(r, model, "true_lumen_wall", [](const auto& v) { return v.side > -2e-3; }), 0.97);
  EXPECT_GT(agreement(r, model, "branches", [](const auto& v) { return v.branch >= 0 || v.lumen < 4e-3; }), 0.97);
}

TEST(DissectionMesh, MatchesTheBodyAtTwoSizesAndHasTwoElementsThroughTheWallOnRequest) {
  const auto shape = config::parse_text(geometry::ParametricDissection::schema(),
                                        "{celiac: {}, superior_mesenteric: {}, left_renal: {}, right_renal: {}, "
                                        "iliacs: {}}")
                         .value;
  const geometry::DissectionModel model(shape);
  const Volumes exact = count_volumes(model);
  std::vector<Result> made;
  for (const case_file::Size& size :
       {case_file::Size(case_file::Coarse{}), case_file::Size(case_file::Across{.count = 3.2})}) {
    const auto& r = made.emplace_back(make(shape, size));
    std::printf(
        "edge %.2f mm: %zu tetrahedra, lumen %.2f ml (exact %.2f), wall %.2f ml (exact %.2f), smallest "
        "dihedral %.2f\n",
        case_file::edge_length(size) / geometry::mm, r.data.tetrahedra.size(), r.volumes.lumen, exact.lumen,
        r.volumes.wall, exact.wall, r.report["shapes"]["smallest_dihedral_deg"].get<double>());
    EXPECT_NEAR(r.volumes.lumen / exact.lumen, 1, 0.002);
    EXPECT_NEAR(r.volumes.wall / exact.wall, 1, 0.003);
    expect_sound(r, model);
    expect_right_regions(r, model);
  }
  const auto& one = made.front();
  const auto two = make(shape, case_file::Coarse{}, 2);
  EXPECT_GT(one.report["wall_one_element_thick_percent"].get<double>(), 50);
  EXPECT_EQ(two.report["wall_one_element_thick_percent"].get<double>(), 0);
  EXPECT_LT(two.data.tetrahedra.size(), 2 * one.data.tetrahedra.size());
  expect_sound(two, model);
}

/// Parameters drawn from wide ranges; not all are possible.
geometry::ParametricDissection draw(std::mt19937& random) {
  const auto from = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto coin = [&] { return from(0, 1) < 0.5; };
  geometry::ParametricDissection d;
  auto& a = d.aorta;
  a.ascending_length = from(40, 80) * geometry::mm;
  a.arch_bend_radius = from(33, 46) * geometry::mm;
  a.arch_angle = from(160, 188) * geometry::degree;
  a.arch_direction = from(20, 110) * geometry::degree;
  a.descending_length = from(250, 330) * geometry::mm;
  a.descending_bend = from(-25, 25) * geometry::degree;
  a.ascending_radius = from(13, 18) * geometry::mm;
  a.arch_radius = from(11, 15) * geometry::mm;
  a.dissected_radius = from(13, 18) * geometry::mm;
  a.abdominal_radius = from(8, 11) * geometry::mm;
  a.wall_thickness = from(1.8, 3.2) * geometry::mm;
  a.branch_fillet = from(2.5, 5) * geometry::mm;
  auto& f = d.flap;
  f.start = a.ascending_length + a.arch_bend_radius * a.arch_angle + from(-15, 10) * geometry::mm;
  f.length = from(150, 220) * geometry::mm;
  f.taper = from(26, 40) * geometry::mm;
  f.thickness = from(1.2, 2.2) * geometry::mm;
  f.false_lumen_wall_thickness = from(1, 1.8) * geometry::mm;
  f.turns = from(-0.8, 0.8);
  f.true_lumen_direction = from(0, 360) * geometry::degree;
  f.true_lumen_share = from(0.3, 0.65);
  f.bow = from(-2, 4) * geometry::mm;
  f.rim_fillet = from(0.3, 0.5) * f.thickness;
  f.corner_fillet = from(1, 3) * geometry::mm;
  f.entry = {f.start + f.taper + from(12, 30) * geometry::mm, from(100, 260) * geometry::mm * geometry::mm,
             from(1, 2.2), from(-2, 2) * geometry::mm};
  f.exit = {f.start + f.length - f.taper - from(12, 30) * geometry::mm, from(100, 260) * geometry::mm * geometry::mm,
            from(1, 2.2), from(-2, 2) * geometry::mm};
  const auto vary = [&](geometry::BranchShape& b, double position) {
    b.position = position;
    b.angle += from(-25, 25) * geometry::degree;
    b.inclination += from(-15, 15) * geometry::degree;
    b.radius *= from(0.8, 1.25);
    b.wall_thickness *= from(0.85, 1.4);
    b.length += from(0, 10) * geometry::mm;
  };
  const auto on_arch = [&](double share) {
    return a.ascending_length + (share + from(-0.02, 0.02)) * a.arch_bend_radius * a.arch_angle;
  };
  vary(d.brachiocephalic, on_arch(0.28));
  vary(d.left_common_carotid, on_arch(0.50));
  vary(d.left_subclavian, on_arch(0.70));
  const auto usual = config::parse_text(geometry::ParametricDissection::schema(), "{celiac: {}, left_renal: {}}").value;
  if (coin()) vary(d.celiac.emplace(*usual.celiac), f.start + f.length + from(14, 22) * geometry::mm);
  if (coin()) vary(d.left_renal.emplace(*usual.left_renal), f.start + f.length + from(30, 50) * geometry::mm);
  if (coin())
    d.iliacs = geometry::IliacShape{from(22, 38) * geometry::degree, from(4.5, 6) * geometry::mm,
                                    from(40, 60) * geometry::mm, from(1, 1.6) * geometry::mm};
  return d;
}

TEST(DissectionMesh, RandomParametersGiveGoodMeshesOrAreRefused) {
  // One takes half a minute, twenty take ten: TUNICA_SEEDS=20.
  const char* seeds = std::getenv("TUNICA_SEEDS");
  const int wanted = seeds ? std::atoi(seeds) : 1;
  std::mt19937 random(2024);
  int refused = 0;
  for (int made = 0; made < wanted;) {
    const auto shape = draw(random);
    const auto found = geometry::impossibilities(shape);
    if (!found.errors.empty()) {
      ++refused;
      for (const auto& problem : found.errors) EXPECT_FALSE(problem.what.empty() || problem.remedy.empty());
      ASSERT_LT(refused, 50 * wanted);
      continue;
    }
    SCOPED_TRACE(made++);
    const geometry::DissectionModel model(shape);
    try {
      const auto r = make(shape, 6 * geometry::mm);
      std::printf("%2d: %zu tetrahedra, smallest dihedral %.2f, %.1f s\n", made, r.data.tetrahedra.size(),
                  r.report["shapes"]["smallest_dihedral_deg"].get<double>(),
                  r.report["seconds"]["total"].get<double>());
      std::fflush(stdout);
      expect_sound(r, model);
      expect_right_regions(r, model);
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }
  std::printf("%d meshes, %d parameter sets refused as impossible\n", wanted, refused);
}

}  // namespace
}  // namespace tunica::stages
