// Fingerprint of cases and meshes, to notice that a file belongs to another one. Not cryptographic.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace tunica::files {

/// FNV-1a (Fowler, Noll, Vo) over words of eight bytes, the last one of an entry filled with zeros.
class Hash {
 public:
  void add(const void* data, std::size_t bytes) {
    const char* p = static_cast<const char*>(data);
    std::uint64_t word = 0;
    for (; bytes >= sizeof word; p += sizeof word, bytes -= sizeof word) {
      std::memcpy(&word, p, sizeof word);
      add(word);
    }
    if (bytes == 0) return;
    word = 0;
    std::memcpy(&word, p, bytes);
    add(word);
  }
  std::uint64_t value() const { return value_; }

 private:
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 1099511628211ULL;
    value_ ^= value_ >> 32;  // words, unlike bytes, need their high bits brought down
  }
  std::uint64_t value_ = 14695981039346656037ULL;
};

/// A fingerprint as files hold it: 16 hexadecimal digits.
std::string hex(std::uint64_t hash);

}  // namespace tunica::files
