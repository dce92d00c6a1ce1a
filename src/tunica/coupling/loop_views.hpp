// What the loops over elements are given and where they put their results, and the loop over fluid elements. Nothing
// here knows a wall law.
#pragma once

#include <cstdint>

#include "tunica/assembly/element_batches.hpp"
#include "tunica/fluid/parameters.hpp"
#include "tunica/fluid/rbvms_shape.hpp"

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
  const double* stream = nullptr;              ///< at t_n: v - v^ [m/s], |dv/dt|^2 [m^2/s^4]; fluid, quadratic elements
  const double* convection = nullptr;          ///< P (2.5) at t_n [m/s^2]; fluid, quadratic elements
};

/// Where a loop adds its results. Without `blocks` it computes the residual only.
struct LoopTarget {
  double* residual = nullptr;  ///< [local node][4]
  float* blocks = nullptr;     ///< BlockMatrix::blocks
};

/// Plain view of ElementBatches.
struct BatchView {
  std::int32_t batches, elements;
  bool split, quadratic;
  const std::int32_t *nodes, *hosts, *slots;

  explicit BatchView(const assembly::ElementBatches& b)
      : batches(b.batches()),
        elements(b.elements),
        split(b.split),
        quadratic(b.nodes_per_element == 10),
        nodes(b.nodes.data()),
        hosts(b.hosts.data()),
        slots(b.slots.data()) {}
};

/// Lumen elements, none or each of which has nodes that the wall takes along.
struct LumenGroupView {
  BatchView batches;
  const double* moves = nullptr;  ///< 1 for such nodes, else 0 [batch][4][lane]; null where there are none
};

using FluidLoop = void (*)(const LumenGroupView&, const FieldsView&, const fluid::Parameters&,
                           const fluid::TimeCoefficients&, const fluid::MotionCoefficients&, const LoopTarget&);

/// Instantiated in fluid_loop_<isa>.cpp.
template <int W>
FluidLoop fluid_loop();

}  // namespace tunica::coupling
