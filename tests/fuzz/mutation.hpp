// Damages a file, the same way for the same seed on every machine.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tunica::fuzz {

/// Random numbers by splitmix64 (Steele, Lea, Flood 2014): unlike the distributions of the standard library the same
/// everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  /// 0 .. count - 1; 0 for a count of 0.
  std::size_t below(std::size_t count) { return count == 0 ? 0 : next() % count; }

 private:
  std::uint64_t state_;
};

/// One to four changes of `bytes`: bits, bytes, blocks and lines changed, removed, doubled and moved, numbers of text
/// and of binary data replaced by extreme ones, the end cut off, and parts of `other` put in.
std::string mutated(std::string bytes, const std::string& other, Random& random);

}  // namespace tunica::fuzz
