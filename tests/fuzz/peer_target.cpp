// Input files of svMultiPhysics and svFSI, up to the case file, and svZeroDSolver's outlets.
#include "fuzz/target.hpp"
#include "tunica/base/text.hpp"
#include "tunica/peer_cases/translate.hpp"
#include "tunica/peer_cases/zerod_file.hpp"

namespace tunica::fuzz {

const char* const target_name = "peer";

void start_target() {}

void read_one(const std::filesystem::path& file, const std::string& kind) {
  using namespace peer_cases;
  if (kind == "zerod") {
    read_zerod_outlet(file, "outlet");
    return;
  }
  const std::string text = text::read(file);
  translate(kind == "xml" ? read_xml(text, file) : read_inp(text, file), unit_system("cgs"), file.parent_path());
}

}  // namespace tunica::fuzz
