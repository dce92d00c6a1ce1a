// The tests of a material file: curves of stress, tables of everything at the material point, measured points beside.
#pragma once

#include <cstdio>
#include <filesystem>
#include <optional>
#include <vector>

#include "tunica/case/material_case.hpp"
#include "tunica/wall/material_paths.hpp"

namespace tunica::stages {

/// What a test gives: one point for each load.
struct MaterialCurve {
  wall::FibreFrame axes;      ///< of the specimen; the fibre frame for given gradients
  std::vector<double> loads;  ///< stretch or amount of shear along the first axis; 1, 2, ... for given gradients
  std::vector<wall::PathPoint> points;
};

/// Throws SolverError naming the step, InputError for a table of gradients that does not read. `name` is for messages.
MaterialCurve run_test(const std::string& name, const case_file::Loading& loading, const wall::Law& law,
                       const wall::Volumetric& volumetric);

/// The same at loads of the caller's choice, in their order; not for given gradients.
MaterialCurve run_test_at(const std::string& name, const case_file::Loading& loading, const std::vector<double>& loads,
                          const wall::Law& law, const wall::Volumetric& volumetric);

/// Stress [Pa] at each point that belongs to the load: along the first axis, or in shear; `across`: along the second.
std::vector<double> stresses(const MaterialCurve& curve, const case_file::Loading& loading,
                             case_file::StressMeasure measure, bool across);

}  // namespace tunica::stages
