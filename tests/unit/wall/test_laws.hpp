// Laws and states shared by the wall tests.
#pragma once

#include <random>

#include "tunica/wall/element.hpp"
#include "tunica/wall/material.hpp"

namespace tunica::wall::test {

/// A stiffening, anisotropic law with every entry of the tangent in use; only its energy is given.
struct ExponentialFibre {
  double shear_modulus = 3.0;
  template <class T>
  T energy(const Symmetric<T>& C) const {
    const T fibre =
        T(0.36) * C[0] + T(0.48) * C[1] + T(0.16) * C[2] + T(2.0) * (T(0.3) * C[3] - T(0.2) * C[5]) - T(1.0);
    const T second = C[1] + T(0.7) * C[4] - T(1.0);
    return T(0.5 * shear_modulus) * (trace(C) - T(3.0)) + exp(T(1.5) * fibre * fibre) - T(1.0) +
           T(0.4) * second * second * second;
  }
  double shear_modulus_at_rest() const { return shear_modulus; }
};

/// mu/2 (I1 - 3) + k (I - 1)^2 with the squared stretch I of a fibre along N, in the axes of the law.
struct FibreAlong {
  Vec3<double> N;
  double stiffness, shear_modulus;
  template <class T>
  T energy(const Symmetric<T>& C) const {
    T strain(-1.0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) strain += T(N[i] * N[j]) * C[voigt_index[i][j]];
    return T(0.5 * shear_modulus) * (trace(C) - T(3.0)) + T(stiffness) * strain * strain;
  }
  double shear_modulus_at_rest() const { return shear_modulus; }
};

/// Neo-Hooke without its fast path.
struct SlowNeoHooke {
  double shear_modulus;
  template <class T>
  T energy(const Symmetric<T>& C) const {
    return T(0.5 * shear_modulus) * (trace(C) - T(3.0));
  }
  double shear_modulus_at_rest() const { return shear_modulus; }
};

static_assert(Material<ExponentialFibre> && Material<NeoHooke> && Material<SlowNeoHooke>);

inline Vec3<double> random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  return {{uniform(random), uniform(random), uniform(random)}};
}

inline fe::Gradients<double> some_tetrahedron(std::mt19937& random) {
  const Vec3<double> corner[4] = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  Vec3<double> x[4];
  for (int a = 0; a < 4; ++a) x[a] = corner[a] + random_vector(random, 0.15);
  return fe::gradients(x);
}

inline ElementState<double> some_state(std::mt19937& random, double displacement = 0.1) {
  ElementState<double> e;
  e.reference = some_tetrahedron(random);
  for (int a = 0; a < 4; ++a) {
    e.displacement[a] = random_vector(random, displacement);
    e.acceleration[a] = random_vector(random, 2.0);
    e.pressure[a] = random_vector(random, 4.0)[0];
  }
  return e;
}

template <class T>
ElementState<T> converted(const ElementState<double>& e) {
  ElementState<T> r;
  r.reference.volume = T(e.reference.volume);
  for (int a = 0; a < 4; ++a) {
    r.pressure[a] = T(e.pressure[a]);
    for (int i = 0; i < 3; ++i) {
      r.reference.dN[a][i] = T(e.reference.dN[a][i]);
      r.displacement[a][i] = T(e.displacement[a][i]);
      r.acceleration[a][i] = T(e.acceleration[a][i]);
    }
  }
  return r;
}

}  // namespace tunica::wall::test
