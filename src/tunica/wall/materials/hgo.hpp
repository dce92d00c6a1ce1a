// Laws with fibre families that enter through structure tensors: aligned (HGO) and dispersed (GOH).
#pragma once

#include <optional>

#include "tunica/wall/elastic_constants.hpp"
#include "tunica/wall/materials/fibre_options.hpp"
#include "tunica/wall/materials/fibre_reinforced.hpp"
#include "tunica/wall/materials/structure_tensor_fibres.hpp"

namespace tunica::wall {

/// Neo-Hookean matrix and families of fibres with structure tensors.
using StructureTensorLaw = FibreReinforced<StructureTensorFibres>;

/// Aligned fibres: H = M (x) M. Holzapfel, Gasser & Ogden (2000).
struct HgoParameters {
  struct Family {
    FibreEnergy energy;
    double mean_angle = 0.0;  ///< of M from e1 (circumferential) towards e2 (longitudinal) [rad]
    static config::Schema<Family> schema();
  };
  ElasticConstants elastic;  ///< of the matrix
  FibreOptions options;
  std::vector<Family> families;

  StructureTensorLaw law() const;
  double shear_modulus() const { return elastic.shear(); }
  double bulk_modulus() const { return elastic.bulk(); }
  static config::Schema<HgoParameters> schema();
};

/// Dispersed fibres: H = kappa I + (1 - 3 kappa) M (x) M (Gasser, Ogden & Holzapfel 2006), or
/// H = A I + B M (x) M + (1 - 3 A - B) e3 (x) e3 with A = 2 kappa_op kappa_ip, B = 2 kappa_op (1 - 2 kappa_ip)
/// (Holzapfel et al. 2015).
struct GohParameters {
  struct Family {
    FibreEnergy energy;
    double mean_angle = 0.0;      ///< [rad]
    std::optional<double> kappa;  ///< 0 aligned ... 1/3 isotropic; or the next two
    std::optional<double> kappa_ip, kappa_op;
    static config::Schema<Family> schema();
  };
  ElasticConstants elastic;  ///< of the matrix
  FibreOptions options;
  std::vector<Family> families;

  StructureTensorLaw law() const;
  double shear_modulus() const { return elastic.shear(); }
  double bulk_modulus() const { return elastic.bulk(); }
  static config::Schema<GohParameters> schema();
};

}  // namespace tunica::wall
