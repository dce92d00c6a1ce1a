// Points in the unit cube for studies of parameters. The same on every machine: generators of the standard library are
// used, its distributions, which differ between libraries, are not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tunica::analysis {

/// One row for each point, one entry in [0, 1) for each dimension.
using UnitPoints = std::vector<std::vector<double>>;

/// One point in each of `count` equal slices of every dimension, anywhere in it (McKay, Beckman & Conover,
/// Technometrics 21, 1979).
UnitPoints latin_hypercube(std::size_t count, std::size_t dimensions, std::uint64_t seed);

/// Beginning of Sobol's sequence with Boost's direction numbers (those of Joe & Kuo, SIAM J. Sci. Comput. 30, 2008),
/// the origin first, without which the first 2^k points are no net (Owen, "On dropping the first Sobol' point", 2020).
UnitPoints sobol_sequence(std::size_t count, std::size_t dimensions);

/// The same with the binary digits of every dimension shifted at random, which keeps it a net and moves it off the
/// origin (L'Ecuyer & Lemieux, "Recent advances in randomized quasi-Monte Carlo methods", 2002).
UnitPoints shifted_sobol_sequence(std::size_t count, std::size_t dimensions, std::uint64_t seed);

/// Blocks A, B, AB_1, ..., AB_d of `rows` points each: A and B from a shifted Sobol sequence of 2d dimensions, AB_i is
/// A with column i of B (Saltelli et al., Comput. Phys. Commun. 181, 2010). What sobol_indices() takes.
UnitPoints saltelli_points(std::size_t rows, std::size_t dimensions, std::uint64_t seed);

}  // namespace tunica::analysis
