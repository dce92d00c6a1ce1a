// The loops over fluid and wall elements, compiled once per instruction set.
#pragma once

#include <span>

#include "tunica/assembly/isa.hpp"
#include "tunica/coupling/loop_views.hpp"
#include "tunica/wall/blended_law.hpp"
#include "tunica/wall/element.hpp"

namespace tunica::coupling {

/// Wall elements that are made of the same laws.
struct WallGroupView {
  BatchView batches;
  wall::LawKind kind;
  std::span<const wall::Law* const> laws;
  const double* weights = nullptr;  ///< of the laws [batch][law][lane], null for one law
  /// Of quadratic elements whose materials have another share at each point: weights [batch][point][law][lane] and K
  /// [Pa, batch][point][lane]; null where they have not.
  const double *point_weights = nullptr, *point_bulk_moduli = nullptr;
  const double* bodies = nullptr;  ///< density, K, shear modulus at rest and present one [batch][4][lane]
  const double* frames = nullptr;  ///< e1 and e2 of the fibre frame [batch][6][lane], null for global axes
  /// In the axes of the frame: S0 [Pa, batch][point][6][lane] or F0 [batch][point][9][lane]; null without.
  const double *prestress = nullptr, *prestretch = nullptr;
};

/// What all elements of the wall have in common.
struct WallElementSettings {
  bool mixed;  ///< the displacement-pressure element, else the displacement element
  wall::VolumetricEnergy volumetric_energy;
  double stabilisation;
};

using WallLoop = void (*)(const WallGroupView&, const FieldsView&, const WallElementSettings&,
                          const wall::Coefficients&, const LoopTarget&);

/// Writes the present modulus (1.16) of every lane, [batch][lane].
using ModulusLoop = void (*)(const WallGroupView&, const FieldsView&, double* modulus);

struct WallLoops {
  WallLoop assemble;
  ModulusLoop modulus;
};
struct ElementLoops {
  FluidLoop fluid;
  WallLoops wall;
};

/// Instantiated in wall_loop_<isa>.cpp.
template <int W>
WallLoops wall_loops();

ElementLoops element_loops(assembly::Isa isa);

}  // namespace tunica::coupling
