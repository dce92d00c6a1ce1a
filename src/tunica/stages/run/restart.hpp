// What a run looks at before it goes on with what is there.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tunica/artifacts/step_grid.hpp"
#include "tunica/case/case.hpp"
#include "tunica/parallel/log.hpp"

namespace tunica::stages {

/// Tables that end before the run, which would end it there. The run goes from `from` to
/// `last_step`. Throws InputError. Collective.
void refuse_tables_that_end(MPI_Comm comm, const case_file::Case& c, const artifacts::StepGrid& from,
                            std::int64_t last_step);

/// The last checkpoint in `folder` that is whole; later ones are passed over with a warning. Throws InputError when
/// there is none, with the command `anew` as the remedy. Collective.
std::filesystem::path last_whole_checkpoint(MPI_Comm comm, const std::filesystem::path& folder, const std::string& anew,
                                            parallel::Log& log);

/// Warns of fields up to `time` [s] that are gone. For rank 0.
void tell_missing_fields(const std::filesystem::path& folder, const std::vector<std::string>& regions, double time,
                         parallel::Log& log);

}  // namespace tunica::stages
