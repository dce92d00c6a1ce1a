#include "tunica/stages/meshing/preview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/drawing/canvas.hpp"
#include "tunica/drawing/page.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/geometry/openings.hpp"
#include "tunica/meshing/geometry.hpp"

namespace tunica::stages {

namespace {

using geometry::Point;

constexpr drawing::Colour of_true{208, 86, 74}, of_false{66, 120, 184}, unlabelled{200, 120, 110},
    end_colour{60, 60, 60}, tear_colour{250, 200, 40}, outer_colour{222, 190, 150};
constexpr int width = 480, height = 800;

/// What is drawn and told.
struct Scene {
  geometry::TriangleSurface lumen;
  std::vector<std::uint8_t> of_false_lumen;  ///< empty: not known
  std::vector<geometry::Opening> openings;
  std::vector<imaging::Contact> tears;
  std::optional<geometry::TriangleSurface> outer;
  std::int64_t genus = 0;
};

bool is_false(const Scene& scene, const geometry::Triangle& t) {
  return !scene.of_false_lumen.empty() &&
         scene.of_false_lumen[t[0]] + scene.of_false_lumen[t[1]] + scene.of_false_lumen[t[2]] >= 2;
}

std::array<Point, 3> corners(const geometry::TriangleSurface& surface, const geometry::Triangle& t) {
  return {surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]};
}

void add_ends(const Scene& scene, drawing::Canvas& canvas) {
  for (const auto& opening : scene.openings)
    for (std::size_t i = 0; i < opening.lumen.size(); ++i)
      canvas.add({opening.centre, scene.lumen.points[opening.lumen[i]],
                  scene.lumen.points[opening.lumen[(i + 1) % opening.lumen.size()]]},
                 end_colour, {}, false);
}

/// An octahedron about the middle of each tear, half as wide as the tear.
void add_tears(const Scene& scene, drawing::Canvas& canvas) {
  for (const auto& tear : scene.tears) {
    const double r = 0.5 * std::sqrt(tear.area / M_PI);
    for (const double x : {-r, r})
      for (const double y : {-r, r})
        for (const double z : {-r, r})
          canvas.add({tear.centre + Point{{x, 0, 0}}, tear.centre + Point{{0, y, 0}}, tear.centre + Point{{0, 0, z}}},
                     tear_colour);
  }
}

enum class Shown { both, true_only };

drawing::Canvas drawn(const Scene& scene, bool from_behind, Shown side) {
  auto camera = drawing::look_at_all(scene.lumen.points, static_cast<double>(width) / height);
  if (from_behind) camera.towards = -1.0 * camera.towards;
  drawing::Canvas canvas(width, height, camera);
  for (const auto& t : scene.lumen.triangles) {
    const bool in_false = is_false(scene, t);
    if (side == Shown::true_only && in_false) continue;
    canvas.add(corners(scene.lumen, t), scene.of_false_lumen.empty() ? unlabelled : in_false ? of_false : of_true);
  }
  add_ends(scene, canvas);
  if (side == Shown::true_only) add_tears(scene, canvas);
  return canvas;
}

drawing::Canvas outer_drawn(const Scene& scene) {
  drawing::Canvas canvas(width, height, drawing::look_at_all(scene.lumen.points, static_cast<double>(width) / height));
  for (const auto& t : scene.outer->triangles) canvas.add(corners(*scene.outer, t), outer_colour);
  return canvas;
}

std::string place(const Point& p) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f})", 1e3 * p[0], 1e3 * p[1], 1e3 * p[2]);
}

std::vector<std::vector<std::string>> rows_of_openings(const Scene& scene) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& o : scene.openings)
    rows.push_back({o.name, place(o.centre),
                    fmt::format("({:.3f}, {:.3f}, {:.3f})", o.normal[0], o.normal[1], o.normal[2]),
                    fmt::format("{:.1f}", 1e6 * o.area), fmt::format("{:.1f}", 2e3 * std::sqrt(o.area / M_PI))});
  return rows;
}

std::string text_of(const Scene& scene) {
  std::string text =
      fmt::format("{:<28}{:>26}{:>26}{:>12}{:>14}\n", "opening", "centre mm", "normal", "area mm^2", "diameter mm");
  for (const auto& row : rows_of_openings(scene))
    text += fmt::format("{:<28}{:>26}{:>26}{:>12}{:>14}\n", row[0], row[1], row[2], row[3], row[4]);
  for (const auto& tear : scene.tears)
    text += fmt::format("tear of {:.0f} mm^2 at {} mm\n", 1e6 * tear.area, place(tear.centre));
  return text + fmt::format("lumen: {} triangles, genus {}\n", scene.lumen.triangles.size(), scene.genus);
}

std::string page_of(const Scene& scene, const std::string& title, const std::vector<std::uint8_t>& front) {
  namespace page = drawing::page;
  const bool labelled = !scene.of_false_lumen.empty();
  std::string html =
      page::begin(title.empty() ? "Preview of a mesh" : title) +
      page::picture(page::data_url(front), labelled ? "Lumen: true red, false blue, ends dark" : "Lumen, ends dark") +
      page::picture(page::data_url(drawn(scene, true, Shown::both).png()), "From behind");
  if (!scene.tears.empty())
    html += page::picture(page::data_url(drawn(scene, false, Shown::true_only).png()),
                          "What faces the true lumen alone; tears yellow");
  if (scene.outer)
    html += page::picture(page::data_url(outer_drawn(scene).png()), "Outside of the wall, as it is given");
  html += "<h2>Openings</h2>\n" + page::table({"name", "centre [mm]", "normal", "area [mm²]", "diameter [mm]"}, [&] {
            auto rows = rows_of_openings(scene);
            for (auto& row : rows) row[0] = page::escaped(row[0]);
            return rows;
          }());
  if (!scene.tears.empty()) {
    std::vector<std::vector<std::string>> rows;
    for (const auto& tear : scene.tears)
      rows.push_back({std::to_string(rows.size() + 1), place(tear.centre), fmt::format("{:.1f}", 1e6 * tear.area)});
    html += "<h2>Tears</h2>\n" + page::table({"tear", "centre [mm]", "contact of the labels [mm²]"}, rows);
  }
  return html + fmt::format("<p>Genus {}: {} tear(s) where the lumens are one.</p>\n", scene.genus, scene.genus + 1) +
         page::end();
}

Scene scene_of(meshing::GeometrySurfaces made) {
  Scene scene;
  scene.openings = geometry::find_openings(made.surfaces.lumen, nullptr, made.surfaces.names);
  scene.genus = geometry::genus(made.surfaces.lumen, std::ssize(scene.openings), made.lumen_parts);
  scene.of_false_lumen = std::move(made.labelled.of_false_lumen);
  scene.tears = std::move(made.labelled.tears);
  scene.lumen = std::move(made.surfaces.lumen);
  scene.outer = std::move(made.surfaces.outer);
  return scene;
}

}  // namespace

Preview preview(const case_file::MeshCase& mesh_case, const files::Say& say) {
  files::Phases phases(say);
  phases.begin("surfaces");
  meshing::ComplexOptions options;
  options.sizes = case_file::size_settings(mesh_case.size);
  options.log = [&](const std::string& line) { phases.tell(line); };
  options.spots = mesh_case.output / "problems.vtp";
  const auto scene = scene_of(meshing::surfaces_of(*mesh_case.geometry, options, false));
  phases.begin("pictures");
  auto picture = drawn(scene, false, Shown::both).png();
  auto page = page_of(scene, mesh_case.title, picture);
  phases.end();
  return {text_of(scene), std::move(page), std::move(picture)};
}

std::string preview_to_files(const case_file::MeshCase& mesh_case, const files::Say& say) {
  const auto& folder = mesh_case.output;
  files::make_folder(folder);
  files::try_outputs(folder, {"preview.html", "preview.png"});
  const auto made = preview(mesh_case, say);
  files::write_atomically(folder / "preview.png",
                          {reinterpret_cast<const char*>(made.picture.data()), made.picture.size()});
  files::write_atomically(folder / "preview.html", made.page);
  return made.text;
}

}  // namespace tunica::stages
