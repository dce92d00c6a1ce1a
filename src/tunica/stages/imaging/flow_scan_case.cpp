#include "tunica/stages/imaging/flow_scan_case.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/analysis/field_series.hpp"
#include "tunica/base/error.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/flow_imaging/inlet_profile.hpp"
#include "tunica/flow_imaging/read_series.hpp"
#include "tunica/mesh/edge_nodes.hpp"
#include "tunica/stages/vessel_of_case.hpp"

namespace tunica::stages {

namespace {

namespace fs = std::filesystem;
namespace flow = flow_imaging;

Vec3<double> vector_at(const std::vector<double>& field, std::size_t node) {
  if (field.empty()) return {};
  return {{field[3 * node], field[3 * node + 1], field[3 * node + 2]}};
}

flow::Instant instant_of(const mesh::MeshData& data, const ComputedBeat::State& state) {
  flow::Instant instant;
  for (std::size_t n = 0; n < data.points.size(); ++n) {
    instant.points.push_back(data.points[n] + vector_at(state.displacement, n));
    instant.velocity.push_back(vector_at(state.velocity, n));
  }
  return instant;
}

/// Openings, the inlet's flow into the vessel, and planes.
std::vector<flow::CrossSection> sections_of(const FlowScanCase& scan, const VesselOfCase& vessel,
                                            const mesh::MeshData& data) {
  std::vector<flow::CrossSection> sections;
  for (const auto& name : vessel.openings) {
    auto section = flow::opening_section(
        data, *std::find_if(data.faces.begin(), data.faces.end(), [&](const auto& f) { return f.name == name; }));
    if (name == vessel.inlet)
      for (auto& t : section.triangles) std::swap(t[1], t[2]);
    sections.push_back(std::move(section));
  }
  for (const auto& [name, plane] : scan.beat.planes)
    sections.push_back(flow::plane_section(data, plane.centre, plane.normal, name, "planes." + name));
  return sections;
}

void write_flows(const std::vector<flow::CrossSection>& sections, const std::vector<double>& times, ComputedBeat& beat,
                 double from, const fs::path& file) {
  std::string text = "time [s]";
  for (const auto& s : sections) text += fmt::format(",{} [ml/s]", s.name);
  text += "\n";
  for (const double t : times) {
    const auto state = beat.at(from + t);
    text += fmt::format("{:.9g}", t);
    for (const auto& s : sections)
      text += fmt::format(
          ",{:.7g}", 1e6 * flow::state_of(s, {.displacement = state.displacement, .velocity = state.velocity}).flow);
    text += "\n";
  }
  files::write_atomically(file, text);
}

/// At the corners of the elements, or where the run has quadratic ones at all of its nodes.
void write_profile(const mesh::MeshData& data, const std::string& inlet, const std::vector<double>& times,
                   double period, ComputedBeat& beat, double from, const fs::path& file) {
  const auto& face =
      *std::find_if(data.faces.begin(), data.faces.end(), [&](const auto& f) { return f.name == inlet; });
  std::vector<std::size_t> nodes;
  for (const auto& t : face.triangles)
    for (const auto n : t) nodes.push_back(static_cast<std::size_t>(n));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  flow::OpeningMesh opening{.name = inlet, .points = {}, .triangles = {}, .edges = {}};
  for (const auto n : nodes) opening.points.push_back(data.points[n]);
  flow::NodalCourse course{.times = times, .period = period, .values = {}};
  for (const double t : times) {
    const auto state = beat.at(from + t);
    auto& v = course.values.emplace_back();
    for (const auto n : nodes) v.push_back(vector_at(state.velocity, n));
  }
  flow::write_nodal_table(opening.points, course, "vx,vy,vz", file);
}

}  // namespace

config::Schema<FlowScanCase> FlowScanCase::schema() {
  using F = FlowScanCase;
  config::Schema<flow::PhaseContrast> scan("scan", "Phase-contrast MRI of three components.");
  flow::PhaseContrast::add_to(scan);
  return config::Schema<F>("tunica synthesise --flow", "File of `tunica synthesise --flow`, in YAML like a case file.")
      .include(&F::beat, ImagedBeat::schema())
      .section("scan", &F::scan, scan, "The scanner")
      .by_default()
      .path("output", &F::output, "Folder of the images, relative to that of this file")
      .by_default("flow_images");
}

config::Parsed<FlowScanCase> read_flow_scan_case(const fs::path& file) {
  return config::parse_file(FlowScanCase::schema(), file);
}

std::string flow_scan_to_files(const FlowScanCase& scan, bool overwrite, const files::Say& say) {
  if (!overwrite && fs::exists(scan.output / "velocity_x.nii.gz"))
    throw InputError(scan.output.string(), "holds images already", "give --overwrite, or another `output`");
  const files::FolderLock lock(scan.output);
  if (!lock.taken_over().empty()) say("warning: " + lock.taken_over());
  files::try_outputs(scan.output, {"velocity_x.nii.gz", "truth.csv"});
  const auto vessel = vessel_of_case(scan.beat.case_file);
  const auto data = vessel.mesh.edges.empty() ? vessel.mesh : mesh::subdivided(vessel.mesh);
  const auto sections = sections_of(scan, vessel, data);
  const fs::path results = scan.beat.results.value_or(vessel.settings.output.directory);
  analysis::FieldSeries fields(case_file::describe(vessel.settings), data, results);
  const double until = scan.beat.until.value_or(fields.times().back()), from = until - scan.beat.period;
  ComputedBeat beat(fields, from, until, results);
  const auto frames = static_cast<double>(scan.scan.frames);
  const auto series = flow::phase_contrast(data, scan.scan, scan.beat.period, [&](std::size_t k) {
    say(fmt::format("frame {} of {}", k + 1, scan.scan.frames));
    return instant_of(data, beat.at(from + scan.beat.period * static_cast<double>(k) / frames));
  });
  flow::write_series(series, scan.output);
  write_flows(sections, series.times, beat, from, scan.output / "truth.csv");
  write_profile(data, vessel.inlet, series.times, scan.beat.period, beat, from,
                scan.output / fmt::format("truth_{}.csv", vessel.inlet));
  const auto folder = scan.output.filename().string();
  return fmt::format(
      "velocity:\n  x: {0}/velocity_x.nii.gz\n  y: {0}/velocity_y.nii.gz\n  z: {0}/velocity_z.nii.gz\n"
      "  magnitude: {0}/magnitude.nii.gz\n  unit: m/s\n  encoding: {1:.6g} m/s\n  axes: image\n  period: {2:.9g} s\n",
      folder, scan.scan.encoding, scan.beat.period);
}

}  // namespace tunica::stages
