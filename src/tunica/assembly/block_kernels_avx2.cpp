#include "tunica/assembly/block_kernels.inl.hpp"

namespace tunica::assembly {
template BlockKernels make_block_kernels<4>();
}
