// tunica study: one case with other values of some of its keys.
#include "tunica/pipeline/study.hpp"

#include <mpi.h>

#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "session.hpp"
#include "version.hpp"

namespace tunica::app {

namespace {

constexpr int point_failed = 3;

}  // namespace

void add_study(CLI::App& app) {
  CLI::App* command = app.add_subcommand("study", "One case with other values of some of its keys, and their table");
  const auto request = std::make_shared<pipeline::StudyRequest>();
  const auto output = std::make_shared<std::string>();
  const auto point = std::make_shared<int>(0);
  command->add_option("file", request->file, "The file of the study")->required();
  command->add_option("-o,--output", *output, "Folder of the results, instead of the one that the file names")
      ->check(some_name());
  auto* one = command->add_option("--point", *point, "Do this point alone, and no table: for arrays of jobs");
  auto* shared =
      command->add_flag("--shared", request->shared, "Do the stages that points have in common, and no more");
  auto* table = command->add_flag("--table", request->table, "Write the table of what is there, and do no point");
  command->add_flag("--dry-run", request->dry_run, "Write the case files of the points and say what would be done")
      ->excludes(table);
  one->excludes(shared)->excludes(table);
  shared->excludes(table);
  command->footer(
      "Examples:\n"
      "  mpirun -n 2 tunica study study.yaml\n"
      "  tunica study study.yaml --dry-run\n"
      "  tunica study study.yaml --point 7          # one of an array of jobs, after --shared\n"
      "  tunica study study.yaml --table\n"
      "A file of a study:\n"
      "  case: case.yaml\n"
      "  vary:\n"
      "    mesh.geometry.parametric.flap.exit_tear.area: [30 mm^2, 60 mm^2]\n"
      "    wall.regions.flap.material.neo_hooke.young_modulus: {from: 0.5 MPa, to: 2 MPa, count: 3, scale: log}\n"
      "  design: grid      # or list, {latin_hypercube: {points: 16}}, {sobol: {points: 16}}, {saltelli: {points: "
      "64}}\n"
      "  quantities: ['tears/*/flow*', 'wall_shear/tawss_Pa/p50']\n"
      "Results: study.csv, study.json, study.html and a folder for each point. What is there is reused, and what was\n"
      "interrupted goes on. Exit code 3 when a point failed; the others are done. All keys: tunica schema --study");
  command->callback([=] {
    throw CLI::RuntimeError(in_session([&] {
      if (!output->empty()) request->output = *output;
      if (one->count() > 0) request->point = *point;
      request->program = {version(), commit()};
      const auto outcome = pipeline::study(*request, MPI_COMM_WORLD, stdout);
      if (outcome.signal != 0) return 128 + outcome.signal;
      return outcome.failed > 0 ? point_failed : 0;
    }));
  });
}

}  // namespace tunica::app
