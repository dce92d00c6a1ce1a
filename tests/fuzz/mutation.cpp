#include "fuzz/mutation.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <limits>

namespace tunica::fuzz {

namespace {

constexpr std::size_t largest = std::size_t{1} << 20;  // what grows beyond is cut

/// A block within a text of `size` bytes, mostly a short one.
struct Block {
  std::size_t begin, length;
};
Block any_block(std::size_t size, Random& random) {
  const std::size_t begin = random.below(size), rest = size - begin;
  const std::size_t longest = random.below(4) == 0 ? rest : std::min<std::size_t>(rest, 16);
  return {begin, longest == 0 ? 0 : 1 + random.below(longest)};
}

void flip_bit(std::string& bytes, Random& random) {
  if (bytes.empty()) return;
  auto& byte = bytes[random.below(bytes.size())];
  byte = static_cast<char>(byte ^ (1 << random.below(8)));
}

void set_byte(std::string& bytes, Random& random) {
  constexpr unsigned char values[] = {0, 1, 0x7f, 0x80, 0xff, '\n', ' ', '0', '-', '"', '<', ',', ':', '{', '\t', '%'};
  if (bytes.empty()) return;
  auto& byte = bytes[random.below(bytes.size())];
  byte = static_cast<char>(random.below(2) == 0 ? values[random.below(std::size(values))] : random.below(256));
}

void truncate(std::string& bytes, Random& random) { bytes.resize(random.below(bytes.size() + 1)); }

void remove_block(std::string& bytes, Random& random) {
  const auto b = any_block(bytes.size(), random);
  bytes.erase(b.begin, b.length);
}

void duplicate_block(std::string& bytes, Random& random) {
  const auto b = any_block(bytes.size(), random);
  const auto block = bytes.substr(b.begin, b.length);
  const std::size_t times = random.below(8) == 0 ? 1 + random.below(64) : 1;
  for (std::size_t i = 0; i < times && bytes.size() + block.size() < largest; ++i) bytes.insert(b.begin, block);
}

void copy_block(std::string& bytes, Random& random) {
  const auto b = any_block(bytes.size(), random);
  const auto block = bytes.substr(b.begin, b.length);
  bytes.replace(random.below(bytes.size() + 1), block.size(), block);
}

void insert_bytes(std::string& bytes, Random& random) {
  std::string block(1 + random.below(16), '\0');
  for (char& c : block) c = static_cast<char>(random.below(256));
  bytes.insert(random.below(bytes.size() + 1), block);
}

void splice(std::string& bytes, const std::string& other, Random& random) {
  const auto from = any_block(other.size(), random);
  const auto part = other.substr(from.begin, random.below(2) == 0 ? std::string::npos : from.length);
  const auto at = random.below(bytes.size() + 1);
  if (random.below(2) == 0)
    bytes = bytes.substr(0, at) + part;
  else
    bytes.insert(at, part);
}

/// Replaces a number of a text.
void replace_number(std::string& bytes, Random& random) {
  static const std::array<const char*, 30> values = {"0",
                                                     "-1",
                                                     "1",
                                                     "2",
                                                     "3",
                                                     "-2147483648",
                                                     "2147483647",
                                                     "2147483648",
                                                     "4294967295",
                                                     "4294967296",
                                                     "100000000",
                                                     "9223372036854775807",
                                                     "-9223372036854775808",
                                                     "18446744073709551616",
                                                     "1e308",
                                                     "-1e308",
                                                     "1e309",
                                                     "1e-320",
                                                     "nan",
                                                     "-nan",
                                                     "inf",
                                                     "-inf",
                                                     "0.5",
                                                     "1e5",
                                                     "0x10",
                                                     "",
                                                     "255",
                                                     "65536",
                                                     "1e",
                                                     "--1"};
  const auto is_digit = [&](std::size_t i) { return std::isdigit(static_cast<unsigned char>(bytes[i])) != 0; };
  std::size_t at = random.below(bytes.size());
  while (at < bytes.size() && !is_digit(at)) ++at;
  if (at >= bytes.size()) return;
  std::size_t begin = at, end = at;
  const auto part_of_number = [&](std::size_t i) {
    return is_digit(i) || (bytes[i] != '\0' && std::strchr(".-+e", bytes[i]));
  };
  while (begin > 0 && part_of_number(begin - 1)) --begin;
  while (end < bytes.size() && part_of_number(end)) ++end;
  bytes.replace(begin, end - begin, values[random.below(values.size())]);
}

template <class T>
void put(std::string& bytes, T value, bool big_endian, Random& random) {
  if (bytes.size() < sizeof(T)) return;
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), &value, sizeof(T));
  if (big_endian) std::reverse(raw.begin(), raw.end());
  // Headers are full of numbers, and lie at the beginning.
  const std::size_t places = bytes.size() - sizeof(T) + 1;
  const auto at = random.below(random.below(2) == 0 ? places : std::min<std::size_t>(places, 512));
  std::memcpy(bytes.data() + at, raw.data(), sizeof(T));
}

/// Puts an extreme number into binary data.
void put_number(std::string& bytes, Random& random) {
  static const std::array<std::int64_t, 14> whole = {0,
                                                     1,
                                                     -1,
                                                     2,
                                                     127,
                                                     128,
                                                     32767,
                                                     65536,
                                                     1 << 24,
                                                     std::numeric_limits<std::int32_t>::max(),
                                                     std::numeric_limits<std::int32_t>::min(),
                                                     std::int64_t{1} << 32,
                                                     std::numeric_limits<std::int64_t>::max(),
                                                     std::numeric_limits<std::int64_t>::min()};
  static const std::array<double, 7> real = {
      0.0, -1.0, 1e308, 1e-308, 0.5, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()};
  const auto number = whole[random.below(whole.size())];
  const auto value = real[random.below(real.size())];
  const bool big = random.below(4) == 0;
  switch (random.below(5)) {
    case 0:
      return put(bytes, static_cast<std::int16_t>(number), big, random);
    case 1:
      return put(bytes, static_cast<std::int32_t>(number), big, random);
    case 2:
      return put(bytes, number, big, random);
    case 3:
      return put(bytes, value > 1e38 ? std::numeric_limits<float>::infinity() : static_cast<float>(value), big, random);
    default:
      return put(bytes, value, big, random);
  }
}

/// Removes, doubles or moves a line.
void change_line(std::string& bytes, Random& random) {
  std::vector<std::string> lines(1);
  for (const char c : bytes) {
    lines.back() += c;
    if (c == '\n') lines.emplace_back();
  }
  const auto at = random.below(lines.size());
  const auto line = lines[at];
  const auto choice = random.below(3);
  if (choice != 1) lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
  if (choice != 0) lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(random.below(lines.size() + 1)), line);
  bytes.clear();
  for (const auto& l : lines) bytes += l;
}

void change(std::string& bytes, const std::string& other, Random& random) {
  switch (random.below(14)) {
    case 0:
      return flip_bit(bytes, random);
    case 1:
      return set_byte(bytes, random);
    case 2:
      return random.below(4) == 0 ? truncate(bytes, random) : flip_bit(bytes, random);
    case 3:
      return remove_block(bytes, random);
    case 4:
      return duplicate_block(bytes, random);
    case 5:
      return copy_block(bytes, random);
    case 6:
      return insert_bytes(bytes, random);
    case 7:
      return splice(bytes, other, random);
    case 8:
    case 9:
    case 10:
      return replace_number(bytes, random);
    case 11:
    case 12:
      return put_number(bytes, random);
    default:
      return change_line(bytes, random);
  }
}

}  // namespace

std::string mutated(std::string bytes, const std::string& other, Random& random) {
  const std::size_t changes = 1 + random.below(4);
  for (std::size_t i = 0; i < changes; ++i) change(bytes, other, random);
  if (bytes.size() > largest) bytes.resize(largest);
  return bytes;
}

}  // namespace tunica::fuzz
