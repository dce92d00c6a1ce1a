// Where a plane crosses a lumen, and openings of it: flat triangulations with a rim.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tunica/mesh/mesh_data.hpp"

namespace tunica::flow_imaging {

/// A point on an edge of the mesh, with which it moves: from `a` (0) to `b` (1); of a node a == b.
struct OnEdge {
  std::int64_t a, b;
  double share;
};

struct CrossSection {
  std::string name;
  Vec3<double> centre{};                               ///< m
  Vec3<double> normal{};                               ///< unit; flow along it is positive
  double area = 0;                                     ///< m^2
  std::vector<Vec3<double>> points;                    ///< m
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< counter-clockwise, seen against the normal
  std::vector<std::array<std::int32_t, 2>> rim{};      ///< edges of one triangle
  std::vector<OnEdge> on_mesh{};                       ///< of each point
};

/// What a section and its mesh do at one instant. Fields by node of the mesh [node][3], [node]; those that are empty
/// are zero: displacement [m], velocity and mesh velocity [m/s], pressure [Pa].
struct MeshFields {
  std::span<const double> displacement{}, velocity{}, mesh_velocity{}, pressure{};
};
struct SectionState {
  double area = 0, flow = 0, pressure = 0;  ///< m^2; along the normal, relative to the moving mesh [m^3/s]; mean [Pa]
};
SectionState state_of(const CrossSection& section, const MeshFields& fields);

/// The piece of the lumen in a plane that is nearest to `centre` [m]. Pieces of less than a thousandth of the largest
/// are none. Throws InputError at `where` when the plane misses the lumen, or its centre is farther from the piece than
/// that is wide.
CrossSection plane_section(const mesh::MeshData& data, const Vec3<double>& centre, const Vec3<double>& normal,
                           const std::string& name, const std::string& where);

/// An opening of the lumen, its normal out of it. Throws InputError when its triangles do not lie in about one plane.
CrossSection opening_section(const mesh::MeshData& data, const mesh::FaceData& face);

/// Area-weighted points of the triangles, and the area that each stands for [m^2].
std::vector<std::pair<Vec3<double>, double>> quadrature(const CrossSection& section);

/// Finds out what lies in front of and behind a section.
class SectionColumn {
 public:
  explicit SectionColumn(const CrossSection& section);
  /// Does the line through the place along the normal meet the section?
  bool holds(const Vec3<double>& place) const;
  double height(const Vec3<double>& place) const;                ///< along the normal [m]
  std::array<double, 2> plane(const Vec3<double>& place) const;  ///< coordinates in the plane [m]

 private:
  std::size_t cell(double u, int axis) const;

  const CrossSection& section_;
  Vec3<double> e1_, e2_;
  std::array<double, 2> low_{}, step_{};
  static constexpr std::size_t cells_ = 48;  ///< along each side of a grid over the section
  std::vector<std::array<std::array<double, 2>, 3>> flat_;
  std::vector<std::vector<std::int32_t>> in_cell_;
};

}  // namespace tunica::flow_imaging
