// Sizes of time steps that follow the error (docs/theory.md, section 4).
#pragma once

#include "tunica/coupling/settings.hpp"
#include "tunica/coupling/state.hpp"
#include "tunica/distributed/distributed_mesh.hpp"

namespace tunica::stages {

struct StepError {
  double relative = 0;   ///< of the velocity, (4.9)
  double reference = 0;  ///< largest norm of the nodal velocities so far, what the error is relative to [m/s]
};

/// Error of the step that led from `before` to `after`. Collective.
StepError step_error(const distributed::DistributedMesh& mesh, const coupling::State& before,
                     const coupling::State& after);

/// Halvings of the largest step that lead to the smallest one allowed.
int finest_level(const coupling::TimeSettings& time);

/// Level of StepGrid that the next step shall have after a step of `level` with this error, (4.10). It is finer than
/// `level` when the step was too large, and coarser by one at most.
int wanted_level(const coupling::TimeSettings& time, int level, const StepError& error);

}  // namespace tunica::stages
