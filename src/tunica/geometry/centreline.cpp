#include "tunica/geometry/centreline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tunica::geometry {

namespace {

/// `v` turned by `angle` about the unit axis.
Point turned(const Point& v, const Point& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * v + s * cross(axis, v) + ((1 - c) * dot(axis, v)) * axis;
}

}  // namespace

void Centreline::append(double length, double angle, double towards) {
  if (angle < 0) {
    angle = -angle;
    towards += std::numbers::pi;
  }
  Piece piece{end_, end_, length_, length, 0, {}, {}, std::cos(towards), std::sin(towards), {}, 0};
  piece.to_centre = piece.cos_towards * end_.e1 + piece.sin_towards * end_.e2;
  piece.binormal = cross(end_.tangent, piece.to_centre);
  if (angle != 0) piece.radius = length / angle;
  end_ = piece.last = on_piece(piece, length);
  piece.middle = on_piece(piece, length / 2).origin;
  piece.reach = length / 2;
  pieces_.push_back(piece);
  length_ += length;
}

Frame Centreline::on_piece(const Piece& piece, double along) const {
  const Frame& f = piece.first;
  if (piece.radius == 0) return {f.origin + along * f.tangent, f.tangent, f.e1, f.e2};
  const double angle = along / piece.radius;
  const Point centre = f.origin + piece.radius * piece.to_centre;
  return {centre - piece.radius * turned(piece.to_centre, piece.binormal, angle),
          turned(f.tangent, piece.binormal, angle), turned(f.e1, piece.binormal, angle),
          turned(f.e2, piece.binormal, angle)};
}

Frame Centreline::frame(double s) const {
  const auto after =
      std::upper_bound(pieces_.begin(), pieces_.end(), s, [](double x, const Piece& p) { return x < p.s; });
  const Piece& piece = after == pieces_.begin() ? pieces_.front() : *(after - 1);
  const double within = std::clamp(s - piece.s, 0.0, piece.length);
  Frame f = on_piece(piece, within);
  f.origin = f.origin + (s - piece.s - within) * f.tangent;
  return f;
}

void Centreline::look_at(const Piece& piece, const Point& p, Closest& best) const {
  const Frame& f = piece.first;
  const Point d = p - f.origin;
  const double aside = dot(d, piece.binormal);  // normal to the plane of the arc
  double along, toward;
  if (piece.radius == 0) {
    along = dot(d, f.tangent);
    toward = dot(d, piece.to_centre);
  } else {
    // Polar coordinates about the centre of the arc.
    const double x = dot(d, f.tangent), y = piece.radius - dot(d, piece.to_centre);
    double angle = std::atan2(x, y);
    const double half = 0.5 * piece.length / piece.radius;
    if (angle < half - std::numbers::pi) angle += 2 * std::numbers::pi;
    along = angle * piece.radius;
    toward = piece.radius - std::sqrt(x * x + y * y);
  }
  double beyond = std::max(-along, along - piece.length);
  const double clamped = std::clamp(along, 0.0, piece.length);
  double distance = std::sqrt(toward * toward + aside * aside);
  if (beyond > 0) {
    const Frame& end = along < 0 ? piece.first : piece.last;
    const Point e = p - end.origin;
    distance = norm(e);
    beyond = along < 0 ? -dot(e, end.tangent) : dot(e, end.tangent);
    toward = piece.cos_towards * dot(e, end.e1) + piece.sin_towards * dot(e, end.e2);
  }
  if (distance >= best.distance) return;
  best = {piece.s + clamped, piece.cos_towards * toward - piece.sin_towards * aside,
          piece.sin_towards * toward + piece.cos_towards * aside, distance,
          piece.s + clamped > 0 && piece.s + clamped < length_ ? 0 : beyond};
}

Centreline::Closest Centreline::closest(const Point& p) const {
  // The nearest ball first; most others are then too far to be looked at.
  const Piece* first = nullptr;
  double nearest = 1e300;
  for (const Piece& piece : pieces_) {
    const double bound = norm(p - piece.middle) - piece.reach;
    if (bound >= nearest) continue;
    nearest = bound;
    first = &piece;
  }
  Closest best{0, 0, 0, 1e300, 0};
  look_at(*first, p, best);
  for (const Piece& piece : pieces_)
    if (&piece != first && norm(p - piece.middle) - piece.reach < best.distance) look_at(piece, p, best);
  return best;
}

}  // namespace tunica::geometry
