#include "tunica/stages/imaging/motion_scan_case.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>

#include "tunica/analysis/field_series.hpp"
#include "tunica/analysis/vessel.hpp"
#include "tunica/base/error.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/flow_imaging/cross_section.hpp"
#include "tunica/imaging/label_image.hpp"
#include "tunica/mesh/edge_nodes.hpp"
#include "tunica/mesh/lumen_fields.hpp"
#include "tunica/motion_imaging/synthetic_phases.hpp"
#include "tunica/stages/vessel_of_case.hpp"

namespace tunica::stages {

namespace {

namespace fs = std::filesystem;

constexpr double margin = 6e-3;  ///< of tissue around the vessel [m]

/// The mesh of the fields that a run leaves, with the lumens told apart.
mesh::MeshData imaged_mesh(const VesselOfCase& vessel) {
  auto data = vessel.mesh;
  const auto settings = post_settings(vessel.settings);
  analysis::tell_lumens_apart(case_file::describe(vessel.settings), settings, data, MPI_COMM_SELF);
  if (vessel.settings.elements != case_file::Elements::quadratic) return data;
  mesh::add_edge_nodes(data);
  return mesh::subdivided(data);
}

std::vector<double> side_of(const mesh::MeshData& data) {
  for (const auto& field : data.node_fields)
    if (field.name == mesh::lumen_side) return field.values;
  return {};
}

}  // namespace

config::Schema<MotionScanCase> MotionScanCase::schema() {
  using M = MotionScanCase;
  config::Schema<imaging::ScanSettings> scan("scan", "Gated CT and its segmentation.");
  imaging::ScanSettings::add_to(scan);
  return config::Schema<M>("tunica synthesise --motion",
                           "File of `tunica synthesise --motion`, in YAML like a case file.")
      .include(&M::beat, ImagedBeat::schema())
      .integer("phases", &M::phases, config::range(2, 100), "Images over the beat")
      .by_default()
      .section("scan", &M::scan, scan, "The scanner")
      .by_default()
      .path("output", &M::output, "Folder of the images, relative to that of this file")
      .by_default("phases");
}

config::Parsed<MotionScanCase> read_motion_scan_case(const fs::path& file) {
  return config::parse_file(MotionScanCase::schema(), file);
}

std::string motion_scan_to_files(const MotionScanCase& scan, bool overwrite, const files::Say& say) {
  if (!overwrite && fs::exists(scan.output / "labels_000.nrrd"))
    throw InputError(scan.output.string(), "holds images already", "give --overwrite, or another `output`");
  const files::FolderLock lock(scan.output);
  if (!lock.taken_over().empty()) say("warning: " + lock.taken_over());
  files::try_outputs(scan.output, {"labels_000.nrrd", "truth.csv"});
  files::remove_outputs(scan.output, {"labels_*.nrrd", "truth.csv"});
  const auto vessel = vessel_with_corners(scan.beat.case_file);
  const auto data = imaged_mesh(vessel);
  const auto side = side_of(data);
  std::vector<flow_imaging::CrossSection> planes;
  for (const auto& [name, plane] : scan.beat.planes)
    planes.push_back(flow_imaging::plane_section(vessel.mesh, plane.centre, plane.normal, name, "planes." + name));
  const fs::path results = scan.beat.results.value_or(vessel.settings.output.directory);
  analysis::FieldSeries fields(case_file::describe(vessel.settings), data, results);
  const double until = scan.beat.until.value_or(fields.times().back()), from = until - scan.beat.period;
  ComputedBeat beat(fields, from, until, results);

  const auto frame = imaging::frame_about(data.points, scan.scan.voxel, margin, scan.scan.tilt);
  std::string truth = "time [s]";
  for (const auto& plane : planes) truth += fmt::format(",{} [mm^2]", plane.name);
  truth += "\n";
  for (std::int64_t k = 0; k < scan.phases; ++k) {
    say(fmt::format("phase {} of {}", k + 1, scan.phases));
    const double t = scan.beat.period * static_cast<double>(k) / static_cast<double>(scan.phases);
    const auto displacement = beat.at(from + t).displacement;
    auto points = data.points;
    for (std::size_t n = 0; n < points.size() && !displacement.empty(); ++n)
      for (std::size_t d = 0; d < 3; ++d) points[n][static_cast<int>(d)] += displacement[3 * n + d];
    const auto image = motion_imaging::phase_image(data, points, side, frame, scan.scan, static_cast<std::uint64_t>(k));
    imaging::write_label_image(image, scan.output / fmt::format("labels_{:03}.nrrd", k));
    truth += fmt::format("{:.9g}", t);
    for (const auto& plane : planes)
      truth += fmt::format(",{:.7g}", 1e6 * flow_imaging::state_of(plane, {.displacement = displacement}).area);
    truth += "\n";
  }
  files::write_atomically(scan.output / "truth.csv", truth);
  return fmt::format("phases: {{labels: {}/labels_*.nrrd, true_lumen: 1{}, period: {:.9g} s}}\n",
                     scan.output.filename().string(), side.empty() ? "" : ", false_lumen: 2", scan.beat.period);
}

}  // namespace tunica::stages
