// What a run starts from: initial fields of the meshes, and a prestress that is to be found.
#include <fmt/format.h>

#include "tunica/peer_cases/problem.hpp"

namespace tunica::peer_cases {

namespace {

/// The files of the initial fields of one mesh.
InitialFiles files_of(Context& context, const Entry& mesh, std::string& sources) {
  InitialFiles files;
  const auto take = [&](const char* key, std::optional<std::filesystem::path>& file) {
    const Entry* entry = mesh.find(key);
    if (entry == nullptr) return;
    context.path(*entry);  // warns when it is not there
    file = context.located(*entry);
    sources += (sources.empty() ? "" : ", ") + entry->where();
  };
  take("Initial_velocities_file_path", files.velocity);
  take("Initial_pressures_file_path", files.pressure);
  take("Initial_displacements_file_path", files.displacement);
  return files;
}

void refuse_displacements(Context& context, const PosedProblem& problem) {
  if (problem.solves_wall() || problem.lumen == nullptr) return;
  if (const Entry* entry = problem.lumen->find("Initial_displacements_file_path"))
    context.missing(*entry, "blood between rigid walls whose mesh starts displaced", "remove the key");
}

void find_prestress(Context& context, const PosedProblem& problem, CaseKey& top) {
  const Entry* prestress = problem.main->find("Prestress");
  if (prestress == nullptr || !context.flag(*problem.main, prestress->key)) return;
  if (!problem.solves_wall())
    return context.refuse(*prestress, "is for walls", "remove it, or use the equation struct, ustruct or FSI");
  if (context.prestress)
    return context.refuse(*prestress, "asks for a prestress beside the one of Prestress_file_path", "keep one of them");
  auto& section = top.section("prestress", prestress->where());
  section.add("method", "stress", fmt::format("S0 is added to the stress of the law, as in {}", context.peer()));
  section.add("update", "second_piola", fmt::format("as in {}", context.peer()));
  context.changed(*prestress, fmt::format("`tunica prestress` finds it by a fixed point on the loads at the start, not "
                                          "in the course of time steps as {} does; `tunica run` goes on from there",
                                          context.peer()));
}

}  // namespace

void translate_start(Context& context, const PosedProblem& problem, CaseKey& top) {
  find_prestress(context, problem, top);
  refuse_displacements(context, problem);
  InitialState state;
  std::string sources;
  if (problem.solves_fluid() && problem.lumen != nullptr) state.lumen = files_of(context, *problem.lumen, sources);
  if (problem.solves_wall() && problem.wall != nullptr) state.wall = files_of(context, *problem.wall, sources);
  if (!state.lumen.any() && !state.wall.any()) return;
  const Entry& mesh = problem.lumen != nullptr ? *problem.lumen : *problem.wall;
  if (state.wall.displacement && problem.solves_fluid() && !state.lumen.displacement)
    context.changed(
        *problem.wall->find("Initial_displacements_file_path"),
        fmt::format("the mesh of the blood starts where the displaced wall takes it, in {} it follows in the "
                    "first step",
                    context.peer()));
  if (massless(context, problem))
    return context.missing(mesh, "initial fields of a wall without mass", "remove them, or write the density");
  state.file = context.file.path.stem().string() + "_start.checkpoint";
  top.add("start", yaml_text(state.file), sources);
  context.changed(mesh, "the initial fields belong in the file " + state.file +
                            ", which is written where meshes and fields are there");
  context.initial = std::move(state);
}

}  // namespace tunica::peer_cases
