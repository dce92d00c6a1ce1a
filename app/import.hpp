// What `tunica import` does, for `tunica run` of such a file, too.
#pragma once

#include "tunica/stages/import/import_case.hpp"

namespace tunica::app {

/// Writes the case file and lists on the screen what it says otherwise. Throws as import_case().
void import_and_report(const stages::ImportRequest& request);

}  // namespace tunica::app
