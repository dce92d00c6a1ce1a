// What the files of `tunica material`, `fit`, `mesh`, `study`, `follow-up`, `what-if` and `identify` may hold, for
// callers that need not know what it fills.
#pragma once

#include <memory>

#include "tunica/config/description.hpp"

namespace tunica::case_file {

std::shared_ptr<const config::Description> material_description();
std::shared_ptr<const config::Description> fit_description();
std::shared_ptr<const config::Description> mesh_description();
std::shared_ptr<const config::Description> study_description();
std::shared_ptr<const config::Description> follow_up_description();
std::shared_ptr<const config::Description> what_if_description();
std::shared_ptr<const config::Description> identify_description();

}  // namespace tunica::case_file
