// Planted for the test of the include check; never compiled.
#pragma once

#include "tunica/meshing/assemble.hpp"
