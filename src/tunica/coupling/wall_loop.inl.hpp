// The loop over wall elements; included only by the translation units of one instruction set each.
#pragma once

#include "tunica/coupling/element_loops.hpp"
#include "tunica/coupling/gather.inl.hpp"
#include "tunica/coupling/quadratic_scatter.inl.hpp"
#include "tunica/wall/prestress.hpp"
#include "tunica/wall/quadratic_element.hpp"

namespace tunica::coupling {

namespace {

/// Imaged shape of a batch, in its fibre frames [e1, e2][component][lane] if there are any.
template <int W>
TUNICA_INLINE void set_shape_of(const WallGroupView& group, std::int32_t batch, const Vec3<Pack<W>> (&X)[4],
                                wall::ElementState<Pack<W>>& state) {
  if (group.frames == nullptr) return wall::set_reference(state, X);
  const double* frame = group.frames + static_cast<std::ptrdiff_t>(batch) * 6 * W;
  Vec3<Pack<W>> e1, e2;
  for (int i = 0; i < 3; ++i) {
    e1[i] = Pack<W>::load(frame + i * W);
    e2[i] = Pack<W>::load(frame + (3 + i) * W);
  }
  wall::set_reference(state, X, e1, e2);
}

/// F0 of a point, 9 W numbers.
template <int W>
TUNICA_INLINE Mat3<Pack<W>> load_stretch(const double* values) {
  Mat3<Pack<W>> F0;
  for (int k = 0; k < 9; ++k) F0(k / 3, k % 3) = Pack<W>::load(values + k * W);
  return F0;
}

/// S0 of a point, 6 W numbers.
template <int W>
TUNICA_INLINE wall::Symmetric<Pack<W>> load_stress(const double* values) {
  wall::Symmetric<Pack<W>> S0;
  for (int k = 0; k < wall::voigt_size; ++k) S0[k] = Pack<W>::load(values + k * W);
  return S0;
}

/// Reference of a batch of linear elements: its imaged shape, or what the prestretch makes of it.
template <int W>
TUNICA_INLINE void set_reference_of(const WallGroupView& group, std::int32_t batch, const Vec3<Pack<W>> (&X)[4],
                                    wall::ElementState<Pack<W>>& state) {
  set_shape_of<W>(group, batch, X, state);
  if (group.prestretch == nullptr) return;
  wall::set_prestretch(state, load_stretch<W>(group.prestretch + static_cast<std::ptrdiff_t>(batch) * 9 * W));
}

template <int W>
TUNICA_INLINE wall::Symmetric<Pack<W>> prestress_of(const WallGroupView& group, std::int32_t batch) {
  return load_stress<W>(group.prestress + static_cast<std::ptrdiff_t>(batch) * wall::voigt_size * W);
}

/// Prestress of a batch of quadratic elements.
template <int W>
TUNICA_INLINE void load_prestress(const WallGroupView& group, std::int32_t batch,
                                  wall::quadratic::PointPrestress<Pack<W>>& prestress) {
  const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(batch) * wall::quadratic::points;
  if (group.prestress != nullptr) {
    prestress.kind = wall::PrestressKind::stress;
    for (int q = 0; q < wall::quadratic::points; ++q)
      prestress.stress[q] = load_stress<W>(group.prestress + (first + q) * wall::voigt_size * W);
  } else if (group.prestretch != nullptr) {
    prestress.kind = wall::PrestressKind::stretch;
    for (int q = 0; q < wall::quadratic::points; ++q)
      prestress.stretch[q] = load_stretch<W>(group.prestretch + (first + q) * 9 * W);
  }
}

/// The blend of one batch as the kernels want it.
template <int W, wall::LawKind kind>
TUNICA_INLINE auto law_of(const WallGroupView& group, std::int32_t batch) {
  const double* values = group.bodies + static_cast<std::ptrdiff_t>(batch) * 4 * W;
  if constexpr (kind == wall::LawKind::linear) {
    return wall::NeoHookeOf<Pack<W>>{Pack<W>::load(values + 2 * W)};
  } else {
    using Law =
        std::conditional_t<kind == wall::LawKind::unsplit, wall::UnsplitBlendedLaw<Pack<W>>, wall::BlendedLaw<Pack<W>>>;
    Law law;
    law.laws = group.laws;
    law.weights = group.weights == nullptr ? nullptr
                                           : group.weights + static_cast<std::ptrdiff_t>(batch) *
                                                                 static_cast<std::ptrdiff_t>(group.laws.size()) * W;
    if (group.point_weights != nullptr)
      law.point_weights = group.point_weights + static_cast<std::ptrdiff_t>(batch) * wall::quadratic::points *
                                                    static_cast<std::ptrdiff_t>(group.laws.size()) * W;
    law.shear_modulus = Pack<W>::load(values + 2 * W);
    law.stabilising_modulus = Pack<W>::load(values + 3 * W);
    return law;
  }
}

template <int W>
TUNICA_INLINE wall::BodyOf<Pack<W>> body_of(const WallGroupView& group, std::int32_t batch,
                                            const WallElementSettings& settings) {
  const double* values = group.bodies + static_cast<std::ptrdiff_t>(batch) * 4 * W;
  return {
      .density = Pack<W>::load(values),
      .volumetric = {settings.volumetric_energy, Pack<W>::load(values + W)},
      .stabilisation = settings.stabilisation,
      .bulk_moduli = group.point_bulk_moduli == nullptr
                         ? nullptr
                         : group.point_bulk_moduli + static_cast<std::ptrdiff_t>(batch) * wall::quadratic::points * W};
}

template <int W, wall::LawKind kind, bool mixed, bool with_tangent>
void loop_over_wall(const WallGroupView& group, const FieldsView& fields, const WallElementSettings& settings,
                    const wall::Coefficients& coefficients, const LoopTarget& target) {
  const BatchView& batches = group.batches;
  const std::ptrdiff_t kinds = batches.split ? 4 : 1;
  for (std::int32_t batch = 0; batch < batches.batches; ++batch) {
    const std::int32_t* nodes = batches.nodes + static_cast<std::ptrdiff_t>(batch) * 4 * W;
    wall::ElementState<Pack<W>> state;
    Vec3<Pack<W>> position[4], velocity[4];
    gather_vectors<W>(fields.reference_position, nodes, position);
    set_reference_of<W>(group, batch, position, state);
    gather_vectors<W>(fields.displacement, nodes, state.displacement);
    gather_vectors<W>(fields.acceleration, nodes, state.acceleration);
    gather_vectors<W>(fields.velocity_pressure, nodes, velocity, state.pressure);
    const auto body = body_of<W>(group, batch, settings);
    const auto law = law_of<W, kind>(group, batch);
    const int used = used_lanes<W>(batches, batch);
    fe::ElementVector<Pack<W>> r;
    if constexpr (with_tangent) {
      const std::int32_t* slots = batches.slots + static_cast<std::ptrdiff_t>(batch) * kinds * 16 * W;
      assembly::prefetch_blocks<W>(slots, static_cast<int>(kinds), target.blocks);
      fe::ElementMatrix<Pack<W>> k;
      if constexpr (mixed)
        wall::mixed_tangent(state, law, body, coefficients, r, k);
      else
        wall::displacement_tangent(state, law, body, coefficients, r, k);
      if (group.prestress != nullptr) {
        const auto S0 = prestress_of<W>(group, batch);
        wall::add_prestress_residual(state, S0, r);
        wall::add_prestress_tangent(state, S0, coefficients, k);
      }
      if (batches.split)
        assembly::scatter_tangent_split<W>(k, slots, used, target.blocks);
      else
        assembly::scatter_tangent<W>(k, slots, used, target.blocks);
    } else {
      if constexpr (mixed)
        wall::mixed_residual(state, law, body, coefficients, r);
      else
        wall::displacement_residual(state, law, body, r);
      if (group.prestress != nullptr) wall::add_prestress_residual(state, prestress_of<W>(group, batch), r);
    }
    if (batches.split)
      assembly::scatter_residual_split<W>(r, nodes, batches.hosts + static_cast<std::ptrdiff_t>(batch) * 4 * W, used,
                                          target.residual);
    else
      assembly::scatter_residual<W>(r, nodes, used, target.residual);
  }
}

template <int W, wall::LawKind kind, bool mixed>
void loop_over_quadratic_wall(const WallGroupView& group, const FieldsView& fields, const WallElementSettings& settings,
                              const wall::Coefficients& coefficients, const LoopTarget& target) {
  namespace wq = wall::quadratic;
  constexpr int n = fe::quadratic_nodes;
  const BatchView& batches = group.batches;
  const std::ptrdiff_t kinds = batches.split ? 4 : 1;
  for (std::int32_t batch = 0; batch < batches.batches; ++batch) {
    const std::int32_t* nodes = batches.nodes + static_cast<std::ptrdiff_t>(batch) * n * W;
    wall::ElementState<Pack<W>> shape;
    wq::ElementState<Pack<W>> state;
    Vec3<Pack<W>> position[4], velocity[4];
    gather_vectors<W>(fields.reference_position, nodes, position);
    set_shape_of<W>(group, batch, position, shape);
    state.reference = shape.reference, state.axes = shape.axes;
    gather_vectors<W>(fields.displacement, nodes, state.displacement);
    gather_vectors<W>(fields.acceleration, nodes, state.acceleration);
    gather_vectors<W>(fields.velocity_pressure, nodes, velocity, state.pressure);
    const auto body = body_of<W>(group, batch, settings);
    const auto law = law_of<W, kind>(group, batch);
    const int used = used_lanes<W>(batches, batch);
    wq::PointPrestress<Pack<W>> prestress;
    load_prestress<W>(group, batch, prestress);
    wq::ElementVector<Pack<W>> r;
    if (target.blocks != nullptr) {
      const std::int32_t* slots = batches.slots + static_cast<std::ptrdiff_t>(batch) * kinds * n * n * W;
      prefetch_row<W>(0, slots, batches.split, target.blocks);
      wq::tangent<mixed>(state, law, body, coefficients, prestress, r, [&](int a, const wq::TangentRow<Pack<W>>& row) {
        if (a + 1 < n) prefetch_row<W>(a + 1, slots, batches.split, target.blocks);
        const bool corner = mixed && a < fe::nodes;
        scatter_row<W>({row.motion, mixed ? row.pressure : nullptr, corner ? row.constraint : nullptr,
                        corner ? row.compressibility : nullptr},
                       a, slots, batches.split, used, target.blocks);
      });
    } else {
      wq::residual<mixed>(state, law, body, coefficients, prestress, r);
    }
    const std::int32_t* hosts = batches.split ? batches.hosts + static_cast<std::ptrdiff_t>(batch) * n * W : nullptr;
    scatter_quadratic_residual<W>(r.momentum, r.constraint, nodes, hosts, used, target.residual);
  }
}

template <int W, wall::LawKind kind>
void wall_of_kind(const WallGroupView& group, const FieldsView& fields, const WallElementSettings& settings,
                  const wall::Coefficients& coefficients, const LoopTarget& target) {
  const bool with_tangent = target.blocks != nullptr;
  if (group.batches.quadratic && settings.mixed)
    loop_over_quadratic_wall<W, kind, true>(group, fields, settings, coefficients, target);
  else if (group.batches.quadratic)
    loop_over_quadratic_wall<W, kind, false>(group, fields, settings, coefficients, target);
  else if (settings.mixed && with_tangent)
    loop_over_wall<W, kind, true, true>(group, fields, settings, coefficients, target);
  else if (settings.mixed)
    loop_over_wall<W, kind, true, false>(group, fields, settings, coefficients, target);
  else if (with_tangent)
    loop_over_wall<W, kind, false, true>(group, fields, settings, coefficients, target);
  else
    loop_over_wall<W, kind, false, false>(group, fields, settings, coefficients, target);
}

template <int W>
void wall(const WallGroupView& group, const FieldsView& fields, const WallElementSettings& settings,
          const wall::Coefficients& coefficients, const LoopTarget& target) {
  switch (group.kind) {
    case wall::LawKind::linear:
      return wall_of_kind<W, wall::LawKind::linear>(group, fields, settings, coefficients, target);
    case wall::LawKind::isochoric:
      return wall_of_kind<W, wall::LawKind::isochoric>(group, fields, settings, coefficients, target);
    case wall::LawKind::unsplit:
      return wall_of_kind<W, wall::LawKind::unsplit>(group, fields, settings, coefficients, target);
  }
}

template <int W, wall::LawKind kind>
void modulus_of_kind(const WallGroupView& group, const FieldsView& fields, double* modulus) {
  for (std::int32_t batch = 0; batch < group.batches.batches; ++batch) {
    const std::int32_t* nodes = group.batches.nodes + static_cast<std::ptrdiff_t>(batch) * 4 * W;
    wall::ElementState<Pack<W>> state;
    Vec3<Pack<W>> position[4];
    gather_vectors<W>(fields.reference_position, nodes, position);
    set_reference_of<W>(group, batch, position, state);
    gather_vectors<W>(fields.displacement, nodes, state.displacement);
    wall::present_modulus(state, law_of<W, kind>(group, batch)).store(modulus + static_cast<std::ptrdiff_t>(batch) * W);
  }
}

template <int W>
void modulus(const WallGroupView& group, const FieldsView& fields, double* target) {
  switch (group.kind) {
    case wall::LawKind::linear:
      return modulus_of_kind<W, wall::LawKind::linear>(group, fields, target);
    case wall::LawKind::isochoric:
      return modulus_of_kind<W, wall::LawKind::isochoric>(group, fields, target);
    case wall::LawKind::unsplit:
      return modulus_of_kind<W, wall::LawKind::unsplit>(group, fields, target);
  }
}

}  // namespace

template <int W>
WallLoops wall_loops() {
  return {&wall<W>, &modulus<W>};
}

}  // namespace tunica::coupling
