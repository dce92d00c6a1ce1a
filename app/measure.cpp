// tunica measure: flows and profiles from velocity images.
#include "tunica/stages/measure/measure.hpp"

#include <mpi.h>

#include <cstdio>

#include "commands.hpp"
#include "file_command.hpp"
#include "session.hpp"
#include "tunica/parallel/patience.hpp"

namespace tunica::app {
namespace {

/// Under mpirun rank 0 does it, and the others wait.
void measure(const FileRequest& request) {
  parallel::on_root_patiently(MPI_COMM_WORLD, [&] {
    auto parsed = stages::read_measure_case(request.file);
    print_warnings(parsed.warnings);
    if (!request.output.empty()) parsed.value.output = request.output;
    stages::measure(parsed.value, request.overwrite, [](const std::string& line) {
      std::printf("%s\n", line.c_str());
      std::fflush(stdout);
    });
  });
}

}  // namespace

void add_measure(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("measure", "Measure flows and inlet profiles in velocity images (4D-flow MRI)");
  command->footer(
      "Example of a file; `tunica schema --measure` prints the reference:\n"
      "  case: case.yaml\n"
      "  velocity: {x: vx.nii.gz, y: vy.nii.gz, z: vz.nii.gz, magnitude: mag.nii.gz, unit: cm/s, encoding: 150 cm/s,\n"
      "             period: 0.78 s}\n"
      "  planes: {descending: {centre: [10 mm, 40 mm, -20 mm], normal: [0, 0, -1]}}\n"
      "  profile: {opening: lumen_inlet}\n"
      "  output: flow\n"
      "Writes flows.csv, flows.json, flows.svg and profile_<opening>.csv.");
  add_file_arguments(
      *command,
      {.file = "Images, and where in the vessel they are looked at",
       .output = "Folder of the results, instead of the one that the file names",
       .overwrite = "Replace results that are there"},
      [](const FileRequest& request) { throw CLI::RuntimeError(in_session([&] { return measure(request), 0; })); });
}

}  // namespace tunica::app
