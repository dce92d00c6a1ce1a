// Quantities of each family of fibres.
#pragma once

#include <fmt/format.h>

#include "tunica/quantities/quantity.hpp"

namespace tunica::quantities {

/// Mean directions of the families that the law of a region has, in the axes of the material.
std::vector<Vec3<double>> families_of(const coupling::Problem& problem, std::size_t region);

/// One array for each family: of(point, direction).
template <class Of>
std::vector<Values> for_fibres(Moment& moment, std::size_t region, const Of& of) {
  std::vector<Values> result;
  for (const auto& direction : families_of(moment.problem(), region)) {
    auto values =
        for_wall_elements(moment, region, 1, [&](const WallPoint& point, double* out) { *out = of(point, direction); });
    values.front().name = fmt::format(" {}", result.size() + 1);
    result.push_back(std::move(values.front()));
  }
  return result;
}

}  // namespace tunica::quantities
