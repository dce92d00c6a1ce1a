// Initial fields of a peer's case as the state that a run starts from.
#pragma once

#include <filesystem>
#include <span>

#include "tunica/base/tensor.hpp"
#include "tunica/case/case.hpp"
#include "tunica/peer_cases/translate.hpp"
#include "tunica/peer_cases/unit_system.hpp"

namespace tunica::stages {

/// Writes `target`, a file for the key `start` of the case `c`, whose meshes are there, from the point arrays Velocity,
/// Pressure and Displacement of the files of `initial`, whose numbers are those of `units`; what has no file is zero.
/// Outlets get the flow and the mean pressure of these fields on their faces. Throws InputError when a file cannot be
/// read, its points are not those of the mesh, or the tetrahedra have ten nodes; SolverError when `target` cannot be
/// written. Not collective.
void write_initial_state(const peer_cases::InitialState& initial, const case_file::Case& c,
                         const peer_cases::UnitSystem& units, const std::filesystem::path& target);

/// Throws InputError where the points of `file` are not `points` [m]; its unit has `metres`.
void check_points(const std::filesystem::path& file, std::span<const Vec3<double>> of_file,
                  std::span<const Vec3<double>> points, double metres, const char* remedy);

}  // namespace tunica::stages
