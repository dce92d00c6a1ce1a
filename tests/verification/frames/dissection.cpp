// Frames of the idealised dissection against those of the body it is made of; the region at the tears with the
// potential of the wall alone and of lumen and wall.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "tunica/distributed/element_shape.hpp"
#include "tunica/frames/frames.hpp"
#include "tunica/frames/tears.hpp"
#include "tunica/geometry/dissection_model.hpp"
#include "tunica/meshing/geometry.hpp"
#include "tunica/stages/meshing/mesh_case.hpp"
#include "verification/frames/angles.hpp"

namespace tunica::frames {
namespace {

using geometry::mm;
using test::angle_between;
using test::Angles;

/// Away from where wall, flap and branches meet.
constexpr double clear = 4 * mm;

const geometry::ParametricDissection& shape() {
  static const auto parsed =
      config::parse_text(geometry::ParametricDissection::schema(),
                         "{celiac: {}, superior_mesenteric: {}, left_renal: {}, right_renal: {}, iliacs: {}}");
  return parsed.value;
}

/// On rank 0.
mesh::MeshData make_data(const case_file::Size& size) {
  return parallel::on_root(MPI_COMM_WORLD, [&] {
    case_file::MeshCase c;
    c.geometry = meshing::Geometry(shape());
    c.size = size;
    return stages::make_mesh(c, [](const std::string&) {}).data;
  });
}

FrameFaces faces_of(const distributed::DistributedMesh& mesh) {
  FrameFaces faces{{"wall_inner"}, {"wall_inlet", "lumen_inlet"}, {}};
  for (const auto& face : mesh.faces)
    if (face.name != "wall_inner" && face.name != "wall_outer" && face.name != "lumen_wall" &&
        !face.name.ends_with("_inlet"))
      faces.outlets.push_back(face.name);
  return faces;
}

/// Angles of e1, e2, e3 to those of the body: everywhere, away from meeting parts in total and by region, within 10 mm
/// and 2 mm of the rims of the tears, and where confidence is below one half.
std::map<std::string, Angles> measure(const ElementGraph& graph, const Frames& f) {
  static const geometry::DissectionModel model(shape());
  std::map<std::string, Angles> angles;
  for (const char* name : {"all", "low confidence", "clear", "near tears", "rims"}) angles[name];
  for (const auto& region : graph.mesh().regions)
    if (region.kind == mesh::RegionKind::wall) angles[region.name];
  for (std::int32_t e = 0; e < graph.owned(); ++e) {
    const auto x = distributed::centroid(graph.mesh(), graph.nodes(e));
    const auto exact = model.axes(x);
    const std::array<double, 3> off = {angle_between(f.e1[e], cross(exact.longitudinal, exact.normal)),
                                       angle_between(f.e2[e], exact.longitudinal),
                                       angle_between(f.e3[e], exact.normal)};
    angles["all"].add(off);
    if (f.confidence[e] < 0.5) angles["low confidence"].add(off);
    if (exact.clear < clear) continue;
    angles["clear"].add(off);
    const std::string& region = graph.mesh().regions[graph.region(e)].name;
    angles[region].add(off);
    const double rim = std::abs(model.at(x).tear);
    if (region == "flap" && rim < 10 * mm) angles["near tears"].add(off);
    if (region == "flap" && rim < 2 * mm) angles["rims"].add(off);
  }
  for (auto& [name, a] : angles) {
    a.sum_over_ranks();
    if (parallel::rank(MPI_COMM_WORLD) == 0)
      std::printf("  %-18s %8.0f elements, mean %5.2f %5.2f %5.2f degrees, above 30: %6.3f %6.3f %6.3f %%\n",
                  name.c_str(), a.elements(), a.mean(0), a.mean(1), a.mean(2), a.share_above_30(0), a.share_above_30(1),
                  a.share_above_30(2));
  }
  return angles;
}

std::map<std::string, Angles> measure(const ElementGraph& graph, const FrameSettings& settings, const char* name) {
  if (parallel::rank(MPI_COMM_WORLD) == 0) std::printf("%s:\n", name);
  return measure(graph, make_frames(graph, faces_of(graph.mesh()), settings));
}

/// Distances to the tears that are found from the mesh against those of the model, in the flap.
void expect_tears_found(const ElementGraph& graph) {
  const geometry::DissectionModel model(shape());
  const auto points = tear_points(graph.mesh(), {{"true_lumen_wall"}, {"false_lumen_wall"}});
  // Near tears only: the points lie across them, not far along the vessel.
  for (const auto& p : points) EXPECT_LT(model.at(p).tear, 1 * mm) << p[0] << " " << p[1] << " " << p[2];
  const auto found = distances(graph, points);
  double count = 0, sum = 0;
  for (std::int32_t e = 0; e < graph.owned(); ++e) {
    const auto v = model.at(distributed::centroid(graph.mesh(), graph.nodes(e)));
    if (graph.mesh().regions[graph.region(e)].name != "flap" || v.tear > 10 * mm) continue;
    ++count;
    sum += std::abs(found[e] - std::max(0.0, v.tear));
  }
  const double mean = parallel::global_sum(MPI_COMM_WORLD, sum) / parallel::global_sum(MPI_COMM_WORLD, count);
  if (parallel::rank(MPI_COMM_WORLD) == 0)
    std::printf("distance to the tears, flap within 10 mm: mean deviation %.2f mm\n", mean / mm);
  EXPECT_LT(mean, 2 * mm);
}

void expect_frames(const case_file::Size& size) {
  const auto mesh = distributed::distribute(make_data(size), MPI_COMM_WORLD);
  const ElementGraph graph(mesh);
  if (parallel::rank(MPI_COMM_WORLD) == 0)
    std::printf("edge %.2f mm, %lld tetrahedra\n", case_file::edge_length(size) / mm,
                static_cast<long long>(mesh.global_elements));
  const auto joined = measure(graph, {FilteredDyads{}, Domain::lumen_and_wall}, "filtered, lumen and wall"),
             alone = measure(graph, {FilteredDyads{}, Domain::wall}, "filtered, wall alone"),
             report = measure(graph, {ConditionalMean{}, Domain::wall}, "conditional, wall alone");
  for (const char* place : {"near tears", "rims"}) {
    const double before = report.at(place).share_above_30(1), after = joined.at(place).share_above_30(1);
    EXPECT_GT(before, 5) << place;
    EXPECT_GT(alone.at(place).share_above_30(1), 5) << place;
    EXPECT_LE(10 * after, before) << place;
    EXPECT_LE(10 * after, alone.at(place).share_above_30(1)) << place;
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LT(joined.at("clear").mean(axis), 3) << axis;
    EXPECT_LT(joined.at("clear").share_above_30(axis), 0.2) << axis;
    EXPECT_LT(joined.at("rims").mean(axis), 5) << axis;
    EXPECT_GT(joined.at("low confidence").share_above_30(axis), 5 * joined.at("all").share_above_30(axis)) << axis;
  }
  expect_tears_found(graph);
}

TEST(DissectionFrames, Coarse) { expect_frames(7 * mm); }
TEST(DissectionFrames, Medium) { expect_frames(3.2 * mm); }

}  // namespace
}  // namespace tunica::frames
