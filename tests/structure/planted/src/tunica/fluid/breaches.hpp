// Planted for the test of the include check; never compiled.
#pragma once

#include <mpi.h>
#include <petscvec.h>

#include "tunica/assembly/newton.hpp"
#include "tunica/wall/kinematics.hpp"
#include "viscosity.hpp"
