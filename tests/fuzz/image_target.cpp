// Labelled images.
#include "fuzz/target.hpp"
#include "tunica/imaging/label_image.hpp"

namespace tunica::fuzz {

const char* const target_name = "image";

void start_target() {}

void read_one(const std::filesystem::path& file, const std::string&) { imaging::read_label_image(file); }

}  // namespace tunica::fuzz
