// Where nodes may go when the shapes of a finished mesh are improved.
#pragma once

#include "tunica/meshing/improve.hpp"
#include "tunica/meshing/patient_complex.hpp"

namespace tunica::meshing {

/// Onto the surfaces that `prepared` was made from; nodes of caps and rings stay in their planes. Looks only at
/// surfaces that face the same way, so that no node gets through a thin flap. Refers to `prepared`.
Projection projection(const PreparedSurfaces& prepared);

}  // namespace tunica::meshing
