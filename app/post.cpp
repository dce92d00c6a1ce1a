// tunica post: figures of a cycle from the results of a run.
#include "tunica/stages/post/post.hpp"

#include <mpi.h>

#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "session.hpp"
#include "tunica/pipeline/chain.hpp"
#include "version.hpp"

namespace tunica::app {

namespace {

/// For a case whose results lie in stages, the stage `post` alone on what the others have left.
int post(const stages::post::PostRequest& request) {
  const bool elsewhere = request.results || request.output;
  if (!elsewhere && pipeline::lies_in_stages(request.case_file, MPI_COMM_WORLD)) {
    pipeline::ChainRequest chain{.case_file = request.case_file};
    chain.only = "post";
    chain.overwrite = request.overwrite;
    chain.program = request.program;
    return pipeline::run_chain(chain, MPI_COMM_WORLD, stdout);
  }
  stages::post::post_results(MPI_COMM_WORLD, request, stdout);
  return 0;
}

}  // namespace

void add_post(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "post", "Wall shear, stresses, lumens, tears and flap over a cycle, from the results of a run");
  command->footer(
      "Examples:\n"
      "  tunica post case.yaml\n"
      "  mpirun -n 4 tunica post case.yaml --overwrite       fields are dealt out to the ranks\n"
      "  tunica post case.yaml --results trial --output trial/figures\n"
      "Of a case with stages it takes what they have left in its folder of results. The section `post` of the case "
      "says\n"
      "which cycle and what of it:\n"
      "  post: {period: 0.78 s, spacing: 5 mm}\n"
      "Results: post.json, tables (.csv), plots (.svg), fields for ParaView (.vtp, .vtu), post.log.");
  const auto request = std::make_shared<stages::post::PostRequest>();
  const auto case_file = std::make_shared<std::string>(), results = std::make_shared<std::string>(),
             output = std::make_shared<std::string>();
  command->add_option("case", *case_file, "The case file")->required();
  auto* from = command->add_option("--results", *results, "Folder that `tunica run` wrote, instead of the case's")
                   ->check(some_name());
  auto* to =
      command->add_option("-o,--output", *output, "Folder of the figures, instead of the case's")->check(some_name());
  command->add_flag("--overwrite", request->overwrite, "Replace what is there");
  command->callback([=] {
    request->case_file = *case_file;
    if (from->count() > 0) request->results = *results;
    if (to->count() > 0) request->output = *output;
    request->program = {version(), commit()};
    throw CLI::RuntimeError(in_session([&] { return post(*request); }));
  });
}

}  // namespace tunica::app
