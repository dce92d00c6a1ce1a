// A homogeneous specimen of one law under load: what a testing machine does to it, or a given deformation gradient.
//
// A specimen is a block with edges along three axes of its own, a1, a2, a3, given in the fibre frame. Stretching holds
// components of C in these axes and leaves the others free; the free ones take the values at which their
// second Piola-Kirchhoff stress vanishes, so that the free faces bear no traction, neither normal nor in shear:
//   stretched along a1 alone:   C11 held;               free C22 C33 C12 C23 C13 (faces across a2 and a3),
//   stretched along a1 and a2:  C11, C22 and C12 = 0;   free C33 C23 C13         (face across a3).
// The block is turned so that the edge a1 keeps its direction and a2 stays in the plane of a1 and a2.
//
// Compressible or not, the pressure is an unknown of its own, tied to the volume by g(J) + p/K = 0 as in the mixed
// element. The equations therefore stay well conditioned up to 1/K = 0.
#pragma once

#include <optional>
#include <vector>

#include "tunica/wall/fibre_frame.hpp"
#include "tunica/wall/material.hpp"
#include "tunica/wall/material_point.hpp"

namespace tunica::wall {

/// State of the specimen; tensors are in the fibre frame.
struct PathPoint {
  Mat3<double> F = identity<double>();
  double pressure = 0.0;                 ///< p = -dPsi_vol/dJ, or what keeps the volume, positive in compression [Pa]
  double energy = 0.0;                   ///< Psi with its volumetric part, per reference volume [J/m^3]
  MaterialPoint<double> state{};         ///< its tangent is at constant pressure when incompressible
  Mat3<double> first_piola_kirchhoff{};  ///< P = F S [Pa]
  std::vector<double> residuals{};       ///< of Newton's method, relative to the stress; empty for a given F
};

enum class StressMeasure {
  cauchy,                 ///< force per present area
  first_piola_kirchhoff,  ///< force per area at rest
  second_piola_kirchhoff  ///< S
};

/// "Cauchy stress".
const char* name_of(StressMeasure measure);

/// The component of a stress [Pa] along `direction` on the face across `normal`, unit vectors in the fibre frame.
double stress_component(const PathPoint& point, StressMeasure measure, const Vec3<double>& direction,
                        const Vec3<double>& normal);

/// Where the specimen is held.
struct Stretches {
  double along = 1.0;            ///< stretch of the edge a1
  std::optional<double> across;  ///< of the edge a2; none: free
};

/// `volumetric` with infinite K: incompressible. The specimen is taken there from `start`, on the way there if
/// necessary in smaller steps. Throws SolverError when no equilibrium is found.
PathPoint stretched(const Law& law, const Volumetric& volumetric, const FibreFrame& axes, const Stretches& stretches,
                    const PathPoint& start);

/// Second Piola-Kirchhoff stress [Pa] of an incompressible sheet in the axes of the specimen, in closed form: C11, C22
/// and C12 are held, C33 keeps the volume, and the pressure is that at which the face across a3 bears no normal
/// traction. None where the law answers with shear across that face, which C13 and C23 would then have to undo.
std::optional<Symmetric<double>> sheet_stress(const Law& law, const FibreFrame& axes, double C11, double C22,
                                              double C12);

/// Simple shear F = I + shear a1 (x) a2, wholly prescribed. An incompressible law takes the pressure at which the
/// face across a3 bears no normal traction; otherwise the pressure is that of J = 1, zero.
PathPoint sheared(const Law& law, const Volumetric& volumetric, const FibreFrame& axes, double shear);

/// A given F with det F > 0, in the fibre frame. An incompressible law takes p = 0: its stress is the isochoric part.
PathPoint deformed(const Law& law, const Volumetric& volumetric, const Mat3<double>& F);

/// Frame of a specimen that is loaded along `along` alone: a2 in the plane of e1 and e2 where it can be. Needs a length
/// above zero.
FibreFrame specimen_axes(const Vec3<double>& along);

}  // namespace tunica::wall
