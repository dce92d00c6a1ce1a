// How many elements the lumen is wide in each part of a vessel.
#pragma once

#include <vector>

#include "tunica/geometry/elements_across.hpp"
#include "tunica/meshing/assemble.hpp"
#include "tunica/meshing/tears.hpp"

namespace tunica::meshing {

/// Of every opening (`lumen_<name>`), tear (`tear_1`, ... by falling area), of `true_lumen`, `false_lumen` and each
/// branch, called as its opening; where there is no flap, `lumen` in place of the lumens.
std::vector<geometry::AcrossPart> resolution(const geometry::Tetrahedra& mesh,
                                             const std::vector<geometry::Opening>& openings, const SurfaceFaces& faces,
                                             const WallRegions& regions, const std::vector<Tear>& tears);

}  // namespace tunica::meshing
