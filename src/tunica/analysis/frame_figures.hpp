// From the fields of a frame to its figures, and from all frames to fields over the cycle.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tunica/analysis/field_series.hpp"
#include "tunica/analysis/figure_table.hpp"
#include "tunica/analysis/settings.hpp"
#include "tunica/analysis/vessel.hpp"
#include "tunica/analysis/wall_parts.hpp"

namespace tunica::analysis {

/// Names of the columns of a frame, SI units.
namespace column {
std::string station(std::size_t station, std::size_t lumen, const char* what);  ///< "area", "pressure", "flow"
std::string opening(const std::string& face, const char* what);                 ///< "flow" (outwards), "pressure"
std::string tear(const std::string& tear, const char* what);  ///< "flow" (into the false lumen), "area"
inline constexpr const char *true_volume = "true volume", *false_volume = "false volume",
                            *false_volume_rate = "false volume rate", *flap_mean = "flap mean displacement",
                            *flap_largest = "flap largest displacement";
/// `part`: of the wall; `statistic`: "mean" or the number of a percentile in the settings.
std::string stress(const std::string& part, const std::string& quantity, const std::string& statistic);
}  // namespace column

/// Sums over the frames that one rank has looked at, and over all ranks after `gather`.
struct CycleFields {
  std::vector<double> shear;                    ///< [node][4]: integrals over time of |tau| and of tau [Pa s]
  std::vector<std::vector<double>> max_stress;  ///< [quantity][element] [Pa]; NaN where there is none
};

/// What does not change from frame to frame.
class FrameFigures {
 public:
  /// All must outlive this. `start`: displacement of the first frame of the window, empty without a wall.
  FrameFigures(const RunDescription& run, const PostSettings& settings, const mesh::MeshData& data,
               const Vessel& vessel, std::vector<std::string> stresses, std::vector<double> start);

  /// `mesh_velocity`: [node][3], empty where nothing moves [m/s].
  FigureTable::Row evaluate(const FieldFrame& frame, const std::vector<double>& mesh_velocity) const;
  /// Of no frame yet.
  CycleFields no_fields() const;
  /// Adds a frame to the fields over the cycle, with its weight in the trapezoidal rule [s].
  void add(const FieldFrame& frame, double weight, CycleFields& fields) const;

  /// Regions of the wall and their layers.
  const std::vector<WallPart>& wall_parts() const { return wall_parts_; }
  /// Value and volume [m^3] of each element of a part of the wall that has one.
  std::vector<std::pair<double, double>> values_in(const WallPart& part, const std::vector<double>& of_elements) const;
  double volume_of(const WallPart& part) const;  ///< m^3
  const std::vector<std::string>& stresses() const { return stresses_; }
  const std::vector<double>& volumes() const { return volumes_; }

 private:
  void flow_figures(const NodalFields& fields, FigureTable::Row& row) const;
  void volume_figures(const NodalFields& fields, FigureTable::Row& row) const;
  void flap_figures(const FieldFrame& frame, FigureTable::Row& row) const;
  void stress_figures(const FieldFrame& frame, FigureTable::Row& row) const;

  const PostSettings& settings_;
  const mesh::MeshData& data_;
  const Vessel& vessel_;
  std::vector<std::string> stresses_;
  std::vector<double> start_;
  std::vector<WallPart> wall_parts_;
  std::vector<double> volumes_;                        ///< of the elements in the reference [m^3]
  std::vector<std::int64_t> inside_;                   ///< nodes at which the flow sticks
  std::vector<std::pair<std::int64_t, double>> flap_;  ///< nodes of the flap and their share of its volume
};

/// Brings the fields of all ranks together on rank 0. Collective.
void gather(MPI_Comm comm, CycleFields& fields);

}  // namespace tunica::analysis
