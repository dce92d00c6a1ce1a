// Discrete directions and weights that represent an orientation density: the discrete fibre dispersion (DFD).
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tunica/wall/fibres/density.hpp"

namespace tunica::wall {

/// Directions on a hemisphere, as unit vectors in the fibre frame, and their shares of the fibres.
struct DirectionSet {
  std::vector<Vec3<double>> directions;
  std::vector<double> weights;  ///< non-negative; their sum is 1 unless degraded
};

/// 4, 16, 64, 256 ...: whether `octahedral` has a set of so many directions.
bool is_octahedral_size(int count);

/// DFD (Rolf-Pissarczyk et al. 2021, doi:10.1016/j.cma.2020.113511): the four octants with N3 >= 0, each split into
/// four spherical triangles again and again. A direction is the normalised sum of the corners of its triangle, its
/// weight the density integrated over the triangle, to about 1e-13. `count` is such that is_octahedral_size(count).
DirectionSet octahedral(const Density& d, int count);

/// Gauss rules fitted to the density, across * around directions (across >= 1, around >= 3). Von Mises: rings about the
/// mean direction, Gauss points in N.M with weight exp[2 b (N.M)^2], times equidistant azimuths. Bivariate: Gauss
/// points in sin(Theta) with weight rho_op, symmetric about the plane, times Gauss points in cos 2(Phi - alpha) with
/// weight rho_ip on the half circle, symmetric about the mean; equidistant for a = 0. The set turns with a mean
/// direction in the plane.
DirectionSet product_rule(const Density& d, int across, int around);

/// A rule and the error of the fibre stress that comes with it.
struct RuleChoice {
  DirectionSet set;
  std::string name;    ///< such as "product 4 x 16"
  double error = 0.0;  ///< see measured_rule
};

/// The error of the fibre stress that a set makes: the largest |S - S_ref| / max(|S_ref|, |S_iso|), Frobenius norms,
/// over isochoric strain states in the axes of the density: uniaxial extension to 1.2 along the mean, across it, along
/// the third axis (e3 for a mean in the plane) and at 45 degrees; equibiaxial extension to 1.15; simple shear of 0.5
/// along the mean both ways, across it, out of the plane, and at 45 degrees with the mean compressed; and in three
/// oblique frames. S = 2 sum rho f' N x N with f of docs/theory.md (1.4), where k1 cancels; S_ref is a fine quadrature
/// of the density; S_iso is that of isotropic fibres with k2 = 0, about 0.2 k1, so that states in which these fibres
/// hardly take part do not decide.
RuleChoice measured_rule(DirectionSet set, std::string name, const Density& d, double k2, bool tension_only);

/// The product rule of fewest directions whose error is at most `tolerance`, or the one of least error when none is.
RuleChoice choose_rule(const Density& d, double k2, double tolerance, bool tension_only);

/// Finds directions again, up to their sign, within 1e-12.
class DirectionIndex {
 public:
  void add(const Vec3<double>& N);
  /// Which of the directions added so far it is, counted from 0.
  std::optional<std::size_t> find(const Vec3<double>& N) const;

 private:
  std::vector<Vec3<double>> directions_;
  std::multimap<double, std::size_t> by_first_;  ///< |N1|, which does not see the sign
};

/// One set of all directions; the weights of directions that are equal up to their sign, within 1e-12, are added.
DirectionSet merge(std::span<const DirectionSet> sets);

/// Fibres of a range of directions that are weakened (Rolf-Pissarczyk et al. 2021). The range is `from` <= angle <
/// `to`, so that ranges can adjoin; one that reaches pi/2 includes it.
struct Degradation {
  double from = 0.0, to = 0.0;  ///< angle to the radial direction e3 [rad], 0 to pi/2
  double factor = 1.0;          ///< share that remains
};

/// Multiplies the weights of the directions in each range by its factor.
void degrade(DirectionSet& set, const std::vector<Degradation>& ranges);

}  // namespace tunica::wall
