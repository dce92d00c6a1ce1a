#include "tunica/stages/import/import_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/case/case.hpp"
#include "tunica/config/units.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/peer_cases/inputs.hpp"
#include "tunica/peer_cases/translate.hpp"
#include "tunica/stages/import/initial_state.hpp"
#include "tunica/stages/import/nodal_prestress.hpp"
#include "tunica/stages/import/nodal_values.hpp"
#include "tunica/stages/import/wall_regions.hpp"

namespace tunica::stages {

namespace fs = std::filesystem;

namespace {

bool all_there(const case_file::NamedFiles& files) {
  std::error_code none;
  for (const auto& [face, path] : files.faces)
    if (!fs::is_regular_file(path, none)) return false;
  return fs::is_regular_file(files.volume, none);
}

/// Is the mesh of the wall there?
bool all_there(const case_file::MeshSettings& meshes) { return meshes.wall && all_there(meshes.wall->files); }

/// What the meshes show, as far as they are there: boundary that no face holds, tetrahedra of ten nodes.
peer_cases::Findings look_at_meshes(case_file::Case c, std::vector<std::string>& warnings) {
  const auto look = [&](auto& mesh, const char* rest) {
    if (!mesh || !all_there(mesh->files)) return false;
    mesh->files.rest = rest;
    return true;
  };
  // Elements and faces alone; what hangs on other files is looked at when the case is checked.
  constexpr const char *lumen = "lumen", *wall = "wall";
  if (c.meshes.wall) c.meshes.wall->region_array.reset();
  c.meshes.interface.reset();
  const bool looked[] = {look(c.meshes.lumen, lumen), look(c.meshes.wall, wall)};
  if (!looked[0]) c.meshes.lumen.reset();
  if (!looked[1]) c.meshes.wall.reset();
  if (!looked[0] && !looked[1]) return {};
  const auto mesh = artifacts::load_meshes(c.meshes, {});
  warnings.insert(warnings.end(), mesh.warnings.begin(), mesh.warnings.end());
  peer_cases::Findings found;
  found.quadratic = mesh.ten_node;
  for (const auto& face : mesh.data.faces) {
    found.lumen_rest |= face.name == lumen;
    found.wall_rest |= face.name == wall;
  }
  return found;
}

bool is_file(const fs::path& path) {
  std::error_code none;
  return fs::is_regular_file(path, none);
}

/// The angles that a law needs, and without the files there is no case.
FibreAngles look_at_fibres(const std::optional<peer_cases::FibreFiles>& fibres, peer_cases::Findings& found) {
  if (!fibres) return {};
  if (!is_file(fibres->first) || !is_file(fibres->second))
    throw InputError(fibres->where, "is not there, or that of the first family: the angle between them stands in both",
                     "import where both files are");
  auto angles = fibre_angles(*fibres);
  found.fibre_angles = angles.angles;
  found.fibre_deviation = angles.largest_deviation;
  return angles;
}

/// A table of values at nodes, by its file in the folder of the case.
struct NamedTable {
  peer_cases::NodalValues wanted;
  NodalTable table;
};

/// Tables of values of one mesh.
struct MeshTables {
  mesh::MeshData mesh;
  std::vector<NamedTable> tables;
};

/// Those of the lumen or of the wall whose files and mesh are there; notes their periods.
MeshTables read_tables(const std::vector<peer_cases::NodalValues>& all, bool wall, const case_file::Case& c,
                       const peer_cases::UnitSystem& units, peer_cases::Findings& found) {
  case_file::MeshSettings meshes = c.meshes;
  if (wall)
    meshes.lumen.reset();
  else
    meshes.wall.reset();
  meshes.interface.reset();
  case_file::NamedFiles* files = nullptr;
  if (meshes.lumen) files = &meshes.lumen->files;
  if (meshes.wall) files = &meshes.wall->files;
  if (files == nullptr || !all_there(*files) ||
      std::none_of(all.begin(), all.end(), [&](const auto& wanted) { return wanted.wall == wall; }))
    return {};
  files->rest = unnamed_boundary;
  if (meshes.wall) meshes.wall->region_array.reset();
  MeshTables read{artifacts::load_meshes(meshes, {}).data, {}};
  for (const auto& wanted : all) {
    if (wanted.wall != wall || (!wanted.file.empty() && !is_file(wanted.file))) continue;
    auto table = read_nodal_values(wanted, read.mesh, meshes.metres(), units);
    if (table.period) found.periods[wanted.table] = *table.period;
    read.tables.push_back({wanted, std::move(table)});
  }
  return read;
}

/// "solver.xml:52 Density", the comment behind the line of the case that a message names, or behind the nearest line
/// that it belongs to; empty where there is none.
std::string source_of(const std::string& yaml, const std::string& where) {
  const auto colon = where.rfind(':');
  int number = 0;
  if (colon == std::string::npos ||
      std::from_chars(where.data() + colon + 1, where.data() + where.size(), number).ec != std::errc{})
    return {};
  std::vector<std::string> lines;
  std::istringstream stream(yaml);
  for (std::string line; static_cast<int>(lines.size()) < number && std::getline(stream, line);) lines.push_back(line);
  std::size_t indent = std::string::npos;
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    const auto begin = line->find_first_not_of(' ');
    if (begin == std::string::npos || begin >= indent) continue;
    indent = begin;
    if (const auto comment = line->find(" # "); comment != std::string::npos) return line->substr(comment + 3);
  }
  return {};
}

/// A message about the case names the place in the peer's file.
void name_source(const std::string& yaml, Problem& problem) {
  if (const auto source = source_of(yaml, problem.where); !source.empty())
    problem.where = fmt::format("{}: {}", source, problem.where);
}

/// The case that the text poses, with warnings of values that look like slips. What it does not take is a value beyond
/// its range, which the peer's file holds.
config::Parsed<case_file::Case> read(const std::string& yaml, const fs::path& file) {
  const config::Origin origin{.name = file.string(), .folder = file.parent_path(), .check_files = false};
  try {
    auto posed = config::parse_document(case_file::Case::schema(), case_file::case_document(yaml, file), origin);
    for (Problem& warning : posed.warnings) name_source(yaml, warning);
    return posed;
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) {
      name_source(yaml, problem);
      problem.where += ", of the case file that would be written";
    }
    throw InputError(std::move(problems));
  }
}

/// Files of fields that the case names, of those of the peer; not where these or the meshes are missing, which has been
/// warned of.
void write_files(const peer_cases::Translation& translation, const case_file::Case& c,
                 const peer_cases::UnitSystem& units, const fs::path& folder) {
  std::error_code none;
  if (const auto& nodal = translation.prestress; nodal && fs::is_regular_file(nodal->file, none) && all_there(c.meshes))
    write_element_prestress(nodal->file, config::unit_factor(units.pressure, config::dimension::pressure), c.meshes,
                            folder / nodal->elements_file);
  if (!translation.initial) return;
  bool all = (!c.meshes.lumen || all_there(c.meshes.lumen->files)) && (!c.meshes.wall || all_there(c.meshes));
  for (const auto* files : {&translation.initial->lumen, &translation.initial->wall})
    for (const auto* file : {&files->velocity, &files->pressure, &files->displacement})
      all = all && (!*file || fs::is_regular_file(**file, none));
  if (all) write_initial_state(*translation.initial, c, units, folder / translation.initial->file);
}

}  // namespace

ImportOutcome import_case(const ImportRequest& request) {
  const auto& units = peer_cases::unit_system(request.units);
  const auto file = peer_cases::read_peer_file(request.file);
  if (peer_cases::is_input(file, request.case_file))
    throw InputError(request.case_file.string(), "is a file that is imported, which the case file would overwrite",
                     "choose another name by -o");
  const fs::path folder = request.case_file.parent_path();
  auto translation = peer_cases::translate(file, units, folder);
  ImportOutcome outcome{.dropped = {}, .changed = {}, .defaults = {}, .warnings = translation.warnings};
  auto posed = read(translation.yaml, request.case_file);
  for (const Problem& warning : posed.warnings) outcome.warnings.push_back(format(warning));
  auto found = look_at_meshes(posed.value, outcome.warnings);
  const auto angles = look_at_fibres(translation.fibres, found);
  MeshTables tables[2];
  for (const bool wall : {false, true})
    tables[wall ? 1 : 0] = read_tables(translation.nodal, wall, posed.value, units, found);
  if (found.lumen_rest || found.wall_rest || found.quadratic || !found.fibre_angles.empty() || !found.periods.empty()) {
    translation = peer_cases::translate(file, units, folder, found);
    posed = read(translation.yaml, request.case_file);
  }
  outcome.dropped = translation.remarks.dropped;
  outcome.changed = translation.remarks.changed;
  outcome.defaults = translation.remarks.defaults;
  std::error_code none;
  if (fs::exists(request.case_file, none)) {
    outcome.unchanged = text::read(request.case_file) == translation.yaml;
    if (!outcome.unchanged && !request.overwrite)
      throw InputError(request.case_file.string(), "is there already, with other contents",
                       "choose another name by -o, or replace it with --overwrite");
  }
  if (const auto& regions = translation.regions; regions && all_there(posed.value.meshes))
    if (regions->domains.empty() || is_file(regions->domains))
      write_wall_regions(*regions, angles, posed.value.meshes, folder);
  write_files(translation, posed.value, units, folder);
  for (const auto& [mesh, of_mesh] : tables)
    for (const auto& [wanted, table] : of_mesh)
      write_nodal_table(table, wanted, mesh, found.quadratic, folder / wanted.table);
  if (!outcome.unchanged) files::write_atomically(request.case_file, translation.yaml);
  return outcome;
}

}  // namespace tunica::stages
