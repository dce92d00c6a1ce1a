#include "tunica/coupling/element_loops.hpp"

namespace tunica::coupling {

extern template FluidLoop fluid_loop<2>();
extern template FluidLoop fluid_loop<4>();
extern template FluidLoop fluid_loop<8>();
extern template WallLoop wall_loop<2>();
extern template WallLoop wall_loop<4>();
extern template WallLoop wall_loop<8>();

ElementLoops element_loops(assembly::Isa isa) {
  switch (isa) {
    case assembly::Isa::avx512:
      return {fluid_loop<8>(), wall_loop<8>()};
    case assembly::Isa::avx2:
      return {fluid_loop<4>(), wall_loop<4>()};
    default:
      return {fluid_loop<2>(), wall_loop<2>()};
  }
}

}  // namespace tunica::coupling
