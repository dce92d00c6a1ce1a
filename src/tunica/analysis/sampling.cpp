#include "tunica/analysis/sampling.hpp"

#include <boost/random/sobol.hpp>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

namespace tunica::analysis {

namespace {

using Words = std::vector<std::vector<std::uint64_t>>;

/// The upper 53 of 64 binary digits, all that a double below 1 holds.
double fraction(std::uint64_t word) { return std::ldexp(static_cast<double>(word >> 11), -53); }

/// Boost's sequence leaves the origin out.
Words sobol_words(std::size_t count, std::size_t dimensions) {
  Words words(count, std::vector<std::uint64_t>(dimensions, 0));
  boost::random::sobol sequence(dimensions);
  for (std::size_t k = 1; k < count; ++k)
    for (auto& word : words[k]) word = sequence();
  return words;
}

UnitPoints fractions(const Words& words) {
  UnitPoints points;
  points.reserve(words.size());
  for (const auto& row : words) {
    auto& point = points.emplace_back();
    for (const auto word : row) point.push_back(fraction(word));
  }
  return points;
}

}  // namespace

UnitPoints latin_hypercube(std::size_t count, std::size_t dimensions, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  UnitPoints points(count, std::vector<double>(dimensions));
  std::vector<std::size_t> slices(count);
  for (std::size_t d = 0; d < dimensions; ++d) {
    std::iota(slices.begin(), slices.end(), std::size_t{0});
    for (std::size_t k = count; k > 1; --k) std::swap(slices[k - 1], slices[random() % k]);
    for (std::size_t k = 0; k < count; ++k)
      points[k][d] = (static_cast<double>(slices[k]) + fraction(random())) / static_cast<double>(count);
  }
  return points;
}

UnitPoints sobol_sequence(std::size_t count, std::size_t dimensions) {
  return fractions(sobol_words(count, dimensions));
}

UnitPoints shifted_sobol_sequence(std::size_t count, std::size_t dimensions, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::uint64_t> shift(dimensions);
  for (auto& word : shift) word = random();
  Words words = sobol_words(count, dimensions);
  for (auto& row : words)
    for (std::size_t d = 0; d < dimensions; ++d) row[d] ^= shift[d];
  return fractions(words);
}

UnitPoints saltelli_points(std::size_t rows, std::size_t dimensions, std::uint64_t seed) {
  const auto both = shifted_sobol_sequence(rows, 2 * dimensions, seed);
  const auto cut = static_cast<std::ptrdiff_t>(dimensions);
  UnitPoints points;
  for (const auto& row : both) points.emplace_back(row.begin(), row.begin() + cut);
  for (const auto& row : both) points.emplace_back(row.begin() + cut, row.end());
  for (std::size_t d = 0; d < dimensions; ++d)
    for (std::size_t k = 0; k < rows; ++k) {
      auto& point = points.emplace_back(both[k].begin(), both[k].begin() + cut);
      point[d] = both[k][dimensions + d];
    }
  return points;
}

}  // namespace tunica::analysis
