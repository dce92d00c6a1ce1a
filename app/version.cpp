#include "version.hpp"

#include "commit.hpp"  // written by cmake/write_commit.cmake with every build

namespace tunica::app {

const char* version() { return TUNICA_VERSION; }
const char* commit() { return TUNICA_COMMIT; }

}  // namespace tunica::app
