// Parameters of the mesh motion.
#pragma once

namespace tunica::config {
template <class T>
class Schema;
}

namespace tunica::ale {

/// Pseudo-elastic extension of the wall's motion into the lumen, section 3 of the theory.
struct Parameters {
  double poisson_ratio = 0.3;        ///< nu [-], below 1/2
  double stiffening_exponent = 1.0;  ///< chi [-]: small elements are stiffer by (mean volume / volume)^chi
  double minimum_quality = 0.1;      ///< least admissible scaled Jacobian relative to that of the initial mesh [-]

  static config::Schema<Parameters> schema();
};

}  // namespace tunica::ale
