// tunica export: a case as svMultiPhysics reads it.
#include <mpi.h>

#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "session.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/pipeline/view_sources.hpp"
#include "tunica/stages/export/export_case.hpp"
#include "tunica/stages/export/export_results.hpp"

namespace tunica::app {

namespace {

void export_and_report(const stages::ExportRequest& request, bool results) {
  if (results) {
    for (const auto& file : stages::export_results({request.case_file, request.folder, request.units}))
      std::printf("%s\n", (request.folder / file).c_str());
    return;
  }
  const auto outcome = stages::export_case(request);
  if (!outcome.changed.empty()) std::printf("svMultiPhysics computes otherwise:\n");
  for (const auto& line : outcome.changed) std::printf("  %s\n", line.c_str());
  for (const auto& line : outcome.warnings) std::printf("warning: %s\n", line.c_str());
  for (const auto& file : outcome.files) std::printf("%s\n", (request.folder / file).c_str());
}

}  // namespace

void add_export(CLI::App& app) {
  CLI::App* command = app.add_subcommand("export", "A case as svMultiPhysics reads it: solver.xml, meshes, tables");
  command->footer(
      "Examples:\n"
      "  tunica export case.yaml -o folder --units cgs\n"
      "  tunica export case.yaml -o folder --units cgs --results   what its run has left, as result_NNN.vtu and "
      "B_*.txt\n"
      "What svMultiPhysics computes otherwise is listed; what it cannot pose is an error with the key of the case.\n"
      "More: docs/coming_from_simvascular.md");
  const auto request = std::make_shared<stages::ExportRequest>();
  const auto names = std::make_shared<std::pair<std::string, std::string>>();
  command->add_option("case", names->first, "The case file")->required();
  command->add_option("-o,--output", names->second, "The folder to write")->required()->check(some_name());
  command->add_option("--units", request->units, "Units of all numbers there: cgs, mmgs or si")->type_name("SYSTEM");
  command->add_flag("--overwrite", request->overwrite, "Replace what an earlier export has left there");
  const auto results = std::make_shared<bool>(false);
  command->add_flag("--results", *results,
                    "Results of the run in svMultiPhysics' files and names, in place of the case");
  command->callback([=] {
    request->case_file = names->first;
    request->folder = names->second;
    throw CLI::RuntimeError(in_session([&] {
      if (*results) request->case_file = pipeline::view_sources(request->case_file, MPI_COMM_WORLD).case_file;
      parallel::on_root(MPI_COMM_WORLD, [&] { export_and_report(*request, *results); });
      return 0;
    }));
  });
}

}  // namespace tunica::app
