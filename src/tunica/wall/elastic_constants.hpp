// Small-strain constants of a law, as the case file gives them: one of Young's and shear modulus, one of Poisson's
// ratio and bulk modulus.
#pragma once

#include <limits>
#include <optional>

#include "tunica/config/schema.hpp"

namespace tunica::wall {

/// What says how far a law whose stiffness has other names can be compressed.
struct Compressibility {
  std::optional<double> poisson_ratio = {};  ///< nu at small strain, 0.5 is incompressible
  std::optional<double> bulk_modulus = {};   ///< K [Pa]

  /// K [Pa] for the shear modulus at rest [Pa], infinite for nu = 0.5. The constants must have passed check().
  double bulk(double shear_modulus) const;

  /// Adds what is missing or given twice.
  void check(config::Problems& problems) const;

  static config::Schema<Compressibility> schema();
};

struct ElasticConstants {
  std::optional<double> young_modulus = {};  ///< E [Pa]
  std::optional<double> shear_modulus = {};  ///< mu [Pa]
  std::optional<double> poisson_ratio = {};  ///< nu, 0.5 is incompressible
  std::optional<double> bulk_modulus = {};   ///< K [Pa]

  /// mu [Pa]. The constants must have passed check().
  double shear() const;
  /// K [Pa], infinite for nu = 0.5. The constants must have passed check().
  double bulk() const;

  /// Adds what is missing, given twice, or impossible.
  void check(config::Problems& problems) const;

  static config::Schema<ElasticConstants> schema();
};

}  // namespace tunica::wall
