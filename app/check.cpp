// tunica check: is a case file sound?
#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "tunica/stages/case.hpp"

namespace tunica::app {
namespace {

void check(const std::filesystem::path& file) {
  const auto parsed = stages::read_case(file);
  for (const Problem& warning : parsed.warnings) std::printf("warning: %s\n", format(warning).c_str());
  std::printf("%s: no errors, %zu warning%s\n", file.c_str(), parsed.warnings.size(),
              parsed.warnings.size() == 1 ? "" : "s");
}

}  // namespace

void add_check(CLI::App& app) {
  CLI::App* command = app.add_subcommand("check", "Validate a case file and the files it names, without running it");
  command->footer(
      "Example:\n  tunica check case.yaml\nReports all errors at once (exit code 2), and warns of values that look "
      "like slips.");
  const auto file = std::make_shared<std::string>();
  command->add_option("case", *file, "The case file")->required();
  command->callback([file] { check(*file); });
}

}  // namespace tunica::app
