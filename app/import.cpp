// tunica import: a case file from an input file of svMultiPhysics or svFSI.
#include "import.hpp"

#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "tunica/stages/import/import_case.hpp"

namespace tunica::app {

namespace {

void list(const char* title, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  std::printf("%s:\n", title);
  for (const auto& line : lines) std::printf("  %s\n", line.c_str());
}

}  // namespace

void import_and_report(const stages::ImportRequest& request) {
  const auto outcome = stages::import_case(request);
  list("dropped, as key:line", outcome.dropped);
  list("changed", outcome.changed);
  list("not written there", outcome.defaults);
  for (const auto& warning : outcome.warnings) std::printf("warning: %s\n", warning.c_str());
  std::printf("%s%s\n", request.case_file.c_str(), outcome.unchanged ? ": as it was" : "");
}

void add_import(CLI::App& app) {
  CLI::App* command = app.add_subcommand("import", "A case file from an input file of svMultiPhysics or svFSI");
  command->footer(
      "Examples:\n"
      "  tunica import solver.xml -o case.yaml --units cgs\n"
      "  tunica import svFSI.inp -o case.yaml --units mmgs --overwrite\n"
      "  tunica import folder -o case.yaml --units si       with one such file in it\n"
      "Behind each line of the case file stands the key that it comes from. Keys that were dropped, changed or taken\n"
      "from defaults are listed at its head and here. What cannot be expressed is an error with key and line.\n"
      "`tunica run solver.xml --units cgs` imports and runs. More: docs/coming_from_simvascular.md");
  const auto request = std::make_shared<stages::ImportRequest>();
  const auto names = std::make_shared<std::pair<std::string, std::string>>();
  command->add_option("file", names->first, "solver.xml, an .inp file, or the folder of one")->required();
  command->add_option("-o,--output", names->second, "The case file to write")->required()->check(some_name());
  command->add_option("--units", request->units, "Units of its numbers, which it does not say itself: cgs, mmgs or si")
      ->type_name("SYSTEM");
  command->add_flag("--overwrite", request->overwrite, "Replace the case file when it is there");
  command->callback([=] {
    request->file = names->first;
    request->case_file = names->second;
    import_and_report(*request);
  });
}

}  // namespace tunica::app
