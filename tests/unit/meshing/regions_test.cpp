#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "block_vessel.hpp"
#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/interface.hpp"
#include "tunica/mesh_io/simvascular.hpp"
#include "tunica/meshing/assemble.hpp"
#include "tunica/meshing/mesh_report.hpp"
#include "tunica/meshing/wall_regions.hpp"

namespace tunica::meshing {
namespace {

struct Block {
  test::BlockVessel vessel;
  geometry::Tetrahedra mesh;
  std::vector<geometry::Opening> openings;
  SurfaceFaces faces;
};

Block make_block(const test::BlockVessel& vessel = {}) {
  Block b{vessel, test::block_vessel(vessel), test::block_openings(vessel), {}};
  b.faces = sort_surface(b.mesh, b.openings);
  return b;
}

WallRegions find(const Block& b) {
  return find_wall_regions(b.mesh, {{b.faces.caps[0], false}, {b.faces.caps[1], false}}, {.thickest_flap = 1.5e-3});
}

TEST(WallRegions, PlacesOverrideWhatTheMeshTells) {
  const auto b = make_block();
  const auto count = [&](const WallRegionOptions& options, WallRegion region = WallRegion::flap) {
    const auto regions = find_wall_regions(b.mesh, {{b.faces.caps[0], false}, {b.faces.caps[1], false}}, options);
    geometry::Index sum = 0;
    for (std::size_t e = 0; e < b.mesh.elements.size(); ++e)
      sum += b.mesh.labels[e] == geometry::wall_label && regions.of_element[e] == region;
    return sum;
  };
  const geometry::Point in_false{{6.5e-3, 4.5e-3, 14e-3}};
  const auto usual = count({.thickest_flap = 1.5e-3});
  EXPECT_GT(usual, 100);
  EXPECT_EQ(count({.thickest_flap = 1.5e-3, .false_lumen = {in_false}}), usual);
  // The other way round, too much is called false: the vessel beyond the flap as well.
  EXPECT_EQ(count({.thickest_flap = 1.5e-3, .true_lumen = {in_false}}), usual);
  EXPECT_EQ(count({.thickest_flap = 1.5e-3, .true_lumen = {in_false}}, WallRegion::true_lumen_wall),
            count({.thickest_flap = 1.5e-3}, WallRegion::false_lumen_wall));
  EXPECT_THROW(count({.true_lumen = {{{1, 1, 1}}}}), InputError);
}

TEST(WallRegions, TrueAndFalseLumenAndFlap) {
  const auto b = make_block();
  const auto regions = find(b);
  const auto& v = b.vessel;
  for (std::size_t n = 0; n < b.mesh.points.size(); ++n) {
    const geometry::Point x = 1e3 * b.mesh.points[n];
    if (regions.side[n] == 0) continue;
    if (x[2] < v.from - 1 || x[0] < v.flap_at) {
      EXPECT_GT(regions.side[n], 0) << x[0] << " " << x[1] << " " << x[2];
    }
    if (x[2] > v.from + 1.5 && x[2] < v.to - 1.5 && x[0] > v.flap_at + 1.5) {
      EXPECT_LT(regions.side[n], 0) << x[0] << " " << x[1] << " " << x[2];
    }
  }
  int flap = 0;
  for (std::size_t e = 0; e < b.mesh.elements.size(); ++e) {
    if (b.mesh.labels[e] != geometry::wall_label) continue;
    const geometry::Point x = 1e3 * mesh::centroid(b.mesh.points, b.mesh.elements[e]);
    const bool within = x[2] > v.from + 2 && x[2] < v.to - 2 && x[1] > 2 && x[1] < v.across - 2;
    if (within && x[0] > v.flap_at && x[0] < v.flap_at + 1 && !(x[2] > 7 && x[2] < 11 && x[1] > 3 && x[1] < 7)) {
      EXPECT_EQ(regions.of_element[e], WallRegion::flap) << x[0] << " " << x[1] << " " << x[2];
      ++flap;
    }
    if (within && x[0] < 1) {
      EXPECT_EQ(regions.of_element[e], WallRegion::true_lumen_wall);
    }
    if (within && x[0] > v.across - 1) {
      EXPECT_EQ(regions.of_element[e], WallRegion::false_lumen_wall);
    }
    if (x[2] < v.from - 1) {
      EXPECT_EQ(regions.of_element[e], WallRegion::true_lumen_wall);
    }
  }
  EXPECT_GT(flap, 50);
}

TEST(WallRegions, ThickWallBetweenTwoLumensIsNoFlap) {
  const auto b = make_block();
  const auto regions =
      find_wall_regions(b.mesh, {{b.faces.caps[0], false}, {b.faces.caps[1], false}}, {.thickest_flap = 0.5e-3});
  for (const auto region : regions.of_element) EXPECT_NE(region, WallRegion::flap);
  EXPECT_THROW(find_wall_regions(b.mesh, {}, {}), InputError);
}

TEST(Assemble, RegionsFacesAndTwinsMakeASoundMesh) {
  const auto b = make_block();
  auto data = assemble(b.mesh, b.openings, b.faces, find(b));
  EXPECT_EQ(data.tetrahedra.size(), b.mesh.elements.size());
  EXPECT_EQ(data.points.size(), b.mesh.points.size() + data.twins.size());
  for (const auto& [wall, lumen] : data.twins) EXPECT_EQ(norm(data.points[wall] - data.points[lumen]), 0);
  std::set<std::string> names;
  for (const auto& face : data.faces) names.insert(face.name);
  EXPECT_EQ(names, (std::set<std::string>{"lumen_inlet", "lumen_outlet", "lumen_wall", "wall_inlet", "wall_outlet",
                                          "wall_inner", "wall_outer"}));
  auto turned = data;
  const mesh::Boundary boundary(data.tetrahedra, std::ssize(data.points), "block");
  EXPECT_NO_THROW(mesh::orient_and_check_faces(turned, boundary, "block"));
  for (std::size_t f = 0; f < data.faces.size(); ++f)
    for (std::size_t t = 0; t < data.faces[f].triangles.size(); ++t) {
      // Turned outward already: the same cyclic order.
      auto a = data.faces[f].triangles[t], c = turned.faces[f].triangles[t];
      std::rotate(a.begin(), std::min_element(a.begin(), a.end()), a.end());
      std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
      EXPECT_EQ(a, c) << data.faces[f].name;
    }
}

TEST(Assemble, LumenAtTheOutsideIsAnError) {
  auto mesh = test::block_vessel({});
  for (auto& label : mesh.labels)
    if (label == geometry::wall_label && &label - mesh.labels.data() > 2000) {
      label = geometry::lumen_label;
      break;
    }
  const auto triangles = geometry::surface_triangles(mesh);
  const bool breached = std::any_of(triangles.begin(), triangles.end(), [&](const geometry::LabelledTriangle& t) {
    return t.label == geometry::lumen_label && t.neighbour_label == geometry::outside_label &&
           mesh.points[t.nodes[0]][2] > 0.001 && mesh.points[t.nodes[0]][2] < 0.023;
  });
  if (!breached)  // else make one
    for (const auto& t : triangles)
      if (t.label == geometry::wall_label && t.neighbour_label == geometry::outside_label &&
          mesh.points[t.nodes[0]][2] > 0.002 && mesh.points[t.nodes[0]][2] < 0.02) {
        mesh.labels[t.element] = geometry::lumen_label;
        break;
      }
  EXPECT_THROW(sort_surface(mesh, test::block_openings({})), SolverError);
}

TEST(SimVascularWriter, FilesReadBackAsTheSameMesh) {
  const auto b = make_block();
  const auto data = assemble(b.mesh, b.openings, b.faces, find(b));
  const tunica::test::TemporaryFolder folder;
  EXPECT_EQ(mesh_io::write_simvascular(folder.path() / "lumen", data, mesh::RegionKind::lumen, 1e-3),
            std::vector<std::string>{"lumen"});
  const auto names = mesh_io::write_simvascular(folder.path() / "wall", data, mesh::RegionKind::wall, 1e-3);
  mesh_io::SimVascularOptions options{.metres_per_unit = 1e-3};
  std::vector<mesh::LoadedMesh> parts = {
      mesh_io::read_simvascular(folder.path() / "lumen", mesh::RegionKind::lumen, "lumen", options)};
  options.regions.emplace().array = "region";
  for (std::size_t r = 0; r < names.size(); ++r) options.regions->names.emplace(static_cast<int>(r) + 1, names[r]);
  parts.push_back(mesh_io::read_simvascular(folder.path() / "wall", mesh::RegionKind::wall, "wall", options));
  const mesh::Interface interface {
    {lumen_interface}, { wall_interface }
  };
  const auto joined = mesh::join(parts, std::span(&interface, 1), {});
  ASSERT_EQ(joined.data.points.size(), data.points.size());
  for (std::size_t n = 0; n < data.points.size(); ++n)
    EXPECT_NEAR(norm(joined.data.points[n] - data.points[n]), 0, 1e-15);
  EXPECT_EQ(joined.data.tetrahedra, data.tetrahedra);
  EXPECT_EQ(joined.data.twins.size(), data.twins.size());
  ASSERT_EQ(joined.data.regions.size(), data.regions.size());
  for (std::size_t r = 0; r < data.regions.size(); ++r) {
    EXPECT_EQ(joined.data.regions[r].name, data.regions[r].name);
    EXPECT_EQ(joined.data.regions[r].end_element, data.regions[r].end_element);
  }
  for (const auto& line : joined.report)
    if (line.starts_with("face ")) {
      EXPECT_EQ(line.find("coordinates"), std::string::npos) << line;
    }
}

TEST(MeshReport, TopologyCountsHandles) {
  // One hole in the flap joins the lumens, no handle; without a false lumen's end walls the flap makes one.
  for (const bool hole : {true, false}) {
    const auto b = make_block({.hole = hole});
    auto all = b.faces.interface;
    for (const auto& cap : b.faces.caps) all.insert(all.end(), cap.begin(), cap.end());
    const auto t = topology(all);
    EXPECT_EQ(t.parts, hole ? 1 : 2);  // else the false lumen is a cavity of its own
    EXPECT_EQ(t.genus, 0);
    EXPECT_TRUE(t.manifold);
  }
  auto open = make_block().faces.interface;
  EXPECT_FALSE(topology(open).manifold);
}

TEST(MeshReport, VolumesAreasAndShapes) {
  const auto b = make_block();
  const auto data = assemble(b.mesh, b.openings, b.faces, find(b));
  const double lumen = test::volume(b.mesh, geometry::lumen_label), wall = test::volume(b.mesh, geometry::wall_label);
  const Fidelity fidelity{{1e-4, 0.1}, {2e-4, 0.2}, lumen / 1.01, wall / 0.98};
  const geometry::Thickness thickness{{1e-3, 2e-3, 3e-3, std::numeric_limits<double>::infinity()}, {0, 0, 1, 0}};
  const std::vector<Tear> tears = {{{{1e-3, 2e-3, 3e-3}}, {{1, 0, 0}}, 5e-6}};
  const auto report =
      mesh_report({data, wall_layers(b.mesh, b.faces.outer), fidelity, thickness, tears, {{"test", 1.5}}, 1e6});
  EXPECT_NEAR(report["fidelity"]["lumen_volume_percent"].get<double>(), 1, 1e-9);
  EXPECT_NEAR(report["fidelity"]["wall_volume_percent"].get<double>(), -2, 1e-9);
  EXPECT_NEAR(report["thickness_mm"]["flap"]["median"].get<double>(), 3, 1e-12);
  EXPECT_NEAR(report["thickness_mm"]["wall"]["95_percent"].get<double>(), 1, 1e-12);
  EXPECT_NEAR(report["tears"][0]["area_mm2"].get<double>(), 5, 1e-12);
  EXPECT_NEAR(report["fidelity"]["outer_distance_mm"].get<double>(), 0.2, 1e-12);
  double volume = 0;
  for (const auto& region : report["regions"]) volume += region["volume_ml"].get<double>();
  EXPECT_NEAR(volume, 9 * 9 * 24 * 1e-3, 1e-9);
  for (const auto& face : report["faces"])
    if (face["name"] == "lumen_inlet") {
      EXPECT_NEAR(face["area_mm2"].get<double>(), 49, 1e-9);
    }
  geometry::Index counted = 0;
  for (const auto& n : report["shapes"]["dihedral_histogram_5_deg"]) counted += n.get<geometry::Index>();
  EXPECT_EQ(counted, std::ssize(data.tetrahedra));
  EXPECT_NEAR(report["shapes"]["smallest_dihedral_deg"].get<double>(), 45, 1e-6);  // Kuhn's split
  EXPECT_NEAR(report["shapes"]["edge_mm"]["longest"].get<double>(), std::sqrt(3.0), 1e-9);
  EXPECT_NE(report_text(report).find("genus 0"), std::string::npos);
}

}  // namespace
}  // namespace tunica::meshing
