// A beat as bytes that a browser unpacks in a second.
#pragma once

#include <string>
#include <vector>

#include "tunica/viewer/beat.hpp"
#include "tunica/viewer/modes.hpp"
#include "tunica/viewer/simplify.hpp"

namespace tunica::viewer {

struct PackOptions {
  double tolerance = 0.005;             ///< of modes, as a share of the range of each quantity
  double distance = 1e-4;               ///< that simplified surfaces may keep from those of the mesh [m]
  std::size_t most_triangles = 120000;  ///< above which surfaces are simplified; those of quadratic elements anyway
};

/// What came of a quantity.
struct PackedQuantity {
  std::string body, name, unit;
  std::size_t modes = 0;
  Deviation compression, simplification;
};

struct PackedBeat {
  std::string head;  ///< JSON: names, units, places of the arrays in the data, all but large numbers
  std::string data;  ///< zlib stream, base64
  std::vector<PackedQuantity> quantities;
  std::vector<Simplification> simplifications;  ///< of the bodies
  double place_step = 0;                        ///< to which coordinates are rounded [m]
};

/// Coordinates of 16 bits, quantities as modes (modes.hpp), differences of neighbours as bytes, zlib; see viewer.js,
/// which reads it. Errors are measured with what is written. Throws SolverError where a quantity holds values that are
/// not finite.
PackedBeat pack(Beat beat, const PackOptions& options);

}  // namespace tunica::viewer
