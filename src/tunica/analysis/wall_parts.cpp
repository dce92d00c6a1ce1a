#include "tunica/analysis/wall_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <span>

namespace tunica::analysis {

std::vector<WallPart> wall_parts(const RunDescription& run, const mesh::MeshData& data) {
  std::vector<WallPart> parts;
  for (const auto& region : data.regions) {
    if (region.kind != mesh::RegionKind::wall) continue;
    WallPart whole{region.name, {}};
    for (auto e = region.first_element; e < region.end_element; ++e) whole.elements.push_back(e);
    parts.push_back(whole);
    const auto own = run.layers_of_region.find(region.name);
    const auto& borders = own == run.layers_of_region.end() ? run.layers : own->second;
    if (!borders) continue;
    const auto depth = std::find_if(data.fields.begin(), data.fields.end(),
                                    [&](const auto& field) { return field.name == borders->depth; });
    if (depth == data.fields.end()) continue;  // of a mesh that was read without it
    std::vector<WallPart> layers(borders->beyond.size() + 1);
    for (const auto e : whole.elements) {
      const auto n = static_cast<std::size_t>(depth->components);  // of the element, or of its corners
      const auto values = std::span(depth->values).subspan(n * static_cast<std::size_t>(e), n);
      const double at = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(n);
      const auto layer =
          std::count_if(borders->beyond.begin(), borders->beyond.end(), [&](double d) { return d <= at; });
      layers[static_cast<std::size_t>(layer)].elements.push_back(e);
    }
    for (std::size_t l = 0; l < layers.size(); ++l) {
      if (layers[l].elements.empty()) continue;
      layers[l].name = fmt::format("{} layer {}", region.name, l + 1);
      parts.push_back(std::move(layers[l]));
    }
  }
  return parts;
}

}  // namespace tunica::analysis
