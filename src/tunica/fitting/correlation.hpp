// How alike neighbouring residuals of a test are, and by how much a fit has made them smaller and less alike than the
// noise: what its parameters could follow they have taken, the slow changes before all.
#pragma once

#include <vector>

#include "tunica/fitting/model.hpp"

namespace tunica::fitting {

/// Residuals at fitted values, and how they change with the unknowns.
struct Linearised {
  std::vector<double> residuals;  ///< weighted [kPa], as Model::residuals
  std::vector<double> slopes;     ///< jacobian() there
  std::vector<bool> held;         ///< unknowns that sit on a bound and cannot follow the noise
};

/// Of noise that each row hands on to the next by a share, the same in all protocols.
struct Correlation {
  double share = 0.0;          ///< of one row that the next one has
  double length = 1.0;         ///< rows of a protocol that together tell as much as one independent one
  double lost_variance = 1.0;  ///< variance of the residuals over that of the noise, <= 1

  /// length of noise that is cut into blocks of so many rows.
  double length_in_blocks(double rows) const;
};

/// The share at which noise, once a fit has taken out what its unknowns can follow, has the correlation of neighbours
/// that the residuals have; or the one that gives the sum of all autocorrelations of the residuals, if that is longer,
/// as it is where the law is not the tissue. At most as long as the longest protocol.
Correlation correlation_of(const Model& model, const Linearised& fitted);

/// Two-sided 95 % quantile of Student's distribution; of fewer than one degree of freedom as of one.
double student_95(double degrees_of_freedom);

}  // namespace tunica::fitting
