// A case and its figures of the cycle.
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "shared_folder.hpp"
#include "tunica/stages/post/post.hpp"
#include "tunica/stages/run/run.hpp"

namespace tunica::verification {

/// Computes the case `text` in `folder`; returns post.json. Collective.
inline nlohmann::json run_and_post(const test::SharedFolder& folder, const std::string& text) {
  const auto file = folder.write("case.yaml", text);
  stages::RunRequest run;
  run.case_file = file;
  stages::run(MPI_COMM_WORLD, run, nullptr);
  stages::post::PostRequest post;
  post.case_file = file;
  stages::post::post_results(MPI_COMM_WORLD, post, nullptr);
  std::ifstream report(folder.path() / "results/post/post.json");
  return nlohmann::json::parse(report);
}

}  // namespace tunica::verification
