#include "tunica/assembly/block_kernels.hpp"

namespace tunica::assembly {

extern template BlockKernels make_block_kernels<2>();
#ifndef TUNICA_BASELINE_ISA
extern template BlockKernels make_block_kernels<4>();
extern template BlockKernels make_block_kernels<8>();
#endif

const BlockKernels& block_kernels([[maybe_unused]] Isa isa) {
  static const BlockKernels sse2 = make_block_kernels<2>();
#ifndef TUNICA_BASELINE_ISA
  static const BlockKernels avx2 = make_block_kernels<4>();
  static const BlockKernels avx512 = make_block_kernels<8>();
  if (isa == Isa::avx512) return avx512;
  if (isa == Isa::avx2) return avx2;
#endif
  return sse2;
}

}  // namespace tunica::assembly
