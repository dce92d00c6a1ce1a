#include "tunica/coupling/element_loops.hpp"

namespace tunica::coupling {

extern template FluidLoop fluid_loop<2>();
extern template WallLoops wall_loops<2>();
#ifndef TUNICA_BASELINE_ISA
extern template FluidLoop fluid_loop<4>();
extern template FluidLoop fluid_loop<8>();
extern template WallLoops wall_loops<4>();
extern template WallLoops wall_loops<8>();
#endif

ElementLoops element_loops(assembly::Isa isa) {
  switch (isa) {
#ifndef TUNICA_BASELINE_ISA
    case assembly::Isa::avx512:
      return {fluid_loop<8>(), wall_loops<8>()};
    case assembly::Isa::avx2:
      return {fluid_loop<4>(), wall_loops<4>()};
#endif
    default:
      return {fluid_loop<2>(), wall_loops<2>()};
  }
}

}  // namespace tunica::coupling
