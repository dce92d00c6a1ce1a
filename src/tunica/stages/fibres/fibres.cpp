#include "tunica/stages/fibres/fibres.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "tunica/artifacts/manifest.hpp"
#include "tunica/base/units.hpp"
#include "tunica/case/case_text.hpp"
#include "tunica/config/json_text.hpp"
#include "tunica/config/nearest.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/frames/depth.hpp"
#include "tunica/frames/tears.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh_io/simvascular.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/gather.hpp"
#include "tunica/stages/fibres/fibres_report.hpp"

namespace tunica::stages::fibres {

namespace {

using unit::mm, unit::degree;

template <class Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

void check_names(const std::vector<std::string>& wanted, const std::vector<std::string>& known, const std::string& key,
                 const std::string& what, std::vector<Problem>& problems) {
  for (const auto& name : wanted)
    if (std::find(known.begin(), known.end(), name) == known.end())
      problems.push_back(
          {key, fmt::format("the mesh has no {} '{}'", what, name), "use some of: " + mesh::list_names(known)});
}

/// Values of the elements of the wall, in the order of the graph, on rank 0 for all elements of the mesh.
class Gatherer {
 public:
  explicit Gatherer(const distributed::DistributedMesh& mesh) : mesh_(mesh) {
    for (const auto& region : mesh.regions)
      ids_.insert(ids_.end(), region.element_ids.begin(), region.element_ids.begin() + region.owned_elements);
  }
  mesh::ElementField operator()(const std::string& name, int components, std::span<const double> wall) const {
    std::vector<double> all;
    for (const auto& region : mesh_.regions) {
      const auto count = static_cast<std::size_t>(region.owned_elements) * components;
      if (region.kind == mesh::RegionKind::lumen) {
        all.insert(all.end(), count, std::numeric_limits<double>::quiet_NaN());
      } else {
        all.insert(all.end(), wall.begin(), wall.begin() + static_cast<std::ptrdiff_t>(count));
        wall = wall.subspan(count);
      }
    }
    return {name, components,
            parallel::gather_by_original_id({mesh_.comm, ids_, mesh_.global_elements}, all, components)};
  }
  mesh::ElementField operator()(const std::string& name, const std::vector<Vec3<double>>& wall) const {
    return (*this)(name, 3, {reinterpret_cast<const double*>(wall.data()), 3 * wall.size()});
  }

 private:
  const distributed::DistributedMesh& mesh_;
  std::vector<std::int64_t> ids_;
};

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (auto& v : values) v *= factor;
  return values;
}

/// All arrays but the distance to the tears.
std::vector<mesh::ElementField> gather_frames(const case_file::FibresCase& c, const frames::ElementGraph& graph,
                                              const frames::Frames& f) {
  const Gatherer gather(graph.mesh());
  std::vector<Vec3<double>> m4, m6;
  for (std::int32_t e = 0; e < graph.owned(); ++e) {
    const auto other = c.regions.find(graph.mesh().regions[graph.region(e)].name);
    const auto m =
        frames::mean_directions(f.e1[e], f.e2[e], other == c.regions.end() ? c.mean_angle : other->second.mean_angle);
    m4.push_back(m.m4);
    m6.push_back(m.m6);
  }
  std::vector<mesh::ElementField> fields;
  fields.push_back(gather(array_e1, f.e1));
  fields.push_back(gather(array_e2, f.e2));
  fields.push_back(gather(array_e3, f.e3));
  fields.push_back(gather(array_m4, m4));
  fields.push_back(gather(array_m6, m6));
  fields.push_back(gather(array_jump, 1, scaled(f.jump, 1 / degree)));
  fields.push_back(gather(array_confidence, 1, f.confidence));
  return fields;
}

/// meshes.yaml: what a case needs to compute on the result.
std::string case_text(const std::vector<std::string>& regions, const case_file::FibresCase& c) {
  return artifacts::meshes_section(regions, c.meshes.interface) +
         fmt::format("# and in its section `wall`:\n#   fibre_frame: {{mesh: {{e1: {}, e2: {}}}}}\n", array_e1,
                     array_e2);
}

void write(const case_file::FibresCase& c, const MadeFibres& made) {
  const auto& folder = c.output;
  if (c.meshes.interface) {
    auto lumen = made.data;
    lumen.fields.clear();  // they are of the wall
    mesh_io::write_simvascular(folder / "lumen", lumen, mesh::RegionKind::lumen, mm);
  }
  const auto regions = mesh_io::write_simvascular(folder / "wall", made.data, mesh::RegionKind::wall, mm);
  files::write_atomically(folder / "meshes.yaml", case_text(regions, c));
  files::write_atomically(folder / "report.json", made.report_json);
}

}  // namespace

frames::FrameFaces face_roles(const case_file::FibresCase& c, const mesh::MeshData& data) {
  std::vector<Problem> problems;
  const auto faces = names_of(data.faces);
  check_names(c.inlet, faces, "inlet", "face", problems);
  check_names(c.outer, faces, "outer", "face", problems);
  check_names(c.inner_faces(), faces, "inner", "face", problems);
  const auto regions = artifacts::wall_regions(data);
  for (const auto& [name, region] : c.regions)
    check_names({name}, regions, "regions." + name, "region of the wall", problems);
  if (c.tears) {
    check_names(c.tears->true_lumen, regions, "tears.true_lumen", "region of the wall", problems);
    check_names(c.tears->false_lumen, regions, "tears.false_lumen", "region of the wall", problems);
  }
  if (!problems.empty()) throw InputError(std::move(problems));

  std::set<std::string> taken(c.inlet.begin(), c.inlet.end());
  taken.insert(c.outer.begin(), c.outer.end());
  taken.insert(c.inner_faces().begin(), c.inner_faces().end());
  if (c.meshes.interface) taken.insert(c.meshes.interface->lumen_faces.begin(), c.meshes.interface->lumen_faces.end());
  frames::FrameFaces roles{c.inner_faces(), {}, {}};
  for (const auto& face : data.faces) {
    if (!frames::includes(c.frames.domain, data.regions[face.region].kind)) continue;
    if (std::find(c.inlet.begin(), c.inlet.end(), face.name) != c.inlet.end()) roles.inlet.push_back(face.name);
    if (!taken.contains(face.name)) roles.outlets.push_back(face.name);
  }
  if (roles.inlet.empty())
    problems.push_back(
        {"inlet", "names no face of the wall, on which alone the potential is solved for", "add the ring of the wall"});
  if (roles.outlets.empty())
    problems.push_back({"outer", "leaves no face where the vessel ends", "name only faces along the vessel"});
  if (!problems.empty()) throw InputError(std::move(problems));
  return roles;
}

MadeFibres make_fibres(const case_file::FibresCase& c, artifacts::CheckedMesh loaded, MPI_Comm comm,
                       const files::Say& say) {
  files::Phases phases(say);
  auto roles = parallel::on_root(comm, [&] { return face_roles(c, loaded.data); });
  for (auto* names : {&roles.inner, &roles.inlet, &roles.outlets}) parallel::broadcast(comm, *names);
  phases.begin("distribute");
  const auto mesh = distributed::distribute(loaded.data, comm);
  const frames::ElementGraph graph(mesh);
  phases.begin("directions");
  const auto frames = frames::make_frames(graph, roles, c.frames);
  auto fields = gather_frames(c, graph, frames);
  if (!c.outer.empty())
    fields.push_back(Gatherer(mesh)(array_depth, 4, frames::depths(graph, c.inner_faces(), c.outer)));
  ReportInput input{.data = loaded.data, .inlet = roles.inlet, .outlets = roles.outlets};
  if (c.tears) {
    phases.begin("tears");
    const auto points = frames::tear_points(mesh, *c.tears);
    fields.push_back(Gatherer(mesh)(array_tear, 1, scaled(frames::distances(graph, points), 1 / mm)));
    input.tear_elements = std::ssize(points);
  }
  phases.end();
  if (parallel::rank(comm) != 0) return {};
  loaded.data.fields = std::move(fields);
  input.iterations = frames.iterations;
  input.undefined = frames.undefined;
  input.ranks = parallel::size(comm);
  input.seconds = phases.seconds;
  input.peak_memory = artifacts::peak_memory();
  const auto report = fibres_report(input);
  return {std::move(loaded.data), config::json_text(report), report_text(report)};
}

std::string fibres_to_files(const FibresRequest& request, MPI_Comm comm, const files::Say& say) {
  std::string text;
  files::FolderLock lock;  // rank 0
  case_file::FibresCase c;
  artifacts::CheckedMesh loaded;
  parallel::on_root(comm, [&] {
    text = request.text ? *request.text : config::read_text(request.file);
    auto parsed = case_file::read_fibres_case(text, request.file);
    for (const Problem& warning : parsed.warnings) say("warning: " + format(warning));
    c = std::move(parsed.value);
    if (request.output) c.output = *request.output;
    lock = files::FolderLock(c.output);
    if (!lock.taken_over().empty()) say("warning: " + lock.taken_over());
    if (!request.overwrite && std::filesystem::exists(c.output / "report.json"))
      throw InputError(c.output.string(), "holds a result already", "give --overwrite, or another `output`");
    files::try_outputs(c.output,
                       {"meshes.yaml", "report.json", "wall/mesh-complete.mesh.vtu", "wall/mesh-surfaces/face.vtp"});
    loaded = artifacts::load_meshes(c.meshes, {});
    for (const auto& line : loaded.warnings) say("warning: " + line);
    face_roles(c, loaded.data);  // throws before anything is written
    request.before_work();
  });
  parallel::broadcast(comm, text);
  if (parallel::rank(comm) != 0) c = case_file::parse_fibres_case(text, request.file);
  const auto made = make_fibres(c, std::move(loaded), comm, say);
  return parallel::on_root(comm, [&] {
    write(c, made);
    return made.report_text;
  });
}

}  // namespace tunica::stages::fibres
