#include "tunica/analysis/description.hpp"

#include <set>

namespace tunica::analysis {

std::vector<std::string> RunDescription::depths() const {
  std::set<std::string> names;
  if (layers) names.insert(layers->depth);
  for (const auto& [region, own] : layers_of_region)
    if (own) names.insert(own->depth);
  return {names.begin(), names.end()};
}

}  // namespace tunica::analysis
