// Pictures of the fields, where there is a display to draw on.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "tunica/base/error.hpp"
#include "tunica/drawing/page.hpp"
#include "tunica/drawing/picture.hpp"
#include "tunica/stages/report/parts.hpp"
#include "tunica/stages/vessel_plane.hpp"

namespace tunica::stages::report {

namespace {

namespace fs = std::filesystem;

Vec3<double> vector_of(const json& list) {
  return {{list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()}};
}

/// The few extreme values at edges would make one colour of all the others.
constexpr double shown = 99;

/// What is drawn of a case, in the unit of its files.
struct Scene {
  std::vector<std::string> lumen, wall;  ///< series of fields
  std::optional<double> peak;            ///< s
  std::string shear;                     ///< wall_shear.vtp
  std::optional<drawing::ClipPlane> plane;
  std::vector<std::pair<std::string, drawing::ClipPlane>> cuts;  ///< across the vessel, at places of interest
};

/// `per_mm`: units of the fields in a millimetre.
void add_cuts(const json& post, double per_mm, Scene& scene) {
  if (post.is_null() || !post.contains("stations")) return;
  std::vector<Vec3<double>> centres;
  for (const auto& station : post["stations"]) centres.push_back(per_mm * vector_of(station.at("centre_mm")));
  if (const auto plane = plane_of(centres)) scene.plane = drawing::ClipPlane{plane->centre, plane->normal};
  if (!post.contains("tears") || centres.size() < 2) return;
  for (const auto& tear : largest_tears(post["tears"])) {
    const auto place = per_mm * vector_of(tear.at("centre_mm"));
    const auto nearest =
        std::min_element(centres.begin(), centres.end(),
                         [&](const auto& a, const auto& b) { return norm(a - place) < norm(b - place); }) -
        centres.begin();
    scene.cuts.emplace_back(tear.value("name", "tear"),
                            drawing::ClipPlane{place, direction_at(centres, static_cast<std::size_t>(nearest))});
  }
}

Scene scene_of(const Results& r) {
  Scene scene;
  if (r.manifest.is_object())
    for (const auto& region : r.manifest["mesh"]["regions"]) {
      const std::string name = region.at("name");
      const fs::path series = r.folder("run") / (name + ".hdf.series");
      if (fs::exists(series)) (name == "lumen" ? scene.lumen : scene.wall).push_back(series.string());
    }
  if (r.post.is_object() && r.post.contains("peak_s")) scene.peak = r.post["peak_s"].get<double>();
  if (const auto shear = r.folder("post") / "wall_shear.vtp"; !r.folder("post").empty() && fs::exists(shear))
    scene.shear = shear.string();
  add_cuts(r.post, 1e-3 / r.report.metres_per_unit, scene);
  return scene;
}

/// Draws one picture after the other into the page.
class Album {
 public:
  Album(const fs::path& folder, const files::Say& say) : file_((folder / "picture.png").string()), say_(say) {}
  ~Album() {
    std::error_code ignored;
    fs::remove(file_, ignored);
  }

  /// A picture that cannot be drawn, as one of an array that the results do not hold, is named with the reason.
  void add(drawing::PictureOptions options, const std::string& caption) {
    options.output = file_;
    say_("picture: " + caption);
    try {
      drawing::render(options);
    } catch (const InputError& error) {
      text += missing(caption, error.what());
      return;
    }
    std::ifstream stream(file_, std::ios::binary);
    text += drawing::page::picture(drawing::page::data_url({std::istreambuf_iterator<char>(stream), {}}), caption);
  }
  std::string text;

 private:
  std::string file_;
  files::Say say_;
};

std::string when_of(const Scene& scene) { return scene.peak ? "at peak pressure" : "at the end"; }

void draw_fields(const Scene& scene, Album& album) {
  const auto of = [&](const std::vector<std::string>& inputs, const std::string& array) {
    drawing::PictureOptions options;
    options.inputs = inputs;
    options.array = array;
    options.time = scene.peak;
    options.percentile = shown;
    if (scene.plane) options.view = scene.plane->normal;
    return options;
  };
  const std::string when = when_of(scene);
  if (!scene.lumen.empty()) {
    album.add(of(scene.lumen, "pressure"), "Pressure of the blood " + when);
    auto lines = of(scene.lumen, "");
    lines.streamlines = "velocity";
    album.add(lines, "Streamlines of the blood, by their speed, " + when);
    if (scene.plane) {
      auto cut = of(scene.lumen, "velocity");
      cut.clip = scene.plane;
      cut.percentile = 100;  // it has no peaks at edges
      album.add(cut, "Velocity in a plane along the aorta, " + when);
    }
  }
  if (!scene.wall.empty()) {
    album.add(of(scene.wall, "displacement"), "Displacement of the wall " + when);
    album.add(of(scene.wall, "von Mises stress"), "Stress in the wall " + when);
    if (scene.plane) {
      auto cut = of(scene.wall, "von Mises stress");
      cut.clip = scene.plane;
      album.add(cut, "Stress in wall and flap, cut along the aorta");
    }
  }
}

void draw_cuts(const Scene& scene, double metres_per_unit, Album& album) {
  struct Cut {
    const std::vector<std::string>& inputs;
    const char *array, *title;
    double percentile;
  };
  for (const auto& [name, plane] : scene.cuts)
    for (const auto& [inputs, array, title, percentile] :
         {Cut{scene.lumen, "velocity", "Velocity", 100}, Cut{scene.wall, "von Mises stress", "Stress", shown}}) {
      if (inputs.empty()) continue;
      drawing::PictureOptions options;
      options.inputs = inputs;
      options.array = array;
      options.time = scene.peak;
      options.percentile = percentile;
      options.clip = plane;
      options.view = plane.normal;
      options.up = std::abs(normalised(plane.normal)[2]) > 0.8 ? Vec3<double>{{0, 1, 0}} : Vec3<double>{{0, 0, 1}};
      options.focus = drawing::Focus{plane.origin, 0.03 / metres_per_unit};
      album.add(options, fmt::format("{} across the vessel at {}, {}", title, readable(name), when_of(scene)));
    }
}

}  // namespace

std::string pictures_part(const Results& r, const files::Say& say) {
  std::string text = "<h2 id=\"pictures\">Pictures</h2>\n";
  if (!r.report.settings.pictures) return text + missing("Pictures", "not wanted (`pictures: false`)");
  const Scene scene = scene_of(r);
  if (const json shear = r.post.is_object() ? r.post.value("wall_shear", json()) : json(); !mark(shear).empty())
    text += missing("Pictures of the flow" + mark(shear), "the warning at the figures of the cycle holds for them");
  if (scene.lumen.empty() && scene.wall.empty()) return text + missing("Pictures", "there are no fields of a run");
  if (const auto tears = r.post.is_object() ? r.post.value("tears", json::array()) : json::array();
      tears.size() > scene.cuts.size())
    text += missing("Sections at the smaller tears",
                    fmt::format("of {} tears the {} largest are drawn", tears.size(), scene.cuts.size()));
  std::error_code ignored;
  fs::create_directories(r.report.output, ignored);
  Album album(r.report.output, say);
  try {
    draw_fields(scene, album);
    draw_cuts(scene, r.report.metres_per_unit, album);
    for (const char* array : {"TAWSS", "OSI"}) {
      if (scene.shear.empty()) break;
      drawing::PictureOptions options;
      options.inputs = {scene.shear};
      options.array = array;
      options.percentile = shown;
      if (scene.plane) options.view = scene.plane->normal;
      album.add(options, fmt::format("{} on the wall of the lumen", array));
    }
  } catch (const SolverError& error) {  // no display
    say(fmt::format("warning: no pictures in the report: {}", error.what()));
    return text + album.text + missing("Pictures", error.what());
  }
  return text + album.text;
}

}  // namespace tunica::stages::report
