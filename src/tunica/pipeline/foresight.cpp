#include "tunica/pipeline/foresight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "tunica/analysis/vessel.hpp"
#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/artifacts/outlets_file.hpp"
#include "tunica/base/error.hpp"
#include "tunica/case/compared_law.hpp"
#include "tunica/case/face_patterns.hpp"
#include "tunica/case/fibres_case.hpp"
#include "tunica/case/mesh_settings.hpp"
#include "tunica/geometry/parametric_dissection.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/meshing/assemble.hpp"
#include "tunica/meshing/geometry.hpp"
#include "tunica/meshing/vessel_roles.hpp"
#include "tunica/meshing/wall_regions.hpp"
#include "tunica/stages/fibres/fibres.hpp"
#include "tunica/stages/posed_case.hpp"
#include "tunica/stages/post/measured.hpp"
#include "tunica/stages/post/post.hpp"
#include "tunica/stages/prestress/prestress.hpp"
#include "tunica/stages/tuning/tune.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;
using Problems = std::vector<Problem>;

/// Runs `action` and keeps what is wrong; `where` stands before the places.
template <class Action>
void collect(Problems& problems, const std::string& where, Action action) {
  try {
    action();
  } catch (const InputError& error) {
    for (const Problem& p : error.problems()) problems.push_back({where + p.where, p.what, p.remedy});
  }
}

// --- openings of a mesh to come -------------------------------------------------------------------------------------

/// Largest k of a face lumen_outlet_k or wall_outlet_k that the case names, at least 1.
int most_outlets(const case_file::Case& c) {
  int most = 1;
  for (const auto& [face, condition] : c.boundary)
    for (const char* part : {"lumen_outlet_", "wall_outlet_"}) {
      const std::string number = face.starts_with(part) ? face.substr(std::string(part).size()) : "";
      if (!number.empty() && number.size() < 4 && number.find_first_not_of("0123456789") == std::string::npos)
        most = std::max(most, std::stoi(number));
    }
  return most;
}

/// Where nobody names the openings, the mesh calls them inlet, outlet_1, outlet_2, ...; how many there are is known to
/// nobody yet, so the case is believed.
Names counted_openings(const case_file::Case& c) {
  Names names = {"inlet"};
  for (int k = 1; k <= most_outlets(c); ++k) names.push_back(fmt::format("outlet_{}", k));
  return names;
}

Names openings_of(const geometry::ParametricDissection& shape, const case_file::Case&) {
  Names names = {"inlet"};
  for (const auto& [name, branch] : shape.branches()) names.push_back(name);
  if (shape.iliacs)
    names.insert(names.end(), {"left_iliac", "right_iliac"});
  else
    names.push_back("abdominal_aorta");
  return names;
}

Names openings_of(const meshing::SurfaceFiles& files, const case_file::Case& c) {
  if (files.openings.empty()) return counted_openings(c);
  const auto places = geometry::read_opening_names(files.openings, files.metres_per_unit);
  meshing::check_names(files.roles, places);
  Names names;
  for (const auto& place : places) names.push_back(place.name);
  return names;
}

Names openings_of(const meshing::ImageGeometry& image, const case_file::Case& c) {
  if (image.surface.openings.empty()) return counted_openings(c);
  Names names;
  std::vector<geometry::NamedPlace> places;
  for (const auto& [name, opening] : image.surface.openings) {
    names.push_back(name);
    places.push_back({name, opening.centre});
  }
  meshing::check_names(meshing::roles_of(image), places);
  return names;
}

std::vector<bc::BoundaryFace> faces_to_come(const Names& openings, bool with_wall) {
  std::vector<bc::BoundaryFace> faces;
  for (const auto& name : openings) {
    faces.push_back({"lumen_" + name, bc::Field::lumen});
    if (with_wall) faces.push_back({"wall_" + name, bc::Field::wall});
  }
  faces.push_back({meshing::lumen_interface, bc::Field::lumen});
  if (!with_wall) return faces;
  faces.push_back({meshing::wall_interface, bc::Field::wall});
  faces.push_back({"wall_outer", bc::Field::wall});
  return faces;
}

Names names_of(const std::vector<bc::BoundaryFace>& faces) {
  Names names;
  for (const auto& face : faces) names.push_back(face.name);
  return names;
}

// --- what the stages ask --------------------------------------------------------------------------------------------

Names regions_to_come() { return {meshing::wall_region_names.begin(), meshing::wall_region_names.end()}; }

void check_region_names(const case_file::Case& c, Problems& problems) {
  const Names known = regions_to_come();
  std::set<std::pair<std::string, std::string>> named;
  const auto add = [&](const std::string& key, const auto& regions) {
    for (const auto& [name, region] : regions) named.emplace(key, name);
  };
  if (c.wall) add("wall.regions.", c.wall->regions);
  if (c.fibres) add("fibres.regions.", c.fibres->regions);
  for (const auto& [law, compared] : c.compare) add(fmt::format("compare.{}.regions.", law), compared->regions);
  for (const auto* tears : {c.fibres && c.fibres->tears ? &*c.fibres->tears : nullptr,
                            c.post && c.post->lumens ? &*c.post->lumens : nullptr})
    if (tears) {
      const std::string key = c.post && c.post->lumens && tears == &*c.post->lumens ? "post.lumens." : "fibres.tears.";
      for (const auto& name : tears->true_lumen) named.emplace(key + "true_lumen: ", name);
      for (const auto& name : tears->false_lumen) named.emplace(key + "false_lumen: ", name);
    }
  for (const auto& [key, name] : named)
    if (std::find(known.begin(), known.end(), name) == known.end())
      problems.push_back(
          {key + name, "the mesh will have no such region of the wall", "its regions: " + mesh::list_names(known)});
}

void check_fibre_faces(const case_file::FibreSettings& fibres, const Names& faces, Problems& problems) {
  const auto look_up = [&](const char* key, const Names& names) {
    for (const auto& name : names)
      if (std::find(faces.begin(), faces.end(), name) == faces.end())
        problems.push_back(
            {key, fmt::format("the mesh will have no face '{}'", name), "use some of: " + mesh::list_names(faces)});
  };
  look_up("fibres.inlet", fibres.inlet);
  look_up("fibres.outer", fibres.outer);
}

/// Fields and faces that `post` will ask for, while nothing is computed yet. Outlets to be tuned have their conditions
/// already.
void check_post(const case_file::Case& c, Problems& problems) {
  if (!c.post) return;
  collect(problems, "", [&] { stages::post::check_post(c); });
  if (!c.fluid) return;
  Names known;
  for (const auto& [face, condition] : c.boundary) known.push_back(face);
  const auto look_up = [&](const char* key, const std::string& face) {
    if (std::none_of(known.begin(), known.end(),
                     [&](const auto& pattern) { return case_file::matches(pattern, face); }))
      problems.push_back(
          {key, fmt::format("'{}' is no opening with a condition", face), "use one of: " + mesh::list_names(known)});
  };
  look_up("post.inlet", analysis::inlet_name(case_file::describe(c), *c.post));
  if (c.post->end) look_up("post.end", *c.post->end);
  if (!c.measured) return;
  for (const auto& kind : case_file::measurement_kinds())
    for (const auto& [name, m] : (*c.measured).*kind.entries)
      if (m.opening) look_up(fmt::format("measured.{}.{}.opening", kind.key, name).c_str(), *m.opening);
}

/// With faces in the place of patterns.
case_file::Case with_named_faces(case_file::Case c, Names faces) {
  for (const auto& [lumen, wall] : case_file::interface_pairs(c.meshes))
    std::erase_if(faces, [&](const auto& name) { return name == lumen || name == wall; });
  Problems found_before;
  c.boundary = case_file::without_patterns(c.boundary, faces, found_before);
  return c;
}

/// What prestress and outlets ask of the faces.
void check_stage_faces(const case_file::Case& c, const std::vector<bc::BoundaryFace>& faces, const Names& wall_regions,
                       Problems& problems) {
  if (c.finds_prestress()) collect(problems, "", [&] { stages::check_prestress(c, faces, wall_regions); });
  if (c.outlets && !c.outlets->given_file) collect(problems, "", [&] { stages::tuning_basis(c, faces); });
}

/// Faces of a mesh that is yet to be made, and the conditions on them.
void check_faces_to_come(const case_file::Case& chain_case, Problems& problems) {
  case_file::Case c = chain_case;
  if (c.solves_wall())
    c.meshes.interface = case_file::InterfaceSettings{{meshing::lumen_interface}, {meshing::wall_interface}};
  Names openings;
  collect(problems, "mesh.geometry: ", [&] {
    openings = std::visit([&](const auto& geometry) { return openings_of(geometry, c); }, *c.mesh->geometry);
  });
  check_region_names(c, problems);
  if (openings.empty()) return;
  const auto faces = faces_to_come(openings, c.solves_wall());
  const auto wrong = artifacts::check_faces(c, faces);
  problems.insert(problems.end(), wrong.begin(), wrong.end());
  if (c.fibres) check_fibre_faces(*c.fibres, names_of(faces), problems);
  if (wrong.empty()) check_stage_faces(with_named_faces(c, names_of(faces)), faces, regions_to_come(), problems);
}

void check_sections(const case_file::Case& c, Problems& problems) {
  if (c.fibres && !c.mesh && c.fibres->inlet.empty())
    problems.push_back({"fibres.inlet", "names no face, and there is no `mesh` that would tell",
                        "name the ring of the wall where blood enters, and the cap of the lumen there"});
  if (c.finds_prestress() && c.start)
    problems.push_back({"start", "is given, and the section `prestress` too",
                        "remove it: that of the stage `prestress` is taken; or name `wall.prestress` as well, and the "
                        "stage is left out"});
}

/// Files of earlier stages that the case names. What is in them is looked at on the mesh that they belong to.
void check_results_named(const case_file::Case& c, Problems& problems) {
  const auto look_for = [&](const char* key, const std::optional<fs::path>& file) {
    if (file && !fs::is_regular_file(*file))
      problems.push_back({key, fmt::format("the file {} does not exist", file->string()),
                          "do first what writes it, or remove the key"});
  };
  look_for("start", c.start);
  if (c.wall) look_for("wall.prestress", c.wall->prestress);
  if (!c.outlets || !c.outlets->given_file) return;
  look_for("outlets.file", c.outlets->given_file);
  const fs::path file = c.outlets->file();
  if (fs::is_regular_file(file))
    collect(problems, "", [&] { artifacts::parse_outlets(config::read_text(file), file, *c.outlets); });
}

/// The laws of `compare` in the place of those of the case: do they read there, and can figures be made?
void check_compared_laws(const Chain& chain, Problems& problems) {
  const config::Origin origin{.name = chain.file.string(), .folder = chain.file.parent_path()};
  for (const auto& [name, law] : chain.settings.compare)
    collect(problems, fmt::format("compare.{}: ", name), [&, &n = name] {
      stages::post::check_post(
          config::parse_document(case_file::Case::schema(), with_law(chain.document, n), origin).value);
    });
}

// --- on meshes that are there ---------------------------------------------------------------------------------------

/// The case that can be posed now: what stages will make is left out, or stands in for it.
case_file::Case posable_case(const Chain& chain) {
  case_file::Case c = chain.settings;
  if (c.fibres) {
    c.wall->fibre_frame = wall::ConstantFrame{};
    c.start.reset();  // belongs to the mesh with its directions
    const auto without_depth = [](wall::Composition& composition) {
      if (composition.layers && composition.layers->depth == stages::fibres::array_depth) composition.layers.reset();
    };
    without_depth(c.wall->composition);
    for (auto& [name, region] : c.wall->regions) without_depth(region.composition);
  }
  c.fibres.reset();
  for (const auto& stage : stages())
    if (stage.name == std::string("run")) c.output.directory = folder_of(chain, stage);
  return c;
}

void check_compared_regions(const Chain& chain, const Names& regions, Problems& problems) {
  for (const auto& [name, law] : chain.settings.compare)
    for (const auto& [region, material] : law->regions)
      if (std::find(regions.begin(), regions.end(), region) == regions.end())
        problems.push_back({fmt::format("compare.{}.regions.{}", name, region),
                            "the mesh has no wall region of this name", "use one of: " + mesh::list_names(regions)});
}

void check_fibres_on(const Chain& chain, const mesh::MeshData& data, Problems& problems) {
  if (!chain.settings.fibres) return;
  case_file::FibresCase c;
  static_cast<case_file::FibreSettings&>(c) = *chain.settings.fibres;
  c.meshes = chain.settings.meshes;
  collect(problems, "fibres.", [&] { stages::fibres::face_roles(c, data); });
}

}  // namespace

config::Document with_law(const config::Document& document, const std::string& name) {
  config::Document changed = document;
  const config::Document law = document.part("compare").part(name);
  changed.set("wall.material", law.part("material"));
  changed.remove("wall.regions");
  if (law.has("regions")) changed.set("wall.regions", law.part("regions"));
  changed.remove("compare");
  return changed;
}

std::vector<std::string> openings_to_come(const case_file::Case& c) {
  if (!c.mesh) return {};
  const auto& geometry = *c.mesh->geometry;
  const auto* files = std::get_if<meshing::SurfaceFiles>(&geometry);
  const auto* image = std::get_if<meshing::ImageGeometry>(&geometry);
  if ((files && files->openings.empty()) || (image && image->surface.openings.empty())) return {};
  return std::visit([&](const auto& shape) { return openings_of(shape, c); }, geometry);
}

Problems foreseen_problems(const Chain& chain) {
  Problems problems;
  if (chain.settings.mesh) check_faces_to_come(chain.settings, problems);
  check_sections(chain.settings, problems);
  check_results_named(chain.settings, problems);
  check_post(chain.settings, problems);
  check_compared_laws(chain, problems);
  for (const auto& stage : stages())
    if (stage.wanted(chain.settings)) collect(problems, "", [&] { stages::check_folder(folder_of(chain, stage)); });
  return problems;
}

std::vector<std::string> check_on_meshes(const Chain& chain) {
  if (chain.settings.mesh) return {};
  stages::ReadCase read;
  read.settings = posable_case(chain);
  read.mesh = artifacts::load_mesh(read.settings);
  const auto faces = artifacts::faces_of(read.mesh.data);
  read.settings = with_named_faces(read.settings, names_of(faces));
  Problems problems;
  check_fibres_on(chain, read.mesh.data, problems);
  const auto regions = artifacts::wall_regions(read.mesh.data);
  check_compared_regions(chain, regions, problems);
  check_stage_faces(read.settings, faces, regions, problems);
  if (chain.settings.post)
    collect(problems, "", [&] { analysis::check_ends(describe(read.settings), *chain.settings.post, read.mesh.data); });
  if (const auto& measured = chain.settings.measured)
    collect(problems, "", [&] { stages::post::find_measured_sections(*measured, read.settings, read.mesh.data); });
  collect(problems, "", [&] {
    if (chain.settings.outlets && chain.settings.outlets->given_file)
      artifacts::take_tuned_outlets(MPI_COMM_SELF, read.settings);
    stages::check_posed(read, MPI_COMM_SELF);
  });
  if (!problems.empty()) throw InputError(std::move(problems));
  auto lines = read.mesh.report;
  for (const auto& warning : read.mesh.warnings) lines.push_back("warning: " + warning);
  return lines;
}

}  // namespace tunica::pipeline
