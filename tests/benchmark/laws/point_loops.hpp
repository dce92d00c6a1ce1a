// Stress and tangent at many points, compiled once per instruction set, and the rate of multiply-adds to compare with.
#pragma once

#include <vector>

#include "tunica/assembly/isa.hpp"
#include "tunica/wall/material.hpp"

namespace tunica::benchmarks {

struct PointLoops {
  /// Second Piola-Kirchhoff stress and tangent for `points` deformation gradients, a multiple of the width:
  /// F [batch][9][lane], results [batch][27][lane].
  void (*evaluate)(const wall::Law& law, int points, const double* F, double* results);
  /// Repeats independent multiply-adds; returns how many floating-point operations it did.
  double (*multiply_add)(int repetitions, double* sink);
  int width;
};

template <int W>
PointLoops make_point_loops();

PointLoops point_loops(assembly::Isa isa);

}  // namespace tunica::benchmarks
