// Angle between two families of fibres whose directions stand in files.
#pragma once

#include "tunica/peer_cases/translate.hpp"

namespace tunica::stages {

/// The angle [rad] from the first direction to the second, 0 to pi, which is the same in all cells. Throws InputError
/// where a file does not read or has no cell array FIB_DIR of three components, where one is zero, and where the angle
/// differs from cell to cell, which no law of tunica has. Not collective.
double fibre_angle(const peer_cases::FibreFiles& files);

}  // namespace tunica::stages
