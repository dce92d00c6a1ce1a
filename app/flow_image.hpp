// tunica synthesise --flow: a computed beat as velocity images.
#pragma once

#include "file_command.hpp"

namespace tunica::app {

void flow_image(const FileRequest& request);

}  // namespace tunica::app
