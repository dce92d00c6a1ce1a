// The shape of a dissected aorta on one date: its line, sections across it with both lumens, flap and wall, where its
// branches leave, its tears, the volume of any stretch. docs/follow_up.md says what each figure is.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tunica/analysis/aorta_line.hpp"
#include "tunica/analysis/aorta_parts.hpp"
#include "tunica/analysis/vessel.hpp"

namespace tunica::analysis {

/// Directions about the line in which radii are kept.
inline constexpr int section_directions = 72;

/// A cross-section; NaN for what it does not have.
struct AortaSection {
  double s = 0;                          ///< along the line [m]
  std::array<double, 2> lumen_area{};    ///< true, false [m^2]
  double flap_area = 0;                  ///< m^2
  double diameter = 0;                   ///< of the circle that is as large as both lumens with the flap [m]
  double largest_diameter = 0;           ///< of the same, between any two points of its edge [m]
  double wall_thickness = 0;             ///< mean over the directions [m]
  double least_wall_thickness = 0;       ///< m
  double flap_position = 0;              ///< centroid of the flap from that of the section, > 0: in the true
                                         ///< lumen's direction, so that this lumen is the smaller one [m]
  std::vector<double> inner{}, outer{};  ///< radius of the lumens' and of the wall's edge, by direction [m]

  double true_share() const { return lumen_area[0] / (lumen_area[0] + lumen_area[1]); }
};

/// Where a branch leaves.
struct Landmark {
  std::string name;  ///< of the opening at its end
  double s = 0, angle = 0;
  Vec3<double> place{{0, 0, 0}};  ///< middle of its mouth [m]
};

struct AnatomyTear {
  std::string name;
  double s = 0, area = 0;          ///< m, m^2
  Vec3<double> centre{{0, 0, 0}};  ///< m
};

/// An element of the aorta's lumen along the line.
struct LumenPiece {
  std::array<double, 4> s;  ///< of its corners [m]
  double volume = 0;        ///< m^3
  double false_share = 0;   ///< 0 where lumens are not told apart
};

struct Anatomy {
  AortaLine line;
  bool two_lumens = false, wall = false;
  std::vector<AortaSection> sections;  ///< from 0 to the length of the line, at equal distances
  std::vector<Landmark> landmarks;     ///< downstream
  std::vector<AnatomyTear> tears;      ///< downstream
  std::vector<LumenPiece> pieces;
  std::vector<std::uint8_t> in_aorta;  ///< of each element of the mesh
  std::vector<LineCoordinates> nodes;  ///< of the nodes of these elements; radius infinite elsewhere

  /// Radius of the edge of the lumens, and of the wall [m]: linear between sections and directions.
  double inner_radius(double s, double angle) const;
  double outer_radius(double s, double angle) const;
  /// Figures at an arc length within the line, linear between sections; without radii.
  AortaSection at(double s) const;
  /// Of true and false lumen between two arc lengths, branches left out [m^3].
  std::array<double, 2> volume(double from, double to) const;
};

/// `data` as make_vessel() takes it, `vessel` with stations at least twice as close as elements are wide. The line runs
/// through the centroids of the sections of lumens and flap. `spacing`: of the sections [m]; `flap`: region of the
/// wall. Throws InputError where the aorta is shorter than three spacings. Not collective.
Anatomy make_anatomy(const mesh::MeshData& data, const Vessel& vessel, double spacing, const std::string& flap);

}  // namespace tunica::analysis
