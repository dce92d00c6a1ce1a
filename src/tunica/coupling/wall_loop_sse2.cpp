#include "tunica/coupling/wall_loop.inl.hpp"

namespace tunica::coupling {
template WallLoops wall_loops<2>();
}
