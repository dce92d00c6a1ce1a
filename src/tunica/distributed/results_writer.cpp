#include "tunica/distributed/results_writer.hpp"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cassert>
#include <cmath>
#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/distributed/element_nodes.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/files/series_file.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::distributed {

namespace {

namespace fs = std::filesystem;

/// What this rank writes of one region.
struct Piece {
  std::vector<std::int32_t> nodes;            ///< local nodes of the owned elements, ascending
  vtkSmartPointer<vtkUnstructuredGrid> grid;  ///< points and cells; arrays only while writing
};

Piece make_piece(const DistributedMesh& mesh, const Region& region, double length_factor) {
  Piece piece;
  std::vector<std::int32_t> number(mesh.nodes(), -1);
  for (std::int32_t e = 0; e < region.owned_elements; ++e)
    for_each_node(region, static_cast<std::size_t>(e), [&](std::int32_t n) { number[n] = 0; });
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  for (std::int32_t n = 0; n < mesh.nodes(); ++n) {
    if (number[n] < 0) continue;
    number[n] = static_cast<std::int32_t>(piece.nodes.size());
    piece.nodes.push_back(n);
    const auto x = length_factor * mesh.points[n];
    points->InsertNextPoint(x[0], x[1], x[2]);
  }
  vtkNew<vtkCellArray> cells;
  const int count = mesh.quadratic ? 10 : 4;
  cells->AllocateExact(region.owned_elements, count * static_cast<vtkIdType>(region.owned_elements));
  for (std::int32_t e = 0; e < region.owned_elements; ++e) {
    cells->InsertNextCell(count);
    for_each_node(region, static_cast<std::size_t>(e), [&](std::int32_t n) { cells->InsertCellPoint(number[n]); });
  }
  piece.grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  piece.grid->SetPoints(points);
  piece.grid->SetCells(mesh.quadratic ? VTK_QUADRATIC_TETRA : VTK_TETRA, cells);
  return piece;
}

vtkSmartPointer<vtkFloatArray> float_array(const std::string& name, int components, std::int64_t tuples) {
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

void add_nodal(Piece& piece, const NodalArray& a) {
  auto array = float_array(a.name, a.components, std::ssize(piece.nodes));
  float* to = array->GetPointer(0);
  for (const auto n : piece.nodes)
    for (int c = 0; c < a.components; ++c)
      *to++ = static_cast<float>(a.factor * a.values[static_cast<std::size_t>(n) * a.stride + c]);
  piece.grid->GetPointData()->AddArray(array);
}

void add_cells(Piece& piece, const CellArray& a) {
  const auto tuples = piece.grid->GetNumberOfCells();
  auto array = float_array(a.name, a.components, tuples);
  float* to = array->GetPointer(0);
  for (vtkIdType i = 0; i < tuples * a.components; ++i) to[i] = static_cast<float>(a.factor * a.values[i]);
  piece.grid->GetCellData()->AddArray(array);
}

/// Takes the place of VTK's own printing: the error is thrown instead.
void discard_message(vtkObject*, unsigned long, void*, void*) {}

void write_grid(vtkUnstructuredGrid* grid, const fs::path& path, bool compress) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  vtkNew<vtkCallbackCommand> silent;
  silent->SetCallback(discard_message);
  writer->AddObserver(vtkCommand::ErrorEvent, silent);
  writer->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, silent);
  // Into memory: VTK itself reports success for files that a full disk has cut off.
  writer->WriteToOutputStringOn();
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetHeaderTypeToUInt64();
  if (compress)
    writer->SetCompressorTypeToZLib();
  else
    writer->SetCompressorTypeToNone();
  if (writer->Write() == 0 || writer->GetErrorCode() != vtkErrorCode::NoError)
    throw SolverError(fmt::format("cannot write {}: VTK error code {}", path.string(), writer->GetErrorCode()));
  files::write_atomically(path, writer->GetOutputString());
}

bool in_region(const NodalArray& a, std::size_t region) {
  return a.region < 0 || a.region == static_cast<std::int32_t>(region);
}
bool in_region(const CellArray& a, std::size_t region) { return a.region == static_cast<std::int32_t>(region); }

template <class Arrays>
std::vector<files::ArrayHeader> headers(const Arrays& arrays, std::size_t region) {
  std::vector<files::ArrayHeader> result;
  for (const auto& a : arrays)
    if (in_region(a, region)) result.push_back({a.name, a.components});
  return result;
}

/// As names of files are tried with.
constexpr std::int64_t largest_step = 999999999;

std::string file_stem(const std::string& region, std::int64_t step) { return fmt::format("{}_{:06}", region, step); }

}  // namespace

void check_region_names(const DistributedMesh& mesh) {
  for (const auto& region : mesh.regions)
    if (region.name.empty() || region.name.find_first_of("/&<>\"") != std::string::npos)
      throw InputError("region \"" + region.name + "\"", "this name cannot be part of a file name",
                       "rename the region");
}

struct ResultsWriter::Implementation {
  const DistributedMesh& mesh;
  ResultsOptions options;
  int rank;
  std::vector<Piece> pieces;                            ///< of each region
  std::vector<std::vector<bool>> has_piece;             ///< rank 0: [region][rank]
  std::vector<std::vector<files::SeriesEntry>> series;  ///< rank 0: of each region

  Implementation(const DistributedMesh& m, const ResultsOptions& o)
      : mesh(m), options(o), rank(parallel::rank(m.comm)), series(m.regions.size()) {
    parallel::on_root(mesh.comm, [&] { prepare_directory(); });
    for (const auto& region : mesh.regions) {
      pieces.push_back(make_piece(mesh, region, options.length_factor));
      const int mine = region.owned_elements > 0;
      std::vector<int> all(parallel::size(mesh.comm));
      MPI_Gather(&mine, 1, MPI_INT, all.data(), 1, MPI_INT, 0, mesh.comm);
      has_piece.emplace_back(all.begin(), all.end());
    }
  }

  fs::path pvd(std::size_t region) const { return options.directory / (mesh.regions[region].name + ".pvd"); }

  void prepare_directory() {
    check_region_names(mesh);
    files::make_folder(options.directory);
    std::vector<fs::path> names;
    for (const auto& region : mesh.regions)
      names.push_back(fmt::format("{}_{}.vtu", file_stem(region.name, largest_step), parallel::size(mesh.comm)));
    files::try_outputs(options.directory, names);
    if (!options.continue_from) return;
    for (std::size_t r = 0; r < series.size(); ++r) {
      series[r] = files::read_pvd(pvd(r));
      // The times of a .pvd are exact, the margin is for a restart time that went through another format.
      const double last = *options.continue_from + 1e-12 * std::abs(*options.continue_from);
      std::erase_if(series[r], [&](const files::SeriesEntry& e) { return e.time > last; });
    }
  }

  void write_pieces(std::int64_t step, std::span<const NodalArray> nodal, std::span<const CellArray> cells) {
    for (std::size_t r = 0; r < pieces.size(); ++r) {
      auto& piece = pieces[r];
      if (piece.nodes.empty()) continue;
      for (const auto& a : nodal)
        if (in_region(a, r)) add_nodal(piece, a);
      for (const auto& a : cells)
        if (in_region(a, r)) add_cells(piece, a);
      const auto path = options.directory / fmt::format("{}_{}.vtu", file_stem(mesh.regions[r].name, step), rank);
      write_grid(piece.grid, path, options.compress);
      // VTK has noted ranges there and would write them next time: files of a continued run would not be the same.
      piece.grid->GetPoints()->GetData()->GetInformation()->Clear();
      piece.grid->GetPointData()->Initialize();
      piece.grid->GetCellData()->Initialize();
    }
  }

  void write_heads(std::int64_t step, double time, std::span<const NodalArray> nodal,
                   std::span<const CellArray> cells) {
    for (std::size_t r = 0; r < pieces.size(); ++r) {
      const auto stem = file_stem(mesh.regions[r].name, step);
      std::vector<std::string> names;
      for (std::size_t k = 0; k < has_piece[r].size(); ++k)
        if (has_piece[r][k]) names.push_back(fmt::format("{}_{}.vtu", stem, k));
      files::write_atomically(options.directory / (stem + ".pvtu"),
                              files::pvtu_text(headers(nodal, r), headers(cells, r), names));
    }
    // Only now, so that the series of the regions stay equally long unless the very last renaming fails.
    for (std::size_t r = 0; r < pieces.size(); ++r) {
      auto longer = series[r];
      std::erase_if(longer, [&](const files::SeriesEntry& e) { return e.time >= time; });
      longer.push_back({time, file_stem(mesh.regions[r].name, step) + ".pvtu"});
      files::write_atomically(pvd(r), files::pvd_text(longer));
      series[r] = std::move(longer);
    }
  }
};

ResultsWriter::ResultsWriter(const DistributedMesh& mesh, const ResultsOptions& options)
    : implementation_(std::make_unique<Implementation>(mesh, options)) {}
ResultsWriter::~ResultsWriter() = default;
ResultsWriter::ResultsWriter(ResultsWriter&&) noexcept = default;
ResultsWriter& ResultsWriter::operator=(ResultsWriter&&) noexcept = default;

void ResultsWriter::write(std::int64_t step, double time, std::span<const NodalArray> nodal,
                          std::span<const CellArray> cells) {
  auto& self = *implementation_;
  for ([[maybe_unused]] const auto& a : nodal)
    assert(a.name.find_first_of("&<>\"") == std::string::npos && a.stride >= a.components &&
           (self.mesh.nodes() == 0 ||
            a.values.size() + a.stride - a.components >= static_cast<std::size_t>(self.mesh.nodes()) * a.stride));
  for ([[maybe_unused]] const auto& a : cells)
    assert(a.values.size() == static_cast<std::size_t>(self.mesh.regions[a.region].owned_elements) * a.components);
  const auto at_time = [&](const auto& action) {
    try {
      action();
    } catch (const SolverError& error) {
      throw SolverError(fmt::format("results of step {} (t = {:g} s): {}", step, time, error.what()));
    }
  };
  parallel::agree(self.mesh.comm, [&] { at_time([&] { self.write_pieces(step, nodal, cells); }); });
  parallel::on_root(self.mesh.comm, [&] { at_time([&] { self.write_heads(step, time, nodal, cells); }); });
}

}  // namespace tunica::distributed
