// Pictures of results, drawn without a window.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tunica/base/tensor.hpp"

namespace tunica::drawing {

/// Half space that is cut away: everything on the side that `normal` points to.
struct ClipPlane {
  Vec3<double> origin, normal;  ///< origin in the length unit of the files
};

/// What the picture shows instead of everything.
struct Focus {
  Vec3<double> centre;
  double radius;  ///< > 0; both in the length unit of the files
};

struct PictureOptions {
  std::vector<std::string> inputs;  ///< .hdf, .vtu, .pvtu, .vtp, .pvtp, .hdf.series, .pvd; all are drawn together
  std::string output;               ///< .png; of a movie also .webm or .gif, and .png means one file for each step
  bool movie = false;               ///< all steps of the series in place of one
  double frame_rate = 10;           ///< of a movie, steps in a second
  std::optional<double> time;       ///< of a series: the step nearest to this time is drawn; default: the last one

  std::string array;             ///< point or cell array to colour by, with or without its unit; empty: plain
  std::optional<int> component;  ///< of a vector array, from 0; default: the magnitude
  double scale = 1.0;            ///< factor on the values, for another unit
  std::string label;             ///< of the colour bar; default: name of the array with its unit
  std::optional<std::array<double, 2>> limits;  ///< of the colour bar, after scaling; default: the values in sight
  double percentile = 100;  ///< without limits: the colour bar ends where so many per cent of the values lie below
                            ///< (of signed values, where so many have a smaller size)

  std::string title;              ///< default: none. The time is added for a series
  std::optional<ClipPlane> clip;  ///< default: nothing is cut
  std::string warp;               ///< point vector array by which points are moved; empty: none
  double warp_factor = 1.0;

  std::string lines;             ///< cell vector array along which short lines are drawn; empty: none
  double line_length = 0;        ///< in the length unit of the files; 0: a hundredth of what is in sight
  std::string streamlines = {};  ///< point vector array that lines follow; they bear the colours, all else is a shell
  int seeds = 300;               ///< points spread over the volume through which these lines go
  std::optional<Focus> focus{};  ///< default: everything is in sight

  Vec3<double> view = {{-1.0, -1.5, 0.8}};  ///< from the scene towards the camera
  Vec3<double> up = {{0.0, 0.0, 1.0}};      ///< direction that points up in the picture
  int width = 0, height = 0;                ///< pixels, 64 to 16384; 0: as the scene is, 1000 high or less
  bool edges = false;                       ///< draw the edges of the elements
};

/// What was drawn, for a line in a log.
struct PictureSummary {
  std::optional<double> time;         ///< of the first series
  std::array<double, 2> limits = {};  ///< of the colour bar
  std::size_t frames = 1;             ///< of a movie
};

/// Colours: whole numbers of at most twelve values are categories with a key; values of both signs have a map about
/// zero; all others go from dark to light. The key has round numbers, and says what lies beyond its ends. Draws the
/// surfaces of `options.inputs` and writes the picture. Inputs that lack the array or the warp vector are drawn in
/// translucent grey and unmoved; it is an error if none has them. Needs an X display (xvfb-run provides one). Call on
/// one rank. Throws InputError for unreadable files, unknown arrays and impossible options, with the arrays that exist,
/// and SolverError if there is no display or, for a movie, no ffmpeg.
PictureSummary render(const PictureOptions& options);

}  // namespace tunica::drawing
