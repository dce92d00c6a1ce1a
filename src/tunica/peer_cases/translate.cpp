#include "tunica/peer_cases/translate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tunica/base/text.hpp"
#include "tunica/peer_cases/context.hpp"
#include "tunica/peer_cases/problem.hpp"
#include "tunica/peer_cases/values.hpp"
#include "tunica/peer_cases/vocabulary.hpp"

namespace tunica::peer_cases {

namespace {

const Entry& general_of(const Context& context) {
  const Entry* general = context.file.root.find("GeneralSimulationParameters");
  return general != nullptr ? *general : context.file.root;
}

/// A run that goes on from files of the peer is one that tunica cannot compute; without such files the peer starts at
/// rest, too.
void check_start(Context& context, const Entry& general) {
  const Entry* going_on = general.find("Continue_previous_simulation");
  if (going_on == nullptr || !context.flag(general, going_on->key)) return;
  std::error_code error;
  const auto folder = context.file.path.parent_path();
  bool found = false;
  for (std::filesystem::directory_iterator at(folder.empty() ? "." : folder, error), end; !error && at != end;
       at.increment(error))
    found = found || at->path().filename().string().ends_with("-procs");
  if (found)
    context.missing(*going_on, fmt::format("a run that goes on from restart files of {}", context.peer()),
                    "write false to start at rest");
  else
    context.changed(*going_on,
                    fmt::format("the run starts at rest, as in {} where there are no restart files", context.peer()));
}

std::optional<double> steps_of(Context& context, const Entry& general) {
  const auto steps = context.number(general, "Number_of_time_steps");
  for (const char* key : {"Number_of_time_steps", "Time_step_size"})
    if (general.find(key) == nullptr) context.refuse(general, fmt::format("has no {}", key), "write it");
  return steps;
}

// The peers keep the faces of ten-node tetrahedra in .vtu files; the volumes are looked at where they are there.
void translate_elements(Context& context, const PosedProblem& problem, CaseKey& top) {
  const bool named = std::any_of(problem.faces.begin(), problem.faces.end(), [](const FacePart& part) {
    const Entry* file = part.face->find("Face_file_path");
    return file != nullptr && text::lower(std::filesystem::path(file->value).extension().string()) == ".vtu";
  });
  if (!named && !context.findings.quadratic) {
    top.add("elements", "linear", "as the peer's");
    return;
  }
  top.add("elements", "quadratic", "ten-node tetrahedra");
  const Entry& mesh = problem.lumen != nullptr ? *problem.lumen : *problem.wall;
  context.changed(mesh,
                  "the edges of ten-node tetrahedra are straight; the nodes on them are made anew in their middles");
  if (problem.solves_fluid())
    context.changed(*problem.main, "pressure is linear in ten-node tetrahedra, as with Use_taylor_hood_type_basis");
}

void translate_analysis(Context& context, const PosedProblem& problem, const Entry& general, CaseKey& top) {
  const std::string source = problem.main->where() + " " + problem.main->label;
  translate_elements(context, problem, top);
  if (!massless(context, problem)) {
    top.add("analysis", problem.coupled() ? "fsi" : problem.solves_fluid() ? "flow" : "wall", source);
    return;
  }
  const Entry& density = *problem.walls[0].properties->find("Density");
  auto& statics = top.section("analysis", source).section("static_wall", density.where() + " 0: no inertia");
  statics.add("load_steps", "1", "");
  const double end = context.number(general, "Number_of_time_steps").value_or(1) *
                     context.number(general, "Time_step_size").value_or(1);
  statics.add("load_time", with_unit(end, "s"), "Number_of_time_steps times Time_step_size");
  context.changed(density, "a wall without mass is computed in equilibrium with the loads of the last instant");
}

void translate_time(Context& context, const PosedProblem& problem, const Entry& general, CaseKey& top) {
  const auto steps = steps_of(context, general);
  if (massless(context, problem)) return;
  auto& time = top.section("time", general.where());
  if (const Entry* step = general.find("Time_step_size")) time.add("step", context.quantity(*step, "s"), step->where());
  if (steps) time.add("steps", number_text(*steps), context.source(general, "Number_of_time_steps"));
  const bool xml = context.file.dialect == Dialect::xml;
  if (const Entry* radius = general.find("Spectral_radius_of_infinite_time_step")) {
    time.add("rho_infinity", context.quantity(*radius, ""), radius->where());
  } else {
    time.add("rho_infinity", xml ? "0.5" : "0.2", fmt::format("the default of {}", context.peer()));
    context.defaulted(general, "Spectral_radius_of_infinite_time_step",
                      fmt::format("{}, the default of {}", xml ? "0.5" : "0.2", context.peer()));
  }
  time.add("loads", "end", fmt::format("{} puts the loads of t_n+1 into the balance of t_n+alpha_f", context.peer()));
}

// The peers take what the last of Max_iterations has left; a step that does not converge is repeated in halves by
// tunica. So the tolerance is met, and a tolerance below round-off is none.
void translate_newton(Context& context, const PosedProblem& problem, CaseKey& top) {
  constexpr double loosest = 1e-4, tightest = 1e-9;
  const Entry* tolerance = problem.main->find("Tolerance");
  if (tolerance == nullptr) {
    context.defaulted(*problem.main, "Tolerance",
                      fmt::format("1e-4, the default of tunica; {} would take {}", context.peer(),
                                  context.file.dialect == Dialect::xml ? "0.5" : "1e64"));
  } else {
    const double asked = context.number(*problem.main, "Tolerance").value_or(loosest);
    const double taken = std::clamp(asked, tightest, loosest);
    top.section("newton", "")
        .add("relative_tolerance", number_text(taken),
             taken == asked ? tolerance->where() : fmt::format("{} {}", tolerance->where(), number_text(asked)));
    if (taken != asked)
      context.changed(*tolerance, taken > asked ? "1e-9: steps below round-off would be rejected"
                                                : "1e-4, the loosest that tunica takes");
  }
  if (const Entry* most = problem.main->find("Max_iterations"))
    context.remarks.dropped.push_back(
        fmt::format("{}: a step that has not converged is repeated in halves, not accepted", most->where()));
  else
    context.defaulted(*problem.main, "Max_iterations",
                      fmt::format("12, the default of tunica; {} would take {}", context.peer(),
                                  context.file.dialect == Dialect::xml ? "1" : "5"));
}

void translate_output(Context& context, const Entry& general, CaseKey& top) {
  auto& output = top.section("output", "");
  if (const Entry* folder = general.find("Save_results_in_folder"))
    output.add("directory", yaml_text(folder->value), folder->where());
  constexpr std::pair<const char*, const char*> increments[] = {
      {"Increment_in_saving_VTK_files", "every"}, {"Increment_in_saving_restart_files", "checkpoint_every"}};
  for (const auto& [theirs, ours] : increments)
    if (context.number(general, theirs).value_or(0) >= 1)
      output.add(ours, context.quantity(*general.find(theirs), ""), general.find(theirs)->where());
  output.add("instant", "end", fmt::format("{} writes the ends of steps", context.peer()));
  const UnitSystem& units = context.units;
  auto& names = output.section("units", fmt::format("--units {}", units.name));
  names.add("length", units.length, "");
  names.add("velocity", units.velocity, "");
  names.add("pressure", units.pressure, "");
  names.add("stress", units.pressure, "");
  names.add("flow", units.flow, "");
}

void translate_mesh_motion(Context& context, const PosedProblem& problem, CaseKey& top) {
  if (!problem.coupled()) return;
  const Entry* equation = problem.mesh_motion;
  if (equation == nullptr)
    return context.refuse(*problem.main, "has no equation `mesh` beside it", "add it; FSI needs a mesh that moves");
  auto& motion = top.section("mesh_motion", equation->where() + " mesh");
  if (const Entry* ratio = equation->find("Poisson_ratio"))
    motion.add("poisson_ratio", context.quantity(*ratio, ""), ratio->where());
  else
    motion.add("poisson_ratio", "0.3", fmt::format("the default of {}", context.peer()));
}

/// Dropped keys of the same reason in one line.
void list_dropped(Context& context, const std::vector<Dropped>& dropped) {
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;
  for (const Dropped& key : dropped) {
    auto at = std::find_if(reasons.begin(), reasons.end(), [&](const auto& r) { return r.first == key.why; });
    if (at == reasons.end()) at = reasons.insert(reasons.end(), {key.why, {}});
    at->second.push_back(fmt::format("{}:{}", key.entry->key, key.entry->line));
  }
  for (const auto& [reason, keys] : reasons) {
    std::string line = reason + ":";
    for (const auto& key : keys) line += " " + key;
    context.remarks.dropped.push_back(std::move(line));
  }
}

void add_remarks(const char* title, const std::vector<std::string>& remarks, std::string& text) {
  text += fmt::format("#\n# {}:{}\n", title, remarks.empty() ? " none" : "");
  for (const auto& remark : remarks) text += "#   " + remark + "\n";
}

std::string with_head(const Context& context, const CaseKey& top) {
  std::string text = fmt::format(
      "# Made by tunica import from {} of {}, whose numbers are taken as {}.\n"
      "# Behind each line stands the file, line and key that it comes from.\n",
      context.file.path.filename().string(), context.peer(), context.units.name);
  add_remarks("Dropped, as key:line", context.remarks.dropped, text);
  add_remarks("Changed", context.remarks.changed, text);
  add_remarks("Not written there", context.remarks.defaults, text);
  return text + "\n" + yaml(top);
}

}  // namespace

Translation translate(PeerFile file, const UnitSystem& units, const std::filesystem::path& case_folder,
                      const Findings& findings) {
  Context context{.file = file, .units = units, .case_folder = case_folder, .findings = findings};
  const auto dropped = check_vocabulary(file, context.problems);
  const Entry& general = general_of(context);
  if (context.number(general, "Number_of_spatial_dimensions").value_or(3) != 3)
    context.missing(*general.find("Number_of_spatial_dimensions"), "problems in two dimensions",
                    "extrude the mesh to one layer of tetrahedra");
  check_start(context, general);
  CaseKey top;
  if (const auto problem = pose(context); problem && problem->has_meshes()) {
    top.add("title", yaml_text(file.path.filename().string()), "");
    translate_analysis(context, *problem, general, top);
    translate_meshes(context, *problem, top);
    translate_fluid(context, *problem, top);
    translate_wall(context, *problem, top);
    translate_mesh_motion(context, *problem, top);
    translate_start(context, *problem, top);
    translate_conditions(context, *problem, top);
    translate_time(context, *problem, general, top);
    translate_newton(context, *problem, top);
    translate_output(context, general, top);
  }
  if (!context.problems.empty()) throw InputError(std::move(context.problems));
  list_dropped(context, dropped);
  list_dropped(context, unread_entries(file, dropped));
  return {with_head(context, top), context.remarks, context.warnings, context.prestress,
          context.initial,         context.fibres,  context.nodal,    context.regions};
}

}  // namespace tunica::peer_cases
