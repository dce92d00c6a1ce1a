#include "tunica/coupling/element_loops.inl.hpp"

namespace tunica::coupling {
template ElementLoops make_element_loops<2>();
}
