// Planted for the test of the include check; never compiled.
#pragma once

#include "tunica/wall/kinematics.hpp"
#include "tunica/assembly/newton.hpp"
#include <petscvec.h>
#  include <mpi.h>
#include "viscosity.hpp"
