// Labelled images, and series of numbers.
#include "fuzz/target.hpp"
#include "tunica/imaging/label_image.hpp"
#include "tunica/imaging/value_image.hpp"

namespace tunica::fuzz {

const char* const target_name = "image";

void start_target() {}

void read_one(const std::filesystem::path& file, const std::string& kind) {
  if (kind != "series") {
    imaging::read_label_image(file);
    return;
  }
  auto image = imaging::open_value_image(file);
  for (std::int64_t k = 0; k < image.times * image.components; ++k) image.next_volume();
}

}  // namespace tunica::fuzz
