#include "tunica/stages/validate/benchmark.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>

namespace tunica::stages::validate {

const char* const output_section =
    "output:\n"
    "  every: 100000\n"
    "  units: {length: m, time: s, velocity: m/s, pressure: Pa, stress: Pa, flow: m^3/s}\n";

std::string elements_line(const Variant& variant) {
  return variant.elements == case_file::Elements::quadratic ? "elements: quadratic\n" : "elements: linear\n";
}

std::string fluid_section(double density, double viscosity) {
  return fmt::format("fluid: {{density: {} kg/m^3, viscosity: {{newtonian: {{viscosity: {} Pa s}}}}}}\n", density,
                     viscosity);
}

std::complex<double> bessel(int order, std::complex<double> z) {
  const std::complex<double> square = -0.25 * z * z;
  std::complex<double> term = order == 0 ? 1.0 : 0.5 * z, sum = term;
  for (int k = 1; k < 80; ++k) {
    term *= square / static_cast<double>(k * (k + order));
    sum += term;
  }
  return sum;
}

std::complex<double> harmonic(const std::vector<double>& time, const std::vector<double>& value, double period) {
  std::complex<double> sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    if (time[k] < time.back() - period * (1 - 1e-6)) continue;
    sum += value[k] * std::exp(std::complex<double>(0, -2 * std::numbers::pi * time[k] / period));
    ++count;
  }
  return 2.0 / count * sum;
}

std::vector<Benchmark> benchmarks() {
  std::vector<Benchmark> all;
  for (auto part : {flow_benchmarks, jet_benchmarks, wall_benchmarks, wave_benchmarks, flag_benchmarks}) {
    auto list = part();
    std::move(list.begin(), list.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace tunica::stages::validate
