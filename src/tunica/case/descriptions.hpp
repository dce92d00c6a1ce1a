// What the files of `tunica material`, `tunica fit` and `tunica mesh` may hold, for callers that need not know what it
// fills.
#pragma once

#include <memory>

#include "tunica/config/description.hpp"

namespace tunica::case_file {

std::shared_ptr<const config::Description> material_description();
std::shared_ptr<const config::Description> fit_description();
std::shared_ptr<const config::Description> mesh_description();

}  // namespace tunica::case_file
