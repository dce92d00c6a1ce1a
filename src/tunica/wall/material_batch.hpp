// Energy, stress and tangent of one law at many deformation gradients, compiled once per instruction set: the same
// point as material_point.hpp, several at a time, as the loops over elements take them.
#pragma once

#include <cstddef>

#include "tunica/wall/material.hpp"
#include "tunica/wall/volumetric.hpp"

namespace tunica::wall {

/// Where the results go; null: not wanted. Tensors by rows.
struct MaterialBatchResults {
  double* energy = nullptr;   ///< Psi with its volumetric part, per reference volume [point] [J/m^3]
  double* stress = nullptr;   ///< second Piola-Kirchhoff S [point][3][3] [Pa], in the axes of the law
  double* cauchy = nullptr;   ///< sigma [point][3][3] [Pa], in the axes of x
  double* tangent = nullptr;  ///< CC = 2 dS/dC [point][6][6] [Pa], order 11 22 33 12 23 13, in the axes of the law
};

/// `F`: [point][3][3], columns in the axes of the law. `pressure` [point] [Pa], positive in compression, takes the
/// place of the volumetric law, whose bulk modulus may then be infinite; null: the volumetric law, with a finite bulk
/// modulus. Of an incompressible law the energy has no volumetric part. NaN where det F <= 0.
using MaterialBatch = void (*)(const Law& law, const Volumetric& volumetric, const double* F, const double* pressure,
                               std::size_t points, const MaterialBatchResults& results);

/// For packs of W doubles; instantiated in material_batch_<isa>.cpp. The processor must have that instruction set.
template <int W>
MaterialBatch material_batch();

/// For a width of 2, 4 or 8 doubles; sanitized builds have 2 alone.
MaterialBatch material_batch(int width);

}  // namespace tunica::wall
