// Tables of numbers, waveforms and openings, and lists of results.
#include "fuzz/target.hpp"
#include "tunica/bc/waveform.hpp"
#include "tunica/field_io/series_index.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/geometry/openings.hpp"

namespace tunica::fuzz {

const char* const target_name = "table";

void start_target() {}

void read_one(const std::filesystem::path& file, const std::string& kind) {
  if (kind == "csv")
    files::read_csv(file, "give a table");
  else if (kind == "openings")
    geometry::read_opening_names(file, 1e-3);
  else if (kind == "series")
    field_io::read_series(file);
  else
    for (const auto interpolation : {bc::Interpolation::linear, bc::Interpolation::spline, bc::Interpolation::fourier})
      bc::make_waveform({.source = bc::TableSource{{.path = file}, {.interpolation = interpolation, .modes = 3}}});
}

}  // namespace tunica::fuzz
