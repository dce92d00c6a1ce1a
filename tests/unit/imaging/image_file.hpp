// Image files written by hand.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "tunica/base/error.hpp"
#include "tunica/imaging/label_image.hpp"

namespace tunica::imaging {

class ImageFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("tunica_image_" + std::to_string(::getpid()) +
                                                  ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  /// The message of the InputError that reading throws.
  std::string refusal(const std::string& name, const std::string& bytes) const {
    try {
      read_label_image(write(name, bytes));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  std::filesystem::path folder_;
};

/// Puts a number into the bytes of a file.
template <class T>
void put_at(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof(value));
}

/// Header of NIfTI-1, by the offsets of its definition.
inline std::string nifti_header(int xform) {
  std::string h(352, '\0');
  const auto put = [&](std::size_t at, auto value) { put_at(h, at, value); };
  put(0, std::int32_t{348});
  const std::int16_t dim[8] = {3, 2, 2, 2, 1, 1, 1, 1};
  for (int i = 0; i < 8; ++i) put(40 + 2 * i, dim[i]);
  put(70, std::int16_t{2});  // unsigned char
  put(72, std::int16_t{8});
  const float pixdim[8] = {1, 2, 3, 4, 0, 0, 0, 0};
  for (int i = 0; i < 8; ++i) put(76 + 4 * i, pixdim[i]);
  put(108, 352.0F);
  h[123] = 2;  // mm
  put(252, static_cast<std::int16_t>(xform));
  // A quarter turn about z: x -> y, y -> -x.
  put(264, static_cast<float>(std::numbers::sqrt2 / 2));
  put(268, 10.0F);
  put(272, 20.0F);
  put(276, 30.0F);
  std::memcpy(h.data() + 344, "n+1", 4);
  return h;
}

}  // namespace tunica::imaging
