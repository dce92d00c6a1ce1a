#include "tunica/coupling/state.hpp"

namespace tunica::coupling {

State with_end_pressure(State state) {
  for (std::size_t i = 0; i < state.end_pressure.size(); ++i)
    state.velocity_pressure[4 * i + 3] = state.end_pressure[i];
  return state;
}

}  // namespace tunica::coupling
