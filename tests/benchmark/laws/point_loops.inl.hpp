// Bodies of point_loops.hpp; included only by the translation units of one instruction set each.
#pragma once

#include <cstddef>

#include "benchmark/laws/point_loops.hpp"
#include "tunica/wall/material_point.hpp"

namespace tunica::benchmarks {

namespace {

template <int W, class L>
__attribute__((noinline)) void evaluate_law(const L& law, int points, const double* F, double* results) {
  const wall::Volumetric volumetric{wall::VolumetricEnergy::simo_taylor, 1e6};
  for (int batch = 0; batch < points / W; ++batch) {
    Mat3<Pack<W>> gradient;
    for (int n = 0; n < 9; ++n)
      gradient(n / 3, n % 3) = Pack<W>::load(F + (static_cast<std::ptrdiff_t>(batch) * 9 + n) * W);
    const auto point = wall::material_point(gradient, law, volumetric);
    double* out = results + static_cast<std::ptrdiff_t>(batch) * 27 * W;
    for (int n = 0; n < 6; ++n) point.stress[n].store(out + n * W);
    for (int n = 0; n < 21; ++n) point.tangent.v[n].store(out + (6 + n) * W);
  }
}

template <int W>
void evaluate(const wall::Law& law, int points, const double* F, double* results) {
  std::visit([&](const auto& l) { evaluate_law<W>(l, points, F, results); }, law);
}

// Enough chains to hide the latency of two units of four cycles each.
template <int W>
double multiply_add(int repetitions, double* sink) {
  constexpr int chains = 12;
  Pack<W> x[chains];
  for (int c = 0; c < chains; ++c) x[c] = Pack<W>(1.0 + 0.01 * c);
  const Pack<W> factor(0.999999), term(1e-6);
  for (int r = 0; r < repetitions; ++r)
#pragma GCC unroll 12
    for (int c = 0; c < chains; ++c) x[c] = x[c] * factor + term;
  Pack<W> sum(0.0);
  for (int c = 0; c < chains; ++c) sum += x[c];
  sum.store(sink);
  return 2.0 * chains * W * static_cast<double>(repetitions);
}

}  // namespace

template <int W>
PointLoops make_point_loops() {
  return {&evaluate<W>, &multiply_add<W>, W};
}

}  // namespace tunica::benchmarks
