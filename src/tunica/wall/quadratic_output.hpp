// Energies and volume of the quadratic wall elements.
#pragma once

#include "tunica/wall/output.hpp"
#include "tunica/wall/quadratic_element.hpp"

namespace tunica::wall::quadratic {

/// Kinetic energy [J] with the consistent mass, from nodal velocities [m/s].
template <class T>
inline T kinetic_energy(const T& volume, const Vec3<T> (&velocity)[nodes], double density) {
  T sum(0.0);
  for (int a = 0; a < nodes; ++a)
    for (int b = 0; b < nodes; ++b) sum += T(fe::quadratic_mass[a][b]) * dot(velocity[a], velocity[b]);
  return T(0.5 * density) * volume * sum;
}

/// Present volume [m^3].
template <class T>
inline T present_volume(const ElementState<T>& e) {
  T sum(0.0);
  for (const auto& point : fe::quadratic_four_points) {
    const wall::ElementState<T> s = at_point(e, point);
    sum += s.reference.volume * determinant(deformation_gradient(s));
  }
  return sum;
}

/// Stored energy [J], see output.hpp, with that of the prestress.
template <bool mixed, class T, class L>
inline T strain_energy(const ElementState<T>& e, const L& law, const Body& body,
                       const std::type_identity_t<PointPrestress<T>>& prestress) {
  T sum(0.0);
  for (int q = 0; q < points; ++q) {
    const wall::ElementState<T> s = at_point(e, q, prestress);
    const auto& here = detail::law_at(law, q);
    const auto body_here = body.at_point(q);
    if constexpr (mixed) {
      const T J = determinant(deformation_gradient(s));
      const T c = body_here.volumetric.unit_pressure(J) + body_here.volumetric.compressibility() * s.pressure[0];
      sum += mixed_strain_energy(s, here, body_here);  // without the subscale, as there is no gradient of p
      sum += T(0.5) * s.reference.volume * detail::augmentation<T>(here, body_here) * c * c;
    } else
      sum += displacement_strain_energy(s, here, body_here);
    if (const auto* S0 = prestress.stress_of(q)) sum += prestress_energy(s, *S0);
  }
  return sum;
}

}  // namespace tunica::wall::quadratic
