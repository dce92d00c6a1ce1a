// Values that depend on the global numbers of nodes only, so that every rank can compute those of all nodes.
#pragma once

#include <cstdint>

#include "tunica/assembly/isa.hpp"
#include "tunica/distributed/distributed_mesh.hpp"

namespace tunica::test {

/// Uniform in [-1, 1), from a splitmix64 hash of the key and the component.
inline double noise(std::int64_t key, int component) {
  std::uint64_t z = static_cast<std::uint64_t>(key) * 64 + static_cast<std::uint64_t>(component) + 1;
  z *= 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-52 - 1.0;
}

/// Entry (i, j) of the 4 x 4 block of two nodes, exact in single precision.
inline double block_entry(std::int64_t row, std::int64_t column, int i, int j) {
  return static_cast<float>(noise(row * 1000003 + column, 4 * i + j));
}

inline std::size_t at(std::int32_t node) { return 4 * static_cast<std::size_t>(node); }

/// The instruction sets that this processor has.
inline std::vector<assembly::Isa> available_isas() {
  std::vector<assembly::Isa> list;
  for (const auto isa : {assembly::Isa::sse2, assembly::Isa::avx2, assembly::Isa::avx512})
    if (isa <= assembly::choose_isa()) list.push_back(isa);
  return list;
}

}  // namespace tunica::test
