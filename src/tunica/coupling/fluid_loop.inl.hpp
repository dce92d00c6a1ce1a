// The loop over fluid elements; included only by the translation units of one instruction set each.
#pragma once

#include <variant>

#include "tunica/coupling/gather.inl.hpp"
#include "tunica/coupling/quadratic_scatter.inl.hpp"
#include "tunica/fluid/rbvms_shape.hpp"
#include "tunica/fluid/taylor_hood.hpp"

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

template <int W, class Viscosity>
void loop_over_quadratic_fluid(const LumenGroupView& group, const FieldsView& fields,
                               const fluid::Parameters& parameters, const Viscosity& law,
                               const fluid::taylor_hood::TimeCoefficients& time,
                               const fluid::MotionCoefficients& motion, const LoopTarget& target) {
  namespace th = fluid::taylor_hood;
  constexpr int n = fe::quadratic_nodes;
  const BatchView& batches = group.batches;
  for (std::int32_t batch = 0; batch < batches.batches; ++batch) {
    const std::int32_t* nodes = batches.nodes + static_cast<std::ptrdiff_t>(batch) * n * W;
    th::ElementState<Pack<W>> state;
    gather_vectors<W>(fields.position, nodes, state.position);
    gather_vectors<W>(fields.velocity_pressure, nodes, state.velocity, state.pressure);
    gather_vectors<W>(fields.acceleration, nodes, state.acceleration);
    gather_vectors<W>(fields.mesh_velocity, nodes, state.mesh_velocity);
    gather_vectors<W>(fields.stream, nodes, state.stream, state.rate_squared);
    gather_vectors<W>(fields.convection, nodes, state.convection);
    const int used = used_lanes<W>(batches, batch);
    th::ElementVector<Pack<W>> r;
    if (target.blocks != nullptr) {
      const std::int32_t* slots = batches.slots + static_cast<std::ptrdiff_t>(batch) * n * n * W;
      Pack<W> moves[4];
      if (group.moves != nullptr)
        for (int a = 0; a < 4; ++a)
          moves[a] = Pack<W>::load(group.moves + (static_cast<std::ptrdiff_t>(batch) * n + a) * W);
      prefetch_row<W>(0, slots, false, target.blocks);
      th::tangent(state, time, parameters, law, motion, group.moves != nullptr ? &moves : nullptr, r,
                  [&](int a, const th::TangentRow<Pack<W>>& row) {
                    if (a + 1 < n) prefetch_row<W>(a + 1, slots, false, target.blocks);
                    scatter_row<W>({row.velocity, row.pressure, a < fe::nodes ? row.continuity : nullptr, nullptr}, a,
                                   slots, false, used, target.blocks);
                  });
    } else {
      th::residual(state, time, parameters, law, r);
    }
    scatter_quadratic_residual<W>(r.momentum, r.continuity, nodes, nullptr, used, target.residual);
  }
}

template <int W>
void fluid(const LumenGroupView& group, const FieldsView& fields, const fluid::Parameters& parameters,
           const fluid::TimeCoefficients& time, const fluid::MotionCoefficients& motion, const LoopTarget& target) {
  std::visit(
      [&](const auto& law) {
        using Viscosity = std::decay_t<decltype(law)>;
        if (group.batches.quadratic)
          loop_over_quadratic_fluid<W>(group, fields, parameters, law, {time.acceleration, time.velocity, time.speed},
                                       motion, target);
        else if (target.blocks == nullptr)
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
