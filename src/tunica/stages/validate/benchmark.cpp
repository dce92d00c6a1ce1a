#include "tunica/stages/validate/benchmark.hpp"

#include <iterator>

namespace tunica::stages::validate {

std::string elements_line(const Variant& variant) {
  return variant.elements == case_file::Elements::quadratic ? "elements: quadratic\n" : "elements: linear\n";
}

std::vector<Benchmark> benchmarks() {
  std::vector<Benchmark> all;
  for (auto part : {flow_benchmarks, wall_benchmarks, flag_benchmarks}) {
    auto list = part();
    std::move(list.begin(), list.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace tunica::stages::validate
