// tunica check: is a case file sound?
#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "file_command.hpp"
#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/artifacts/outlets_file.hpp"
#include "tunica/pipeline/chain.hpp"
#include "version.hpp"

namespace tunica::app {
namespace {

void check(const std::filesystem::path& file) {
  auto parsed = case_file::read_case(file);
  if (parsed.value.is_chain()) {
    for (const auto& line : pipeline::check_chain({.case_file = file, .program = {version(), commit()}}))
      std::printf("%s\n", line.c_str());
    std::printf("%s: no errors that can be found before its stages are done\n", file.c_str());
    return;
  }
  const auto outlets = artifacts::unusual_outlets(parsed.value);
  parsed.warnings.insert(parsed.warnings.end(), outlets.begin(), outlets.end());
  print_warnings(parsed.warnings);
  const auto mesh = artifacts::load_mesh(parsed.value);
  for (const auto& line : mesh.report) std::printf("%s\n", line.c_str());
  for (const auto& warning : mesh.warnings) std::printf("warning: %s\n", warning.c_str());
  const std::size_t warnings = parsed.warnings.size() + mesh.warnings.size();
  std::printf("%s: no errors, %zu warning%s\n", file.c_str(), warnings, warnings == 1 ? "" : "s");
}

}  // namespace

void add_check(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("check", "Validate a case file, its meshes and their faces, without running it");
  command->footer(
      "Example:\n  tunica check case.yaml\nReports all errors at once (exit code 2), and warns of values that look "
      "like slips.");
  const auto file = std::make_shared<std::string>();
  command->add_option("case", *file, "The case file")->required();
  command->callback([file] { check(*file); });
}

}  // namespace tunica::app
