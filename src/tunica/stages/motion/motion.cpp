#include "tunica/stages/motion/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/base/units.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/flow_imaging/read_series.hpp"
#include "tunica/geometry/surface_file.hpp"
#include "tunica/imaging/label_image.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/motion_imaging/extension.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/stages/motion/moving_vessel.hpp"

namespace tunica::stages {

namespace {

namespace fs = std::filesystem;
namespace dimension = config::dimension;
using config::Problems;
using config::Schema;
using motion_imaging::LumenBoundary;

constexpr double margin_of_labels = 5e-3;  ///< beyond reach: blurred labels see the voxels around [m]
constexpr double least_seen = 0.6;         ///< of the wall: otherwise mesh and images are not of one vessel
constexpr double nearly_all = 0.9;         ///< of the wall; less is told

void check_phases(const PhaseFiles& f, Problems& problems) {
  if (f.labels.has_value() == f.surfaces.has_value())
    problems.add("", f.labels ? "has `labels` and `surfaces`" : "names no files",
                 "give `labels: labels_*.nrrd`, or `surfaces: phase_*.stl`");
  if (f.lumens.false_lumen && *f.lumens.false_lumen == f.lumens.true_lumen)
    problems.add("false_lumen", fmt::format("is {}, as the true one", *f.lumens.false_lumen),
                 "leave it out where both lumens have one label");
}

Schema<MotionPoint> point_schema() {
  return Schema<MotionPoint>("point", "A place in the mesh.")
      .quantities("place", &MotionPoint::place, dimension::length, config::anything(),
                  "The node next to it is followed")
      .shorthand("place");
}

/// Files and times of the phases, and which of them the mesh is of.
struct Order {
  std::vector<std::string> files;
  std::vector<double> times;
  std::size_t of_mesh = 0;
};

Order order_of(const MotionCase& c) {
  Order order;
  const auto& f = c.phases;
  order.files = flow_imaging::files_of_frames(f.labels ? *f.labels : f.surfaces.value(),
                                              f.labels ? "phases.labels" : "phases.surfaces", "phase");
  if (order.files.size() < 2)
    throw InputError("phases", "names one phase, at least 2 are needed", "write * in place of the number of the phase");
  std::vector<std::string> names;
  for (const auto& file : order.files) names.push_back(fs::path(file).filename().string());
  order.times = flow_imaging::frame_times(f.times, f.period, names, "phases.times", "phase");
  if (!c.mesh_at) return order;
  std::string known;
  for (std::size_t k = 0; k < order.times.size(); ++k) {
    if (std::abs(order.times[k] - *c.mesh_at) < 1e-6 * f.period) return order.of_mesh = k, order;
    known += fmt::format("{}{:.6g} s", k == 0 ? "" : ", ", order.times[k]);
  }
  throw InputError("mesh_at", fmt::format("of {:.6g} s is the time of no phase", *c.mesh_at),
                   "choose one of: " + known);
}

std::vector<Vec3<double>> normals_at(const geometry::TriangleSurface& surface) {
  std::vector<Vec3<double>> normals;
  for (const auto& t : surface.triangles) {
    const auto a = geometry::area_vector(surface, t);
    normals.push_back((1 / std::max(norm(a), 1e-300)) * a);
  }
  return normals;
}

std::unique_ptr<LumenBoundary> boundary_of(const MotionCase& c, const MovingVessel& v, const std::string& file) {
  const auto& wall = v.wall.surface;
  if (c.phases.labels)
    return motion_imaging::boundary_in_labels(imaging::read_label_image(file), c.phases.lumens, wall.points,
                                              c.tracking.reach + margin_of_labels, file);
  std::vector<geometry::Point> centres;
  for (const auto& t : wall.triangles) centres.push_back(mesh::centroid(wall.points, t));
  return motion_imaging::boundary_on_surface(geometry::read_surface(file, c.phases.length_unit), centres,
                                             normals_at(wall));
}

/// Files that are there are not to be lost, those that are read least of all.
void refuse_folder(const MotionCase& c, const Order& order, bool overwrite) {
  std::error_code error;
  for (const auto& file : order.files)
    if (fs::equivalent(fs::path(file).parent_path().empty() ? "." : fs::path(file).parent_path(), c.output, error))
      throw InputError("output", fmt::format("is the folder of the phases, {}", c.output.string()),
                       "name another folder: files there would be replaced");
  for (const auto& entry : fs::directory_iterator(c.output, error))
    for (const auto& pattern : motion_files())
      if (!overwrite && files::fits(pattern, entry.path().filename().string()))
        throw InputError(c.output.string(), fmt::format("holds {} already", entry.path().filename().string()),
                         "give --overwrite, or another `output`");
}

/// Before any work: files that do not read, and phases in other voxels, which are of another reconstruction or have a
/// wrong header. Cuts of one grid may differ.
void check_labels(const std::vector<std::string>& files) {
  constexpr double tolerance = 0.01;
  std::optional<imaging::ImageFrame> first;
  for (const auto& file : files) {
    const auto frame = imaging::read_label_image(file).frame;
    if (!first) first = frame;
    for (std::size_t d = 0; d < 3; ++d) {
      const auto &here = frame.steps[d], &there = first->steps[d];
      if (norm(here - there) < tolerance * norm(there)) continue;
      throw InputError(
          file,
          fmt::format("has voxels of ({:.4g}, {:.4g}, {:.4g}) mm along axis {}, {} has ({:.4g}, {:.4g}, {:.4g}) mm",
                      here[0] / unit::mm, here[1] / unit::mm, here[2] / unit::mm, d + 1, files.front(),
                      there[0] / unit::mm, there[1] / unit::mm, there[2] / unit::mm),
          "give phases of one reconstruction: the same spacing and directions");
    }
  }
}

/// Where both labels meet, at the rims of tears, a label does not tell where its lumen ends.
void open_rims(MovingVessel& v, double near) {
  std::vector<geometry::Point> across;
  for (const auto& tear : v.anatomy.tears)
    for (const auto& t : tear.surface)
      for (const auto& corner : t.corners)
        across.push_back(analysis::position(t.nodes, corner, {.points = &v.vessel.mesh.points}));
  for (std::size_t t = 0; t < v.wall.sides.size(); ++t) {
    const auto centre = mesh::centroid(v.wall.surface.points, v.wall.surface.triangles[t]);
    for (const auto& x : across)
      if (norm(x - centre) < near) v.wall.sides[t] = motion_imaging::Side::either;
  }
}

void require_seen(const motion_imaging::WallMotion& found, const std::string& file, bool of_mesh, double reach) {
  double squares = 0;
  for (const auto& u : found.displacement) squares += dot(u, u) / static_cast<double>(found.displacement.size());
  const bool far = of_mesh && std::sqrt(squares) > 0.5 * reach;
  if (found.seen >= least_seen && !far) return;
  throw InputError(
      file,
      far ? fmt::format("the mesh lies {:.3g} mm from the lumen of its own phase", 1e3 * std::sqrt(squares))
          : fmt::format("the lumen ends near {:.0f} % of the wall of the mesh, {:.0f} % are needed", 100 * found.seen,
                        100 * least_seen),
      "mesh and images have to be of one patient and in the same coordinates; `mesh_at` is the phase of the mesh, and "
      "`reach` has to be longer than the wall moves between two phases");
}

/// What moves farther than was looked for was not found, but carried along.
void require_within_reach(const motion_imaging::WallMotion& found, const std::vector<Vec3<double>>& before,
                          const std::string& file, double reach) {
  double largest = 0;
  for (std::size_t n = 0; n < before.size(); ++n) largest = std::max(largest, norm(found.displacement[n] - before[n]));
  if (largest > 1.5 * reach)
    throw InputError(
        file,
        fmt::format("the wall moves by {:.3g} mm from the phase before, {:.3g} mm are looked for", largest / unit::mm,
                    reach / unit::mm),
        "check that all phases are of one patient, in the same coordinates and in their order; else give a "
        "longer `reach`, or phases in between");
}

/// From the phase of the mesh on round the beat, each from where the one before it was found.
std::vector<Phase> track_phases(const MotionCase& c, MovingVessel& v, const Order& order, const files::Say& say) {
  std::vector<Phase> phases(order.files.size());
  const motion_imaging::Extension extension(v.vessel.mesh, v.nodes);
  std::optional<motion_imaging::WallTracker> tracker;
  motion_imaging::WallMotion of_mesh;
  std::vector<Vec3<double>> start;
  for (std::size_t step = 0; step < phases.size(); ++step) {
    const auto k = (order.of_mesh + step) % phases.size();
    const auto boundary = boundary_of(c, v, order.files[k]);
    if (step == 0) {
      if (c.phases.lumens.false_lumen) open_rims(v, boundary->grain());
      tracker.emplace(v.wall, c.tracking);
    }
    auto found = tracker->track(*boundary, start);
    require_seen(found, order.files[k], step == 0, c.tracking.reach);
    if (step > 0) require_within_reach(found, start, order.files[k], c.tracking.reach);
    if (found.seen < nearly_all)
      say(fmt::format("warning: {}: {:.0f} % of the wall is not seen; there its motion is that of the neighbourhood",
                      order.files[k], 100 * (1 - found.seen)));
    start = found.displacement;
    if (step == 0) of_mesh = found;
    auto& phase = phases[k];
    phase.file = order.files[k];
    phase.time = order.times[k];
    phase.residual = found.residual;
    phase.seen = found.seen;
    phase.motion = motion_imaging::difference(found, of_mesh);
    double largest = 0;
    for (const auto& u : phase.motion.displacement) largest = std::max(largest, norm(u));
    phase.displacement = extension.of(phase.motion.displacement);
    say(fmt::format("phase {} of {}, {}: moved by up to {:.3g} mm, {:.2g} mm left of it, {:.0f} % of the wall seen",
                    step + 1, phases.size(), fs::path(phase.file).filename().string(), largest / unit::mm,
                    phase.residual / unit::mm, 100 * phase.seen));
  }
  return phases;
}

}  // namespace

Schema<PhaseFiles> PhaseFiles::schema() {
  using F = PhaseFiles;
  return Schema<F>("phases", "Labels or surfaces at several phases of the beat.")
      .path("labels", &F::labels, "Label images (NRRD, MetaImage, NIfTI), a name with * for one file a phase")
      .path("surfaces", &F::surfaces, "Or surfaces of the lumen (.stl, .vtp, .ply, .obj), a name with *")
      .integer(
          "true_lumen", [](F & f) -> auto& { return f.lumens.true_lumen; }, config::range(1, 32767),
          "Label of the lumen, or of the true one")
      .by_default()
      .integer(
          "false_lumen", [](F & f) -> auto& { return f.lumens.false_lumen; }, config::range(1, 32767),
          "Label of the false lumen; left out where both lumens have one label")
      .optional()
      .unit("length_unit", &F::length_unit, dimension::length, "Of the coordinates of `surfaces`")
      .by_default("mm")
      .quantity("period", &F::period, dimension::time, config::above(0), "Of the heart beat")
      .plausible("0.3 s", "2 s")
      .quantities("times", &F::times, dimension::time, config::at_least(0),
                  "Of the phases; equal parts of the period when left out")
      .by_default("[]")
      .check(check_phases);
}

namespace {

/// Names stand in headings of tables and in names of files.
void check_names(const MotionCase& c, Problems& problems) {
  const auto check = [&](const std::string& where, const std::string& name) {
    if (name.find_first_of(",\"'[]/\\") != std::string::npos)
      problems.add(where + "." + name, "has a name with one of , \" ' [ ] / \\", "name it by letters, digits and _");
  };
  for (const auto& [name, plane] : c.planes) check("planes", name);
  for (const auto& [name, point] : c.points) check("points", name);
  auto rings = c.rings;
  std::sort(rings.begin(), rings.end());
  if (const auto twice = std::adjacent_find(rings.begin(), rings.end()); twice != rings.end())
    problems.add("rings", fmt::format("names {} twice", *twice), "name each face once");
}

}  // namespace

Schema<MotionCase> MotionCase::schema() {
  using M = MotionCase;
  return Schema<M>("tunica motion", "File of `tunica motion`, in YAML like a case file.")
      .file("case", &M::case_file, "Case file whose lumen is followed; its mesh is there")
      .section("phases", &M::phases, PhaseFiles::schema(), "Images or surfaces of the phases")
      .quantity("mesh_at", &M::mesh_at, dimension::time, config::at_least(0),
                "Phase whose shape the mesh has; the first one when left out")
      .quantity(
          "smoothing", [](M & m) -> auto& { return m.tracking.smoothing; }, dimension::length,
          config::range(5e-4, 0.05), "Length below which motion is taken for noise")
      .by_default("4 mm")
      .quantity(
          "reach", [](M & m) -> auto& { return m.tracking.reach; }, dimension::length, config::range(1e-3, 0.05),
          "How far from where it was in the phase before the wall is looked for")
      .by_default("6 mm")
      .texts("ends", &M::ends,
             "Openings that are seen to move: there the lumen ends in the images as it does in the mesh")
      .by_default("[]")
      .map("planes", &M::planes, case_file::MeasuredPlane::schema(), "Planes whose areas are told, by name")
      .by_default()
      .map("points", &M::points, point_schema(), "Places whose motion is told, by name")
      .by_default()
      .texts("rings", &M::rings, "Faces of the wall whose motion becomes a condition: `wall_inlet`")
      .by_default("[]")
      .path("output", &M::output, "Folder of the results, relative to that of this file")
      .by_default("motion")
      .check(check_names);
}

config::Parsed<MotionCase> read_motion_case(const fs::path& file) {
  return config::parse_file(MotionCase::schema(), file);
}

void motion(const MotionCase& c, bool overwrite, MPI_Comm comm, const files::Say& say) {
  std::optional<files::FolderLock> lock;
  const auto order = parallel::agree(comm, [&] { return order_of(c); });
  parallel::on_root(comm, [&] {
    refuse_folder(c, order, overwrite);
    if (c.phases.labels) check_labels(order.files);
    lock.emplace(c.output);
    if (!lock->taken_over().empty()) say("warning: " + lock->taken_over());
    files::try_outputs(c.output, {"curves.csv", "stations.csv", "motion.json"});
  });
  auto vessel = find_moving_vessel(c, comm);
  parallel::on_root(comm, [&] {
    if (c.phases.lumens.false_lumen && vessel.anatomy.side.empty())
      say("warning: the mesh tells no true and false lumen apart, so both labels count as one lumen");
    for (const auto& point : vessel.points)
      if (point.distance > unit::mm)
        say(fmt::format("warning: point {}: the node that is followed lies {:.2g} mm away", point.name,
                        point.distance / unit::mm));
    say(fmt::format("wall of {} triangles, {} phases of {:.4g} s", vessel.wall.surface.triangles.size(),
                    order.files.size(), c.phases.period));
    const auto phases = track_phases(c, vessel, order, say);
    write_motion(c, vessel, phases, say);
  });
}

}  // namespace tunica::stages
