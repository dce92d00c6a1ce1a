// tunica motion: how wall, flap and lumens move over the beat, from labels or surfaces at several phases.
#include "tunica/stages/motion/motion.hpp"

#include <mpi.h>

#include <cstdio>

#include "commands.hpp"
#include "file_command.hpp"
#include "session.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::app {
namespace {

void motion(const FileRequest& request) {
  const bool speaks = parallel::rank(MPI_COMM_WORLD) == 0;
  auto parsed = parallel::agree(MPI_COMM_WORLD, [&] { return stages::read_motion_case(request.file); });
  if (speaks) print_warnings(parsed.warnings);
  if (!request.output.empty()) parsed.value.output = request.output;
  stages::motion(parsed.value, request.overwrite, MPI_COMM_WORLD, [speaks](const std::string& line) {
    if (!speaks) return;
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
  });
}

}  // namespace

void add_motion(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("motion", "Motion of wall, flap and lumens from labels or surfaces over the beat (gated CT)");
  command->footer(
      "Example of a file; `tunica schema --motion` prints the reference:\n"
      "  case: case.yaml                  # its mesh is that of one of the phases\n"
      "  phases: {labels: labels_*.nrrd, true_lumen: 1, false_lumen: 2, period: 0.78 s}\n"
      "  planes: {descending: {centre: [10 mm, 40 mm, -20 mm], normal: [0, 0, -1]}}\n"
      "  points: {flap: [12 mm, 40 mm, -60 mm]}\n"
      "  rings: [wall_inlet]\n"
      "  output: motion\n"
      "Writes curves.csv, stations.csv, motion.pvd, ring_<face>.csv, motion.json, curves.svg.");
  add_file_arguments(
      *command,
      {.file = "The phases, and what is looked at in them",
       .output = "Folder of the results, instead of the one that the file names",
       .overwrite = "Replace results that are there"},
      [](const FileRequest& request) { throw CLI::RuntimeError(in_session([&] { return motion(request), 0; })); });
}

}  // namespace tunica::app
