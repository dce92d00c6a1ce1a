// All conditions that a face can have, as plain values in SI units. Exactly one per face.
//
// In the generalised-alpha step, prescribed velocities belong to t_{n+1}, where the unknowns are, and tractions and
// pressures to t_{n+af}, where momentum is balanced.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tunica/base/tensor.hpp"
#include "tunica/bc/inflow.hpp"
#include "tunica/bc/outlets.hpp"
#include "tunica/bc/waveform.hpp"

namespace tunica::config {
template <class T>
class Schema;
}

namespace tunica::bc {

/// Some of the axes x, y, z.
using Axes = std::array<bool, 3>;

/// What a load or a motion is at scattered points of its face, at one time or at several, in a CSV file.
struct OverFace {
  enum class Interpolation { nearest, linear };
  std::filesystem::path table;     ///< x, y, z, the values, and t where they vary
  std::optional<double> period{};  ///< of a table with t [s]; none: its first and last values hold
  double unit = 1.0;               ///< of the values [SI]
  double length_unit = 1.0;        ///< of x, y, z [m]
  Interpolation interpolation = Interpolation::linear;
};

// --- lumen faces ------------------------------------------------------------------------------------------------

struct NoSlip {
  static config::Schema<NoSlip> schema();
};

/// v = value * course(t), the same at all nodes of the face, along `directions`; along the others the blood is free and
/// no traction acts.
struct Velocity {
  Vec3<double> value{};       ///< m/s
  WaveformInput course{1.0};  ///< dimensionless
  Axes directions{true, true, true};
  static config::Schema<Velocity> schema();
};

/// Flow Q(t) through the face with a profile; `inflow` gives Q positive *into* the domain.
struct Flow {
  /// What a positive number of the case file or table means. `automatic`: inflow, but outflow in tables of the
  /// SimVascular format, where inflow is negative.
  enum class Sign { automatic, inflow, outflow };
  WaveformInput course;  ///< m^3/s, as given
  Sign positive = Sign::automatic;
  Profile profile = Profile::parabolic;
  static config::Schema<Flow> schema();
};
/// Q(t) [m^3/s], positive into the domain. Throws as make_waveform.
Waveform inflow(const Flow& flow);

/// Traction `vector * course(t)` per current area of a lumen face, per reference area (dead load) of a wall face; or
/// in the place of `vector` that of a table with the columns tx, ty, tz.
struct Traction {
  Vec3<double> vector{};      ///< Pa
  WaveformInput course{1.0};  ///< dimensionless
  Axes fixed{};               ///< no displacement along these, beside the load; wall faces alone
  bool undeforming = false;   ///< the face moves as a whole, without turning; wall faces alone
  std::optional<OverFace> over_face{};
  static config::Schema<Traction> schema();
};

// Resistance and Rcr: outlets.hpp.

/// v(x, t) at the nodes of a face, by formulas or by a table of points and perhaps times, times course(t). The nodes
/// get what these say: the flow through the face is that of their interpolation. Exactly one of `velocity`, `speed` and
/// `table` is given. Along `directions` only, as Velocity.
struct VelocityProfile {
  using Interpolation = OverFace::Interpolation;
  std::vector<std::string> velocity{};         ///< formulas (formula.hpp) of the three components
  std::optional<std::string> speed{};          ///< formula of the speed into the domain, along the mean normal
  std::optional<std::filesystem::path> table;  ///< CSV with the columns x, y, z, vx, vy, vz, and t where it varies
  std::optional<double> period{};              ///< of a table with t [s]; none: its first and last values hold
  double unit = 1.0, length_unit = 1.0;        ///< of velocities [m/s] and coordinates [m], in formulas and table
  Interpolation interpolation = Interpolation::linear;
  WaveformInput course{1.0};  ///< dimensionless
  Axes directions{true, true, true};
  /// The table, which is given.
  OverFace over_face() const { return {table.value(), period, unit, length_unit, interpolation}; }
  static config::Schema<VelocityProfile> schema();
};

// --- lumen and wall faces ---------------------------------------------------------------------------------------

/// Plane of symmetry: no velocity and no displacement across the plane of the face, no traction along it. The face has
/// to be flat.
struct Symmetry {
  static config::Schema<Symmetry> schema();
};

/// Traction -p n, of a table with the column `factor` -factor p n. On a wall face `follower` turns and stretches with
/// the deformed face; a dead one keeps the normal and area of the reference. On a lumen face n is the current normal
/// and follower has no meaning.
struct Pressure {
  WaveformInput pressure;  ///< Pa
  bool follower = true;
  Axes fixed{};              ///< no displacement along these, beside the load; wall faces alone
  bool undeforming = false;  ///< the face moves as a whole, without turning; wall faces alone
  std::optional<OverFace> over_face{};
  static config::Schema<Pressure> schema();
};

// --- wall faces -------------------------------------------------------------------------------------------------

/// Zero displacement, in all directions, along the face's mean normal, or along some axes.
struct Fixed {
  enum Direction { x, y, z, normal, all };
  std::array<bool, 5> directions{false, false, false, false, true};  ///< by Direction; `all` and `normal` stand alone

  /// Only along the mean normal? Then `axes` says nothing.
  bool along_normal() const { return directions[normal]; }
  /// Is the displacement along x, y, z fixed?
  std::array<bool, 3> axes() const {
    return {directions[all] || directions[x], directions[all] || directions[y], directions[all] || directions[z]};
  }
  static config::Schema<Fixed> schema();
};

/// u = value * course(t) at all nodes of a wall face, along `directions`; the others are free. In the place of `value`
/// that of a table with the columns ux, uy, uz. At t_{n+1}, as prescribed velocities; statics multiplies it by its load
/// factor.
struct Displacement {
  Vec3<double> value{};       ///< m
  WaveformInput course{1.0};  ///< dimensionless
  Axes directions{true, true, true};
  std::optional<OverFace> over_face{};
  static config::Schema<Displacement> schema();
};

struct Free {
  static config::Schema<Free> schema();
};

/// A point array of a face, in the mesh file or in one of its own.
struct FaceArray {
  std::string name;
  double unit = 1.0;                               ///< SI value of 1
  std::optional<std::filesystem::path> file = {};  ///< .vtp with the points of the face
};
/// The same on the whole face [SI], or an array.
using SupportValue = std::variant<double, FaceArray>;

/// Elastic tissue around the wall: traction -k_s u - c_s du/dt - p0 n, the first two of the full vectors or of their
/// normal parts, on the reference face.
struct Support {
  enum class Direction { full, normal };
  SupportValue stiffness = 0.0;  ///< k_s, N/m^3
  SupportValue damping = 0.0;    ///< c_s, N s/m^3
  SupportValue pressure = 0.0;   ///< p0, Pa
  Direction direction = Direction::full;
  /// Has it a stiffness, anywhere?
  bool holds() const { return stiffness.index() != 0 || std::get<double>(stiffness) > 0; }
  /// The point arrays that it wants.
  std::vector<FaceArray> arrays() const;
  static config::Schema<Support> schema();
};

using Condition = std::variant<NoSlip, Velocity, Flow, Pressure, Traction, Resistance, Rcr, Fixed, Free, Support,
                               Symmetry, VelocityProfile, Displacement>;

/// Exactly one of the keys no_slip, velocity, flow, pressure, traction, resistance, rcr, fixed, free, support,
/// symmetry, profile, displacement: `outlet: {rcr: {...}}`; those without required keys may stand as a bare name,
/// `wall_outer: free`.
config::Schema<Condition> condition_schema();

/// Name as in the case file: "no_slip", "velocity", ...
std::string_view name(const Condition& condition);
bool fits_lumen(const Condition& condition);
bool fits_wall(const Condition& condition);
/// Does the wall face move as a whole?
bool undeforming(const Condition& condition);
/// Axes along which the displacement of a wall face is given, be it zero; those of a normal direction are none.
Axes held_axes(const Condition& condition);
/// Does it prescribe the velocity along all axes (and so leave the pressure open)?
bool prescribes_velocity(const Condition& condition);

}  // namespace tunica::bc
