// Planted for the test of the include check; never compiled. Everything here is allowed.
#pragma once

#include <vector>

#include "tunica/base/tensor.hpp"
#include "tunica/fe/tetrahedron.hpp"
#include "tunica/fluid/viscosity.hpp"
// #include "tunica/wall/kinematics.hpp" is only mentioned
