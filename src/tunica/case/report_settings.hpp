// The section `report` of a case file.
#pragma once

#include "tunica/config/schema.hpp"

namespace tunica::case_file {

struct ReportSettings {
  bool pictures = true;
  bool view = true;

  static config::Schema<ReportSettings> schema() {
    return config::Schema<ReportSettings>("report", "One page with what was done and found.")
        .flag("pictures", &ReportSettings::pictures, "Draw pictures of the fields; needs an X display or xvfb-run")
        .by_default()
        .flag("view", &ReportSettings::view, "Show the beat in 3D, which is most of the bytes of the page")
        .by_default();
  }
};

}  // namespace tunica::case_file
