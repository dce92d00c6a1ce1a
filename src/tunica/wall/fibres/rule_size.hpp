// Product rules by their numbers alone, for laws that are made for many sets of parameters.
#pragma once

#include "tunica/wall/fibres/density.hpp"

namespace tunica::wall {

struct RuleSize {
  int across = 1, around = 3;
};

/// Of the product rule that choose_rule() takes.
RuleSize choose_rule_size(const Density& d, double k2, double tolerance, bool tension_only);

}  // namespace tunica::wall
