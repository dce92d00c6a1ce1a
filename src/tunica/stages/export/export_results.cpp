#include "tunica/stages/export/export_results.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cmath>
#include <span>

#include "tunica/analysis/field_series.hpp"
#include "tunica/artifacts/histories.hpp"
#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/artifacts/manifest.hpp"
#include "tunica/base/error.hpp"
#include "tunica/case/case.hpp"
#include "tunica/config/description.hpp"
#include "tunica/config/units.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh_io/vtk_writer.hpp"
#include "tunica/peer_cases/unit_system.hpp"
#include "tunica/stages/posed_case.hpp"

namespace tunica::stages {

namespace fs = std::filesystem;
using peer_cases::UnitSystem;

namespace {

struct Units {
  double length, velocity, pressure, flow;  ///< SI values
  explicit Units(const UnitSystem& units)
      : length(units.metres),
        velocity(config::unit_factor(units.velocity, config::dimension::velocity)),
        pressure(config::unit_factor(units.pressure, config::dimension::pressure)),
        flow(config::unit_factor(units.flow, config::dimension::volume_flow)) {}
};

vtkNew<vtkUnstructuredGrid> shape_of(const mesh::MeshData& data, double length) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& x : data.points) points->InsertNextPoint(x[0] / length, x[1] / length, x[2] / length);
  grid->SetPoints(points);
  const bool quadratic = !data.edges.empty();
  vtkNew<vtkCellArray> cells;
  for (std::size_t e = 0; e < data.tetrahedra.size(); ++e) {
    cells->InsertNextCell(quadratic ? 10 : 4);
    for (const auto node : data.tetrahedra[e]) cells->InsertCellPoint(node);
    if (quadratic)
      for (const auto node : data.edges[e]) cells->InsertCellPoint(node);
  }
  grid->SetCells(quadratic ? VTK_QUADRATIC_TETRA : VTK_TETRA, cells);
  return grid;
}

/// A field of nodes; nothing where the run has none of the kind.
void set_array(vtkUnstructuredGrid* grid, const char* name, const std::vector<double>& values, double unit) {
  const auto nodes = grid->GetNumberOfPoints();
  if (values.empty() || nodes == 0) return;
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(values.size() / static_cast<std::size_t>(nodes)));
  array->SetNumberOfTuples(nodes);
  for (std::size_t i = 0; i < values.size(); ++i) array->SetValue(static_cast<vtkIdType>(i), values[i] / unit);
  grid->GetPointData()->AddArray(array);
}

/// Number of the step that ends at each of the times; statics count their load steps.
std::vector<std::int64_t> steps_of(const case_file::Case& c, const std::vector<double>& times) {
  std::vector<std::int64_t> steps;
  for (std::size_t f = 0; f < times.size(); ++f)
    steps.push_back(c.time ? std::llround(times[f] / c.time->step) : static_cast<std::int64_t>(f));
  return steps;
}

/// Integrals over the domains, which are the regions of the mesh, at every instant of the fields.
class VolumeFiles {
 public:
  VolumeFiles(const case_file::Case& c, const mesh::MeshData& data, const Units& units)
      : fluid_(c.solves_fluid()), wall_(c.solves_wall()), data_(data), units_(units) {
    for (const auto& region : data.regions) initial_.push_back(integrals(region, data.points, {}));
  }

  void add(std::int64_t step, const analysis::FieldFrame& frame) {
    auto points = data_.points;
    for (std::size_t n = 0; n < points.size() && !frame.displacement.empty(); ++n)
      for (int i = 0; i < 3; ++i) points[n][i] += frame.displacement[3 * n + static_cast<std::size_t>(i)];
    std::string pressures, jacobians;
    for (std::size_t r = 0; r < data_.regions.size(); ++r) {
      const auto now = integrals(data_.regions[r], points, frame.pressure);
      const bool lumen = data_.regions[r].kind == mesh::RegionKind::lumen;
      (lumen ? pressures : jacobians) += fmt::format(
          " {:.10e} ", lumen ? now.pressure / now.volume / units_.pressure : now.volume / initial_[r].volume);
    }
    const std::string start = fmt::format(" {}   {:.10e} ", step, frame.time);
    pressures_ += start + pressures + "\n";
    jacobians_ += start + jacobians + "\n";
  }

  std::vector<std::string> write(const fs::path& folder) const {
    std::vector<std::string> files;
    const auto put = [&](const std::string& name, mesh::RegionKind kind, const std::string& lines) {
      files::write_atomically(folder / name, head(kind) + lines);
      files.push_back(name);
    };
    if (fluid_) put(wall_ ? "V_FS_Pressure_flux.txt" : "V_NS_Pressure_flux.txt", mesh::RegionKind::lumen, pressures_);
    if (wall_) put(fluid_ ? "V_FS_Jacobian_flux.txt" : "V_ST_Jacobian_flux.txt", mesh::RegionKind::wall, jacobians_);
    return files;
  }

 private:
  struct Integrals {
    double volume = 0, pressure = 0;
  };
  /// Of the corners at `points`; without `pressure` its integral is 0.
  Integrals integrals(const mesh::RegionData& region, const std::vector<Vec3<double>>& points,
                      std::span<const double> pressure) const {
    Integrals sum;
    for (auto e = region.first_element; e < region.end_element; ++e) {
      const auto& corners = data_.tetrahedra[static_cast<std::size_t>(e)];
      const double volume = mesh::volume(points, corners);
      sum.volume += volume;
      for (std::size_t a = 0; a < 4 && !pressure.empty(); ++a)
        sum.pressure += volume * pressure[static_cast<std::size_t>(corners[a])] / 4;
    }
    return sum;
  }
  std::string head(mesh::RegionKind kind) const {
    std::string volumes, names;
    for (std::size_t r = 0; r < data_.regions.size(); ++r)
      if (data_.regions[r].kind == kind) {
        volumes += fmt::format(" {:4.3e} ", initial_[r].volume / (units_.length * units_.length * units_.length));
        names += data_.regions[r].name + " ";
      }
    return "# Volume integrals of tunica in the form of svMultiPhysics: domain volumes, then step, time, means of the "
           "domains\ndomain volumes: " +
           volumes + "\nstep   time  " + names + "\n";
  }

  bool fluid_, wall_;
  const mesh::MeshData& data_;
  const Units& units_;
  std::vector<Integrals> initial_;
  std::string pressures_, jacobians_;
};

std::vector<std::string> write_fields(const case_file::Case& c, const mesh::MeshData& data, const Units& units,
                                      const fs::path& folder) {
  VolumeFiles volumes(c, data, units);
  analysis::FieldSeries series(case_file::describe(c), data, c.output.directory);
  const auto steps = steps_of(c, series.times());
  const auto grid = shape_of(data, units.length);
  std::vector<std::string> files;
  for (std::size_t f = 0; f < steps.size(); ++f) {
    if (steps[f] == 0) continue;  // the start, which svMultiPhysics does not write
    const auto frame = series.read(f);
    set_array(grid, "Velocity", frame.velocity, units.velocity);
    set_array(grid, "Pressure", frame.pressure, units.pressure);
    set_array(grid, "Displacement", frame.displacement, units.length);
    set_array(grid, "WSS", frame.wall_shear, units.pressure);
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    writer->SetInputData(grid);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToZLib();
    files.push_back(fmt::format("result_{:03}.vtu", steps[f]));
    mesh_io::write_vtk(*writer, folder / files.back());
    volumes.add(steps[f], frame);
  }
  for (auto& file : volumes.write(folder)) files.push_back(std::move(file));
  return files;
}

/// A file of one quantity on all faces of the lumen.
struct BoundaryFile {
  const char *name, *column;
  const config::Dimension& dimension;
  double unit;
};

std::string text_of(const BoundaryFile& file, const files::CsvColumns& history, const std::vector<std::string>& faces,
                    const std::vector<double>& times, const Units& units) {
  std::string text =
      "# Boundary integrals of tunica in the form of svMultiPhysics: face areas, then step, time, values of the faces\n"
      "face areas: ";
  std::vector<std::vector<double>> columns;
  for (const auto& face : faces) {
    const auto areas = artifacts::si_column(history, face + " area", config::dimension::area);
    text += fmt::format(" {:4.3e} ", areas.empty() ? 0.0 : areas.front() / (units.length * units.length));
    columns.push_back(artifacts::si_column(history, fmt::format("{} {}", face, file.column), file.dimension));
  }
  text += "\nstep   time  ";
  for (const auto& face : faces) text += fmt::format(" {} ", face);
  text += "\n";
  for (std::size_t row = 0; row < times.size(); ++row) {
    text += fmt::format(" {}   {:.10e} ", history.columns[0][row], times[row]);
    for (const auto& column : columns) text += fmt::format(" {:.10e} ", column[row] / file.unit);
    text += "\n";
  }
  return text;
}

std::vector<std::string> write_histories(const case_file::Case& c, const mesh::MeshData& data, const Units& units,
                                         const fs::path& folder) {
  if (!c.solves_fluid()) return {};
  std::vector<std::string> faces;
  for (const auto& face : data.faces)
    if (data.regions[static_cast<std::size_t>(face.region)].kind == mesh::RegionKind::lumen) faces.push_back(face.name);
  const auto history = files::read_csv(c.output.directory / "faces.csv", artifacts::history_remedy);
  const auto times = artifacts::si_column(history, "time", config::dimension::time);
  const BoundaryFile kinds[] = {{"Velocity_flux.txt", "flow", config::dimension::volume_flow, units.flow},
                                {"Pressure_average.txt", "pressure", config::dimension::pressure, units.pressure}};
  std::vector<std::string> files;
  for (const auto& kind : kinds) {
    files.push_back(fmt::format("B_{}_{}", c.solves_wall() ? "FS" : "NS", kind.name));
    files::write_atomically(folder / files.back(), text_of(kind, history, faces, times, units));
  }
  return files;
}

/// What was computed from another case would come out under the name of this one.
void check_fresh(const fs::path& case_file, const case_file::Case& c) {
  const auto results = artifacts::find_results(c.output.directory);
  if (!results || !results->damage.empty()) return;  // what is missing is told where it is read
  if (results->case_hash != inputs_of(config::read_text(case_file), case_file, c).fingerprint())
    throw InputError(c.output.directory.string(), "holds results of another case, or of this one before it was changed",
                     "run the case, or name the folder of its results by `output.directory`");
}

}  // namespace

std::vector<std::string> export_results(const ResultsRequest& request) {
  const Units units(peer_cases::unit_system(request.units));
  const auto c = case_file::read_case(request.case_file).value;
  check_fresh(request.case_file, c);
  const auto mesh = artifacts::load_mesh(c);
  fs::create_directories(request.folder);
  auto files = write_fields(c, mesh.data, units, request.folder);
  for (auto& file : write_histories(c, mesh.data, units, request.folder)) files.push_back(std::move(file));
  return files;
}

}  // namespace tunica::stages
