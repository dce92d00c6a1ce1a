// Verification of the dispersed fibres as a user sees it: finite elements, sum over directions, analytic solution.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "tunica/stages/material/verify_cube.hpp"

namespace tunica::stages {

/// All results of one curve [Pa].
struct VerifiedCase {
  CubeCase definition;
  std::vector<double> loads;
  std::vector<double> analytic;  ///< continuous density, incompressible
  std::vector<double> sum;       ///< 256 directions at the material point, incompressible
  std::vector<double> point;     ///< the same with the bulk modulus of the elements
  CubeSolution mixed, displacement;
};
VerifiedCase verify_case(const CubeCase& c);

/// One statement that holds or does not.
struct Comparison {
  std::string test, curve, what;
  double difference = 0.0, bound = 0.0;  ///< relative
  bool passed() const { return difference <= bound; }
};
/// Finite elements against the point: largest pointwise difference, of any element. Against the analytic solution:
/// relative to the largest stress of the curve, and pointwise for the sum.
std::vector<Comparison> compare(const VerifiedCase& c);

}  // namespace tunica::stages
