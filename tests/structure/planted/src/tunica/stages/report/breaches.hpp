// Planted for the test of the include check; never compiled.
#pragma once

#include "tunica/stages/report/report.hpp"
#include "tunica/stages/run/run.hpp"
