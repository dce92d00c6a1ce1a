// What this program was built from.
#pragma once

namespace tunica::app {

const char* version();
/// Commit of the source tree when it was compiled, with "-dirty" when files had been changed; "unknown" outside git.
const char* commit();

}  // namespace tunica::app
