#include <algorithm>

#include "tunica/quantities/list.hpp"
#include "tunica/quantities/names.hpp"

namespace tunica::quantities {

const std::vector<Quantity>& registry() {
  static const std::vector<Quantity> all{
#define TUNICA_CALL(name) name(),
      TUNICA_QUANTITIES(TUNICA_CALL)
#undef TUNICA_CALL
  };
  return all;
}

std::vector<std::string> keys() {
  std::vector<std::string> result;
  for (const auto& quantity : registry()) result.push_back(quantity.key);
  return result;
}

std::vector<bool> standard() {
  std::vector<bool> result;
  for (const auto& quantity : registry()) result.push_back(quantity.standard);
  return result;
}

const Quantity* find(const std::string& key) {
  const auto found = std::find_if(registry().begin(), registry().end(), [&](const auto& q) { return q.key == key; });
  return found == registry().end() ? nullptr : &*found;
}

Table table_of(const std::vector<Values>& arrays, int components, std::size_t entries) {
  const auto width = static_cast<std::size_t>(components);
  Table table{arrays.size() * width, std::vector<double>(arrays.size() * width * entries)};
  for (std::size_t k = 0; k < arrays.size(); ++k) {
    const auto values = arrays[k].values();
    for (std::size_t n = 0; n < entries; ++n)
      for (std::size_t c = 0; c < width; ++c)
        table.values[n * table.columns + k * width + c] = values[n * static_cast<std::size_t>(arrays[k].stride) + c];
  }
  return table;
}

}  // namespace tunica::quantities
