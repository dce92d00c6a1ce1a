#include "tunica/stages/export/export_case.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/mesh_io/simvascular.hpp"
#include "tunica/stages/export/exported.hpp"
#include "tunica/wall/parameters.hpp"
#include "tunica/wall/prestress.hpp"

namespace tunica::stages {

namespace fs = std::filesystem;
using mesh::RegionKind;
using peer_cases::add_key;
using peer_cases::add_section;
using peer_cases::Entry;

double Exported::end() const { return c.time ? c.time->step * static_cast<double>(c.time->most_steps()) : 0.0; }

namespace {

std::vector<const mesh::RegionData*> wall_regions(const mesh::MeshData& data) {
  std::vector<const mesh::RegionData*> regions;
  for (const auto& region : data.regions)
    if (region.kind == RegionKind::wall) regions.push_back(&region);
  return regions;
}

void refuse_what_has_no_counterpart(Exported& e) {
  if (e.c.elements == case_file::Elements::quadratic)
    e.missing("elements", "nodes on the edges that a program adds itself", "set `elements: linear`");
  if (e.c.pressure_point) e.missing("pressure_point", "a pressure at one node", "give an opening a pressure");
  if (e.c.start) e.missing("start", "a state of tunica to start from", "remove it: svMultiPhysics starts at rest");
  if (e.c.meshes.interface && case_file::interface_pairs(e.c.meshes).size() > 1 &&
      e.c.meshes.interface->lumen_faces.size() != e.c.meshes.interface->wall_faces.size())
    e.missing("meshes.interface", "faces of the interface that are no pairs", "join them to as many on either side");
  if (e.c.time && e.c.time->adaptive) e.change("time.adaptive", "all steps have the size of `step`");
  if (e.c.time && e.c.time->cycles) e.change("time.cycles", "the run takes all of `most` cycles");
  if (const auto* statics = std::get_if<case_file::StaticWall>(&e.c.analysis))
    e.change("analysis.static_wall",
             fmt::format("one step with the loads of its end, {} s, in the place of equal parts of the load",
                         number(statics->load_time)));
}

/// Prestress of the wall at its nodes: the mean over the elements there, by their volumes.
void export_prestress(Exported& e, Entry& mesh) {
  if (!e.c.wall->prestress) return;
  const auto field = std::find_if(e.data.fields.begin(), e.data.fields.end(),
                                  [](const auto& f) { return f.name == wall::prestress_array; });
  if (field == e.data.fields.end() || field->components != wall::voigt_size)
    return e.missing("wall.prestress", "a prestress as deformation gradients",
                     "find one by the update of the stress (`prestress: {method: stress}`)");
  mesh_io::VolumeArray nodal{.name = "Stress", .of = mesh_io::VolumeArray::Of::nodes, .components = wall::voigt_size};
  nodal.values.assign(wall::voigt_size * e.data.points.size(), 0.0);
  std::vector<double> weight(e.data.points.size(), 0.0);
  const double unit = config::unit_factor(e.units.pressure, config::dimension::pressure);
  for (const auto* region : wall_regions(e.data))
    for (auto k = region->first_element; k < region->end_element; ++k) {
      const auto& nodes = e.data.tetrahedra[static_cast<std::size_t>(k)];
      Vec3<double> x[4];
      for (std::size_t a = 0; a < 4; ++a) x[a] = e.data.points[static_cast<std::size_t>(nodes[a])];
      const double volume = dot(x[1] - x[0], cross(x[2] - x[0], x[3] - x[0])) / 6;
      for (const auto node : nodes) {
        weight[static_cast<std::size_t>(node)] += volume;
        for (std::size_t i = 0; i < wall::voigt_size; ++i)
          nodal.values[wall::voigt_size * static_cast<std::size_t>(node) + i] +=
              volume / unit * field->values[wall::voigt_size * static_cast<std::size_t>(k) + i];
      }
    }
  for (std::size_t k = 0; k < nodal.values.size(); ++k)
    if (const double w = weight[k / wall::voigt_size]; w > 0) nodal.values[k] /= w;
  e.change("wall.prestress",
           "svMultiPhysics keeps it at the nodes: the mean over their elements, which does not "
           "balance the load exactly");
  e.wall_arrays.emplace_back("prestress.vtu", std::move(nodal));
  add_key(mesh, "Prestress_file_path", "mesh/prestress.vtu");
}

void export_domains(Exported& e, Entry& mesh) {
  const auto regions = wall_regions(e.data);
  if (regions.size() == 1) {
    if (e.c.solves_fluid()) add_key(mesh, "Domain", "1");
    return;
  }
  mesh_io::VolumeArray ids{.name = "DOMAIN_ID"};
  ids.whole_numbers = true;
  ids.values.assign(e.data.tetrahedra.size(), 0.0);
  for (std::size_t r = 0; r < regions.size(); ++r)
    std::fill(ids.values.begin() + regions[r]->first_element, ids.values.begin() + regions[r]->end_element,
              static_cast<double>(r + 1));
  e.wall_arrays.emplace_back("domains.vtu", std::move(ids));
  add_key(mesh, "Domain_file_path", "mesh/domains.vtu");
  if (e.c.wall->smoothing_length != 0.0)
    e.change("wall.smoothing_length", "materials jump from one region to the next");
}

void export_mesh(Exported& e, RegionKind kind, Entry& root) {
  const char* name = kind == RegionKind::lumen ? "lumen" : "wall";
  Entry& mesh = add_section(root, "Add_mesh", name);
  add_key(mesh, "Mesh_file_path", fmt::format("mesh/{}/mesh-complete.mesh.vtu", name));
  for (const auto& face : e.data.faces)
    if (e.data.regions[static_cast<std::size_t>(face.region)].kind == kind)
      add_key(add_section(mesh, "Add_face", face.name), "Face_file_path",
              fmt::format("mesh/{}/mesh-surfaces/{}.vtp", name, face.name));
  if (kind == RegionKind::lumen) {
    if (e.c.solves_wall()) add_key(mesh, "Domain", "0");
    return;
  }
  export_domains(e, mesh);
  export_fibres(e, mesh);
  export_prestress(e, mesh);
}

/// The material of each region of the wall, as a Domain of its own or as keys of the one equation.
void export_walls(Exported& e, Entry& equation) {
  const auto regions = wall_regions(e.data);
  const auto& wall = *e.c.wall;
  const char* kind = wall.element == wall::Element::mixed ? "ustruct" : "struct";
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const auto own = wall.regions.find(regions[r]->name);
    const bool named = own != wall.regions.end();
    Entry* domain = &equation;
    if (e.c.solves_fluid() || regions.size() > 1) {
      domain = &add_section(equation, "Domain", fmt::format("{}", r + 1));
      add_key(*domain, "Equation", kind);
    }
    const std::string where = named ? "wall.regions." + regions[r]->name : "wall.material";
    export_material(e, named ? own->second.material : wall.material,
                    named ? own->second.density.value_or(wall.density) : wall.density, where, *domain);
    if (wall.element == wall::Element::mixed) {
      add_key(*domain, "Momentum_stabilization_coefficient", "1e-3");
      add_key(*domain, "Continuity_stabilization_coefficient", "0");
    }
  }
  if (wall.element == wall::Element::mixed)
    e.change("wall.element", "ustruct has a stabilisation of its own, with a coefficient of 1e-3");
}

void add_linear_solver(Entry& equation) {
  Entry& solver = add_section(equation, "LS", "GMRES");
  add_key(add_section(solver, "Linear_algebra", "fsils"), "Preconditioner", "fsils");
  add_key(solver, "Tolerance", "1e-4");
  add_key(solver, "Max_iterations", "500");
  add_key(solver, "Krylov_space_dimension", "100");
}

void add_outputs(const Exported& e, Entry& equation) {
  Entry& output = add_section(equation, "Output", "Spatial");
  add_key(output, "Velocity", "true");
  if (e.c.solves_fluid())
    for (const char* key : {"Pressure", "WSS"}) add_key(output, key, "true");
  if (e.c.solves_wall())
    for (const char* key : {"Displacement", "VonMises_stress"}) add_key(output, key, "true");
}

void export_equations(Exported& e, Entry& root) {
  const bool coupled = e.c.solves_fluid() && e.c.solves_wall();
  const bool mixed = e.c.wall && e.c.wall->element == wall::Element::mixed;
  Entry& equation = add_section(root, "Add_equation",
                                coupled              ? "FSI"
                                : e.c.solves_fluid() ? "fluid"
                                : mixed              ? "ustruct"
                                                     : "struct");
  add_key(equation, "Coupled", "true");
  add_key(equation, "Min_iterations", "1");
  add_key(equation, "Max_iterations", fmt::format("{}", e.c.newton.max_iterations));
  add_key(equation, "Tolerance", number(e.c.newton.relative_tolerance));
  if (e.c.solves_fluid()) {
    Entry* blood = &equation;
    if (coupled) {
      blood = &add_section(equation, "Domain", "0");
      add_key(*blood, "Equation", "fluid");
    }
    export_blood(e, *blood);
  }
  if (e.c.solves_wall()) export_walls(e, equation);
  add_linear_solver(equation);
  add_outputs(e, equation);
  export_conditions(e, equation);
  if (!coupled) return;
  Entry& motion = add_section(root, "Add_equation", "mesh");
  add_key(motion, "Coupled", "true");
  add_key(motion, "Min_iterations", "1");
  add_key(motion, "Max_iterations", "5");
  add_key(motion, "Tolerance", "1e-4");
  add_key(motion, "Poisson_ratio", number(e.c.mesh_motion->poisson_ratio));
  add_linear_solver(motion);
  for (const auto& face : e.data.faces) {
    const bool opening = e.data.regions[static_cast<std::size_t>(face.region)].kind == RegionKind::lumen &&
                         std::any_of(e.c.boundary.begin(), e.c.boundary.end(),
                                     [&](const auto& condition) { return condition.first == face.name; });
    if (!opening) continue;
    Entry& condition = add_section(motion, "Add_BC", face.name);
    add_key(condition, "Type", "Dir");
    add_key(condition, "Value", "0");
  }
  e.change("mesh_motion", "the nodes of openings stay where they are, where here they slide in their plane");
}

void export_general(Exported& e, Entry& root) {
  Entry& general = add_section(root, "GeneralSimulationParameters");
  const auto* statics = std::get_if<case_file::StaticWall>(&e.c.analysis);
  const double end = statics != nullptr ? (statics->load_time > 0 ? statics->load_time : 1.0) : 0.0;
  add_key(general, "Continue_previous_simulation", "false");
  add_key(general, "Number_of_spatial_dimensions", "3");
  add_key(general, "Number_of_time_steps", statics ? "1" : fmt::format("{}", e.c.time->most_steps()));
  add_key(general, "Time_step_size", number(statics ? end : e.c.time->step));
  add_key(general, "Spectral_radius_of_infinite_time_step", number(statics ? 0.5 : e.c.time->rho_infinity));
  if (statics == nullptr && e.c.time->loads == coupling::LoadInstant::balance)
    e.change("time.loads", "svMultiPhysics puts the loads of the end of a step into its balance: `end`");
  add_key(general, "Save_results_to_VTK_format", "true");
  add_key(general, "Name_prefix_of_saved_VTK_files", "result");
  add_key(general, "Start_saving_after_time_step", "1");
  add_key(general, "Increment_in_saving_VTK_files", fmt::format("{}", e.c.output.every));
  add_key(general, "Increment_in_saving_restart_files", fmt::format("{}", e.c.output.checkpoint_every));
}

Entry solver_file(Exported& e) {
  refuse_what_has_no_counterpart(e);
  Entry root{.key = "svMultiPhysicsFile", .label = "0.1", .value = {}, .section = true};
  export_general(e, root);
  if (e.c.solves_fluid()) export_mesh(e, RegionKind::lumen, root);
  if (e.c.solves_wall()) export_mesh(e, RegionKind::wall, root);
  if (e.c.solves_fluid() && e.c.solves_wall())
    for (const auto& [lumen, wall] : case_file::interface_pairs(e.c.meshes))
      add_key(add_section(root, "Add_projection", wall), "Project_from_face", lumen);
  export_equations(e, root);
  return root;
}

void write_all(const Exported& e, const Entry& root, const fs::path& folder, std::vector<std::string>& files) {
  const double length = config::unit_factor(e.units.length, config::dimension::length);
  if (e.c.solves_fluid()) mesh_io::write_simvascular(folder / "mesh/lumen", e.data, RegionKind::lumen, length);
  if (e.c.solves_wall()) mesh_io::write_simvascular(folder / "mesh/wall", e.data, RegionKind::wall, length);
  for (const auto& [name, array] : e.wall_arrays) {
    mesh_io::write_volume_array(folder / "mesh" / name, e.data, RegionKind::wall, length, array);
    files.push_back("mesh/" + name);
  }
  for (const auto& [name, text] : e.tables) {
    files::write_atomically(folder / name, text);
    files.push_back(name);
  }
  files::write_atomically(folder / "solver.xml", peer_cases::xml_text(root));
  files.emplace_back("solver.xml");
}

}  // namespace

ExportOutcome export_case(const ExportRequest& request) {
  const auto& units = peer_cases::unit_system(request.units);
  auto read = case_file::read_case(request.case_file);
  const auto mesh = artifacts::load_corner_mesh(read.value);
  artifacts::name_faces(read.value, mesh, MPI_COMM_SELF);
  Exported exported{.c = read.value, .data = mesh.data, .units = units};
  const Entry root = solver_file(exported);
  if (!exported.problems.empty()) throw InputError(std::move(exported.problems));
  std::error_code none;
  if (fs::exists(request.folder / "solver.xml", none) && !request.overwrite)
    throw InputError((request.folder / "solver.xml").string(), "is there already",
                     "choose another folder by -o, or replace it with --overwrite");
  fs::create_directories(request.folder, none);
  if (none) throw InputError(request.folder.string(), "cannot be made: " + none.message(), "choose another folder");
  ExportOutcome outcome{.files = {}, .changed = exported.changed, .warnings = mesh.warnings};
  for (const Problem& warning : read.warnings) outcome.warnings.push_back(format(warning));
  write_all(exported, root, request.folder, outcome.files);
  return outcome;
}

}  // namespace tunica::stages
