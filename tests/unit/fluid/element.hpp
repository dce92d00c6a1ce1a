// Elements and states for the tests of the flow kernels.
#pragma once

#include <random>

#include "tunica/fluid/rbvms.hpp"

namespace tunica::fluid::test {

inline const Parameters blood{.density = 1060.0, .viscosity = Newtonian{}};
inline const TimeCoefficients step{.dt = 1e-3, .acceleration = 1250.0, .velocity = 0.8};

template <class T>
Vec3<T> convert(const Vec3<double>& x) {
  return {{T(x[0]), T(x[1]), T(x[2])}};
}

/// The same state in another scalar type.
template <class T>
ElementState<T> convert(const ElementState<double>& s) {
  ElementState<T> r;
  for (int a = 0; a < 4; ++a) {
    r.position[a] = convert<T>(s.position[a]);
    r.velocity[a] = convert<T>(s.velocity[a]);
    r.acceleration[a] = convert<T>(s.acceleration[a]);
    r.mesh_velocity[a] = convert<T>(s.mesh_velocity[a]);
    r.pressure[a] = T(s.pressure[a]);
  }
  return r;
}

/// Stabilisation parameters that do not depend on the state.
template <class T>
Tau<T> frozen(const Tau<double>& tau) {
  Tau<T> r;
  for (int q = 0; q < 4; ++q) {
    r.m[q] = T(tau.m[q]);
    r.c[q] = T(tau.c[q]);
    r.b[q] = T(tau.b[q]);
  }
  return r;
}

/// An element of 1 mm size with blood-like random nodal values.
class RandomElement {
 public:
  explicit RandomElement(unsigned seed) : engine_(seed) {}
  double operator()(double scale) { return scale * uniform_(engine_); }
  Vec3<double> vector(double scale) { return {{(*this)(scale), (*this)(scale), (*this)(scale)}}; }

  ElementState<double> state() {
    const double h = 1e-3;
    ElementState<double> s;
    s.position[0] = {{0, 0, 0}};
    s.position[1] = {{h, 0, 0}};
    s.position[2] = {{0, h, 0}};
    s.position[3] = {{0, 0, h}};
    for (int a = 0; a < 4; ++a) {
      s.position[a] = s.position[a] + vector(0.2 * h);
      s.velocity[a] = vector(0.5);
      s.acceleration[a] = vector(10.0);
      s.mesh_velocity[a] = vector(0.05);
      s.pressure[a] = 1e4 + (*this)(100.0);
    }
    return s;
  }

 private:
  std::mt19937 engine_;
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

}  // namespace tunica::fluid::test
