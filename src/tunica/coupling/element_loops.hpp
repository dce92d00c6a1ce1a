// The loops over fluid and wall elements, compiled once per instruction set.
#pragma once

#include <cstdint>
#include <span>

#include "tunica/assembly/element_batches.hpp"
#include "tunica/assembly/isa.hpp"
#include "tunica/fluid/parameters.hpp"
#include "tunica/fluid/rbvms_shape.hpp"
#include "tunica/wall/blended_law.hpp"
#include "tunica/wall/element.hpp"

namespace tunica::coupling {

/// Nodal fields at the instants at which a loop needs them, all [local node][4]; the fourth entry is the pressure in
/// `velocity_pressure` and unused elsewhere.
struct FieldsView {
  const double* reference_position = nullptr;  ///< X [m]
  const double* position = nullptr;            ///< x at t_{n+alpha_f} [m]; fluid
  const double* velocity_pressure = nullptr;   ///< v at t_{n+alpha_f} [m/s], p [Pa]
  const double* acceleration = nullptr;        ///< dv/dt at t_{n+alpha_m} [m/s^2]
  const double* mesh_velocity = nullptr;       ///< at t_{n+alpha_f} [m/s]; fluid
  const double* displacement = nullptr;        ///< u at t_{n+alpha_f} [m]; wall
};

/// Where a loop adds its results. Without `blocks` it computes the residual only.
struct LoopTarget {
  double* residual = nullptr;  ///< [local node][4]
  float* blocks = nullptr;     ///< BlockMatrix::blocks
};

/// Plain view of ElementBatches.
struct BatchView {
  std::int32_t batches, elements;
  bool split;
  const std::int32_t *nodes, *hosts, *slots;

  explicit BatchView(const assembly::ElementBatches& b)
      : batches(b.batches()),
        elements(b.elements),
        split(b.split),
        nodes(b.nodes.data()),
        hosts(b.hosts.data()),
        slots(b.slots.data()) {}
};

/// Lumen elements, none or each of which has nodes that the wall takes along.
struct LumenGroupView {
  BatchView batches;
  const double* moves = nullptr;  ///< 1 for such nodes, else 0 [batch][4][lane]; null where there are none
};

/// Wall elements that are made of the same laws.
struct WallGroupView {
  BatchView batches;
  wall::LawKind kind;
  std::span<const wall::Law* const> laws;
  const double* weights = nullptr;  ///< of the laws [batch][law][lane], null for one law
  const double* bodies = nullptr;   ///< density, K, shear modulus at rest and present one [batch][4][lane]
  const double* frames = nullptr;   ///< e1 and e2 of the fibre frame [batch][6][lane], null for global axes
  /// In the axes of the frame: S0 [Pa, batch][6][lane] or F0 [batch][9][lane]; null without.
  const double *prestress = nullptr, *prestretch = nullptr;
};

/// What all elements of the wall have in common.
struct WallElementSettings {
  bool mixed;  ///< the displacement-pressure element, else the displacement element
  wall::VolumetricEnergy volumetric_energy;
  double stabilisation;
};

using FluidLoop = void (*)(const LumenGroupView&, const FieldsView&, const fluid::Parameters&,
                           const fluid::TimeCoefficients&, const fluid::MotionCoefficients&, const LoopTarget&);
using WallLoop = void (*)(const WallGroupView&, const FieldsView&, const WallElementSettings&,
                          const wall::Coefficients&, const LoopTarget&);

/// Writes the present modulus (1.16) of every lane, [batch][lane].
using ModulusLoop = void (*)(const WallGroupView&, const FieldsView&, double* modulus);

struct WallLoops {
  WallLoop assemble;
  ModulusLoop modulus;
};
struct ElementLoops {
  FluidLoop fluid;
  WallLoops wall;
};

/// Instantiated in fluid_loop_<isa>.cpp and wall_loop_<isa>.cpp.
template <int W>
FluidLoop fluid_loop();
template <int W>
WallLoops wall_loops();

ElementLoops element_loops(assembly::Isa isa);

}  // namespace tunica::coupling
