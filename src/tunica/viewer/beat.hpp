// What a page shows in 3D: surfaces and cuts with their quantities over a beat, as plain values.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tunica/base/tensor.hpp"

namespace tunica::viewer {

/// Values at consecutive points of a body, such as those where blood and wall meet.
struct Quantity {
  std::string name, unit;
  std::string of;                          ///< "wall", "blood", or "inside" for the blood at the wall
  int components = 1;                      ///< 1, or 3: shown by its magnitude
  std::size_t first = 0, count = 0;        ///< points of the body that have it
  std::vector<std::vector<float>> frames;  ///< [time][point][component] in `unit`; a single one does not change
};

/// Triangles that are shown or hidden together.
struct Group {
  std::string kind;                  ///< "outer", "inner", "end", "opening", "section" (of the blood) or "wall section"
  std::string name;                  ///< of the region, the face or the section
  std::size_t first = 0, count = 0;  ///< triangles of the body
};

/// A triangle of the mesh in whose place four parts stand.
struct Joined {
  std::array<std::uint32_t, 3> corners;
  std::array<std::uint32_t, 3> between;  ///< points on the edges, each after its corner
};

struct Body {
  std::string name;                                     ///< "surface" or "sections"
  std::vector<Vec3<double>> points;                     ///< reference [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< seen from outside counter-clockwise
  std::vector<Group> groups;                            ///< cover all triangles, in order
  /// Where four triangles stand in place of each of the mesh: those of the mesh, in the order of the groups.
  std::vector<Joined> joined{};
  std::vector<Quantity> quantities;  ///< of one name "displacement" [mm] for all points: motion
};

/// Short lines on the surface, such as directions of fibres. They move with the point that is nearest to them.
struct Lines {
  std::string name;                              ///< those of one name are shown or hidden together
  std::string kind, region;                      ///< of the group that they lie on
  double length = 0;                             ///< [m]
  std::vector<Vec3<double>> places, directions;  ///< middles, reference [m]; unit vectors
};

/// A name at a place.
struct Label {
  std::string text, kind;  ///< "opening", "tear" or "lumen"
  Vec3<double> place;      ///< reference [m]
};

/// A plane of interest; a group of kind "section" of the same name fills it.
struct Section {
  std::string name;
  Vec3<double> centre, normal;  ///< [m], unit; what lies on the side of the normal is cut away
};

struct Curve {
  std::string name;
  std::vector<double> x, y;
  int style = 0;          ///< number of its colour and line, the same for the same thing in all plots
  std::string role = "";  ///< "measured", "target" or empty: computed
};

/// Curves over time or along the aorta.
struct Plot {
  std::string title, x_label, y_label;
  bool in_time = false;  ///< x is the time of the fields [s]: a line marks the instant that is shown
  std::vector<Curve> curves;
};

struct Beat {
  std::string title;
  std::vector<double> times;  ///< of the frames [s]
  std::size_t start = 0;      ///< frame that is shown first
  std::vector<Body> bodies;
  std::vector<Lines> lines;  ///< on the first body
  std::vector<Label> labels;
  std::vector<Section> sections;
  Vec3<double> view{{0, -1, 0}}, up{{0, 0, 1}};  ///< direction towards the camera, and up;
  std::vector<std::string> remarks;              ///< what is not shown, and why
};

}  // namespace tunica::viewer
