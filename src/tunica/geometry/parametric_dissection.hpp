// Parameters of an idealised type-B dissection: what the user may choose, and what is possible.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/base/units.hpp"
#include "tunica/config/schema.hpp"

namespace tunica::geometry {

using unit::mm, unit::degree;

/// Lengths along the centreline of the aorta count from the inlet. Angles about it count from the outside of the arch
/// towards the right of the vessel's direction. Radii are those of the lumen.
struct BranchShape {
  double position;        ///< of its origin [m]
  double angle;           ///< about the aorta [rad]
  double inclination;     ///< of its axis, from straight away towards downstream [rad]
  double radius, length;  ///< length outside the aortic lumen [m]
  double wall_thickness;  ///< m
};

struct TearShape {
  double position;  ///< of its middle [m]
  double area;      ///< at its narrowest [m^2]
  double aspect;    ///< length along the vessel by width
  double across;    ///< of its middle, from the middle of the flap [m]
};

struct AortaShape {
  double ascending_length = 60 * mm, arch_bend_radius = 38 * mm, arch_angle = 175 * degree,
         descending_length = 275 * mm, descending_bend = 15 * degree, arch_direction = 65 * degree;
  double ascending_radius = 16 * mm, arch_radius = 13.5 * mm, dissected_radius = 16 * mm, abdominal_radius = 10 * mm;
  double wall_thickness = 2.2 * mm;
  double branch_fillet = 4 * mm;  ///< radius of the rounding where branches leave
};

struct FlapShape {
  double start = 165 * mm, length = 200 * mm, taper = 32 * mm;
  double thickness = 1.75 * mm, false_lumen_wall_thickness = 1.4 * mm;
  double turns = 0.5, true_lumen_direction = 180 * degree, true_lumen_share = 0.42, bow = 2 * mm;
  double rim_fillet = 0.8 * mm, corner_fillet = 2 * mm;
  TearShape entry{212 * mm, 228 * mm*mm, 1.7, 0}, exit{318 * mm, 227 * mm*mm, 1.7, 0};
};

/// Clotted blood along the outer wall of the false lumen.
struct ThrombusShape {
  double start = 225 * mm, length = 75 * mm, taper = 15 * mm;  ///< taper: at either end, part of the length
  double thickness = 6 * mm;
};

struct IliacShape {
  double angle = 25 * degree, radius = 5.5 * mm, length = 45 * mm, wall_thickness = 1.2 * mm;
};

struct ParametricDissection {
  AortaShape aorta;
  FlapShape flap;
  BranchShape brachiocephalic{98 * mm, 0, -10 * degree, 6 * mm, 35 * mm, 1.3 * mm};
  BranchShape left_common_carotid{121 * mm, 0, -5 * degree, 3.7 * mm, 35 * mm, 1.1 * mm};
  BranchShape left_subclavian{141 * mm, 0, 10 * degree, 4.8 * mm, 35 * mm, 1.2 * mm};
  std::optional<BranchShape> celiac, superior_mesenteric, left_renal, right_renal;
  std::optional<IliacShape> iliacs;
  std::optional<ThrombusShape> thrombus;

  /// Branches that are there, by name, in the order of their positions as declared above.
  std::vector<std::pair<std::string, BranchShape>> branches() const;
  double length() const;  ///< of the centreline [m]
  static config::Schema<ParametricDissection> schema();
};

/// What makes the parameters impossible: parts that would overlap, tears that do not fit. Empty when all is well.
config::Problems impossibilities(const ParametricDissection& shape);

}  // namespace tunica::geometry
