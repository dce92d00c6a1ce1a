#include "tunica/pipeline/view_sources.hpp"

#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/pipeline/chain.hpp"
#include "tunica/pipeline/plan.hpp"
#include "tunica/stages/post/post.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;

ViewSources of_stages(const fs::path& file) {
  std::vector<Problem> warnings;
  const Chain chain = read_chain(file, std::nullopt, warnings);
  const Stage& run = stage("run");
  const fs::path folder = folder_of(chain, run);
  if (!fs::exists(folder / run.file))
    throw InputError(folder.string(), "holds no results", "do the case first: tunica run " + file.string());
  return {folder / run.file, folder, folder_of(chain, stage("post"))};
}

ViewSources of_case(const fs::path& file) {
  const auto c = case_file::read_case(file).value;
  stages::post::PostRequest request;
  request.case_file = file;
  return {file, c.output.directory, stages::post::post_folder(c, request)};
}

}  // namespace

ViewSources view_sources(const fs::path& case_file, MPI_Comm comm) {
  const bool in_stages = lies_in_stages(case_file, comm);
  ViewSources found;
  parallel::on_root(comm, [&] { found = in_stages ? of_stages(case_file) : of_case(case_file); });
  return found;
}

}  // namespace tunica::pipeline
