#include "tunica/mesh_io/vtk_array_check.hpp"

#include <fmt/format.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <charconv>
#include <vector>

#include "tunica/mesh_io/xml_tags.hpp"

namespace tunica::mesh_io {

namespace {

using Bytes = std::vector<unsigned char>;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(xml_space);
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(xml_space) - first + 1);
}

/// Calls `take(token)` until it returns false.
template <class Take>
void each_token(std::string_view text, const Take& take) {
  for (auto at = text.find_first_not_of(xml_space); at != std::string_view::npos;) {
    const auto end = std::min(text.find_first_of(xml_space, at), text.size());
    if (!take(text.substr(at, end - at))) return;
    at = text.find_first_not_of(xml_space, end);
  }
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// A stretch of bytes in the file, raw or in base64.
class Stretch {
 public:
  Stretch(std::string_view data, bool base64) : data_(base64 ? trimmed(data) : data), base64_(base64) {}

  std::size_t size() const { return base64_ ? data_.size() / 4 * 3 : data_.size(); }
  /// Fewer where it ends, or where a letter belongs to no code.
  Bytes read(std::size_t from, std::size_t count) const {
    Bytes bytes;
    if (!base64_) {
      if (from < data_.size())
        for (const char c : data_.substr(from, count)) bytes.push_back(static_cast<unsigned char>(c));
      return bytes;
    }
    for (std::size_t group = from / 3 * 4; group + 4 <= data_.size() && bytes.size() < count; group += 4) {
      std::uint32_t bits = 0;
      int digits = 0;
      while (digits < 4 && base64_digit(data_[group + digits]) >= 0)
        bits = (bits << 6) | static_cast<std::uint32_t>(base64_digit(data_[group + digits++]));
      bits <<= 6 * (4 - digits);
      for (int k = 0; k + 1 < digits; ++k)
        if (group / 4 * 3 + k >= from && bytes.size() < count)
          bytes.push_back(static_cast<unsigned char>(bits >> (16 - 8 * k)));
      if (digits < 4) break;
    }
    return bytes;
  }
  /// What follows `bytes` bytes, which in base64 are encoded on their own.
  Stretch after(std::size_t bytes) const {
    const auto letters = base64_ ? (bytes + 2) / 3 * 4 : bytes;
    return {data_.substr(std::min(letters, data_.size())), base64_};
  }

 private:
  std::string_view data_;
  bool base64_;
};

std::uint64_t number(const unsigned char* bytes, std::size_t size, bool big_endian) {
  std::uint64_t value = 0;
  for (std::size_t k = 0; k < size; ++k) value = (value << 8) | bytes[big_endian ? k : size - 1 - k];
  return value;
}

/// Numbers at the begin of the data; fewer when there are not that many.
std::vector<std::uint64_t> header(const Stretch& data, std::size_t from, std::size_t count,
                                  const VtkEncoding& encoding) {
  const auto bytes = data.read(from * encoding.header_bytes, count * encoding.header_bytes);
  std::vector<std::uint64_t> numbers;
  for (std::size_t k = 0; (k + 1) * encoding.header_bytes <= bytes.size(); ++k)
    numbers.push_back(number(bytes.data() + k * encoding.header_bytes, encoding.header_bytes, encoding.big_endian));
  return numbers;
}

/// Sizes of the compressed blocks, and what they hold.
struct Blocks {
  std::uint64_t size = 0, last = 0;  ///< bytes when expanded; `last` 0: the last one is whole
  std::vector<std::uint64_t> compressed;
  std::uint64_t total = 0, total_compressed = 0;
  std::string problem;

  std::uint64_t expanded(std::size_t block) const { return block + 1 == compressed.size() && last > 0 ? last : size; }
};

std::uint64_t expansion(const std::string& compressor) {
  return compressor == "vtkZLibDataCompressor"  ? 1100
         : compressor == "vtkLZ4DataCompressor" ? 300
                                                : static_cast<std::uint64_t>(largest_expansion);
}

Blocks read_blocks(const Stretch& data, const VtkEncoding& encoding) {
  constexpr std::uint64_t largest_block = 1ULL << 40;
  Blocks blocks;
  const auto head = header(data, 0, 3, encoding);
  if (head.size() < 3) return blocks.problem = "its head is cut off", blocks;
  const auto n = head[0];
  blocks.size = head[1];
  blocks.last = head[2];
  if (n > data.size() / encoding.header_bytes || blocks.size > largest_block || blocks.last > blocks.size ||
      (n > 0 && blocks.size == 0))
    return blocks.problem =
               fmt::format("{} blocks of {} bytes, the last of {}, are not possible", n, blocks.size, blocks.last),
           blocks;
  blocks.compressed = header(data, 3, n, encoding);
  if (blocks.compressed.size() < n) return blocks.problem = "the sizes of its blocks are cut off", blocks;
  const auto left = data.after((3 + n) * encoding.header_bytes).size();
  for (std::size_t k = 0; k < n; ++k) {
    if (blocks.compressed[k] > left - blocks.total_compressed)
      return blocks.problem = fmt::format("block {} of {} reaches beyond the end of the data", k + 1, n), blocks;
    blocks.total_compressed += blocks.compressed[k];
    blocks.total += blocks.expanded(k);
  }
  if (blocks.total > blocks.total_compressed * expansion(encoding.compressor) + 64 * n)
    blocks.problem = fmt::format("{} bytes cannot expand to {}", blocks.total_compressed, blocks.total);
  return blocks;
}

std::string too_few(std::uint64_t there, std::int64_t needed) {
  return fmt::format("{} values are there, {} are needed", there, needed);
}

vtkSmartPointer<vtkDataCompressor> make_compressor(const std::string& name) {
  if (name == "vtkZLibDataCompressor") return vtkSmartPointer<vtkZLibDataCompressor>::New();
  if (name == "vtkLZ4DataCompressor") return vtkSmartPointer<vtkLZ4DataCompressor>::New();
  return vtkSmartPointer<vtkLZMADataCompressor>::New();
}

/// The bytes of the value at this byte of an array in blocks; empty when the block does not expand.
Bytes from_blocks(const Stretch& data, std::uint64_t from, std::size_t count, const VtkEncoding& encoding) {
  const auto blocks = read_blocks(data, encoding);
  if (!blocks.problem.empty() || from + count > blocks.total) return {};
  const auto block = static_cast<std::size_t>(from / blocks.size);
  if (from % blocks.size + count > blocks.expanded(block)) return {};  // no writer parts a number
  std::uint64_t begin = 0;
  for (std::size_t k = 0; k < block; ++k) begin += blocks.compressed[k];
  const auto packed =
      data.after((3 + blocks.compressed.size()) * encoding.header_bytes).read(begin, blocks.compressed[block]);
  Bytes whole(blocks.expanded(block));
  if (packed.size() < blocks.compressed[block] ||
      make_compressor(encoding.compressor)->Uncompress(packed.data(), packed.size(), whole.data(), whole.size()) == 0)
    return {};
  const auto first = whole.begin() + static_cast<std::ptrdiff_t>(from % blocks.size);
  return {first, first + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

bool known_compressor(const std::string& name) {
  return name.empty() || name == "vtkZLibDataCompressor" || name == "vtkLZ4DataCompressor" ||
         name == "vtkLZMADataCompressor";
}

std::optional<std::size_t> bytes_of_type(std::string_view type) {
  if (type == "Float32") return 4;
  if (type == "Float64") return 8;
  if (type.starts_with('U')) type.remove_prefix(1);
  if (type == "Int8") return 1;
  if (type == "Int16") return 2;
  if (type == "Int32") return 4;
  if (type == "Int64") return 8;
  return std::nullopt;
}

std::string array_problem(const VtkArray& array, std::int64_t values, const VtkEncoding& encoding) {
  const auto needed = static_cast<std::uint64_t>(values);
  if (array.form == VtkArray::Form::ascii) {
    std::uint64_t there = 0;
    each_token(array.data, [&](std::string_view) { return ++there < needed; });
    return there < needed ? too_few(there, values) : "";
  }
  if (values == 0) return "";
  const Stretch data(array.data, array.form == VtkArray::Form::base64);
  std::uint64_t bytes = 0;
  if (encoding.compressor.empty()) {
    const auto head = header(data, 0, 1, encoding);
    if (head.empty()) return "its head is cut off, " + too_few(0, values);
    bytes = head[0];
    if (const auto left = data.size() - encoding.header_bytes; bytes > left)
      return fmt::format("its head says {} bytes, {} follow", bytes, left);
  } else {
    const auto blocks = read_blocks(data, encoding);
    if (!blocks.problem.empty()) return blocks.problem;
    bytes = blocks.total;
  }
  return bytes / array.value_bytes < needed ? too_few(bytes / array.value_bytes, values) : "";
}

std::optional<std::int64_t> value_at(const VtkArray& array, std::int64_t place, const VtkEncoding& encoding) {
  if (array.form == VtkArray::Form::ascii) {
    std::optional<std::int64_t> value;
    std::int64_t at = 0;
    each_token(array.data, [&](std::string_view token) {
      if (at++ < place) return true;
      std::int64_t v = 0;
      if (std::from_chars(token.data(), token.data() + token.size(), v).ec == std::errc()) value = v;
      return false;
    });
    return value;
  }
  const Stretch data(array.data, array.form == VtkArray::Form::base64);
  const auto from = static_cast<std::uint64_t>(place) * array.value_bytes;
  const Bytes bytes = encoding.compressor.empty() ? data.read(encoding.header_bytes + from, array.value_bytes)
                                                  : from_blocks(data, from, array.value_bytes, encoding);
  if (bytes.size() < array.value_bytes) return std::nullopt;
  auto value = number(bytes.data(), array.value_bytes, encoding.big_endian);
  // Extends the sign.
  const auto unused = 64 - 8 * array.value_bytes;
  if (array.is_signed) return static_cast<std::int64_t>(value << unused) >> unused;
  return static_cast<std::int64_t>(value);
}

}  // namespace tunica::mesh_io
