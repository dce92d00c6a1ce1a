#include "tunica/imaging/voxel_data.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <string_view>

#include "tunica/base/error.hpp"
#include "tunica/imaging/header_file.hpp"

namespace tunica::imaging {

namespace {

constexpr std::int64_t block_of_values = 1 << 16;

/// Room for the labels of an image whose size is credible.
std::vector<std::int16_t> room_for(std::int64_t count, const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(path.string(),
                     fmt::format("its {} voxels need {:.1f} GB of memory, {}", count, 2e-9 * count, what),
                     "cut the image down to the vessel, or take a machine with more memory");
  };
  const double memory = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  if (memory > 0 && 2.0 * static_cast<double>(count) > memory)
    refuse(fmt::format("this machine has {:.1f} GB", 1e-9 * memory));
  std::vector<std::int16_t> labels;
  try {
    labels.reserve(static_cast<std::size_t>(count));
  } catch (const std::bad_alloc&) {
    refuse("which are not to be had");
  }
  return labels;
}

std::string sides(const ImageFrame& frame) {
  return fmt::format("{} x {} x {}", frame.size[0], frame.size[1], frame.size[2]);
}

[[noreturn]] void refuse_bytes(const std::string& found, std::int64_t wanted, const ImageFrame& frame,
                               const std::filesystem::path& path, bool too_few) {
  throw InputError(
      path.string(),
      fmt::format("holds {} bytes of data, its size of {} voxels asks for {}", found, sides(frame), wanted),
      too_few ? "copy the file again, it seems to be cut off; or correct size and type of the values in its header"
              : "correct size and type of the values in its header");
}

template <class T>
double value_at(const char* bytes, bool turn) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes, sizeof(T));
  if (turn) std::reverse(raw.begin(), raw.end());
  return static_cast<double>(std::bit_cast<T>(raw));
}

using ValueAt = double (*)(const char* bytes, bool turn);

ValueAt value_reader(ValueType type) {
  switch (type) {
    case ValueType::int8:
      return value_at<std::int8_t>;
    case ValueType::uint8:
      return value_at<std::uint8_t>;
    case ValueType::int16:
      return value_at<std::int16_t>;
    case ValueType::uint16:
      return value_at<std::uint16_t>;
    case ValueType::int32:
      return value_at<std::int32_t>;
    case ValueType::uint32:
      return value_at<std::uint32_t>;
    case ValueType::int64:
      return value_at<std::int64_t>;
    case ValueType::uint64:
      return value_at<std::uint64_t>;
    case ValueType::float32:
      return value_at<float>;
    default:
      return value_at<double>;
  }
}

/// Words of a stream, cut where they are longer than any number.
class Words {
 public:
  explicit Words(DataStream& data) : data_(data) {}
  /// Empty at the end.
  std::string_view next() {
    std::size_t length = 0;
    for (int c = get(); c >= 0; c = get()) {
      const bool blank = c == ' ' || (c >= '\t' && c <= '\r') || c == ',';
      if (blank && length > 0) break;
      if (blank) continue;
      word_[length++] = static_cast<char>(c);
      if (length == word_.size()) break;
    }
    return {word_.data(), length};
  }

 private:
  int get() {
    if (at_ == end_) {
      end_ = data_.read(buffer_.data(), buffer_.size());
      at_ = 0;
    }
    return at_ == end_ ? -1 : static_cast<unsigned char>(buffer_[at_++]);
  }
  DataStream& data_;
  std::array<char, 1 << 14> buffer_;
  std::array<char, 64> word_;
  std::size_t at_ = 0, end_ = 0;
};

}  // namespace

std::int64_t bytes_of(ValueType type) {
  switch (type) {
    case ValueType::int8:
    case ValueType::uint8:
      return 1;
    case ValueType::int16:
    case ValueType::uint16:
      return 2;
    case ValueType::int32:
    case ValueType::uint32:
    case ValueType::float32:
      return 4;
    default:
      return 8;
  }
}

std::vector<std::int16_t> read_labels(DataStream& data, const ValueFormat& format, const ImageFrame& frame,
                                      const std::filesystem::path& path) {
  const std::int64_t count = frame.count(), bytes = bytes_of(format.type);
  // Before memory is taken: a small file cannot hold a large image.
  if (data.most() < count * bytes || (!data.deflated() && data.most() > count * bytes))
    refuse_bytes(fmt::format("{}{}", data.deflated() ? "at most " : "", data.most()), count * bytes, frame, path,
                 data.most() < count * bytes);
  auto labels = room_for(count, path);
  const bool turn = format.big_endian != (std::endian::native == std::endian::big);
  const auto value = value_reader(format.type);
  std::vector<char> block(static_cast<std::size_t>(block_of_values * bytes));
  while (std::ssize(labels) < count) {
    const auto first = std::ssize(labels);
    const auto wanted = static_cast<std::size_t>(std::min(block_of_values, count - first) * bytes);
    const auto got = data.read(block.data(), wanted);
    if (got < wanted)
      refuse_bytes(std::to_string(first * bytes + static_cast<std::int64_t>(got)), count * bytes, frame, path, true);
    for (std::int64_t i = 0; i * bytes < static_cast<std::int64_t>(wanted); ++i)
      labels.push_back(label_from_value(
          format.scaling.slope * value(block.data() + i * bytes, turn) + format.scaling.intercept, first + i, path));
  }
  // One byte more: it tells an image that is larger than it says, and lets zlib compare its check sum.
  if (data.read(block.data(), 1) != 0)
    refuse_bytes(fmt::format("more than {}", count * bytes), count * bytes, frame, path, false);
  return labels;
}

std::vector<float> read_values(DataStream& data, const ValueFormat& format, std::int64_t count,
                               const std::filesystem::path& path) {
  const std::int64_t bytes = bytes_of(format.type);
  const auto refuse = [&](std::int64_t found) {
    throw InputError(path.string(), fmt::format("holds {} bytes where its header announces {}", found, count * bytes),
                     "copy the file again, it seems to be cut off; or correct size and type in its header");
  };
  if (data.most() < count * bytes) refuse(data.most());
  std::vector<float> values(static_cast<std::size_t>(count));
  const bool turn = format.big_endian != (std::endian::native == std::endian::big);
  const auto value = value_reader(format.type);
  std::vector<char> block(static_cast<std::size_t>(block_of_values * bytes));
  for (std::int64_t first = 0; first < count; first += block_of_values) {
    const auto wanted = std::min(block_of_values, count - first);
    const auto got = data.read(block.data(), static_cast<std::size_t>(wanted * bytes));
    if (static_cast<std::int64_t>(got) < wanted * bytes) refuse(first * bytes + static_cast<std::int64_t>(got));
    for (std::int64_t i = 0; i < wanted; ++i) {
      const double v = format.scaling.slope * value(block.data() + i * bytes, turn) + format.scaling.intercept;
      if (!std::isfinite(v))
        throw InputError(path.string(), fmt::format("its value number {} is {}, no number", first + i, v),
                         "write the image again, with 0 where nothing was measured");
      values[static_cast<std::size_t>(first + i)] = static_cast<float>(v);
    }
  }
  return values;
}

std::vector<std::int16_t> read_labels_from_text(DataStream& data, const ImageFrame& frame,
                                                const std::filesystem::path& path) {
  const auto count = frame.count();
  const auto refuse = [&](const std::string& found) {
    throw InputError(
        path.string(),
        fmt::format("holds {} values as text, its size of {} voxels asks for {}", found, sides(frame), count),
        "copy the file again, or correct the size in its header");
  };
  // Each value takes a digit, and a blank before the next one.
  if ((data.most() + 1) / 2 < count) refuse(fmt::format("at most {}", (data.most() + 1) / 2));
  auto labels = room_for(count, path);
  Words words(data);
  for (std::int64_t i = 0; i < count; ++i) {
    auto word = words.next();
    if (word.empty()) refuse(std::to_string(i));
    const std::string shown(word);
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
      throw InputError(path.string(), fmt::format("the value of voxel {} is '{}', no number", i, printable(shown)),
                       "write the labels as whole numbers, or as binary data");
    labels.push_back(label_from_value(value, i, path));
  }
  if (!words.next().empty()) refuse(fmt::format("more than {}", count));
  return labels;
}

std::int16_t label_from_value(double value, std::int64_t index, const std::filesystem::path& path) {
  using Limits = std::numeric_limits<std::int16_t>;
  if (value >= Limits::min() && value <= Limits::max() && value == std::floor(value))
    return static_cast<std::int16_t>(value);
  throw InputError(path.string(),
                   fmt::format("the value of voxel {} is {}, labels are whole numbers from {} to {}", index, value,
                               Limits::min(), Limits::max()),
                   "give the labels of the segmentation, not the scan itself");
}

std::string bytes_from_labels(const std::vector<std::int16_t>& labels) {
  std::string bytes(2 * labels.size(), '\0');
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto value = static_cast<std::uint16_t>(labels[i]);
    bytes[2 * i] = static_cast<char>(value & 0xff);
    bytes[2 * i + 1] = static_cast<char>(value >> 8);
  }
  return bytes;
}

}  // namespace tunica::imaging
