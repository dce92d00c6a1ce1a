// From a patient's surfaces to the labelled complex that the tetrahedral engine fills.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/geometry/openings.hpp"
#include "tunica/geometry/size_field.hpp"
#include "tunica/meshing/conforming_surfaces.hpp"
#include "tunica/meshing/surface_complex.hpp"

namespace tunica::meshing {

/// Surfaces as they come from files (`read_surface`), open at the vessel ends.
struct PatientSurfaces {
  geometry::TriangleSurface lumen;
  std::optional<geometry::TriangleSurface> outer;  ///< outside of the wall; none: the complex has no wall
  std::vector<geometry::NamedPlace>
      names;  ///< of the openings; empty: called inlet and outlet_1, ... (`find_openings`)
};

struct ComplexOptions {
  geometry::SizeSettings sizes;
  Accuracy accuracy;
  int lumen_parts = 1;            ///< connected parts of the lumen surface: 2 for true and false lumen without a tear
  double clearance = 0.1e-3;      ///< smallest allowed distance between lumen and outer surface [m]
  double thickness_reach = 6e-3;  ///< walls thicker than this [m] do not limit the edge length
  double diameter_reach = 0.1;    ///< nor do wider vessels [m]
  Log log = [](const std::string&) {};  ///< gets what was mended, done and measured, one line each
  std::filesystem::path spots;          ///< .vtp file for places of problems; empty: none is written
  std::optional<int> genus{};           ///< that the lumen surface must have; none: any
};

struct PreparedSurfaces {
  SurfaceComplex complex;
  geometry::SizeField sizes;                    ///< edge length at any point, for the tetrahedra
  geometry::TriangleTree lumen;                 ///< the mended and flattened lumen surface
  std::optional<geometry::TriangleTree> outer;  ///< the same of the outer one
  geometry::Thickness thickness;                ///< of wall and flap, at the points of `lumen`
  std::vector<geometry::Opening> openings;      ///< their loops refer to `lumen` and `outer`
  std::optional<geometry::SizeField> inside{};  ///< edge length in the lumen, where its diameter counts
};

/// Mends both surfaces, flattens their rims, remeshes them and closes them with plane caps and rings. Patches:
/// interface, wall_outer, and for each opening lumen_<name> and wall_<name>. InputError for surfaces that cannot be
/// mended, have another genus than asked for or do not fit together, SolverError when the remeshed ones are too far
/// from the originals or cross.
PreparedSurfaces patient_complex(const PatientSurfaces& surfaces, const ComplexOptions& options);

/// `mend_surface` with what it did in the log; `name` is for messages.
geometry::TriangleSurface mended(const geometry::TriangleSurface& surface, const std::string& name, int parts,
                                 const ComplexOptions& options);

/// Closes remeshed surfaces at their openings: the loop of a surface nearest to an opening is its rim. `outer` null: no
/// wall.
SurfaceComplex close_at_openings(const geometry::TriangleSurface& lumen, const geometry::TriangleSurface* outer,
                                 const std::vector<geometry::Opening>& openings);

}  // namespace tunica::meshing
