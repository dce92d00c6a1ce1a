// tunica picture: a PNG of results, or a movie of them.
#include "tunica/drawing/picture.hpp"

#include <cstdio>
#include <memory>

#include "commands.hpp"

namespace tunica::app {
namespace {

/// What CLI11 fills, before it becomes PictureOptions.
struct Arguments {
  drawing::PictureOptions options;
  double time = 0.0;
  int component = 0;
  std::array<double, 2> limits{};
  std::array<int, 2> size{0, 0};
  std::array<double, 6> clip{};
  std::array<double, 4> focus{};
  std::array<double, 3> view{-1.0, -1.5, 0.8}, up{0.0, 0.0, 1.0};
};

Vec3<double> vector(const double* x) { return {{x[0], x[1], x[2]}}; }

void picture(const CLI::App& command, const Arguments& arguments) {
  drawing::PictureOptions options = arguments.options;
  if (command.count("--time")) options.time = arguments.time;
  if (command.count("--component")) options.component = arguments.component;
  if (command.count("--range")) options.limits = arguments.limits;
  if (command.count("--clip"))
    options.clip = drawing::ClipPlane{vector(arguments.clip.data()), vector(arguments.clip.data() + 3)};
  if (command.count("--focus")) options.focus = drawing::Focus{vector(arguments.focus.data()), arguments.focus[3]};
  options.view = vector(arguments.view.data());
  options.up = vector(arguments.up.data());
  options.width = arguments.size[0];
  options.height = arguments.size[1];
  const auto summary = drawing::render(options);
  std::printf("%s: ", options.output.c_str());
  if (options.movie) std::printf("%zu steps, ", summary.frames);
  if (summary.time && !options.movie) std::printf("t = %g s, ", *summary.time);
  const std::string& array = options.array.empty() ? options.streamlines : options.array;
  if (array.empty()) {
    std::printf("no colours\n");
  } else {
    std::printf("%s from %g to %g\n", array.c_str(), summary.limits[0], summary.limits[1]);
  }
}

}  // namespace

void add_picture(CLI::App& app) {
  CLI::App* command = app.add_subcommand("picture", "Draw results or meshes as a PNG or a movie, without a screen");
  command->footer(
      "Needs an X display, which xvfb-run provides. Example:\n"
      "  xvfb-run -a tunica picture results/lumen.hdf.series --array pressure --clip 0 0 0 0 -1 0 -o pressure.png\n"
      "  xvfb-run -a tunica picture results/lumen.hdf.series --streamlines velocity --movie -o flow.webm");
  const auto a = std::make_shared<Arguments>();
  auto& o = a->options;
  command
      ->add_option("files", o.inputs,
                   "Time series (.hdf.series, .pvd) or meshes (.hdf, .vtu, .pvtu, .vtp, .pvtp), drawn together")
      ->required();
  command
      ->add_option("-o,--output", o.output,
                   "The picture, ending in .png; a movie: .webm, .gif, or .png for single ones")
      ->required()
      ->check(some_name());
  command->add_flag("--movie", o.movie, "All steps of a series, with the same colours; .webm and .gif need ffmpeg");
  command->add_option("--frame-rate", o.frame_rate, "Steps of a movie in a second; default: 10");
  command->add_option("--time", a->time, "Step of a series nearest to this time; default: the last");
  command->add_option("--array", o.array, "Point or cell array to colour by; default: none");
  command->add_option("--component", a->component, "Of a vector array, 0 1 2; default: the magnitude");
  command->add_option("--scale", o.scale, "Factor on the values, for another unit");
  command->add_option("--label", o.label, "Of the colour bar; default: the name of the array");
  command->add_option("--range", a->limits, "Lowest and highest value of the colour bar; default: those in sight");
  command
      ->add_option("--percentile", o.percentile,
                   "The colour bar ends where so many per cent of the values in sight lie below; default: 100")
      ->check(CLI::Range(1.0, 100.0));
  command->add_option("--title", o.title, "Text above the picture");
  command->add_option("--clip", a->clip, "Cut away one side of a plane: point x y z, direction of that side x y z");
  command->add_option("--warp", o.warp, "Vector array by which points are moved");
  command->add_option("--warp-factor", o.warp_factor, "Factor on that vector");
  command->add_option("--lines", o.lines, "Cell vector array along which short lines are drawn");
  command->add_option("--line-length", o.line_length,
                      "Of these, in the unit of the files; default: a hundredth of the view");
  command->add_option("--streamlines", o.streamlines, "Point vector array that lines follow; they bear the colours");
  command->add_option("--seeds", o.seeds, "Points that these lines go through; default: 300");
  command->add_option("--focus", a->focus, "Show only the surroundings of a point: x y z, radius");
  command->add_option("--view", a->view, "Direction from the scene to the camera, x y z");
  command->add_option("--up", a->up, "Direction that points up in the picture, x y z");
  command->add_option("--size", a->size, "Width and height in pixels; default: as the scene is, at most 1000 high");
  command->add_flag("--edges", o.edges, "Draw the edges of the elements");
  command->callback([command, a] { picture(*command, *a); });
}

}  // namespace tunica::app
