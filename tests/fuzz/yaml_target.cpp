// Case files of the commands, with all files that they name beside them.
#include "fuzz/target.hpp"
#include "tunica/base/error.hpp"
#include "tunica/case/case.hpp"
#include "tunica/case/fibres_case.hpp"
#include "tunica/case/material_case.hpp"
#include "tunica/case/mesh_settings.hpp"
#include "tunica/config/description.hpp"

namespace tunica::fuzz {

const char* const target_name = "yaml";

void start_target() {}

void read_one(const std::filesystem::path& file, const std::string& kind) {
  if (kind == "mesh") {
    case_file::read_mesh_case(file);
  } else if (kind == "material") {
    case_file::read_material_case(file);
  } else if (kind == "fibres") {
    case_file::read_fibres_case(file);
  } else {
    // Ranks that get the text from another one do not look for files, and so come further.
    try {
      case_file::parse_case(config::read_text(file), file);
    } catch (const InputError&) {
    }
    case_file::read_case(file);
  }
}

}  // namespace tunica::fuzz
