// Manufactured solutions at finite deformation: orders of convergence of both elements.
//
// A smooth u(X) and p(X) are chosen; the body force b = -Div P(F, p), evaluated with nested dual numbers, and the
// traction P N on the face z_max enter as nodal forces, u itself on the other faces.
#include <array>

#include "tunica/base/dual.hpp"
#include "verification/wall/solid.hpp"

namespace tunica::verification {
namespace {

using D = Dual<double, 3>;

constexpr double mu = 5e4;  // Pa
constexpr double L = 0.01;  // edge of the block [m]

// sin x where Dual has none.
double sine(double x) { return std::sin(x); }
double cosine(double x) { return std::cos(x); }
template <class T, int N>
Dual<T, N> cosine(const Dual<T, N>& x);
template <class T, int N>
Dual<T, N> sine(const Dual<T, N>& x) {
  return Dual<T, N>::chain(x, sine(x.value), cosine(x.value));
}
template <class T, int N>
Dual<T, N> cosine(const Dual<T, N>& x) {
  return Dual<T, N>::chain(x, cosine(x.value), -sine(x.value));
}

/// General smooth motion with volume change; the pressure follows from the volumetric energy.
struct Compressible {
  double poisson_ratio = 0.3;
  bool follows_volume = true;
  template <class T>
  Vec3<T> position(const Vec3<T>& X) const {
    const T k(2.0 / L), a(0.06 * L);
    return {{X[0] + a * sine(k * X[0]) * cosine(k * X[1]) + a * sine(k * X[2]), X[1] + a * sine(k * (X[1] + X[2])),
             X[2] + a * cosine(k * X[0]) * sine(k * X[1])}};
  }
  template <class T>
  T pressure(const Vec3<T>&) const {
    return T(0.0);
  }
};

/// Two successive shears, J = 1 exactly, with a pressure of its own: incompressible.
struct Isochoric {
  double poisson_ratio = 0.5;
  bool follows_volume = false;
  template <class T>
  Vec3<T> position(const Vec3<T>& X) const {
    const T k(1.2 / L), a(0.15 * L);
    const T x = X[0] + a * sine(k * X[1]) * cosine(k * X[2]);
    return {{x, X[1] + a * sine(k * x), X[2]}};
  }
  template <class T>
  T pressure(const Vec3<T>& X) const {
    const T k(1.2 / L);
    return T(0.5 * mu) * cosine(k * X[0]) * sine(k * X[1] + k * X[2]);
  }
};

/// The shears and a small stretch along z, so that p = -U'(J) is of the order of mu although K is 5000 times mu.
struct NearlyIsochoric {
  double poisson_ratio = 0.4999;
  bool follows_volume = true;
  template <class T>
  Vec3<T> position(const Vec3<T>& X) const {
    const T k(1.2 / L), a(0.15 * L), small(0.3 * L * mu / bulk());
    const T x = X[0] + a * sine(k * X[1]) * cosine(k * X[2]);
    return {{x, X[1] + a * sine(k * x), X[2] + small * cosine(k * X[0]) * sine(k * (X[1] + X[2]))}};
  }
  template <class T>
  T pressure(const Vec3<T>&) const {
    return T(0.0);
  }
  double bulk() const { return 2.0 * mu * (1.0 + poisson_ratio) / (3.0 * (1.0 - 2.0 * poisson_ratio)); }
};

template <class T>
struct PointStress {
  Mat3<T> F, P;
  T p;
};

/// P = J^(-2/3) mu (F - tr(C)/3 F^-T) - p J F^-T of the isochoric neo-Hooke law.
template <class Motion, class T>
PointStress<T> stress_at(const Motion& motion, const wall::Volumetric& volumetric, const Vec3<T>& X) {
  using S = Dual<T, 3>;
  Vec3<S> Y;
  for (int i = 0; i < 3; ++i) Y[i] = S::variable(X[i], i);
  const Vec3<S> x = motion.position(Y);
  PointStress<T> s;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) s.F(i, j) = x[i].d[j];
  const T J = determinant(s.F);
  s.p = motion.follows_volume ? T(-volumetric.bulk_modulus) * volumetric.unit_pressure(J) : motion.pressure(X);
  const Mat3<T> inverse_T = transpose(inverse(s.F));
  const T scale = T(mu) * pow(J, -2.0 / 3.0), isotropic = -T(1.0 / 3.0) * double_dot(s.F, s.F) * scale - s.p * J;
  s.P = scale * s.F + isotropic * inverse_T;
  return s;
}

/// -Div P [N/m^3].
template <class Motion>
Vec3<double> body_force(const Motion& motion, const wall::Volumetric& volumetric, const Vec3<double>& X) {
  Vec3<D> Y;
  for (int i = 0; i < 3; ++i) Y[i] = D::variable(X[i], i);
  const auto s = stress_at(motion, volumetric, Y);
  Vec3<double> b{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) b[i] -= s.P(i, j).d[j];
  return b;
}

Vec3<double> point(const Vec3<double>* X, const double* barycentric, int corners) {
  Vec3<double> x{};
  for (int a = 0; a < corners; ++a) x = x + barycentric[a] * X[a];
  return x;
}

template <class Motion>
std::vector<double> nodal_forces(const distributed::DistributedMesh& mesh, const Motion& motion,
                                 const wall::Volumetric& volumetric) {
  std::vector<double> forces(at(mesh.nodes()), 0.0);
  const auto add = [&](std::int32_t node, double factor, const Vec3<double>& f) {
    for (int c = 0; c < 3; ++c) forces[at(node) + c] += factor * f[c];
  };
  for (const auto& nodes : mesh.regions[0].elements) {
    Vec3<double> X[4];
    for (int a = 0; a < 4; ++a) X[a] = mesh.points[nodes[a]];
    const double volume = fe::gradients(X).volume;
    for (const auto& q : fe::four_points) {
      const Vec3<double> b = body_force(motion, volumetric, point(X, q.barycentric, 4));
      for (int a = 0; a < 4; ++a) add(nodes[a], q.weight * volume * q.barycentric[a], b);
    }
  }
  for (const auto& nodes : mesh.face("z_max").triangles) {
    Vec3<double> X[3];
    for (int a = 0; a < 3; ++a) X[a] = mesh.points[nodes[a]];
    const Vec3<double> area = 0.5 * cross(X[1] - X[0], X[2] - X[0]);
    for (const auto& q : fe::three_points) {
      const Vec3<double> t = stress_at(motion, volumetric, point(X, q.barycentric, 3)).P * area;
      for (int a = 0; a < 3; ++a) add(nodes[a], q.weight * q.barycentric[a], t);
    }
  }
  return forces;
}

struct Errors {
  double u = 0, gradient = 0, pressure = 0;  ///< relative L2 norms; the pressure relative to mu
};

/// Nodes and weights of the product Gauss rule of order 4 on the tetrahedron (Duffy's map).
template <class Visit>
void for_each_point(const Visit& visit) {
  constexpr double x[4] = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263};
  constexpr double w[4] = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) {
        const double r = x[i], s = x[j] * (1 - r), t = x[k] * (1 - r - s);
        const double barycentric[4] = {1 - r - s - t, r, s, t};
        visit(barycentric, 6.0 * w[i] * w[j] * w[k] * (1 - r) * (1 - r - s));
      }
}

template <class Motion>
Errors errors(const Problem& problem, const State& state, const Motion& motion, const wall::Volumetric& volumetric) {
  double sums[5] = {};  // |du|^2, |u|^2, |dF|^2, |F - I|^2, dp^2
  for_each_element(problem.mesh(), problem.wall_model(), state, [&](const ElementData& e) {
    const Mat3<double> F = wall::deformation_gradient(e.state);
    for_each_point([&](const double* barycentric, double weight) {
      const Vec3<double> X = point(e.X, barycentric, 4);
      const Vec3<double> u = motion.position(X) - X, u_h = point(e.state.displacement, barycentric, 4);
      const auto s = stress_at(motion, volumetric, X);
      const Mat3<double> dF = F + (-1.0) * s.F, H = s.F + (-1.0) * identity<double>();
      double p_h = 0;
      for (int a = 0; a < 4; ++a) p_h += barycentric[a] * e.state.pressure[a];
      const double w = weight * e.state.reference.volume;
      sums[0] += w * dot(u_h - u, u_h - u);
      sums[1] += w * dot(u, u);
      sums[2] += w * double_dot(dF, dF);
      sums[3] += w * double_dot(H, H);
      sums[4] += w * (p_h - s.p) * (p_h - s.p);
    });
  });
  parallel::global_sum(problem.mesh().comm, sums);
  return {std::sqrt(sums[0] / sums[1]), std::sqrt(sums[2] / sums[3]), std::sqrt(sums[4] / (L * L * L)) / mu};
}

template <class Motion>
Errors solve(Element element, int n, const Motion& motion) {
  const auto mesh = share(mesh::box(n, n, n, {{L, L, L}}, mesh::RegionKind::wall));
  auto in = solid_input({element, mu, motion.poisson_ratio}, {{"x_min", bc::Fixed{}},
                                                              {"x_max", bc::Fixed{}},
                                                              {"y_min", bc::Fixed{}},
                                                              {"y_max", bc::Fixed{}},
                                                              {"z_min", bc::Fixed{}},
                                                              {"z_max", bc::Free{}}});
  in.newton.relative_tolerance = 1e-7;
  Problem problem(mesh, in);
  const wall::Volumetric volumetric = problem.input().wall->body().volumetric;
  problem.set_nodal_forces(nodal_forces(mesh, motion, volumetric));
  State state = problem.initial_state();
  set_displacement(mesh, state, [&](const Vec3<double>& X) { return motion.position(X) - X; });
  const auto report = problem.solve_static(state, 1.0);
  EXPECT_TRUE(report.converged) << report.failure;
  return errors(problem, state, motion, volumetric);
}

/// `asked`: least orders of u in L2, grad u in L2 and p in L2 between the two finest meshes.
template <class Motion>
void check_orders(const char* title, Element element, const Motion& motion, std::array<double, 3> asked) {
  print("manufactured, %s, %s element, nu %.4g\n     n   error u   order  error F   order  error p/mu order\n", title,
        name(element), motion.poisson_ratio);
  Errors last;
  for (const int n : {6, 12, 24}) {
    const Errors e = solve(element, n, motion);
    const double order[3] = {std::log2(last.u / e.u), std::log2(last.gradient / e.gradient),
                             std::log2(last.pressure / e.pressure)};
    if (n == 6)
      print("  %4d   %.3e        %.3e        %.3e\n", n, e.u, e.gradient, e.pressure);
    else
      print("  %4d   %.3e  %.2f  %.3e  %.2f  %.3e  %.2f\n", n, e.u, order[0], e.gradient, order[1], e.pressure,
            order[2]);
    if (n == 24) {
      EXPECT_GT(order[0], asked[0]);
      EXPECT_GT(order[1], asked[1]);
      if (element == Element::mixed) {
        EXPECT_GT(order[2], asked[2]);
      }
    }
    last = e;
  }
}

TEST(Manufactured, CompressibleDisplacementElement) {
  check_orders("compressible", Element::displacement, Compressible{}, {1.9, 0.95, 0});
}
TEST(Manufactured, CompressibleMixedElement) {
  check_orders("compressible", Element::mixed, Compressible{}, {1.85, 0.95, 1.0});
}
TEST(Manufactured, NearlyIncompressibleMixedElement) {
  check_orders("nearly incompressible", Element::mixed, NearlyIsochoric{}, {1.8, 0.95, 1.0});
}
TEST(Manufactured, IncompressibleMixedElement) {
  check_orders("incompressible", Element::mixed, Isochoric{}, {1.8, 0.95, 1.0});
}

}  // namespace
}  // namespace tunica::verification
