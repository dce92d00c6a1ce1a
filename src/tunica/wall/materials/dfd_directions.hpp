// Dispersed fibres with directions of the caller's choice.
#pragma once

#include "tunica/wall/fibres/rule_size.hpp"
#include "tunica/wall/materials/dfd.hpp"

namespace tunica::wall {

/// The law with a product rule of this size for every family, without measuring what error it makes: to have its stress
/// for many sets of parameters. There are no notes.
DiscreteFibreLaw law_with(const DfdParameters& parameters, const RuleSize& directions);

/// A product rule that keeps the tolerance of the fibre stress for all families.
RuleSize rule_size_for(const DfdParameters& parameters, double tolerance);

}  // namespace tunica::wall
