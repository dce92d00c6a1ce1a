// One `tunica prestress`: the class behind prestress(). Only for the files of this folder.
#pragma once

#include <mpi.h>

#include <optional>
#include <string>
#include <vector>

#include "tunica/artifacts/histories.hpp"
#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/config/units.hpp"
#include "tunica/coupling/prestress.hpp"
#include "tunica/distributed/results_writer.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/mesh/submesh.hpp"
#include "tunica/parallel/gather.hpp"
#include "tunica/parallel/log.hpp"
#include "tunica/stages/prestress/prestress.hpp"
#include "tunica/stages/prestress/steady_flow.hpp"

namespace tunica::stages {

constexpr const char* prestress_report_file = "prestress.json";

/// "stress", "stretch" or "inverse".
const char* name_of(coupling::PrestressSettings::Method method);

/// The wall of a case alone, in equilibrium with its loads.
case_file::Case wall_case(const case_file::Case& c, const std::vector<std::string>& wall_faces);

parallel::NodeOrder node_order(const distributed::DistributedMesh& mesh);

/// One `tunica prestress`. Its member functions are collective.
class PrestressRun {
 public:
  PrestressRun(MPI_Comm comm, const PrestressRequest& request, std::FILE* screen);
  /// To the end, or to another one, of which prestress.json tells. Returns the signal that stopped it, or 0.
  int steps();

 private:
  void compute();
  void record_end(const char* status, const std::string& message);
  void read();
  void prepare_folder();
  void find_flow();
  std::string command(const char* option) const;
  void take_steps_of_flow(coupling::Problem& problem);
  void write_flow(const coupling::Problem& problem, const case_file::Case& flow);
  void take_forces(const coupling::Problem& problem);
  void find_wall();
  coupling::ProblemInput wall_input();
  /// What is left of the flow's forces once the pressure has its part [N], [local node][4].
  std::vector<double> forces_beside_pressure() const;
  void write_traction(const coupling::Problem& problem);
  void set_corners_to_mean(std::vector<double>& traction) const;
  void follow(const coupling::PrestressRecord& record);
  void plot_history(const std::vector<coupling::PrestressRecord>& history);
  void write_prestress_file(const coupling::WallPrestress& prestress);
  void write_stress(const coupling::Problem& problem, const coupling::State& state);
  void write_unloaded(const std::vector<double>& unloading);
  void write_start(const coupling::State& wall);
  void write_report(const coupling::PrestressResult& result);

  const case_file::PrestressCase& settings() const { return *case_.prestress; }
  double per_si(const std::string& unit, const config::Dimension& dimension) const {
    return 1 / config::unit_factor(unit, dimension);
  }
  distributed::ResultsOptions results_in(const char* folder) const {
    distributed::ResultsOptions options{.directory = folder_ / folder};
    options.length_factor = per_si(case_.output.units.length, config::dimension::length);
    return options;
  }

  MPI_Comm comm_;
  const PrestressRequest& request_;
  std::string text_;
  case_file::Case case_;
  std::filesystem::path folder_;
  files::FolderLock lock_;  ///< rank 0
  std::optional<parallel::Log> log_;
  double started_ = MPI_Wtime();

  artifacts::CheckedMesh whole_;  ///< rank 0
  std::uint64_t mesh_hash_ = 0, lumen_hash_ = 0;
  mesh::Submesh lumen_part_, wall_part_;  ///< rank 0
  std::vector<std::string> wall_faces_, lumen_faces_, lumen_interface_, wall_interface_;

  distributed::DistributedMesh lumen_, wall_;
  coupling::State flow_;
  SteadyRecord steady_;
  std::vector<double> forces_;        ///< of the flow [N], and its pressure [Pa]; rank 0, [wall node in file order][4]
  std::vector<double> local_forces_;  ///< forces_ at the local nodes
  std::optional<artifacts::CsvTable> history_;  ///< rank 0
};

}  // namespace tunica::stages
