// What the verification of flow and outlets shares: set-up of cases, errors against exact fields, printing.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "folders.hpp"
#include "tunica/coupling/problem.hpp"
#include "tunica/distributed/element_nodes.hpp"
#include "tunica/fe/quadratic_tetrahedron.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::verification {

inline constexpr double pi = 3.14159265358979323846;
inline std::size_t at(std::int32_t node) { return 4 * static_cast<std::size_t>(node); }

/// Prints on rank 0 of the world.
[[gnu::format(printf, 1, 2)]] inline void say(const char* format, ...) {
  if (parallel::rank(MPI_COMM_WORLD) != 0) return;
  std::va_list arguments;
  va_start(arguments, format);
  std::vprintf(format, arguments);
  va_end(arguments);
  std::fflush(stdout);
}

inline double order(double coarse, double fine, double ratio = 2.0) {
  return std::log(coarse / fine) / std::log(ratio);
}

inline coupling::ProblemInput newtonian(double density, double viscosity) {
  coupling::ProblemInput input;
  input.fluid = fluid::Parameters{};
  input.fluid->density = density;
  input.fluid->viscosity = fluid::Newtonian{viscosity};
  input.boundary.fluid = input.fluid;
  input.newton.relative_tolerance = 1e-6;
  input.linear.tolerance = 1e-4;
  return input;
}

using ScalarField = std::function<double(const Vec3<double>&, double)>;

/// Velocity, its rate and the pressure at the nodes at the start.
inline coupling::State state_from(const coupling::Problem& problem, double time, const coupling::VectorField& velocity,
                                  const coupling::VectorField& rate, const ScalarField& pressure) {
  coupling::State state = problem.initial_state();
  state.time = time;
  const auto& mesh = problem.mesh();
  for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
    const auto v = velocity(mesh.points[i], time), a = rate(mesh.points[i], time);
    for (int c = 0; c < 3; ++c) {
      state.velocity_pressure[at(i) + c] = v[c];
      state.acceleration[at(i) + c] = a[c];
    }
    state.velocity_pressure[at(i) + 3] = pressure(mesh.points[i], time);
  }
  return state;
}

/// A fixed number of steps; a step that does not converge fails the test and ends it.
inline void march(coupling::Problem& problem, coupling::State& state, double dt, int steps,
                  const std::function<void()>& after_step = {}) {
  for (int k = 0; k < steps; ++k) {
    const auto report = problem.advance(state, dt);
    ASSERT_TRUE(report.converged) << "step " << state.step + 1 << ": " << report.failure;
    if (after_step) after_step();
  }
}

struct Errors {
  double velocity = 0, pressure = 0;  ///< L2 norms over the domain, relative to those of the exact fields
};

/// Against exact fields on the mesh at rest, with rules of degree 2 for linear and 5 for quadratic elements; the
/// pressure belongs to time `pressure_time`.
inline Errors errors(const coupling::Problem& problem, const coupling::State& state, double pressure_time,
                     const coupling::VectorField& velocity, const ScalarField& pressure) {
  const auto& mesh = problem.mesh();
  std::vector<double> sums(4, 0.0);
  for (const auto& region : mesh.regions)
    for (std::int32_t e = 0; e < region.owned_elements; ++e) {
      std::vector<std::int32_t> nodes;
      distributed::for_each_node(region, static_cast<std::size_t>(e),
                                 [&](std::int32_t node) { nodes.push_back(node); });
      Vec3<double> x[4];
      for (int a = 0; a < 4; ++a) x[a] = mesh.points[nodes[a]];
      const double volume = fe::gradients(x).volume;
      // At a point with the barycentric coordinates l, where the shape functions of the velocity are N.
      const auto add = [&](const double(&l)[4], const double* N, double weight) {
        Vec3<double> place{}, v{};
        double p = 0;
        for (std::size_t a = 0; a < nodes.size(); ++a) {
          const double* nodal = state.velocity_pressure.data() + at(nodes[a]);
          v = v + N[a] * Vec3<double>{{nodal[0], nodal[1], nodal[2]}};
          if (a >= 4) continue;
          place = place + l[a] * x[a];
          p += l[a] * nodal[3];
        }
        const auto exact_v = velocity(place, state.time);
        const double exact_p = pressure(place, pressure_time), w = weight * volume;
        sums[0] += w * dot(v - exact_v, v - exact_v);
        sums[1] += w * dot(exact_v, exact_v);
        sums[2] += w * (p - exact_p) * (p - exact_p);
        sums[3] += w * exact_p * exact_p;
      };
      if (mesh.quadratic)
        for (const auto& point : fe::quadratic_fourteen_points) add(point.barycentric, point.N, point.weight);
      else
        for (const auto& point : fe::four_points) add(point.barycentric, point.barycentric, point.weight);
    }
  parallel::global_sum(mesh.comm, sums);
  return {std::sqrt(sums[0] / sums[1]), std::sqrt(sums[2] / sums[3])};
}

/// Columns of a CSV file with comment lines (#) and one header line.
struct Columns {
  std::map<std::string, std::vector<double>> columns;
  const std::vector<double>& operator[](const std::string& name) const { return columns.at(name); }
};

inline std::filesystem::path reference(const std::string& name) {
  return std::filesystem::path(TUNICA_SHARED_DATA) / "analytic" / name;
}

inline Columns read_columns(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line, cell;
  std::vector<std::string> names;
  Columns result;
  while (std::getline(file, line)) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    const bool header = names.empty();
    for (std::size_t k = 0; std::getline(cells, cell, ','); ++k) {
      if (header)
        names.push_back(cell);
      else
        result.columns[names.at(k)].push_back(std::stod(cell));
    }
  }
  return result;
}

}  // namespace tunica::verification
