// What is where in the lumen of a dissection, for those who measure in it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tunica::distributed {

/// An element in which a piecewise linear function q varies that is one behind a cut and zero before it.
struct CutElement {
  std::int32_t region = 0, element = 0;  ///< an owned one
  std::int32_t cut = 0;
  std::array<double, 4> q{};  ///< at its corners
};

struct LumenMap {
  std::vector<std::string> tears;
  std::vector<CutElement> cuts;  ///< across the tears, in the order of regions and elements; `cut`: number of the tear
  std::vector<double> in_false;  ///< q: 1 in the false lumen, else 0 [local node]; empty without lumens
  std::vector<std::string> parts;                  ///< of the lumen; empty without lumens
  std::vector<std::vector<std::int32_t>> part_of;  ///< [region][owned element]; of lumen regions
  std::vector<char> sticks;  ///< [face] does the blood stick to it? What passes it is no outflow but leakage

  bool empty() const { return in_false.empty(); }
};

}  // namespace tunica::distributed
