// tunica view: the beat in 3D as one HTML file.
#include "tunica/stages/view/view.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "session.hpp"
#include "tunica/base/error.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/pipeline/view_sources.hpp"

namespace tunica::app {

namespace {

int view(stages::ViewRequest request, const std::string& results, const std::string& post) {
  const auto found = pipeline::view_sources(request.case_file, MPI_COMM_WORLD);
  request.case_file = found.case_file;
  request.results = results.empty() ? found.results : std::filesystem::path(results);
  request.post = post.empty() ? found.post : std::filesystem::path(post);
  if (!post.empty() && !std::filesystem::exists(request.post / "post.json"))
    throw InputError("--figures", fmt::format("{} holds no figures: there is no post.json", post),
                     "name the folder that `tunica post` has written, or leave it out");
  parallel::on_root(MPI_COMM_WORLD, [&] {
    stages::write_view(request, [](const std::string& line) {
      std::printf("%s\n", line.c_str());
      std::fflush(stdout);
    });
    std::printf("written: %s\n", request.output.c_str());
  });
  return 0;
}

}  // namespace

void add_view(CLI::App& app) {
  CLI::App* command = app.add_subcommand("view", "The beat in 3D, with its curves, as one HTML file");
  command->footer(
      "Example:\n"
      "  tunica view case.yaml -o beat.html\n"
      "Needs the results of `tunica run`; with those of `tunica post` there are sections, tears and all curves. The "
      "page\n"
      "needs no network and no other file. What is shown, and how exact, is in docs/view.md.");
  const auto request = std::make_shared<stages::ViewRequest>();
  const auto case_file = std::make_shared<std::string>(), output = std::make_shared<std::string>("beat.html"),
             results = std::make_shared<std::string>(), post = std::make_shared<std::string>();
  const auto distance = std::make_shared<double>(0.1);
  command->add_option("case", *case_file, "The case file")->required();
  command->add_option("-o,--output", *output, "The page; default: beat.html")->check(some_name());
  command->add_option("--results", *results, "Folder that `tunica run` wrote, instead of the case's")
      ->check(some_name());
  command->add_option("--figures", *post, "Folder that `tunica post` wrote, instead of the case's")->check(some_name());
  command
      ->add_option("--tolerance", request->packing.tolerance,
                   "99.9 % of the values differ by less, as a share of the range; default: 0.005")
      ->check(CLI::Range(1e-5, 0.1));
  command
      ->add_option("--triangles", request->packing.most_triangles, "Surfaces with more are simplified; default: 120000")
      ->check(CLI::Range(1000, 10000000));
  command->add_option("--distance", *distance, "[mm] by which they may leave those of the mesh; default: 0.1")
      ->check(CLI::Range(0.0, 10.0));
  command->add_flag("--overwrite", request->overwrite, "Replace a page that is there");
  command->callback([=] {
    request->case_file = *case_file;
    request->output = *output;
    request->packing.distance = 1e-3 * *distance;
    throw CLI::RuntimeError(in_session([&] { return view(*request, *results, *post); }));
  });
}

}  // namespace tunica::app
