// Fields of a run for the time series: names with units, stresses, wall shear stress.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tunica/case/case.hpp"
#include "tunica/coupling/problem.hpp"
#include "tunica/distributed/results_writer.hpp"

namespace tunica::artifacts {

/// Prepares a state for the ResultsWriter, in the units of the case:
/// lumen: velocity, pressure, displacement (of the mesh, when it moves), wall shear stress [Pa] (zero off the wall);
/// wall: velocity (in dynamics), displacement, wall pressure (mixed element), and for each element the von Mises
/// stress, the largest principal stress, and the Cauchy stress along the mean direction of each family of fibres that
/// the law of its region has. Pressures and stresses of the wall are those of the instant that the case chooses,
/// t_{n-1+alpha_f} or t_n, all else belongs to t_n.
class OutputFields {
 public:
  /// `problem` must outlive this.
  OutputFields(const coupling::Problem& problem, const case_file::Case& c);

  /// Collective. Throws as ResultsWriter::write.
  void write(distributed::ResultsWriter& writer, std::int64_t step, double time, const coupling::State& state);

 private:
  /// A triangle of the vessel's inside and the lumen element behind it, local nodes.
  struct WallTriangle {
    std::array<std::int32_t, 3> nodes;
    std::array<std::int32_t, 4> element;
    std::array<std::int32_t, 6> edges;  ///< of the element; quadratic ones only
  };
  void find_wall_triangles(const case_file::Case& c);
  void compute_shear_stress(const coupling::State& state);
  template <class Add>
  void add_at_nodes(const WallTriangle& triangle, const fe::Gradients<double>& shape, const double* velocity,
                    Add add) const;
  void compute_wall_stress(const coupling::FieldsView& fields);
  void write_instant(distributed::ResultsWriter& writer, std::int64_t step, double time, const coupling::State& state,
                     const coupling::FieldsView& wall);

  const coupling::Problem& problem_;
  case_file::OutputUnits units_;
  bool dynamic_ = true, at_end_ = false;
  std::vector<WallTriangle> wall_triangles_;
  std::vector<double> shear_;  ///< [local node][3], Pa
  struct RegionStress {
    std::int32_t region;
    std::vector<double> von_mises, principal;  ///< of the owned elements, Pa
    std::vector<Vec3<double>> fibres{};        ///< mean directions in the fibre frame
    std::vector<std::vector<double>> fibre{};  ///< of each of them
  };
  std::vector<RegionStress> stress_;
};

}  // namespace tunica::artifacts
