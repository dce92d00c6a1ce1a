// Small cases of every kind, and what is needed to run them and to look at what they leave.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "shared_folder.hpp"
#include "tunica/stages/run/run.hpp"

namespace tunica::test {

namespace fs = std::filesystem;

inline const std::string coarse_tube =
    "radius: 5 mm, length: 2 cm, cells_around: 8, cells_radial: 1, cells_along: 5, cells_through_wall: 1";

/// Pressure pulse in a compliant tube; `more` replaces or adds whole sections.
inline std::string coupled_case(int steps, const std::string& more = "") {
  std::string text =
      "analysis: fsi\nelements: linear\n"
      "meshes:\n  tube: {" +
      coarse_tube +
      ", wall_thickness: 1 mm}\n"
      "  interface: {lumen: lumen_wall, wall: wall_inner}\n"
      "fluid: {density: 1 g/cm^3, viscosity: {newtonian: {viscosity: 3 mPa s}}}\n"
      "wall: {density: 1.2 g/cm^3, material: {neo_hooke: {young_modulus: 300 kPa, poisson_ratio: 0.3}}}\n"
      "boundary:\n"
      "  lumen_inlet: {pressure: {step: {value: 1.3332 kPa, end: 0.3 ms}}}\n"
      "  lumen_outlet: {resistance: {resistance: 1e8 Pa s/m^3}}\n"
      "  wall_inlet: fixed\n  wall_outlet: fixed\n  wall_outer: free\n";
  if (more.find("time:") == std::string::npos) text += fmt::format("time: {{step: 0.1 ms, steps: {}}}\n", steps);
  if (more.find("output:") == std::string::npos) text += "output: {every: 5, checkpoint_every: 5, units: {time: ms}}\n";
  if (more.find("newton:") == std::string::npos) text += "newton: {relative_tolerance: 1e-8}\n";
  return text + more;
}

/// Flow through a rigid tube into a Windkessel.
inline std::string windkessel_case(int steps) {
  return "analysis: flow\nelements: linear\n"
         "meshes: {tube: {" +
         coarse_tube +
         "}}\n"
         "fluid: {density: 1.06 g/cm^3, viscosity: {newtonian: {viscosity: 4 mPa s}}}\n"
         "boundary:\n"
         "  lumen_inlet: {flow: {value: 20 ml/s, ramp_time: 10 ms}}\n"
         "  lumen_outlet: {rcr: {proximal: 1e7 Pa s/m^3, capacitance: 1e-9 m^3/Pa, distal: 1e8 Pa s/m^3}}\n"
         "  lumen_wall: no_slip\n" +
         fmt::format("time: {{step: 2 ms, steps: {}}}\n", steps) +
         "newton: {relative_tolerance: 1e-8}\n"
         "output: {every: 5, units: {pressure: Pa, flow: ml/s}}\n";
}

/// Runs the case on `comm` and returns what it printed (on rank 0).
inline std::string run(const fs::path& case_file, stages::RunRequest request = {}, MPI_Comm comm = MPI_COMM_WORLD,
                       stages::RunOutcome* outcome = nullptr) {
  request.case_file = case_file;
  request.program = {"test", "none"};
  request.verbose = true;  // every step is told
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* screen = open_memstream(&text, &size);
  std::exception_ptr error;
  try {
    const auto result = stages::run(comm, request, screen);
    if (outcome != nullptr) *outcome = result;
  } catch (...) {
    error = std::current_exception();
  }
  std::fclose(screen);
  const std::string printed(text, size);
  std::free(text);
  MPI_Barrier(comm);
  if (error) std::rethrow_exception(error);
  return printed;
}

/// A history: columns by name.
struct Table {
  std::map<std::string, std::vector<double>> columns;
  explicit Table(const fs::path& file) {
    std::ifstream in(file);
    std::string line, cell;
    std::vector<std::string> names;
    for (bool header = true; std::getline(in, line); header = false) {
      std::istringstream cells(line);
      for (std::size_t k = 0; std::getline(cells, cell, ','); ++k)
        if (header)
          names.push_back(cell);
        else
          columns[names.at(k)].push_back(std::stod(cell));
    }
  }
  const std::vector<double>& operator[](const std::string& name) const { return columns.at(name); }
  double last(const std::string& name) const { return columns.at(name).back(); }
};

}  // namespace tunica::test
