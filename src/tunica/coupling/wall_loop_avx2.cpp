#include "tunica/coupling/wall_loop.inl.hpp"

namespace tunica::coupling {
template WallLoop wall_loop<4>();
}
