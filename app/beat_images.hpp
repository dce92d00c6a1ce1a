// tunica synthesise --flow and --motion: a computed beat as velocity images, or as labels of its phases.
#pragma once

#include "file_command.hpp"

namespace tunica::app {

void flow_image(const FileRequest& request);
void motion_image(const FileRequest& request);

}  // namespace tunica::app
