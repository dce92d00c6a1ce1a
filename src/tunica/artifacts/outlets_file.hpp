// The file that hands the tuned outlets from `tunica tune` to `tunica run`.
#pragma once

#include <mpi.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tunica/case/case.hpp"

namespace tunica::artifacts {

using TunedOutlets = std::vector<std::pair<std::string, bc::Rcr>>;

/// Throws SolverError when it cannot be written. Not collective.
void write_outlets(const std::filesystem::path& file, const case_file::TuningCase& outlets, const TunedOutlets& found);

/// Outlets from the text of that file, in the order of the fractions. Throws InputError when it does not read, or was
/// made for other faces, pressures, fractions or shares than `outlets` has. `warnings`, unless null, receives what is
/// unusual.
TunedOutlets parse_outlets(const std::string& text, const std::filesystem::path& file,
                           const case_file::TuningCase& outlets, std::vector<Problem>* warnings = nullptr);

/// Puts `tuned` in the place of the provisional outlets of a case.
void set_outlets(case_file::Case& c, const TunedOutlets& tuned);

/// Reads the file that the section `outlets` of `c` names, sets its outlets and returns its text; does nothing and
/// returns an empty text without that section. `c` is the same on all ranks. Throws InputError: no such file, and as
/// parse_outlets. Collective.
std::string take_tuned_outlets(MPI_Comm comm, case_file::Case& c);

/// Warnings of unusual values among the tuned outlets; none while there is no such file. Throws InputError as
/// parse_outlets. For one rank.
std::vector<Problem> unusual_outlets(case_file::Case c);

}  // namespace tunica::artifacts
