// Where the results of a case lie, for what looks at them.
#pragma once

#include <mpi.h>

#include <filesystem>

namespace tunica::pipeline {

struct ViewSources {
  std::filesystem::path case_file;  ///< of the run itself: its meshes are those of the fields
  std::filesystem::path results;    ///< folder of the fields
  std::filesystem::path post;       ///< folder of the figures, which may not be there
};

/// Of a case with stages those of its stages `run` and `post`, else of the case itself. Throws InputError when the file
/// does not read, or the stage `run` has left nothing. Collective.
ViewSources view_sources(const std::filesystem::path& case_file, MPI_Comm comm);

}  // namespace tunica::pipeline
