// The two tests of `tunica verify` and their analytic solutions: fibres dispersed continuously, incompressible.
#pragma once

#include <string>
#include <vector>

#include "tunica/wall/material.hpp"

namespace tunica::stages {

/// Two fibre families with the same von Mises density in a neo-Hookean matrix.
struct DispersedFibres {
  double shear_modulus = 0.0, bulk_modulus = 0.0;  ///< Pa
  double k1 = 0.0, k2 = 0.0;                       ///< Pa, -
  double concentration = 3.0;                      ///< b
  Vec3<double> mean_direction{{0.0, 0.0, 1.0}};
  bool tension_only = true;

  static constexpr int families = 2;
  /// The same as a law of the program, represented by 256 directions of the octahedral set.
  wall::DfdParameters parameters() const;
};

enum class CubeLoading {
  extension,  ///< uniaxial along e3
  shear       ///< F = I + c e1 (x) e3
};

/// One curve of the figures.
struct CubeCase {
  CubeLoading loading = CubeLoading::extension;
  DispersedFibres material;

  std::string name() const;           ///< such as "mu 50 kPa (tension only)"
  std::vector<double> loads() const;  ///< stretches, amounts of shear; without the one at rest
};

/// The extension with mu = 50 and 100 kPa, then the shear, each with and without fibres under compression.
std::vector<CubeCase> cube_cases();

/// Cauchy stress [Pa] sigma_33 at a stretch along e3, or sigma_13 at an amount of shear in the plane of e1 and e3:
/// S = mu I + 2 sum over the families of the mean of rho f' N (x) N over the sphere, by adaptive Gauss-Kronrod
/// quadrature to about 1e-10; rho of docs/theory.md (1.7), f of (1.4). The extension needs the mean direction e3.
/// Throws SolverError when the quadrature does not reach 1e-8.
double analytic_stress(const CubeCase& c, double load);

}  // namespace tunica::stages
