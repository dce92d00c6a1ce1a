// A case between its files and its first step: what `tunica run` computes with, and all that `tunica check` can find
// wrong with it. Both take this way, so that one cannot accept what the other refuses.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/analysis/lumens.hpp"
#include "tunica/artifacts/fields.hpp"
#include "tunica/artifacts/inputs.hpp"
#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/case/case.hpp"
#include "tunica/coupling/monitors.hpp"
#include "tunica/coupling/probes.hpp"
#include "tunica/coupling/problem.hpp"

namespace tunica::stages {

/// A case that was read, with the text that it was read from and (on rank 0) its mesh.
struct ReadCase {
  case_file::Case settings;
  std::string text;
  artifacts::Inputs inputs;  ///< on rank 0: what tells results of this case from those of another
  artifacts::CheckedMesh mesh;
  std::vector<std::string> warnings;  ///< on rank 0: of values in the case that look like slips
  /// Of faces with a condition `flow`, in the place of what it says: BoundaryInput::inflows. On all ranks.
  std::vector<std::pair<std::string, coupling::Course>> inflows{};
};

/// What results of a case depend on, its tuned outlets included. Not collective.
artifacts::Inputs inputs_of(const std::string& text, const std::filesystem::path& case_file,
                            const case_file::Case& settings);

/// Case, mesh and tuned outlets. `text`: that of the case, where it does not stand in the file, from whose folder paths
/// count all the same. Throws InputError with all problems. Collective, as all here.
ReadCase read_case(MPI_Comm comm, const std::filesystem::path& case_file,
                   const std::optional<std::string>& text = std::nullopt);

/// The problem that a case poses on the ranks, before anything is computed. Stays where it is made.
struct PosedCase {
  distributed::DistributedMesh mesh;
  std::optional<coupling::Problem> problem;
  std::optional<coupling::Monitors> monitors;
  std::optional<artifacts::OutputFields> fields;
  std::optional<coupling::Probes> probes;  ///< at the points of the case
  std::optional<analysis::Lumens> lumens;  ///< where true and false lumen are told apart

  PosedCase() = default;
  PosedCase(const PosedCase&) = delete;
  PosedCase& operator=(const PosedCase&) = delete;
  /// Throws InputError where mesh and case do not fit: directions, supports, regions, names.
  void pose(const ReadCase& c, MPI_Comm comm);
};

/// Sets the fields, and the flows of the outlets, that `file` starts from. A Windkessel that names no initial pressure
/// starts from the pressure that its face has there. Throws InputError when the file does not read, or belongs to
/// another mesh.
void start_from(const std::filesystem::path& file, const case_file::Case& c, const distributed::DistributedMesh& mesh,
                std::uint64_t mesh_hash, coupling::State& state);

/// Can results be written into a folder that may be there or not? Throws InputError. Not collective.
void check_folder(const std::filesystem::path& folder);

/// Does all that comes before the first step of a run, and writes nothing. Throws what the run would throw. Returns
/// what there is to say of an earlier result in the folder; empty when there is none.
std::string check_posed(const ReadCase& c, MPI_Comm comm);

}  // namespace tunica::stages
