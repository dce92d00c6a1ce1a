// tunica converge: the same case on finer meshes and with smaller steps.
#include "tunica/pipeline/converge.hpp"

#include <mpi.h>

#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "file_command.hpp"
#include "session.hpp"
#include "version.hpp"

namespace tunica::app {

void add_converge(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("converge", "Error bands for the figures of a case: finer meshes, smaller steps");
  const auto given = std::make_shared<pipeline::ConvergeRequest>();
  const auto meshes = std::make_shared<int>(-1);
  command->add_option("--meshes", *meshes, "Finer meshes [2; 0 where the case names mesh files]")
      ->check(CLI::Range(0, 5));
  command->add_option("--ratio", given->ratio, "Edges of a mesh over those of the next finer one")
      ->check(CLI::Range(1.1, 4.0))
      ->capture_default_str();
  command->add_option("--steps", given->steps, "How often the step is halved")
      ->check(CLI::Range(0, 5))
      ->capture_default_str();
  command
      ->add_option("--quantity", given->quantities,
                   "Pattern of the figures to look at, as paths in post.json; as often as wanted")
      ->type_name("PATTERN");
  command->footer(
      "Examples:\n"
      "  mpirun -n 2 tunica converge case.yaml\n"
      "  mpirun -n 2 tunica converge case.yaml --meshes 1 --steps 0 --ratio 1.3\n"
      "  mpirun -n 2 tunica converge case.yaml --quantity 'tears/*/flow*' --quantity 'wall_shear/tawss_Pa/p50'\n"
      "The case needs `post`. A mesh that is finer by 1.4 has 2.7 times the tetrahedra, and a step half as large "
      "costs\n"
      "twice the time: two finer meshes and one halving take about 12 times as long as the case. With two finer "
      "meshes\n"
      "the order is observed, with one it is assumed. Results: converge/converge.html, converge.csv, converge.json and "
      "a\n"
      "folder for each level in the folder of results; the report of the case then has the bands. What is there is\n"
      "reused, and what was interrupted goes on.");
  add_file_arguments(*command,
                     {.file = "The case file",
                      .output = "Folder of the results, instead of the one that the case names",
                      .overwrite = "Do all stages of all levels anew"},
                     [given, meshes](const FileRequest& file) {
                       throw CLI::RuntimeError(in_session([&] {
                         pipeline::ConvergeRequest request = *given;
                         request.chain.case_file = file.file;
                         if (!file.output.empty()) request.chain.directory = file.output;
                         request.chain.overwrite = file.overwrite;
                         request.chain.program = {version(), commit()};
                         if (*meshes >= 0) request.meshes = *meshes;
                         const int signal = pipeline::converge(request, MPI_COMM_WORLD, stdout);
                         return signal == 0 ? 0 : 128 + signal;
                       }));
                     });
}

}  // namespace tunica::app
