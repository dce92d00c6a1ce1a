// What a part of the wall is made of where that is not one material everywhere: layers one above the other, and a
// second material that takes a share of the volume (docs/theory.md, section 1). Both are read from cell arrays.
//
//   Psi = (1 - f) sum_l w_l(d) Psi_l + f Psi_a                                                                 (1.17)
//
// d: depth, f: share. A share scales whatever the energy is linear in (mu, K, k1) by any field: the second material
// then is the same law with the scaled parameters at f = 1.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tunica/config/schema.hpp"
#include "tunica/wall/material.hpp"

namespace tunica::wall {

struct Layer {
  double beyond = 0.0;  ///< depth at which it begins [-]
  LawParameters material;
  static config::Schema<Layer> schema();
};

/// The material that they are given with is the innermost layer.
struct Layers {
  std::string depth;            ///< cell array, 0 at the inner and 1 at the outer surface
  double blending = 0.0;        ///< depth over which one layer turns into the next [-]; 0: they jump
  std::vector<Layer> outwards;  ///< from the second one
  static config::Schema<Layers> schema();

  /// Weights of the layers at a depth, the innermost first; they sum to one.
  std::vector<double> weights(double at_depth) const;
};

struct Admixture {
  std::string share;  ///< cell array, 0 to 1
  LawParameters material;
  static config::Schema<Admixture> schema();
};

struct Composition {
  std::optional<Layers> layers;
  std::optional<Admixture> admixture;
  static config::Schema<Composition> schema();

  /// Materials beside the first one: the layers outwards, then the admixture.
  std::vector<const LawParameters*> further() const;
  /// Cell arrays that it is read from.
  std::vector<std::string> arrays() const;
  /// Weights of the first material and the further ones. `depth`, `share`: of the element, where they are asked for.
  std::vector<double> weights(double depth, double share) const;
};

}  // namespace tunica::wall
