#include "tunica/wall/blended_law.hpp"

#include <algorithm>

namespace tunica::wall {

LawKind kind_of(std::span<const Law* const> laws) {
  const auto linear = [](const Law* law) { return std::holds_alternative<NeoHooke>(*law); };
  if (std::any_of(laws.begin(), laws.end(), [](const Law* law) { return has_unsplit_part(*law); }))
    return LawKind::unsplit;
  return std::all_of(laws.begin(), laws.end(), linear) ? LawKind::linear : LawKind::isochoric;
}

}  // namespace tunica::wall
