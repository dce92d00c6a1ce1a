// Bodies of element_loops.hpp; included only by the translation units of one instruction set each.
#pragma once

#include <variant>

#include "tunica/assembly/batch_access.inl.hpp"
#include "tunica/coupling/element_loops.hpp"
#include "tunica/fluid/rbvms_tangent.hpp"

namespace tunica::coupling {

namespace {

template <int W>
TUNICA_INLINE void gather_vectors(const double* field, const std::int32_t* nodes, Vec3<Pack<W>> (&out)[4]) {
  for (int a = 0; a < 4; ++a) {
    Pack<W> values[4];
    assembly::gather4<W>(field, nodes + a * W, values);
    for (int i = 0; i < 3; ++i) out[a][i] = values[i];
  }
}

template <int W>
TUNICA_INLINE void gather_vectors(const double* field, const std::int32_t* nodes, Vec3<Pack<W>> (&out)[4],
                                  Pack<W> (&fourth)[4]) {
  for (int a = 0; a < 4; ++a) {
    Pack<W> values[4];
    assembly::gather4<W>(field, nodes + a * W, values);
    for (int i = 0; i < 3; ++i) out[a][i] = values[i];
    fourth[a] = values[3];
  }
}

template <int W>
TUNICA_INLINE int used_lanes(const BatchView& batches, std::int32_t batch) {
  const std::int32_t left = batches.elements - batch * W;
  return left < W ? left : W;
}

template <int W, class Viscosity, bool with_tangent>
void fluid_loop(const BatchView& batches, const FieldsView& fields, const fluid::Parameters& parameters,
                const Viscosity& law, const fluid::TimeCoefficients& time, const LoopTarget& target) {
  for (std::int32_t batch = 0; batch < batches.batches; ++batch) {
    const std::int32_t* nodes = batches.nodes + static_cast<std::ptrdiff_t>(batch) * 4 * W;
    fluid::ElementState<Pack<W>> state;
    gather_vectors<W>(fields.position, nodes, state.position);
    gather_vectors<W>(fields.velocity_pressure, nodes, state.velocity, state.pressure);
    gather_vectors<W>(fields.acceleration, nodes, state.acceleration);
    gather_vectors<W>(fields.mesh_velocity, nodes, state.mesh_velocity);
    const int used = used_lanes<W>(batches, batch);
    fe::ElementVector<Pack<W>> r;
    if constexpr (with_tangent) {
      assembly::prefetch_blocks<W>(batches.slots + static_cast<std::ptrdiff_t>(batch) * 16 * W, 1, target.blocks);
      fe::ElementMatrix<Pack<W>> k;
      fluid::tangent(state, time, parameters, law, r, k);
      assembly::scatter_tangent<W>(k, batches.slots + static_cast<std::ptrdiff_t>(batch) * 16 * W, used, target.blocks);
    } else {
      fluid::residual(state, time, parameters, law, r);
    }
    assembly::scatter_residual<W>(r, nodes, used, target.residual);
  }
}

template <int W, class Law, bool mixed, bool with_tangent, bool split>
void wall_loop(const BatchView& batches, const FieldsView& fields, const Law& law, const wall::Body& body,
               const wall::Coefficients& coefficients, const LoopTarget& target) {
  for (std::int32_t batch = 0; batch < batches.batches; ++batch) {
    const std::int32_t* nodes = batches.nodes + static_cast<std::ptrdiff_t>(batch) * 4 * W;
    wall::ElementState<Pack<W>> state;
    Vec3<Pack<W>> position[4], velocity[4];
    gather_vectors<W>(fields.reference_position, nodes, position);
    state.reference = fe::gradients(position);
    gather_vectors<W>(fields.displacement, nodes, state.displacement);
    gather_vectors<W>(fields.acceleration, nodes, state.acceleration);
    gather_vectors<W>(fields.velocity_pressure, nodes, velocity, state.pressure);
    const int used = used_lanes<W>(batches, batch);
    fe::ElementVector<Pack<W>> r;
    if constexpr (with_tangent) {
      constexpr int kinds = split ? 4 : 1;
      assembly::prefetch_blocks<W>(batches.slots + static_cast<std::ptrdiff_t>(batch) * kinds * 16 * W, kinds,
                                   target.blocks);
      fe::ElementMatrix<Pack<W>> k;
      if constexpr (mixed)
        wall::mixed_tangent(state, law, body, coefficients, r, k);
      else
        wall::displacement_tangent(state, law, body, coefficients, r, k);
      if constexpr (split)
        assembly::scatter_tangent_split<W>(k, batches.slots + static_cast<std::ptrdiff_t>(batch) * 64 * W, used,
                                           target.blocks);
      else
        assembly::scatter_tangent<W>(k, batches.slots + static_cast<std::ptrdiff_t>(batch) * 16 * W, used,
                                     target.blocks);
    } else {
      if constexpr (mixed)
        wall::mixed_residual(state, law, body, coefficients, r);
      else
        wall::displacement_residual(state, law, body, r);
    }
    if constexpr (split)
      assembly::scatter_residual_split<W>(r, nodes, batches.hosts + static_cast<std::ptrdiff_t>(batch) * 4 * W, used,
                                          target.residual);
    else
      assembly::scatter_residual<W>(r, nodes, used, target.residual);
  }
}

template <int W>
void fluid(const BatchView& batches, const FieldsView& fields, const fluid::Parameters& parameters,
           const fluid::TimeCoefficients& time, const LoopTarget& target) {
  std::visit(
      [&](const auto& law) {
        using Viscosity = std::decay_t<decltype(law)>;
        if (target.blocks != nullptr)
          fluid_loop<W, Viscosity, true>(batches, fields, parameters, law, time, target);
        else
          fluid_loop<W, Viscosity, false>(batches, fields, parameters, law, time, target);
      },
      parameters.viscosity);
}

template <int W, class Law, bool mixed>
void wall_of_law(const BatchView& batches, const FieldsView& fields, const Law& law, const wall::Body& body,
                 const wall::Coefficients& coefficients, const LoopTarget& target) {
  if (target.blocks != nullptr && batches.split)
    wall_loop<W, Law, mixed, true, true>(batches, fields, law, body, coefficients, target);
  else if (target.blocks != nullptr)
    wall_loop<W, Law, mixed, true, false>(batches, fields, law, body, coefficients, target);
  else if (batches.split)
    wall_loop<W, Law, mixed, false, true>(batches, fields, law, body, coefficients, target);
  else
    wall_loop<W, Law, mixed, false, false>(batches, fields, law, body, coefficients, target);
}

template <int W>
void wall(const BatchView& batches, const FieldsView& fields, const wall::Law& any_law, bool mixed,
          const wall::Body& body, const wall::Coefficients& coefficients, const LoopTarget& target) {
  std::visit(
      [&](const auto& law) {
        using Law = std::decay_t<decltype(law)>;
        if (mixed)
          wall_of_law<W, Law, true>(batches, fields, law, body, coefficients, target);
        else
          wall_of_law<W, Law, false>(batches, fields, law, body, coefficients, target);
      },
      any_law);
}

}  // namespace

template <int W>
ElementLoops make_element_loops() {
  return {&fluid<W>, &wall<W>};
}

}  // namespace tunica::coupling
