// Surfaces of vessels, and what is made of them before anything else.
#include "fuzz/target.hpp"
#include "tunica/geometry/surface_mending.hpp"

namespace tunica::fuzz {

const char* const target_name = "surface";

void start_target() {}

void read_one(const std::filesystem::path& file, const std::string&) {
  geometry::mend_surface(geometry::read_surface(file, 1e-2), {});
}

}  // namespace tunica::fuzz
