// Orientation densities of dispersed fibres, in the fibre frame: e1 circumferential, e2 longitudinal, e3 radial.
#pragma once

#include <variant>

#include "tunica/base/tensor.hpp"

namespace tunica::wall {

/// Rotationally symmetric von Mises density, docs/theory.md (1.7); Gasser, Ogden & Holzapfel (2006),
/// doi:10.1098/rsif.2005.0073.
struct VonMises {
  double concentration = 0.0;                    ///< b >= 0, 0 is isotropic
  Vec3<double> mean_direction{{1.0, 0.0, 0.0}};  ///< M, unit vector
};

/// Bivariate von Mises density, docs/theory.md (1.8); Holzapfel et al. (2015), doi:10.1098/rsif.2015.0188.
struct BivariateVonMises {
  double in_plane = 0.0;      ///< a >= 0, 0 is isotropic in the e1-e2 plane
  double out_of_plane = 0.0;  ///< b >= 0, 0 is isotropic about the plane, large is planar
  double mean_angle = 0.0;    ///< alpha, from e1 towards e2 [rad]
};

using Density = std::variant<VonMises, BivariateVonMises>;

/// rho(N) >= 0 of the unit vector N; rho(-N) = rho(N), and the mean over the sphere is 1. Finite for every
/// concentration. The bivariate density has no limit at N = e3 when a > 0: its mean over the in-plane angle is returned
/// there.
double density(const Density& d, const Vec3<double>& N);

/// kappa of the structure tensor kappa I + (1 - 3 kappa) M x M: 1/3 isotropic, 0 aligned.
double kappa(const VonMises& d);
/// kappa_ip of docs/theory.md (1.8): 1/2 isotropic in the plane, 0 aligned.
double kappa_in_plane(const BivariateVonMises& d);
/// kappa_op of docs/theory.md (1.8): 1/2 planar, 1/3 isotropic out of the plane.
double kappa_out_of_plane(const BivariateVonMises& d);

}  // namespace tunica::wall
