// A smooth space curve of straight lines and circular arcs: closest points in closed form.
#pragma once

#include <vector>

#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::geometry {

/// Axes across the curve, carried along it without turning about it: directions around a vessel are told by their angle
/// from `e1` towards `e2`.
struct Frame {
  Point origin, tangent, e1, e2;
};

class Centreline {
 public:
  /// Starts at `start`; `start.tangent`, `e1`, `e2` are orthonormal.
  explicit Centreline(const Frame& start) : end_(start) {}

  /// Goes on by `length` [m] > 0, bending by `angle` [rad] towards the direction at `towards` [rad] from e1; an angle
  /// of 0 is a straight line.
  void append(double length, double angle = 0, double towards = 0);

  double length() const { return length_; }
  Frame frame(double s) const;  ///< at arc length s, on the tangent lines beyond the ends

  /// The closest point, seen from the curve.
  struct Closest {
    double s;         ///< arc length [m], 0 and length() for points beyond the ends
    double x1, x2;    ///< offset along e1, e2 at s [m]
    double distance;  ///< to the curve [m]
    double beyond;    ///< past the end of the curve, or before its start [m]; <= 0 within
  };
  Closest closest(const Point& p) const;

 private:
  struct Piece {
    Frame first, last;
    double s, length, radius;  ///< radius of curvature [m], 0: straight
    Point to_centre, binormal;
    double cos_towards, sin_towards;
    Point middle;  ///< of a ball that holds the piece
    double reach;
  };
  Frame on_piece(const Piece& piece, double along) const;
  void look_at(const Piece& piece, const Point& p, Closest& best) const;

  std::vector<Piece> pieces_;
  Frame end_;
  double length_ = 0;
};

}  // namespace tunica::geometry
