// The loop over fluid elements; included only by the translation units of one instruction set each.
#pragma once

#include <variant>

#include "tunica/coupling/gather.inl.hpp"
#include "tunica/fluid/rbvms_shape.hpp"

namespace tunica::coupling {

namespace {

enum class Tangent { none, fixed_mesh, beside_wall };

template <int W, class Viscosity, Tangent kind>
void loop_over_fluid(const LumenGroupView& group, const FieldsView& fields, const fluid::Parameters& parameters,
                     const Viscosity& law, const fluid::TimeCoefficients& time, const fluid::MotionCoefficients& motion,
                     const LoopTarget& target) {
  const BatchView& batches = group.batches;
  for (std::int32_t batch = 0; batch < batches.batches; ++batch) {
    const std::int32_t* nodes = batches.nodes + static_cast<std::ptrdiff_t>(batch) * 4 * W;
    fluid::ElementState<Pack<W>> state;
    gather_vectors<W>(fields.position, nodes, state.position);
    gather_vectors<W>(fields.velocity_pressure, nodes, state.velocity, state.pressure);
    gather_vectors<W>(fields.acceleration, nodes, state.acceleration);
    gather_vectors<W>(fields.mesh_velocity, nodes, state.mesh_velocity);
    const int used = used_lanes<W>(batches, batch);
    fe::ElementVector<Pack<W>> r;
    if constexpr (kind != Tangent::none) {
      assembly::prefetch_blocks<W>(batches.slots + static_cast<std::ptrdiff_t>(batch) * 16 * W, 1, target.blocks);
      fe::ElementMatrix<Pack<W>> k;
      if constexpr (kind == Tangent::beside_wall) {
        Pack<W> moves[fe::nodes];
        for (int a = 0; a < fe::nodes; ++a)
          moves[a] = Pack<W>::load(group.moves + (static_cast<std::ptrdiff_t>(batch) * 4 + a) * W);
        fluid::tangent_beside_wall(state, time, parameters, law, motion, moves, r, k);
      } else {
        fluid::tangent(state, time, parameters, law, r, k);
      }
      assembly::scatter_tangent<W>(k, batches.slots + static_cast<std::ptrdiff_t>(batch) * 16 * W, used, target.blocks);
    } else {
      fluid::residual(state, time, parameters, law, r);
    }
    assembly::scatter_residual<W>(r, nodes, used, target.residual);
  }
}

template <int W>
void fluid(const LumenGroupView& group, const FieldsView& fields, const fluid::Parameters& parameters,
           const fluid::TimeCoefficients& time, const fluid::MotionCoefficients& motion, const LoopTarget& target) {
  std::visit(
      [&](const auto& law) {
        using Viscosity = std::decay_t<decltype(law)>;
        if (target.blocks == nullptr)
          loop_over_fluid<W, Viscosity, Tangent::none>(group, fields, parameters, law, time, motion, target);
        else if (group.moves == nullptr)
          loop_over_fluid<W, Viscosity, Tangent::fixed_mesh>(group, fields, parameters, law, time, motion, target);
        else
          loop_over_fluid<W, Viscosity, Tangent::beside_wall>(group, fields, parameters, law, time, motion, target);
      },
      parameters.viscosity);
}

}  // namespace

template <int W>
FluidLoop fluid_loop() {
  return &fluid<W>;
}

}  // namespace tunica::coupling
