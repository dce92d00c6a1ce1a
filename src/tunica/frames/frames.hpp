// Material directions in every element of the wall: e1 circumferential, e2 longitudinal, e3 across the wall.
#pragma once

#include <string>
#include <vector>

#include "tunica/frames/laplace.hpp"
#include "tunica/frames/wall_normals.hpp"

namespace tunica::frames {

struct FrameFaces {
  std::vector<std::string> inner;    ///< of the wall, towards the lumen
  std::vector<std::string> inlet;    ///< phi = 0: rings of the wall, and caps of the lumen where it takes part
  std::vector<std::string> outlets;  ///< one phi for each opening, unit flux on average
};

/// [owned element of the graph]. Orthonormal and right-handed; families of fibres are symmetric about e1 and e2, so
/// that the sign of e1 and e3 has no meaning.
struct Frames {
  std::vector<Vec3<double>> e1, e2, e3;
  std::vector<double> confidence;  ///< 0 .. 1, eq. (6.6)
  std::vector<double> jump;        ///< largest angle of an axis to that of a neighbour, without signs [rad], eq. (6.7)
  int iterations = 0;              ///< of the Laplace problem
  std::int64_t undefined = 0;      ///< elements of all ranks whose e2 came from their neighbours
};

/// Throws InputError when a face does not exist or part of the wall is out of reach of the interface, SolverError when
/// the Laplace problem cannot be solved. Collective.
Frames make_frames(const ElementGraph& graph, const FrameFaces& faces, const FrameSettings& settings);

/// Mean directions of two families of fibres at an angle [rad] from e1 towards e2 and -e2, eq. (6.5).
struct MeanDirections {
  Vec3<double> m4, m6;
};
MeanDirections mean_directions(const Vec3<double>& e1, const Vec3<double>& e2, double angle);

}  // namespace tunica::frames
