// How much a quantity follows each of the parameters that were varied.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tunica::analysis {

/// Spearman's rank correlation in [-1, 1], equal values with their mean rank. Pairs with an entry that is not finite
/// are left out; NaN where fewer than three are left, or where one of the two does not vary. Throws
/// std::invalid_argument for numbers of values that differ.
double rank_correlation(std::span<const double> x, std::span<const double> y);

struct RankCorrelation {
  double value;           ///< as rank_correlation()
  double low, high;       ///< percentiles 2.5 and 97.5 over bootstrap samples; NaN where `value` is
  std::size_t pairs = 0;  ///< with two finite entries
};

/// With an interval from samples of whole blocks of `block` neighbours, taken round the end (circular block bootstrap:
/// Politis & Romano, 1992): pairs that stand next to each other, as stations along a vessel do, may depend on each
/// other. A block of 1 takes pairs as independent. Throws std::invalid_argument as rank_correlation(), and for a block
/// of 0.
RankCorrelation rank_correlation_interval(std::span<const double> x, std::span<const double> y, std::size_t block,
                                          std::size_t bootstraps = 2000, std::uint64_t seed = 1);

/// Shares of the variance that one parameter accounts for: alone, and with all that it does together with others.
struct SobolIndex {
  double first, total;
  double first_error, total_error;  ///< standard deviation over bootstrap samples of the rows
};

struct SobolIndices {
  std::vector<SobolIndex> of;  ///< one for each parameter; NaN where the quantity does not vary
  std::size_t rows = 0;        ///< that had a value in all blocks
};

/// `values`: at saltelli_points(rows, dimensions, ...), in their order; a row with an entry that is not finite is left
/// out of all blocks. First order: Saltelli et al., Comput. Phys. Commun. 181 (2010), table 2, (b); total: (f), which
/// is Jansen's. Values are taken relative to their mean, which both estimators allow and which lowers the error of the
/// first. Throws std::invalid_argument when there are not rows * (dimensions + 2) values.
SobolIndices sobol_indices(std::span<const double> values, std::size_t rows, std::size_t dimensions,
                           std::size_t bootstraps = 1000, std::uint64_t seed = 1);

}  // namespace tunica::analysis
