#include "tunica/coupling/fluid_loop.inl.hpp"

namespace tunica::coupling {
template FluidLoop fluid_loop<8>();
}
