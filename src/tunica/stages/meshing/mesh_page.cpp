#include "tunica/stages/meshing/mesh_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tunica/drawing/canvas.hpp"
#include "tunica/drawing/page.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/meshing/element_cut.hpp"

namespace tunica::stages {

namespace {

constexpr drawing::Colour true_lumen{246, 200, 196}, false_lumen{196, 214, 240};
/// In the order of `WallRegion`.
constexpr std::array<drawing::Colour, meshing::wall_region_names.size()> region_colours = {
    {{192, 57, 43}, {41, 98, 155}, {46, 160, 67}, {222, 165, 50}, {122, 79, 58}}};

std::string hex(const drawing::Colour& c) { return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]); }

std::string figure(const drawing::Canvas& canvas, const std::string& caption) {
  return drawing::page::picture(drawing::page::data_url(canvas.png()), caption);
}

std::string legend(const std::vector<std::pair<std::string, drawing::Colour>>& entries) {
  std::string text = "<p class=\"legend\">";
  for (const auto& [name, colour] : entries)
    text += fmt::format("<span><i style=\"background:{}\"></i>{}</span> ", hex(colour), name);
  return text + "</p>\n";
}

std::array<geometry::Point, 3> corners_of(const geometry::Tetrahedra& mesh,
                                          const std::array<geometry::Index, 3>& nodes) {
  return {mesh.points[nodes[0]], mesh.points[nodes[1]], mesh.points[nodes[2]]};
}

class Pictures {
 public:
  explicit Pictures(const MeshPageInput& input) : in_(input), triangles_(geometry::surface_triangles(input.mesh)) {}

  /// The wall from outside, or what lies around the lumen, each triangle in the colour of its wall element's region.
  drawing::Canvas regions(bool from_outside, bool from_behind) const {
    drawing::Canvas canvas(width, height, all(from_behind));
    for (const auto& t : triangles_) {
      const bool outer = t.label == geometry::wall_label, interface = t.neighbour_label == geometry::wall_label;
      if (from_outside ? !outer : !interface) continue;
      const auto region = in_.regions.of_element[outer ? t.element : t.neighbour];
      canvas.add(corners_of(in_.mesh, t.nodes), region_colours[static_cast<std::size_t>(region)]);
    }
    return canvas;
  }

  drawing::Canvas thickness(double thinnest, double thickest) const {
    drawing::Canvas canvas(width, height, all(false));
    const auto& surface = in_.prepared.lumen.surface();
    for (const auto& t : surface.triangles) {
      const double value = (in_.prepared.thickness.value[t[0]] + in_.prepared.thickness.value[t[1]] +
                            in_.prepared.thickness.value[t[2]]) /
                           3;
      const drawing::Colour colour = std::isfinite(value)
                                         ? drawing::scale_colour((value - thinnest) / (thickest - thinnest))
                                         : drawing::Colour{200, 200, 200};
      canvas.add({surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]}, colour);
    }
    return canvas;
  }

  /// The elements cut by a plane, within `reach` of its centre.
  drawing::Canvas cut(const geometry::Point& centre, const Vec3<double>& normal, const Vec3<double>& up,
                      double reach) const {
    drawing::Canvas canvas(side, side, {centre, normal, up, 2 * reach});
    const auto& mesh = in_.mesh;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      std::array<geometry::Point, 4> x;
      std::array<double, 4> heights;
      for (int k = 0; k < 4; ++k) {
        x[k] = mesh.points[mesh.elements[e][k]];
        heights[k] = dot(x[k] - centre, normal);
      }
      if (norm(x[0] - centre) > 1.6 * reach) continue;
      const auto polygon = meshing::zero_polygon(x, heights);
      for (std::size_t k = 2; k < polygon.size(); ++k)
        canvas.add({polygon[0], polygon[k - 1], polygon[k]}, colour_of(e), {k == 2, true, k + 1 == polygon.size()},
                   false);
    }
    return canvas;
  }

  /// Direction in which the part of the flap near a place is longest: the axis of the vessel there.
  Vec3<double> axis_near(const geometry::Point& place, double reach) const {
    // The vessel is longer than wide, so power iteration on the moments of the wall within a ball finds it.
    Mat3<double> moments{};
    for (std::size_t e = 0; e < in_.mesh.elements.size(); ++e) {
      if (in_.mesh.labels[e] != geometry::wall_label || in_.regions.of_element[e] != meshing::WallRegion::flap)
        continue;
      const auto d = in_.mesh.points[in_.mesh.elements[e][0]] - place;
      if (norm(d) > reach) continue;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) moments(i, j) += d[i] * d[j];
    }
    Vec3<double> axis{{0.3, 0.4, 0.87}};
    for (int k = 0; k < 100; ++k) {
      const auto next = moments * axis;
      if (norm(next) == 0) break;
      axis = (1 / norm(next)) * next;
    }
    return axis;
  }

 private:
  static constexpr int width = 360, height = 640, side = 560;

  drawing::Camera all(bool from_behind) const {
    const auto& surface = in_.prepared.outer ? *in_.prepared.outer : in_.prepared.lumen;
    auto camera = drawing::look_at_all(surface.surface().points, static_cast<double>(width) / height);
    if (from_behind) camera.towards = -1.0 * camera.towards;
    return camera;
  }
  drawing::Colour colour_of(std::size_t e) const {
    if (in_.mesh.labels[e] == geometry::wall_label)
      return region_colours[static_cast<std::size_t>(in_.regions.of_element[e])];
    double sum = 0;
    for (const auto n : in_.mesh.elements[e]) sum += in_.regions.side[n];
    return sum > 0 ? true_lumen : false_lumen;
  }

  const MeshPageInput& in_;
  std::vector<geometry::LabelledTriangle> triangles_;
};

/// The flap element nearest to the middle of the flap; none when there is no flap.
std::vector<geometry::Point> middle_of_flap(const MeshPageInput& in) {
  std::vector<geometry::Point> flap;
  geometry::Point middle{{0, 0, 0}};
  for (std::size_t e = 0; e < in.mesh.elements.size(); ++e)
    if (in.mesh.labels[e] == geometry::wall_label && in.regions.of_element[e] == meshing::WallRegion::flap) {
      flap.push_back(in.mesh.points[in.mesh.elements[e][0]]);
      middle = middle + flap.back();
    }
  if (flap.empty()) return {};
  middle = (1.0 / static_cast<double>(flap.size())) * middle;
  return {*std::min_element(flap.begin(), flap.end(), [&](const geometry::Point& a, const geometry::Point& b) {
    return norm(a - middle) < norm(b - middle);
  })};
}

/// Any direction across the axis will do as up, but one that does not jump.
Vec3<double> across(const Vec3<double>& axis) {
  const Vec3<double> other = std::abs(axis[1]) < 0.8 ? Vec3<double>{{0, 1, 0}} : Vec3<double>{{1, 0, 0}};
  return cross(cross(axis, other), axis);
}

std::string pictures(const MeshPageInput& in) {
  const Pictures draw(in);
  std::vector<std::pair<std::string, drawing::Colour>> colours;
  for (std::size_t r = 0; r < meshing::wall_region_names.size(); ++r)
    colours.emplace_back(meshing::wall_region_names[r], region_colours[r]);
  std::string text = "<h2>Regions</h2>\n" + legend(colours) +
                     figure(draw.regions(true, false), "The wall from outside") +
                     figure(draw.regions(true, true), "From behind") +
                     figure(draw.regions(false, false), "The inside of the wall, seen through the outside");
  const auto& spread = in.report["thickness_mm"];
  double thinnest = 1e300, thickest = 0;
  for (const auto& [name, values] : spread.items()) {
    thinnest = std::min(thinnest, values["5_percent"].get<double>());
    thickest = std::max(thickest, values["95_percent"].get<double>());
  }
  if (thickest > thinnest)
    text +=
        figure(draw.thickness(1e-3 * thinnest, 1e-3 * thickest),
               fmt::format("Thickness of wall and flap, {:.1f} mm (dark) to {:.1f} mm (yellow)", thinnest, thickest));
  colours.emplace_back("true lumen", true_lumen);
  colours.emplace_back("false lumen", false_lumen);
  text += "<h2>Cuts</h2>\n" + legend(colours);
  constexpr double reach = 25e-3;
  for (const auto& place : middle_of_flap(in)) {
    const auto axis = draw.axis_near(place, reach);
    text += figure(draw.cut(place, axis, across(axis), reach), "Across the middle of the flap; 50 mm wide");
  }
  constexpr std::size_t most = 6;
  for (std::size_t t = 0; t < std::min(most, in.tears.size()); ++t) {
    const auto& tear = in.tears[t];
    const auto axis = draw.axis_near(tear.centre, reach);
    // Along the vessel and across the flap, so that both rims are seen.
    const auto normal = cross(axis, tear.normal);
    if (norm(normal) < 0.1) continue;
    text += figure(draw.cut(tear.centre, (1 / norm(normal)) * normal, axis, reach),
                   fmt::format("Along the vessel through tear {} ({:.0f} mm²); 50 mm wide", t + 1, 1e6 * tear.area));
  }
  return text;
}

std::string histogram(const nlohmann::json& counts, double bin, const std::string& title, const std::string& label) {
  drawing::Series bars{"", {}, {}};
  double at = 0;
  for (const auto& n : counts) {
    for (const double x : {at, at + bin}) {
      bars.x.push_back(x);
      bars.y.push_back(std::max(0.5, n.get<double>()));
    }
    at += bin;
  }
  return drawing::page::drawing(drawing::draw_plot(
      {bars}, {.title = title, .x_label = label, .y_label = "elements", .log_y = true, .width = 560}));
}

std::string number(const nlohmann::json& value, int digits) {
  return fmt::format("{:.{}f}", value.get<double>(), digits);
}

std::string tables(const nlohmann::json& r) {
  std::string text = "<h2>Regions in numbers</h2>\n<table>\n" +
                     drawing::page::row({"region", "elements", "volume [ml]", "smallest dihedral angle",
                                         "exceeded by 99.99 %", "mean edge [mm]"},
                                        "th");
  const auto line = [&](const std::string& name, const nlohmann::json& s, const std::string& volume) {
    text +=
        drawing::page::row({drawing::page::escaped(name), std::to_string(s["elements"].get<geometry::Index>()), volume,
                            number(s["smallest_dihedral_deg"], 1) + "°",
                            number(s["dihedral_of_worst_0.01_percent_deg"], 1) + "°", number(s["edge_mm"]["mean"], 2)});
  };
  for (const auto& region : r["regions"]) line(region["name"], region, number(region["volume_ml"], 2));
  line("all", r["shapes"], "");
  text += "</table>\n<h2>Faces</h2>\n<table>\n" + drawing::page::row({"face", "triangles", "area [mm²]"}, "th");
  for (const auto& face : r["faces"])
    text += drawing::page::row({drawing::page::escaped(face["name"].get<std::string>()),
                                std::to_string(face["triangles"].get<geometry::Index>()), number(face["area_mm2"], 1)});
  text +=
      "</table>\n<h2>Elements across</h2>\n<p>Size asked for: " + drawing::page::escaped(r["size"].get<std::string>()) +
      ".</p>\n";
  if (const auto thin = r["too_few_across"].get<std::string>(); !thin.empty())
    text += "<p><b>Warning:</b> " + drawing::page::escaped(thin) + "</p>\n";
  text += "<table>\n" +
          drawing::page::row({"part of the lumen", "least", "median", "diameter there [mm]", "place [mm]"}, "th");
  for (const auto& part : r["elements_across"])
    text += drawing::page::row({drawing::page::escaped(part["name"].get<std::string>()), number(part["least"], 1),
                                number(part["median"], 1), number(part["diameter_mm"], 1),
                                fmt::format("{:.1f}, {:.1f}, {:.1f}", part["place_mm"][0].get<double>(),
                                            part["place_mm"][1].get<double>(), part["place_mm"][2].get<double>())});
  text += "</table>\n<h2>Tears</h2>\n<table>\n" + drawing::page::row({"tear", "area [mm²]", "centre [mm]"}, "th");
  int count = 0;
  for (const auto& tear : r["tears"])
    text += drawing::page::row({std::to_string(++count), number(tear["area_mm2"], 1),
                                fmt::format("{:.1f}, {:.1f}, {:.1f}", tear["centre_mm"][0].get<double>(),
                                            tear["centre_mm"][1].get<double>(), tear["centre_mm"][2].get<double>())});
  text += "</table>\n<h2>Thickness</h2>\n<table>\n" +
          drawing::page::row({"of", "5 % [mm]", "median [mm]", "95 % [mm]"}, "th");
  for (const auto& [name, values] : r["thickness_mm"].items())
    text += drawing::page::row({drawing::page::escaped(name), number(values["5_percent"], 2),
                                number(values["median"], 2), number(values["95_percent"], 2)});
  return text + "</table>\n";
}

std::string summary(const nlohmann::json& r) {
  const auto& f = r["fidelity"];
  const auto& lumen = r["lumen_boundary"];
  return fmt::format(
      "<p>{} tetrahedra, {} points, {} nodes shared by lumen and wall. Smallest dihedral angle {}°.<br>\n"
      "Against the surfaces given: lumen volume {:+.2f} %, wall volume {:+.2f} %; the lumen surface is within {} mm or "
      "{} edge lengths, the outer one within {} mm or {}.<br>\n"
      "The lumen is {} piece(s) of genus {}: {} tear(s). The wall is one element thick at {} % of its surface "
      "nodes.<br>\nMade in {} s with {} MB.</p>\n",
      r["tetrahedra"].get<geometry::Index>(), r["points"].get<geometry::Index>(),
      r["interface_nodes"].get<geometry::Index>(), number(r["shapes"]["smallest_dihedral_deg"], 1),
      f["lumen_volume_percent"].get<double>(), f["wall_volume_percent"].get<double>(),
      number(f["lumen_distance_mm"], 2), number(f["lumen_distance_per_edge"], 2), number(f["outer_distance_mm"], 2),
      number(f["outer_distance_per_edge"], 2), lumen["parts"].get<geometry::Index>(),
      lumen["genus"].get<geometry::Index>(), r["tears"].size(), number(r["wall_one_element_thick_percent"], 1),
      number(r["seconds"]["total"], 0), number(r["peak_memory_MB"], 0));
}

}  // namespace

std::string mesh_page(const MeshPageInput& in) {
  const auto& shapes = in.report["shapes"];
  const std::string title = in.title.empty() ? "Mesh" : in.title;
  return drawing::page::begin(title) + summary(in.report) + pictures(in) + "<h2>Shapes</h2>\n" +
         histogram(shapes["dihedral_histogram_5_deg"], 5, "Smallest dihedral angle of each element",
                   "angle [degrees]") +
         histogram(shapes["radius_ratio_histogram_0.1"], 0.1, "Radius ratio of each element (1: regular)",
                   "3 inradius / circumradius") +
         tables(in.report) + drawing::page::end();
}

}  // namespace tunica::stages
