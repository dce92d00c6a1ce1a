// Surfaces of the idealised dissection, as a segmented scan would give them: lumen and outside of the wall, open at the
// vessel ends.
#pragma once

#include "tunica/geometry/dissection_model.hpp"
#include "tunica/meshing/patient_complex.hpp"

namespace tunica::meshing {

/// Zero surfaces of the model's functions, cut at its openings. Triangles have edges of at most 2 `spacing` [m], and
/// less where the surface is curved; volumes are those of the body within 0.1 %.
PatientSurfaces dissection_surfaces(const geometry::DissectionModel& model, double spacing);

}  // namespace tunica::meshing
