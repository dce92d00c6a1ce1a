// Tables of measured points to protocols.
#pragma once

#include <vector>

#include "tunica/case/fit_case.hpp"
#include "tunica/fitting/protocol.hpp"

namespace tunica::stages {

/// All protocols of all specimens. Throws InputError with file, line and value for what cannot have been measured.
std::vector<fitting::Protocol> read_protocols(const case_file::FitCase& c);

}  // namespace tunica::stages
