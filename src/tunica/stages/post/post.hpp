// tunica post: from the results of a run to the figures of a cycle.
#pragma once

#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "tunica/artifacts/manifest.hpp"
#include "tunica/case/case.hpp"

namespace tunica::stages::post {

struct PostRequest {
  std::filesystem::path case_file;
  std::optional<std::string> case_text;          ///< where it does not stand in that file
  std::optional<std::filesystem::path> results;  ///< folder that `tunica run` wrote, instead of the one in the case
  std::optional<std::filesystem::path> output;   ///< instead of the one in the case
  bool overwrite = false;                        ///< earlier files may be replaced
  artifacts::ProgramVersion program;
};

/// Reads the series of fields and the histories of a run, and writes post.json, tables (.csv), plots (.svg) and fields
/// for ParaView; docs/post.md says what. The summary goes to `screen` of rank 0.
///
/// Frames are dealt out to the ranks, each of which holds the mesh: what a frame gives does not depend on their number.
///
/// Throws InputError when there are no results, when they do not cover the window, lack a field or belong to another
/// mesh. The same on all ranks. Collective.
void post_results(MPI_Comm comm, const PostRequest& request, std::FILE* screen);

/// Looks at a case before it is run. Throws InputError when it has no course in time, or the fields that the run will
/// write do not cover the window.
void check_post(const case_file::Case& c);

/// Where its files go.
std::filesystem::path post_folder(const case_file::Case& c, const PostRequest& request);

}  // namespace tunica::stages::post
