// tunica what-if: one case with another anatomy or other loads, side by side.
#include "tunica/pipeline/what_if.hpp"

#include <mpi.h>

#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "session.hpp"
#include "version.hpp"

namespace tunica::app {

void add_what_if(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("what-if", "A case with a tear closed or opened, a stent graft, another pressure or beat");
  const auto request = std::make_shared<pipeline::WhatIfRequest>();
  const auto output = std::make_shared<std::string>();
  command->add_option("file", request->file, "The file of the variants")->required();
  command->add_option("-o,--output", *output, "Folder of the results, instead of the one that the file names")
      ->check(some_name());
  command->footer(
      "Examples:\n"
      "  mpirun -n 2 tunica what-if what_if.yaml\n"
      "A file of variants:\n"
      "  case: case.yaml\n"
      "  variants:\n"
      "    exit_closed: {close_tears: tear_2}\n"
      "    new_tear: {open_tears: [{position: 260 mm, area: 100 mm^2}]}\n"
      "    stent: {sleeve: {from: 195 mm, to: 250 mm, material: {neo_hooke: {young_modulus: 20 MPa, poisson_ratio: "
      "0.45}}}}\n"
      "    exercise: {heart_rate: 1.3, stroke_volume: 1.1}\n"
      "    hypertension: {pressure: 1.2}\n"
      "The case is done first, variants on what they have in common with it; what is there is reused. Results:\n"
      "what_if.html, what_if.csv and a folder for each variant. All keys: tunica schema --what-if");
  command->callback([=] {
    throw CLI::RuntimeError(in_session([&] {
      if (!output->empty()) request->output = *output;
      request->program = {version(), commit()};
      const int signal = pipeline::what_if(*request, MPI_COMM_WORLD, stdout);
      return signal == 0 ? 0 : 128 + signal;
    }));
  });
}

}  // namespace tunica::app
