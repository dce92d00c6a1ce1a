// How far a figure is from the one of an infinitely fine mesh or step, from a few computations (Richardson's
// extrapolation; Roache, J. Fluids Eng. 116, 1994; Eca & Hoekstra, J. Comput. Phys. 262, 2014).
#pragma once

#include <span>
#include <string>

namespace tunica::analysis {

struct ErrorBand {
  enum class Kind {
    one_level,    ///< nothing can be said
    two_levels,   ///< the order is assumed
    monotone,     ///< the order is observed
    oscillating,  ///< increments change their sign
    diverging     ///< increments do not become smaller
  };
  Kind kind = Kind::one_level;
  double band;               ///< of the first value, half its width; NaN with one level
  double extrapolated;       ///< to size zero; NaN unless two_levels or monotone
  double order;              ///< observed or assumed; NaN where there is none
  std::string text() const;  ///< of the kind, for tables
};

/// `sizes`: of mesh or step, falling; `values`: the figure for each, the first is the one whose band is asked for.
/// The three finest decide. Monotone: C and the order p of f + C h^p are found, the band is 1.25 times the distance of
/// the first value to f where 0.5 <= p <= formal_order + 0.1, else 3 times, p then cut to these bounds. Two levels: the
/// same with the formal order and 3. Else 3 times the range of all values. Throws std::invalid_argument for sizes that
/// do not fall or numbers of values that differ.
ErrorBand error_band(std::span<const double> sizes, std::span<const double> values, double formal_order);

}  // namespace tunica::analysis
