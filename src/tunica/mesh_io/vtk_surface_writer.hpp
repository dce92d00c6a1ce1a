// Surfaces with values at their points, for ParaView.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tunica/base/tensor.hpp"

namespace tunica::mesh_io {

/// Values at the points, one after the other.
struct PointArray {
  std::string name;  ///< with its unit, as in "growth [mm]"
  int components = 1;
  std::vector<double> values{};  ///< [point][component]
};

struct SurfaceWithArrays {
  std::vector<Vec3<double>> points;  ///< in the unit of the file
  std::vector<std::array<std::int64_t, 3>> triangles;
  std::vector<PointArray> arrays;
};

/// Writes a .vtp file. Throws SolverError with file and cause when it cannot.
void write_surface_with_arrays(const SurfaceWithArrays& surface, const std::filesystem::path& file);

}  // namespace tunica::mesh_io
