// All conditions that a face can have, as plain values in SI units. Exactly one per face.
#pragma once

#include <optional>
#include <string_view>
#include <variant>

#include "tunica/base/tensor.hpp"
#include "tunica/bc/inflow.hpp"
#include "tunica/bc/outlets.hpp"
#include "tunica/bc/waveform.hpp"

namespace tunica::bc {

// --- lumen faces ------------------------------------------------------------------------------------------------

struct NoSlip {};

/// v = value * course(t), the same at all nodes of the face.
struct Velocity {
  Vec3<double> value{};       ///< m/s
  WaveformInput course{1.0};  ///< dimensionless
};

/// Flow Q(t) through the face with a profile. `flow` is positive *into* the domain whatever the file's convention was.
struct Flow {
  WaveformInput flow;  ///< m^3/s
  Profile profile = Profile::parabolic;
};

/// Traction `vector * course(t)` per current area of a lumen face, per reference area (dead load) of a wall face.
struct Traction {
  Vec3<double> vector{};      ///< Pa
  WaveformInput course{1.0};  ///< dimensionless
};

// Resistance and Rcr: outlets.hpp.

// --- lumen and wall faces ---------------------------------------------------------------------------------------

/// Traction -p n. On a wall face `follower` turns and stretches with the deformed face; a dead one keeps the normal and
/// area of the reference. On a lumen face n is the current normal and follower has no meaning.
struct Pressure {
  WaveformInput pressure;  ///< Pa
  bool follower = true;
};

// --- wall faces -------------------------------------------------------------------------------------------------

/// Zero displacement, in all directions, along the face's mean normal, or along some axes.
struct Fixed {
  enum class Directions { all, normal, axes };
  Directions directions = Directions::all;
  std::array<bool, 3> axes{true, true, true};  ///< x, y, z; read with Directions::axes only
};

struct Free {};

/// Elastic tissue around the wall: traction -k_s u - c_s du/dt - p0 n, the first two of the full vectors or of their
/// normal parts, on the reference face.
struct Support {
  enum class Direction { full, normal };
  double stiffness = 0.0;  ///< k_s, N/m^3
  double damping = 0.0;    ///< c_s, N s/m^3
  double pressure = 0.0;   ///< p0, Pa
  Direction direction = Direction::full;
};

using Condition = std::variant<NoSlip, Velocity, Flow, Pressure, Traction, Resistance, Rcr, Fixed, Free, Support>;

/// Name as in the case file: "no_slip", "velocity", ...
std::string_view name(const Condition& condition);
bool fits_lumen(const Condition& condition);
bool fits_wall(const Condition& condition);
/// Does it prescribe the velocity (and so leave the pressure open)?
bool prescribes_velocity(const Condition& condition);

}  // namespace tunica::bc
