// Time series of results.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "tunica/distributed/distributed_mesh.hpp"

namespace tunica::distributed {

/// A field on the nodes. Component c of local node n is values[n * stride + c] * factor, so that velocity and pressure
/// can be taken from one array of unknowns (`values` then begins at their first component). Ghost nodes must be up to
/// date: the elements that a rank owns also touch ghosts.
struct NodalArray {
  std::string name;                ///< as it shall appear, with its unit: "pressure [mmHg]"; none of & < > "
  int components = 1;              ///< 1, 3, or 9
  std::span<const double> values;  ///< SI
  int stride = 1;                  ///< >= components
  double factor = 1;               ///< from SI to the unit in the name
  std::int32_t region = -1;        ///< the one region that has this field, -1: all
};

/// A field on the elements of one region: component c of owned element e is values[e * components + c] * factor.
struct CellArray {
  std::string name;
  std::int32_t region = 0;
  int components = 1;
  std::span<const double> values;
  double factor = 1;
};

struct ResultsOptions {
  std::filesystem::path directory;        ///< created when missing
  double length_factor = 1;               ///< from m to the length unit of the files, for example 1000 for mm
  std::optional<double> continue_from{};  ///< time of the restart [s]: keep the series up to it. Otherwise begin anew
};

/// Throws InputError where the name of a region cannot be part of a file name.
void check_region_names(const DistributedMesh& mesh);

/// Writes for each region `<region>_mesh.hdf` once, and for each step `<region>_<step>.hdf` with the fields
/// (field_io/field_file.hpp); `<region>.hdf.series` lists the instants, `results.xdmf` all of all regions. A region is
/// one piece in the order of the case's mesh, whatever number of ranks writes it, so that partition faces do not show.
/// It is packed and written by one rank, other regions by other ranks at the same time. Numbers are Float32;
/// coordinates are those of the reference configuration. Each file appears by renaming, the lists only after what they
/// name, so the series can be opened at any time, also after an interruption.
class ResultsWriter {
 public:
  /// `mesh` must outlive the writer. Throws InputError on all ranks when the directory cannot be written, a region's
  /// name cannot be a file name, or a series to be continued cannot be read or is of another mesh. Collective.
  ResultsWriter(const DistributedMesh& mesh, const ResultsOptions& options);
  ~ResultsWriter();
  ResultsWriter(ResultsWriter&&) noexcept;
  ResultsWriter& operator=(ResultsWriter&&) noexcept;

  /// Adds `time` [s] to the series; entries at this time or later are replaced. Every rank passes the same arrays in
  /// the same order. Throws SolverError on all ranks when a file cannot be written; the series then still ends with the
  /// last complete step. Collective.
  void write(std::int64_t step, double time, std::span<const NodalArray> nodal, std::span<const CellArray> cells);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tunica::distributed
