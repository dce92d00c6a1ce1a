#include "tunica/assembly/block_kernels.hpp"

namespace tunica::assembly {

extern template BlockKernels make_block_kernels<2>();
extern template BlockKernels make_block_kernels<4>();
extern template BlockKernels make_block_kernels<8>();

const BlockKernels& block_kernels(Isa isa) {
  static const BlockKernels sse2 = make_block_kernels<2>();
  static const BlockKernels avx2 = make_block_kernels<4>();
  static const BlockKernels avx512 = make_block_kernels<8>();
  return isa == Isa::avx512 ? avx512 : isa == Isa::avx2 ? avx2 : sse2;
}

}  // namespace tunica::assembly
