// The idealised dissection as a body: for any point, lumen, wall or outside.
#pragma once

#include <string>
#include <vector>

#include "tunica/geometry/centreline.hpp"
#include "tunica/geometry/parametric_dissection.hpp"
#include "tunica/geometry/tetrahedra.hpp"

namespace tunica::geometry {

struct Box {
  Point low{{0, 0, 0}}, high{{0, 0, 0}};  ///< m
};

/// A planar end of a vessel, round in lumen and wall.
struct RoundOpening {
  std::string name;
  Point centre, normal;               ///< normal points out of the body
  double lumen_radius, outer_radius;  ///< m
};

/// Values of a function along the centreline, tabulated.
class Profile {
 public:
  template <class Function>
  Profile(double length, const Function& function) : step_(length / intervals) {
    for (int k = 0; k <= intervals + 1; ++k) values_.push_back(function(k * step_));
  }
  struct Value {
    double value, slope;
  };
  Value at(double s) const {
    const double x = s / step_;
    const auto k = static_cast<std::size_t>(x < 0 ? 0 : x > intervals ? intervals : x);
    const double slope = values_[k + 1] - values_[k];
    return {values_[k] + (x - static_cast<double>(k)) * slope, slope / step_};
  }

 private:
  static constexpr int intervals = 4000;
  std::vector<double> values_;
  double step_;
};

/// Level-set functions that are negative inside and distances near their surface. Vessels are tubes about their
/// centrelines, joined with rounded edges; the flap is a spiral sheet with elliptic holes, taken out of the lumen.
class DissectionModel {
 public:
  explicit DissectionModel(const ParametricDissection& shape);

  struct Values {
    double lumen, outer;  ///< < 0 in the lumen; < 0 in lumen or wall [m]
    double flap;          ///< distance from the flap, < 0 within; large where there is none [m]
    double tear;          ///< distance from the rim of the nearest tear [m]
    double vessel;        ///< < 0 in the lumen and in clotted blood, where `lumen` is not negative [m]
    double side;          ///< > 0 on the side of the true lumen, and where there is no flap [m]
    double thickness;     ///< of the wall or flap nearby [m]
    int branch;           ///< number of the branch, -1 in the aorta
  };
  /// Vessels go on straight by `beyond` [m] past their ends.
  Values at(const Point& p, double beyond = 0) const;
  int label(const Point& p) const;

  /// Material directions at a point of wall or flap.
  struct Axes {
    Point normal, longitudinal;  ///< across the sheet or wall, outwards in the latter; along the vessel; orthonormal
    double clear;                ///< distance from where wall, flap and branches meet, and no direction is right [m]
  };
  Axes axes(const Point& p) const;

  Box box() const { return box_; }                                         ///< 3 mm larger than the body
  const std::vector<RoundOpening>& openings() const { return openings_; }  ///< the first one is the inlet
  double aorta_radius(double s) const { return radius_.at(s).value; }
  bool has_thrombus() const { return shape_.thrombus.has_value(); }
  const Centreline& centreline() const { return centreline_; }
  /// Distance of `p` from the surface of the aorta without branches [m], of the outer surface.
  double outside_aorta(const Point& p) const;
  /// Half the width of the flap between the walls at s; 0 where there is none [m].
  double flap_half_width(double s) const;
  /// Depth of the true and the false lumen across the flap at s [m].
  struct Depths {
    double true_lumen, false_lumen;
  };
  Depths depths(double s) const;

  struct Tube {
    Point origin, axis;
    double length, radius, wall_thickness;
  };
  const std::vector<Tube>& tubes() const { return tubes_; }

 private:
  struct Sheet {
    double flap, tear, side, weight;
  };
  Sheet sheet(const Centreline::Closest& c, double radius) const;
  double clot_thickness(double s) const;
  Axes aorta_axes(const Point& p) const;
  void join_tubes(const Point& p, double beyond, Values& v) const;
  double tear_rim(const TearShape& tear, double s, double m, double stretch) const;
  double share_of_true_lumen(double offset, double bow) const;
  double find_offset() const;
  void add_tube(const std::string& name, const Point& origin, const Point& axis, double length, double radius,
                double wall_thickness);
  void find_box();

  ParametricDissection shape_;
  Centreline centreline_;
  Profile radius_, weight_;
  double offset_ = 0;  ///< of the flap from the middle, towards the true lumen [m]
  double entry_stretch_ = 1, exit_stretch_ = 1;
  std::vector<Tube> tubes_;
  std::vector<RoundOpening> openings_;
  Box box_;
};

}  // namespace tunica::geometry
