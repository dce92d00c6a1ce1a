// A wall around a lumen surface alone.
#pragma once

#include "tunica/meshing/patient_complex.hpp"
#include "tunica/meshing/vessel_roles.hpp"
#include "tunica/meshing/wall_growth.hpp"

namespace tunica::meshing {

/// Adds the outer surface to a lumen surface, open at the vessel ends: a wall grown outward, thicker around wider
/// vessels. Where `growth` gives thicknesses by region, a coarse mesh with a first wall tells the regions, and the wall
/// is grown again; the thickness changes smoothly between regions. Errors as of `mend_surface`, `find_openings`,
/// `grow_wall` and, by region, of `patient_complex` and `tetrahedralise`. `body`: what the wall goes around where that
/// is more than the lumen, lumen and thrombus, open at the same ends; null: the lumen.
PatientSurfaces with_grown_wall(const geometry::TriangleSurface& lumen, const std::vector<geometry::NamedPlace>& names,
                                const GrowthSettings& growth, const VesselRoles& roles, const ComplexOptions& options,
                                const geometry::TriangleSurface* body = nullptr);

}  // namespace tunica::meshing
