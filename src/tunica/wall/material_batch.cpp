#include "tunica/wall/material_batch.hpp"

namespace tunica::wall {

extern template MaterialBatch material_batch<2>();
#ifndef TUNICA_BASELINE_ISA
extern template MaterialBatch material_batch<4>();
extern template MaterialBatch material_batch<8>();
#endif

MaterialBatch material_batch([[maybe_unused]] int width) {
#ifndef TUNICA_BASELINE_ISA
  if (width == 8) return material_batch<8>();
  if (width == 4) return material_batch<4>();
#endif
  return material_batch<2>();
}

}  // namespace tunica::wall
