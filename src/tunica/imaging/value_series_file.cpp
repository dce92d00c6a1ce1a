// 4D NIfTI-1 files of numbers, header by header as in nifti1.h. VTK's writer knows times only as components.
#include <fmt/format.h>

#include <cstring>

#include "tunica/base/error.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/imaging/header_file.hpp"
#include "tunica/imaging/value_image.hpp"

namespace tunica::imaging {

namespace {

constexpr std::size_t header_size = 352;
constexpr int patient_axes[3] = {-1, -1, 1};  // NIfTI's x and y point the other way

template <class T>
void put(std::string& bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof(T));
}

std::string header_of(const ImageFrame& frame, std::int64_t times, double time_step) {
  std::string h(header_size, '\0');
  put<std::int32_t>(h, 0, 348);
  const std::int64_t dim[8] = {4, frame.size[0], frame.size[1], frame.size[2], times, 1, 1, 1};
  for (std::size_t d = 0; d < 8; ++d) put<std::int16_t>(h, 40 + 2 * d, static_cast<std::int16_t>(dim[d]));
  put<std::int16_t>(h, 70, 16);  // float32
  put<std::int16_t>(h, 72, 32);
  put<float>(h, 76, 1.0F);
  for (std::size_t a = 0; a < 3; ++a) put<float>(h, 80 + 4 * a, static_cast<float>(1e3 * norm(frame.steps[a])));
  put<float>(h, 92, static_cast<float>(time_step));
  put<float>(h, 108, static_cast<float>(header_size));
  put<float>(h, 112, 1.0F);
  put<std::uint8_t>(h, 123, 2 + 8);  // mm and s
  put<std::int16_t>(h, 254, 1);      // sform: as the scanner has it
  for (int d = 0; d < 3; ++d) {
    const std::size_t row = 280 + 16 * static_cast<std::size_t>(d);
    for (int a = 0; a < 3; ++a)
      put<float>(h, row + 4 * static_cast<std::size_t>(a),
                 static_cast<float>(1e3 * patient_axes[d] * frame.steps[static_cast<std::size_t>(a)][d]));
    put<float>(h, row + 12, static_cast<float>(1e3 * patient_axes[d] * frame.origin[d]));
  }
  std::memcpy(h.data() + 344, "n+1", 4);
  return h;
}

}  // namespace

void write_value_series(const ImageFrame& frame, const std::vector<std::vector<float>>& volumes, double time_step,
                        const std::filesystem::path& path) {
  const auto name = lower(path.filename().string());
  const bool packed = name.ends_with(".nii.gz");
  if (!packed && !name.ends_with(".nii"))
    throw InputError(path.string(), "is not named as a series of images", "give a .nii or .nii.gz file");
  constexpr std::int64_t most = 32767;
  for (const auto size : {frame.size[0], frame.size[1], frame.size[2], std::ssize(volumes)})
    if (size > most)
      throw InputError(path.string(), fmt::format("{} entries along an axis are more than the format has", size),
                       "take larger voxels");
  std::string bytes = header_of(frame, std::ssize(volumes), time_step);
  for (const auto& volume : volumes)
    bytes.append(reinterpret_cast<const char*>(volume.data()), volume.size() * sizeof(float));
  files::write_atomically(path, packed ? compressed(bytes, true) : bytes);
}

}  // namespace tunica::imaging
