// What the data determine of a fit, and what not. Neighbouring residuals of a test are alike (friction, drift, a law
// that is not the tissue), so that intervals from independent noise would be several times too short.
#pragma once

#include <cstdint>
#include <vector>

#include "tunica/fitting/fit.hpp"

namespace tunica::fitting {

struct ProfilePoint {
  std::vector<double> x;  ///< scaled; one is held, the others are fitted
  double squares;         ///< [kPa^2]
};

/// An interval of an unknown; scaled.
struct Interval {
  double low = 0.0, high = 1.0;
};

enum class Identification {
  identified,      ///< both ends of the profile interval lie within the bounds, and it is a small part of them
  weak,            ///< both ends lie within the bounds, but far apart
  not_identified,  ///< the data allow values up to a bound
};

struct Determination {
  Interval interval;   ///< 95 %: the outer one of the two at each end
  Interval bootstrap;  ///< 95 %, moving blocks
  Interval profile;    ///< 95 %, by the profile likelihood with the effective number of residuals
  bool open_below = false, open_above = false;  ///< does the profile reach the bound without leaving the interval?
  std::vector<ProfilePoint> points{};           ///< in the order of the unknown
  Identification identification = Identification::identified;
};

struct Uncertainty {
  std::vector<Determination> unknowns;
  std::vector<std::vector<double>> replicates;   ///< of the bootstrap that came to a fit, scaled
  std::vector<std::vector<double>> correlation;  ///< of the replicates
  std::size_t block = 1;                         ///< rows
};

struct UncertaintyOptions {
  int replicates = 200;
  std::uint64_t seed = 1;
  int threads = 2;
};

/// Throws SolverError when too few replicates come to a fit.
Uncertainty uncertainty(const Model& model, const Fit& fit, const UncertaintyOptions& options);

/// 2.5 % and 97.5 % of values. Needs one at least.
Interval percentiles(std::vector<double> values);

}  // namespace tunica::fitting
