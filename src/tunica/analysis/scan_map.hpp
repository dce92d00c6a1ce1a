// The same places in an aorta on two dates.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tunica/analysis/anatomy.hpp"
#include "tunica/base/error.hpp"

namespace tunica::analysis {

/// From one scan to another. Arc length is linear between branches that leave at least 10 mm apart and keeps its
/// measure beyond the first and the last of them; angles are turned so that these branches lie over each other, evenly
/// in between; a radius is scaled within the lumens by what their edges have in the same direction, smoothed over some
/// sections and directions and across mouths of branches, and within the wall by its mean thickness there.
/// Each of the three rises with its own coordinate, so that the map turns nothing inside out where coordinates are
/// unique. Both scans must outlive it.
class ScanMap {
 public:
  /// Throws InputError where no branch is in both, with all that check_match() finds.
  ScanMap(const Anatomy& from, const Anatomy& to);

  double arc(double s) const;
  double back(double s) const;  ///< its inverse
  double turn(double s) const;  ///< by which angles at arc length s of `from` rise [rad]
  /// Radius of the lumens' edge after by that before, at a place of `from`.
  double stretch(double s, double angle) const;
  LineCoordinates coordinates(const LineCoordinates& at) const;
  Vec3<double> point(const LineCoordinates& at) const { return to_->line.point(coordinates(at)); }  ///< m

  /// Names and arc lengths in `from` of the branches that it is anchored at.
  const std::vector<std::string>& anchors() const { return anchors_; }
  const std::vector<double>& anchor_arcs() const { return from_arcs_; }
  /// Arc lengths of `from` that both scans reach [m].
  std::array<double, 2> range() const;

 private:
  void find_stretches();

  const Anatomy *from_, *to_;
  std::vector<std::string> anchors_;
  std::vector<double> from_arcs_, to_arcs_, turns_;
  std::vector<std::vector<double>> stretches_;  ///< [section of `from`][direction]
};

/// What says that two scans are not of one aorta, or that names of branches are swapped: branches of one alone, in
/// another order, at other distances from each other (by more than 15 mm and a quarter), or in other directions (by
/// more than 70 degrees against the others). `where`: of the second scan.
std::vector<Problem> check_match(const Anatomy& first, const Anatomy& second, const std::string& where,
                                 const std::string& name_of_first);

struct Folds {
  std::size_t elements = 0;   ///< of the aorta, lumen and wall, that both scans reach
  std::size_t folded = 0;     ///< those that the map turns inside out
  double least_jacobian = 0;  ///< smallest quotient of volumes after and before
};
/// `data`: the mesh of `from`.
Folds count_folds(const mesh::MeshData& data, const Anatomy& from, const ScanMap& map);

}  // namespace tunica::analysis
