#include "tunica/wall/material_paths.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tunica/base/error.hpp"

namespace tunica::wall {

namespace {

constexpr double balance_tolerance = 1e-11;  // of stresses relative to the largest, of volumes relative to the volume
constexpr int most_iterations = 40, most_halvings = 10, most_unknowns = 6;
constexpr double smallest_step = 1.0 / 256.0;  // of the way from the start to the target

/// The state at F with the pressure p, whether or not p belongs to J.
PathPoint state_at(const Law& law, const Volumetric& volumetric, const Mat3<double>& F, double pressure) {
  PathPoint at;
  at.F = F;
  at.pressure = pressure;
  const double J = determinant(F);
  const bool compressible = std::isfinite(volumetric.bulk_modulus);
  const double slope = compressible ? J * volumetric.bulk_modulus * volumetric.unit_stiffness(J) - pressure : -pressure;
  std::visit(
      [&](const auto& l) {
        at.state = detail::material_point(F, l, J, -pressure, slope);
        at.energy = elastic_energy(F, l);
      },
      law);
  if (compressible) at.energy += volumetric.bulk_modulus * volumetric.unit_energy(J);
  at.first_piola_kirchhoff = F * full(at.state.stress);
  return at;
}

Mat3<double> columns(const FibreFrame& axes) {
  Mat3<double> Q{};
  for (int i = 0; i < 3; ++i) Q(i, 0) = axes.e1[i], Q(i, 1) = axes.e2[i], Q(i, 2) = axes.e3[i];
  return Q;
}

/// U with C = U^T U, upper triangular; none when C is not positive definite.
std::optional<Mat3<double>> upper_root(const Symmetric<double>& C) {
  Mat3<double> U{};
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      double sum = C[voigt_index[i][j]];
      for (int k = 0; k < i; ++k) sum -= U(k, i) * U(k, j);
      if (i == j && !(sum > 0.0)) return std::nullopt;
      U(i, j) = i == j ? std::sqrt(sum) : sum / U(i, i);
    }
  return U;
}

/// Solves A x = b of at most six unknowns in place by elimination with row pivoting; false when A is singular.
bool eliminate(double (&A)[most_unknowns][most_unknowns], double (&b)[most_unknowns], int n) {
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(A[i][k]) > std::abs(A[pivot][k])) pivot = i;
    if (!(std::abs(A[pivot][k]) > 0.0)) return false;
    std::swap(A[k], A[pivot]);
    std::swap(b[k], b[pivot]);
    for (int i = k + 1; i < n; ++i) {
      const double factor = A[i][k] / A[k][k];
      for (int j = k; j < n; ++j) A[i][j] -= factor * A[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (int i = n - 1; i >= 0; --i) {
    for (int j = i + 1; j < n; ++j) b[i] -= A[i][j] * b[j];
    b[i] /= A[i][i];
  }
  return true;
}

/// Newton's method for the free components of C in the axes of the specimen and the pressure.
class Equilibrium {
 public:
  Equilibrium(const Law& law, const Volumetric& volumetric, const FibreFrame& axes, bool across_is_held)
      : law_(law), volumetric_(volumetric), rotation_(columns(axes)), modulus_(shear_modulus_at_rest(law)) {
    // Voigt 11 22 33 12 23 13
    for (const int n : across_is_held ? std::vector{2, 4, 5} : std::vector{1, 2, 3, 4, 5}) {
      const Vec3<double> a = column(voigt_row[n]), b = column(voigt_column[n]);
      Symmetric<double> B{};  // dC of a change of the component n
      for (int m = 0; m < voigt_size; ++m) {
        const int i = voigt_row[m], j = voigt_column[m];
        B[m] = n < 3 ? a[i] * a[j] : a[i] * b[j] + b[i] * a[j];
      }
      free_.push_back({n, B});
    }
  }

  /// From `start` to the held `stretches`; none when it does not converge, with the last residual in `residual`.
  std::optional<PathPoint> solve(const Stretches& stretches, const PathPoint& start, double& residual) const {
    Trial at = evaluate(predict(stretches, start), start.pressure);
    std::vector<double> residuals;
    for (int k = 0; k <= most_iterations && at.valid; ++k) {
      residuals.push_back(residual = at.norm);
      if (at.norm <= balance_tolerance) {
        at.point.residuals = std::move(residuals);
        return at.point;
      }
      if (!improve(at)) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  struct Component {
    int voigt;
    Symmetric<double> direction;
  };
  struct Trial {
    bool valid = false;
    Symmetric<double> C{};  ///< in the axes of the specimen
    PathPoint point;
    double volume = 0.0;  ///< g(J) + p/K
    double norm = 0.0;
  };

  Vec3<double> column(int j) const { return {{rotation_(0, j), rotation_(1, j), rotation_(2, j)}}; }

  /// C of `start` stretched to the held values at constant volume.
  Symmetric<double> predict(const Stretches& s, const PathPoint& start) const {
    const Mat3<double> F = start.F * rotation_;
    Symmetric<double> C = right_cauchy_green(F);
    const double along = s.along / std::sqrt(C[0]);
    const double across = s.across ? *s.across / std::sqrt(C[1]) : 1.0 / std::sqrt(along);
    const double factor[3] = {along, across, 1.0 / (along * across)};
    for (int n = 0; n < voigt_size; ++n) C[n] *= factor[voigt_row[n]] * factor[voigt_column[n]];
    C[0] = s.along * s.along;
    if (s.across) C[1] = *s.across * *s.across, C[3] = 0.0;
    return C;
  }

  Trial evaluate(const Symmetric<double>& C, double pressure) const {
    Trial t;
    const auto U = upper_root(C);
    if (!U) return t;
    t.C = C;
    t.point = state_at(law_, volumetric_, rotation_ * *U * transpose(rotation_), pressure);
    t.volume = volumetric_.unit_pressure(t.point.state.J) + pressure * volumetric_.compressibility();
    const double scale = std::max(modulus_, norm(t.point.state.stress));
    double sum = t.volume * t.volume;
    for (const Component& c : free_) {
      const double r = double_dot(t.point.state.stress, c.direction) / scale;
      sum += r * r;
    }
    t.norm = std::sqrt(sum);
    t.valid = std::isfinite(t.norm) && std::isfinite(scale);
    return t;
  }

  /// One Newton increment, halved until the residual falls.
  bool improve(Trial& at) const {
    const int m = static_cast<int>(free_.size());
    double A[most_unknowns][most_unknowns], b[most_unknowns];
    linearise(at, A, b);
    if (!eliminate(A, b, m + 1)) return false;
    double length = 1.0;
    for (int halving = 0; halving <= most_halvings; ++halving, length *= 0.5) {
      Symmetric<double> C = at.C;
      for (int n = 0; n < m; ++n) C[free_[n].voigt] += length * b[n];
      Trial next = evaluate(C, at.point.pressure + length * b[m] * modulus_);
      if (!next.valid || (next.norm > (1.0 - 1e-4 * length) * at.norm && next.norm > balance_tolerance)) continue;
      at = std::move(next);
      return true;
    }
    return false;
  }

  /// Unknowns: free components of C, p over the modulus. Rows: their stresses over the modulus, the volume.
  void linearise(const Trial& at, double (&A)[most_unknowns][most_unknowns], double (&b)[most_unknowns]) const {
    const int m = static_cast<int>(free_.size());
    const double J = at.point.state.J;
    std::array<Symmetric<double>, most_unknowns> dS;
    const PathPoint fixed_pressure = state_at(law_, {volumetric_.energy}, at.point.F, at.point.pressure);
    for (int n = 0; n < m; ++n)
      for (int k = 0; k < voigt_size; ++k) {
        double sum = 0.0;
        for (int l = 0; l < voigt_size; ++l)
          sum += (l < 3 ? 0.5 : 1.0) * fixed_pressure.state.tangent(k, l) * free_[n].direction[l];
        dS[n][k] = sum;
      }
    const Mat3<double> F_inverse = inverse(at.point.F), C_inverse = F_inverse * transpose(F_inverse);
    for (int i = 0; i < m; ++i) {
      const Symmetric<double>& B = free_[i].direction;
      const double trace = double_dot(C_inverse, full(B));  // dJ = J/2 C^-1 : dC
      for (int n = 0; n < m; ++n) A[i][n] = double_dot(B, dS[n]) / modulus_;
      A[i][m] = -J * trace;
      A[m][i] = 0.5 * volumetric_.unit_stiffness(J) * J * trace;
      b[i] = -double_dot(at.point.state.stress, B) / modulus_;
    }
    A[m][m] = modulus_ * volumetric_.compressibility();
    b[m] = -at.volume;
  }

  const Law& law_;
  Volumetric volumetric_;
  Mat3<double> rotation_;  ///< axes of the specimen as columns
  double modulus_;
  std::vector<Component> free_;
};

std::string text(const Stretches& s) {
  return fmt::format("a stretch of {:.6g}", s.along) +
         (s.across ? fmt::format(" along and {:.6g} across", *s.across) : "");
}

}  // namespace

PathPoint stretched(const Law& law, const Volumetric& volumetric, const FibreFrame& axes, const Stretches& stretches,
                    const PathPoint& start) {
  const Equilibrium equilibrium(law, volumetric, axes, stretches.across.has_value());
  const double along = norm(start.F * axes.e1), across = norm(start.F * axes.e2);
  PathPoint at = start;
  double done = 0.0, step = 1.0, residual = 0.0;
  while (done < 1.0) {
    const double share = std::min(1.0, done + step);
    Stretches target{along + share * (stretches.along - along), std::nullopt};
    if (stretches.across) target.across = across + share * (*stretches.across - across);
    if (auto next = equilibrium.solve(share < 1.0 ? target : stretches, at, residual)) {
      at = std::move(*next);
      done = share;
    } else if ((step *= 0.5) < smallest_step) {
      throw SolverError(
          fmt::format("no equilibrium at {}: Newton's method stops at a residual of {:.3e} of the "
                      "stress, asked {:.0e}; it came as far as {:.0f} % of the last step",
                      text(stretches), residual, balance_tolerance, 100.0 * done));
    }
  }
  return at;
}

PathPoint sheared(const Law& law, const Volumetric& volumetric, const FibreFrame& axes, double shear) {
  Mat3<double> F = identity<double>();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) F(i, j) += shear * axes.e1[i] * axes.e2[j];
  if (std::isfinite(volumetric.bulk_modulus)) return state_at(law, volumetric, F, 0.0);
  // F^T a3 = a3, so that the traction is a3 . S a3, and the pressure adds -p to it.
  const PathPoint isochoric = state_at(law, volumetric, F, 0.0);
  return state_at(law, volumetric, F, dot(axes.e3, isochoric.state.stress * axes.e3));
}

PathPoint deformed(const Law& law, const Volumetric& volumetric, const Mat3<double>& F) {
  const double pressure = std::isfinite(volumetric.bulk_modulus)
                              ? -volumetric.bulk_modulus * volumetric.unit_pressure(determinant(F))
                              : 0.0;
  return state_at(law, volumetric, F, pressure);
}

std::optional<Symmetric<double>> sheet_stress(const Law& law, const FibreFrame& axes, double C11, double C22,
                                              double C12) {
  const double area = C11 * C22 - C12 * C12;
  if (!(area > 0.0)) return std::nullopt;
  const Mat3<double> Q = columns(axes);
  const Mat3<double> in_axes = full(Symmetric<double>{{C11, C22, 1.0 / area, C12, 0.0, 0.0}});
  const Mat3<double> turned = Q * in_axes * transpose(Q);
  Symmetric<double> C;
  for (int n = 0; n < voigt_size; ++n) C[n] = turned(voigt_row[n], voigt_column[n]);
  const Symmetric<double> elastic = std::visit(
      [&](const auto& l) {
        Symmetric<double> S = stress(l, C);
        if constexpr (can_be_unsplit<std::decay_t<decltype(l)>>)
          if (l.has_unsplit_part()) S = S + l.unsplit_stress(C);
        return S;
      },
      law);
  const Mat3<double> S_axes = transpose(Q) * full(elastic) * Q;
  Symmetric<double> S;
  for (int n = 0; n < voigt_size; ++n) S[n] = S_axes(voigt_row[n], voigt_column[n]);
  if (std::max(std::abs(S[4]), std::abs(S[5])) > balance_tolerance * std::max(shear_modulus_at_rest(law), norm(S)))
    return std::nullopt;
  // S - (S33 / C33^-1) C^-1, C33^-1 = area
  const double share = S[2] / area;
  S[0] -= share * C22 / area;
  S[1] -= share * C11 / area;
  S[3] += share * C12 / area;
  S[2] = S[4] = S[5] = 0.0;
  return S;
}

const char* name_of(StressMeasure measure) {
  constexpr const char* names[] = {"Cauchy stress", "first Piola-Kirchhoff stress", "second Piola-Kirchhoff stress"};
  return names[static_cast<int>(measure)];
}

double stress_component(const PathPoint& point, StressMeasure measure, const Vec3<double>& direction,
                        const Vec3<double>& normal) {
  switch (measure) {
    case StressMeasure::cauchy:
      return dot(direction, point.state.cauchy * normal);
    case StressMeasure::first_piola_kirchhoff:
      return dot(direction, point.first_piola_kirchhoff * normal);
    case StressMeasure::second_piola_kirchhoff:
      break;
  }
  return dot(direction, point.state.stress * normal);
}

FibreFrame specimen_axes(const Vec3<double>& along) {
  const Vec3<double> e1{{1.0, 0.0, 0.0}}, e3{{0.0, 0.0, 1.0}}, in_plane = cross(e3, along);
  return orthonormal_frame(along, norm(in_plane) > 0.01 * norm(along) ? in_plane : e1, "specimen");
}

}  // namespace tunica::wall
