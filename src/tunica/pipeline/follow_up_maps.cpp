// Growth on the edge of the lumens, for ParaView.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "tunica/geometry/parametric_dissection.hpp"
#include "tunica/mesh_io/vtk_surface_writer.hpp"
#include "tunica/pipeline/follow_up_findings.hpp"

namespace tunica::pipeline {

namespace {

using geometry::degree, geometry::mm;
using mesh_io::PointArray;

/// The edge of a scan within a range of arc lengths, in mm, with the nodes of its points.
struct Edge {
  mesh_io::SurfaceWithArrays surface;
  std::vector<std::int64_t> nodes;
};

Edge edge_within(const ScanAnatomy& scan, const std::array<double, 2>& range) {
  Edge edge;
  std::map<std::int64_t, std::int64_t> number;
  for (const auto& t : scan.edge) {
    bool within = true;
    for (const auto node : t) {
      const double s = scan.anatomy.nodes[static_cast<std::size_t>(node)].s;
      within = within && s >= range[0] && s <= range[1];
    }
    if (!within) continue;
    auto& triangle = edge.surface.triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [at, fresh] = number.try_emplace(t[i], std::ssize(edge.nodes));
      if (fresh) {
        edge.nodes.push_back(t[i]);
        edge.surface.points.push_back((1 / mm) * scan.data.points[static_cast<std::size_t>(t[i])]);
      }
      triangle[i] = at->second;
    }
  }
  return edge;
}

template <class Value>
PointArray array(const std::string& name, const ScanAnatomy& scan, const Edge& edge, const Value& value) {
  PointArray result{.name = name};
  for (const auto node : edge.nodes) result.values.push_back(value(scan.anatomy.nodes[static_cast<std::size_t>(node)]));
  return result;
}

void write_growth(const FollowUpFindings& f) {
  const auto& first = *f.scans[0];
  Edge edge = edge_within(first, f.growth.range);
  auto& arrays = edge.surface.arrays;
  arrays.push_back(array("distance [mm]", first, edge, [](const auto& at) { return at.s / mm; }));
  arrays.push_back(array("angle [deg]", first, edge, [](const auto& at) { return at.angle / degree; }));
  const auto anatomies = f.anatomies();
  const auto add = [&](std::size_t from, std::size_t to, double years, const std::string& name) {
    const auto growth = [&, from, to](const analysis::LineCoordinates& at) {
      return analysis::radial_growth(f.growth, anatomies, from, to, at) / mm;
    };
    arrays.push_back(array(fmt::format("{} [mm]", name), first, edge, growth));
    arrays.push_back(array(fmt::format("{} [mm/year]", name), first, edge,
                           [&, years](const analysis::LineCoordinates& at) { return growth(at) / years; }));
  };
  for (const auto& i : f.intervals) add(i.from, i.to, i.years, i.name);
  if (f.intervals.size() > 1)
    add(0, f.scans.size() - 1, f.plan.scans.back().years,
        fmt::format("{} to {}", f.plan.scans.front().name, f.plan.scans.back().name));
  mesh_io::write_surface_with_arrays(edge.surface, f.plan.output / "growth.vtp");
}

void write_map(const FollowUpFindings& f, const Interval& i) {
  const auto& scan = *f.scans[i.from];
  const analysis::ScanMap map(scan.anatomy, f.scans[i.to]->anatomy);
  Edge edge = edge_within(scan, map.range());
  PointArray way{.name = "to the next scan [mm]", .components = 3};
  for (std::size_t k = 0; k < edge.nodes.size(); ++k) {
    const auto node = static_cast<std::size_t>(edge.nodes[k]);
    const auto d = (1 / mm) * (map.point(scan.anatomy.nodes[node]) - scan.data.points[node]);
    way.values.insert(way.values.end(), d.x, d.x + 3);
  }
  edge.surface.arrays.push_back(std::move(way));
  edge.surface.arrays.push_back(array("distance [mm]", scan, edge, [](const auto& at) { return at.s / mm; }));
  edge.surface.arrays.push_back(
      array("distance in the next scan [mm]", scan, edge, [&](const auto& at) { return map.arc(at.s) / mm; }));
  mesh_io::write_surface_with_arrays(
      edge.surface,
      f.plan.output / fmt::format("map_{}_to_{}.vtp", f.plan.scans[i.from].name, f.plan.scans[i.to].name));
}

}  // namespace

void write_growth_maps(const FollowUpFindings& f) {
  write_growth(f);
  for (const auto& i : f.intervals) write_map(f, i);
}

}  // namespace tunica::pipeline
