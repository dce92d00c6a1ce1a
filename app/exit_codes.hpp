// Exit codes of the program; beside these 0, and that of an abort where the program itself is wrong.
#pragma once

namespace tunica::app {

inline constexpr int input_error = 2, solver_failure = 3;

}  // namespace tunica::app
