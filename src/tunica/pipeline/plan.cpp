#include "tunica/pipeline/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "tunica/analysis/vessel.hpp"
#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/case/face_patterns.hpp"
#include "tunica/case/mesh_settings.hpp"
#include "tunica/case/table_ends.hpp"
#include "tunica/config/nearest.hpp"
#include "tunica/geometry/parametric_dissection.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/meshing/assemble.hpp"
#include "tunica/meshing/wall_regions.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
using config::Kind;

/// Openings that the idealised dissection will have.
std::vector<std::string> openings_of(const geometry::ParametricDissection& shape) {
  std::vector<std::string> names = {"inlet"};
  for (const auto& [name, branch] : shape.branches()) names.push_back(name);
  if (shape.iliacs)
    names.insert(names.end(), {"left_iliac", "right_iliac"});
  else
    names.push_back("abdominal_aorta");
  return names;
}

/// Those of surfaces with a table, read and checked as the mesh will have them; none when they are not known yet.
std::vector<std::string> openings_of(const meshing::SurfaceFiles& files) {
  std::vector<std::string> names;
  if (files.openings.empty()) return names;
  const auto placed = geometry::read_opening_names(files.openings, files.metres_per_unit);
  meshing::check_names(files.roles, placed);
  for (const auto& opening : placed) names.push_back(opening.name);
  return names;
}

std::vector<std::string> openings_of(const meshing::ImageGeometry& image) {
  std::vector<std::string> names;
  for (const auto& [name, opening] : image.surface.openings) names.push_back(name);
  return names;
}

void check_region_names(const case_file::Case& c, std::vector<Problem>& problems) {
  const std::vector<std::string> known(meshing::wall_region_names.begin(), meshing::wall_region_names.end());
  std::set<std::pair<std::string, std::string>> named;
  if (c.wall)
    for (const auto& [name, region] : c.wall->regions) named.emplace("wall.regions.", name);
  if (c.fibres)
    for (const auto& [name, region] : c.fibres->regions) named.emplace("fibres.regions.", name);
  for (const auto& [key, name] : named)
    if (std::find(known.begin(), known.end(), name) == known.end())
      problems.push_back(
          {key + name, "the mesh will have no such region of the wall", "its regions: " + mesh::list_names(known)});
}

/// Faces of a mesh that is yet to be made are known where its openings have names.
void check_faces_to_come(const Chain& chain, std::vector<Problem>& problems) {
  const auto openings =
      std::visit([](const auto& geometry) { return openings_of(geometry); }, chain.settings.mesh->geometry);
  if (openings.empty()) return;
  std::vector<bc::BoundaryFace> faces;
  for (const auto& name : openings) {
    faces.push_back({"lumen_" + name, bc::Field::lumen});
    faces.push_back({"wall_" + name, bc::Field::wall});
  }
  faces.push_back({meshing::lumen_interface, bc::Field::lumen});
  faces.push_back({meshing::wall_interface, bc::Field::wall});
  faces.push_back({"wall_outer", bc::Field::wall});
  case_file::Case c = chain.settings;
  c.meshes.interface = case_file::InterfaceSettings{{meshing::lumen_interface}, {meshing::wall_interface}};
  const auto wrong = artifacts::check_faces(c, faces);
  problems.insert(problems.end(), wrong.begin(), wrong.end());
  check_region_names(c, problems);
}

void check_fibres(const case_file::Case& c, std::vector<Problem>& problems) {
  if (c.fibres && !c.mesh && c.fibres->inlet.empty())
    problems.push_back({"fibres.inlet", "names no face, and there is no `mesh` that would tell",
                        "name the ring of the wall where blood enters, and the cap of the lumen there"});
}

/// Faces that `post` will ask for, while nothing is computed yet. Outlets to be tuned have their conditions already.
void check_post(const case_file::Case& c, std::vector<Problem>& problems) {
  if (!c.post || !c.fluid) return;
  std::vector<std::string> known;
  for (const auto& [face, condition] : c.boundary) known.push_back(face);
  const auto look_up = [&](const char* key, const std::string& face) {
    if (std::none_of(known.begin(), known.end(),
                     [&](const auto& pattern) { return case_file::matches(pattern, face); }))
      problems.push_back(
          {key, fmt::format("'{}' is no opening with a condition", face), "use one of: " + mesh::list_names(known)});
  };
  look_up("post.inlet", analysis::inlet_name(case_file::describe(c), *c.post));
  if (c.post->end) look_up("post.end", *c.post->end);
}

bool matters(const Stage& stage, const std::string& key) {
  return std::none_of(stage.without.begin(), stage.without.end(),
                      [&](const auto& pattern) { return case_file::matches(pattern, key); });
}

std::string from_folder(const std::string& path, const fs::path& folder) {
  const fs::path full = fs::absolute(path).lexically_normal(), base = fs::absolute(folder).lexically_normal();
  return full.lexically_relative(base).string();
}

/// As a record can hold it: names of files need not be UTF-8.
std::string recorded(const std::string& text) { return text::printable(text, std::string::npos); }

Inputs inputs_of(const Chain& chain, const Stage& stage, const config::Document& document) {
  const fs::path folder = folder_of(chain, stage);
  const config::Origin origin{.name = (folder / stage.file).string(), .folder = folder};
  Inputs inputs;
  Fingerprints fingerprints;
  const auto add_file = [&](const std::string& path) {
    if (const auto print = fingerprints.of(folder / path); !print.empty()) inputs.files[recorded(path)] = print;
  };
  for (const auto& s : stage.settings(document, origin)) {
    if (!matters(stage, s.path)) continue;
    const bool file = s.kind == Kind::file || s.kind == Kind::folder || s.kind == Kind::path;
    const std::string value = file ? from_folder(s.value, folder) : s.value;
    inputs.settings[s.path] = recorded(value);
    if (file) add_file(value);
  }
  if (stage.reads)
    for (const auto& path : stage.reads(chain)) add_file(from_folder(path.string(), folder));
  return inputs;
}

/// With the same inputs as the last time.
void compare_results(const Stage& stage, const fs::path& folder, Plan& p) {
  if (p.last->status != "done") {
    p.resume = true;
    p.reason = fmt::format("it was {}", p.last->status == "running" ? "interrupted" : p.last->status);
    return;
  }
  const auto lost = lost_outputs(folder, p.last->outputs);
  p.fresh = lost.empty() && fs::exists(folder / stage.result);
  if (p.fresh) return;
  p.resume = !lost.empty() && stage.recovers && stage.recovers(folder, lost);
  p.reason = lost.empty() ? fmt::format("its result {} is missing", stage.result) : text_of_lost(lost);
  if (p.resume) p.reason += "; it goes on with what is there";
}

/// What is to be done after a last time with the same inputs that did not come to its end, or with others.
void compare(const Stage& stage, const fs::path& folder, Plan& p) {
  if (!p.last) {
    p.reason = "never done";
    return;
  }
  const Change change = difference(p.last->inputs, p.inputs);
  if (p.last->inputs == p.inputs) {
    compare_results(stage, folder, p);
    return;
  }
  p.resume = stage.continues(change);
  p.reason = fmt::format("inputs changed: {}{}", text_of(change), p.resume ? "; it goes on with what is there" : "");
}

/// The files of the stages, which are YAML, name the case file from their folders and these from its own.
void check_paths(const Chain& chain, std::vector<Problem>& problems) {
  const fs::path file = fs::absolute(chain.file).lexically_normal(), folder = file.parent_path(),
                 output = fs::absolute(chain.output).lexically_normal();
  for (const auto& path : {file.lexically_relative(output), output.lexically_relative(folder)})
    if (text::valid_utf8(path.string()) < path.string().size())
      problems.push_back({text::printable(path.string(), 400),
                          "is a path that is not UTF-8, and the files of the stages have to name it",
                          "rename the file or folder, or choose another folder by --output"});
}

}  // namespace

Chain read_chain(const fs::path& file, const std::optional<fs::path>& directory, std::vector<Problem>& warnings) {
  Chain chain;
  chain.file = file;
  chain.document = case_file::case_document(config::read_text(file), file);
  auto parsed = case_file::read_case(file);
  warnings = std::move(parsed.warnings);
  chain.settings = std::move(parsed.value);
  chain.output = directory.value_or(chain.settings.output.directory);
  std::vector<Problem> problems;
  check_paths(chain, problems);
  if (chain.settings.mesh) check_faces_to_come(chain, problems);
  check_fibres(chain.settings, problems);
  check_post(chain.settings, problems);
  const auto ends = case_file::check_table_ends(chain.settings.boundary, case_file::asked_by_run(chain.settings));
  problems.insert(problems.end(), ends.begin(), ends.end());
  if (!problems.empty()) throw InputError(std::move(problems));
  return chain;
}

std::vector<const Stage*> wanted_stages(const Chain& chain) {
  std::vector<const Stage*> wanted;
  for (const auto& stage : stages())
    if (stage.wanted(chain.settings)) wanted.push_back(&stage);
  return wanted;
}

Plan plan(const Chain& chain, const Stage& stage, bool anew) {
  const fs::path folder = folder_of(chain, stage);
  Plan p;
  p.document = stage.document(chain, folder);
  p.inputs = inputs_of(chain, stage, p.document);
  p.last = read_record(folder);
  if (p.last && p.last->stage != stage.name)
    throw InputError(folder.string(), fmt::format("holds the stage {}, not {}", p.last->stage, stage.name),
                     "give the stages folders of their own");
  if (anew)
    p.reason = "asked to be done anew";
  else
    compare(stage, folder, p);
  return p;
}

}  // namespace tunica::pipeline
