// The voxels of an image file: bytes that lie raw, compressed or as text behind a header, turned into labels one block
// after the other. No more is read, and no more memory taken, than the size of the image asks for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "tunica/imaging/label_image.hpp"

namespace tunica::imaging {

enum class Packing {
  raw,
  deflated,  ///< zlib or gzip, of any number of gzip members
  detected   ///< deflated where the bytes begin like gzip, else raw
};

/// Where the bytes lie.
struct DataPlace {
  std::filesystem::path file;
  std::int64_t offset = 0;                                        ///< of the first byte, at least 0
  std::int64_t bytes = std::numeric_limits<std::int64_t>::max();  ///< that are looked at, at most
};

/// Bytes in a row.
class DataStream {
 public:
  /// InputError when there is no such file, or it is shorter than `place.offset`.
  DataStream(const DataPlace& place, Packing packing);
  ~DataStream();
  DataStream(const DataStream&) = delete;
  DataStream& operator=(const DataStream&) = delete;

  /// Puts up to `bytes` of them at `to` and returns how many; fewer mean that they have come to their end. InputError
  /// when compressed data are damaged or cut off.
  std::size_t read(char* to, std::size_t bytes);
  /// Leaves bytes out; returns how many there were, at most `bytes`.
  std::int64_t skip(std::int64_t bytes);
  /// The most that read() can still give: what the file holds, times the most that deflate packs.
  std::int64_t most() const;
  bool deflated() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Values of an image as the bytes of a file hold them.
enum class ValueType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };
std::int64_t bytes_of(ValueType type);

/// What a value of the file stands for: slope * value + intercept.
struct Scaling {
  double slope = 1, intercept = 0;
};

struct ValueFormat {
  ValueType type = ValueType::int16;
  bool big_endian = false;
  Scaling scaling{};
};

/// As many labels as the frame has voxels. `path` is the image, for messages. InputError when there are too few or too
/// many values, when one is no label, and when there is not the memory for so many.
std::vector<std::int16_t> read_labels(DataStream& data, const ValueFormat& format, const ImageFrame& frame,
                                      const std::filesystem::path& path);
/// The same of numbers in text, with blanks or commas between them.
std::vector<std::int16_t> read_labels_from_text(DataStream& data, const ImageFrame& frame,
                                                const std::filesystem::path& path);

/// The next `count` values, as they stand after scaling; `path` is the image, for messages. InputError when there are
/// fewer, and for values that are no numbers.
std::vector<float> read_values(DataStream& data, const ValueFormat& format, std::int64_t count,
                               const std::filesystem::path& path);

/// One value as a label; InputError when it is none.
std::int16_t label_from_value(double value, std::int64_t index, const std::filesystem::path& path);
std::string bytes_from_labels(const std::vector<std::int16_t>& labels);  ///< little-endian
std::string compressed(const std::string& bytes, bool gzip);

}  // namespace tunica::imaging
