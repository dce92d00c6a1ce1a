#include "tunica/stages/posed_case.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "tunica/artifacts/checkpoint.hpp"
#include "tunica/artifacts/manifest.hpp"
#include "tunica/artifacts/outlets_file.hpp"
#include "tunica/artifacts/problem_input.hpp"
#include "tunica/base/error.hpp"
#include "tunica/case/case_text.hpp"
#include "tunica/case/table_ends.hpp"
#include "tunica/distributed/results_writer.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/stages/vessel_of_case.hpp"

namespace tunica::stages {

namespace fs = std::filesystem;

namespace {

/// As read_start(), with the key in messages and what to do about it.
std::vector<artifacts::OutletStart> read_named_start(const fs::path& file, const distributed::DistributedMesh& mesh,
                                                     std::uint64_t mesh_hash, coupling::State& state) {
  try {
    return artifacts::read_start(
        file, mesh, state, mesh_hash,
        "name the start.checkpoint of this mesh in `start`, or find it anew: tunica prestress CASE --overwrite");
  } catch (const InputError& error) {
    auto problems = error.problems();
    for (auto& p : problems) p.where = fmt::format("start ({})", p.where);
    throw InputError(std::move(problems));
  }
}

/// Tables that end before the run, or that do not hold the instant of the prestress.
void check_tables(const case_file::Case& c, const mesh::MeshData& data) {
  auto problems = case_file::check_table_ends(c.boundary, case_file::asked_by_run(c));
  if (c.prestress) {
    std::vector<std::string> wall;
    for (const auto& face : data.faces)
      if (data.regions[static_cast<std::size_t>(face.region)].kind == mesh::RegionKind::wall) wall.push_back(face.name);
    const auto more =
        case_file::check_table_ends(case_file::conditions_on(c.boundary, wall), case_file::asked_by_prestress(c));
    problems.insert(problems.end(), more.begin(), more.end());
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

bool is_tuned(const std::string& face, const case_file::TuningCase& outlets) {
  return std::any_of(outlets.fractions.begin(), outlets.fractions.end(),
                     [&](const auto& f) { return f.first == face; });
}

}  // namespace

artifacts::Inputs inputs_of(const std::string& text, const fs::path& case_file, const case_file::Case& settings) {
  auto inputs = artifacts::run_inputs(text, case_file);
  if (settings.outlets) artifacts::Fingerprints().add(inputs, "outlets.file", settings.outlets->file());
  return inputs;
}

ReadCase read_case(MPI_Comm comm, const fs::path& case_file, const std::optional<std::string>& text) {
  ReadCase c;
  parallel::on_root(comm, [&] {
    c.text = text ? *text : config::read_text(case_file);
    auto parsed = case_file::read_case(c.text, case_file);
    c.settings = std::move(parsed.value);
    for (const auto& warning : parsed.warnings) c.warnings.push_back(format(warning));
    for (const auto& warning : artifacts::unusual_outlets(c.settings)) c.warnings.push_back(format(warning));
    c.mesh = artifacts::load_mesh(c.settings);
    c.inputs = inputs_of(c.text, case_file, c.settings);
  });
  parallel::broadcast(comm, c.text);
  if (parallel::rank(comm) != 0) c.settings = case_file::parse_case(c.text, case_file);
  artifacts::name_faces(c.settings, c.mesh, comm);
  artifacts::take_tuned_outlets(comm, c.settings);
  return c;
}

void PosedCase::pose(const ReadCase& c, MPI_Comm comm) {
  mesh = distributed::distribute(c.mesh.data, comm);
  distributed::check_region_names(mesh);
  auto input = artifacts::problem_input(c.settings);
  input.boundary.inflows = c.inflows;
  lumens = analysis::find_lumens(mesh, case_file::describe(c.settings), post_settings(c.settings));
  if (lumens) input.lumens = lumens->map;
  problem.emplace(mesh, input);
  monitors.emplace(*problem);
  fields.emplace(*problem, c.settings);
  const auto places = artifacts::probe_places(c.settings);
  probes.emplace(mesh, places);
}

void start_from(const fs::path& file, const case_file::Case& c, const distributed::DistributedMesh& mesh,
                std::uint64_t mesh_hash, coupling::State& state) {
  const auto outlets = read_named_start(file, mesh, mesh_hash, state);
  for (auto& outlet : state.outlets) {
    const auto found =
        std::find_if(outlets.begin(), outlets.end(), [&](const auto& o) { return o.face == outlet.face(); });
    if (found == outlets.end()) continue;
    outlet.set_initial_flow(found->flow);
    const bool goes_on = c.outlets && c.outlets->continued && is_tuned(outlet.face(), *c.outlets);
    for (const auto& [face, condition] : c.boundary)
      if (const auto* rcr = std::get_if<bc::Rcr>(&condition);
          rcr && face == outlet.face() && (goes_on || !rcr->initial_pressure))
        outlet.restore(std::array{found->flow, found->pressure - rcr->proximal * found->flow});
  }
}

void check_folder(const fs::path& folder) {
  fs::path there = fs::absolute(folder).lexically_normal();
  std::error_code none;
  while (!fs::exists(there, none) && there.has_relative_path()) there = there.parent_path();
  const bool writable = access(there.c_str(), W_OK | X_OK) == 0;
  if (!fs::is_directory(there, none) || !writable)
    throw InputError(folder.string(),
                     fmt::format("the folder of results cannot be made ({} {})", there.string(),
                                 writable ? "is no folder" : "cannot be written"),
                     "name one that can be created and written");
}

std::string check_posed(const ReadCase& c, MPI_Comm comm) {
  const fs::path folder = c.settings.output.directory;
  const std::string earlier = parallel::on_root(comm, [&]() -> std::string {
    check_folder(folder);
    check_tables(c.settings, c.mesh.data);
    const auto results = artifacts::find_results(folder);
    if (!results) return {};
    return fmt::format(
        "{} holds results ({}, {} steps): to go on with them, `tunica run` needs --restart, to replace "
        "them --overwrite",
        folder.string(), results->status, results->last_step);
  });
  PosedCase posed;
  posed.pose(c, comm);
  coupling::State state = posed.problem->initial_state();
  if (!c.settings.start) return earlier;
  std::uint64_t mesh_hash = parallel::on_root(comm, [&] { return artifacts::mesh_hash(c.mesh.data); });
  parallel::broadcast(comm, mesh_hash);
  start_from(*c.settings.start, c.settings, posed.mesh, mesh_hash, state);
  return earlier;
}

}  // namespace tunica::stages
