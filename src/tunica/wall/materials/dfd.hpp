// Discrete fibre dispersion (DFD): a matrix with fibre families whose orientation density is represented by directions.
#pragma once

#include <string>
#include <variant>

#include "tunica/wall/elastic_constants.hpp"
#include "tunica/wall/fibres/density.hpp"
#include "tunica/wall/fibres/directions.hpp"
#include "tunica/wall/materials/discrete_fibres.hpp"
#include "tunica/wall/materials/fibre_options.hpp"
#include "tunica/wall/materials/fibre_reinforced.hpp"

namespace tunica::wall {

struct DiscreteFibreLaw : FibreReinforced<DiscreteFibres> {
  std::vector<std::string> notes;  ///< rule, directions and error of each family
};

/// Parts of DfdParameters.
namespace dfd {

/// Von Mises density, rotationally symmetric about a mean direction in or out of the plane of the wall, (1.7).
struct Symmetric {
  double concentration = 0.0;                  ///< b >= 0, 0 is isotropic
  std::optional<double> mean_angle;            ///< from e1 towards e2 [rad]; or the next
  std::optional<Vec3<double>> mean_direction;  ///< in the fibre frame, of any length but 0
  static config::Schema<Symmetric> schema();
};
/// Bivariate von Mises density, (1.8).
struct Bivariate {
  double in_plane = 0.0, out_of_plane = 0.0;  ///< a >= 0, b >= 0
  double mean_angle = 0.0;                    ///< [rad]
  static config::Schema<Bivariate> schema();
};
using Orientation = std::variant<Symmetric, Bivariate>;

struct Family {
  FibreEnergy energy;
  Orientation orientation;
  std::vector<Degradation> degradation;
  static config::Schema<Family> schema();

  Density density() const;
};

/// The cheapest product rule whose estimated error of the stress is below the tolerance.
struct Automatic {
  double tolerance = 0.005;
  static config::Schema<Automatic> schema();
};
/// m = 4^(l+1) spherical triangles of the octahedral hemisphere.
struct Octahedral {
  int count = 256;
  static config::Schema<Octahedral> schema();
};
/// Gauss points across times equidistant ones around.
struct Product {
  int across = 4, around = 16;
  static config::Schema<Product> schema();
};
using Rule = std::variant<Automatic, Octahedral, Product>;

}  // namespace dfd

struct DfdParameters {
  ElasticConstants elastic;  ///< of the matrix
  FibreOptions options;
  dfd::Rule rule;
  std::vector<dfd::Family> families;

  /// Throws InputError when no rule keeps the tolerance.
  DiscreteFibreLaw law() const;
  double shear_modulus() const { return elastic.shear(); }
  double bulk_modulus() const { return elastic.bulk(); }
  static config::Schema<DfdParameters> schema();
};

}  // namespace tunica::wall
