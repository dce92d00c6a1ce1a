// tunica check: is a case file sound?
#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "file_command.hpp"
#include "tunica/artifacts/load_mesh.hpp"
#include "tunica/artifacts/outlets_file.hpp"
#include "tunica/base/error.hpp"
#include "tunica/case/table_ends.hpp"
#include "tunica/pipeline/chain.hpp"
#include "version.hpp"

namespace tunica::app {
namespace {

/// Tables that end before the run, or that do not hold the instant of the prestress.
void check_tables(const case_file::Case& c, const mesh::MeshData& data) {
  auto problems = case_file::check_table_ends(c.boundary, case_file::asked_by_run(c));
  if (c.prestress) {
    std::vector<std::string> wall;
    for (const auto& face : data.faces)
      if (data.regions[static_cast<std::size_t>(face.region)].kind == mesh::RegionKind::wall) wall.push_back(face.name);
    const auto more =
        case_file::check_table_ends(case_file::conditions_on(c.boundary, wall), case_file::asked_by_prestress(c));
    problems.insert(problems.end(), more.begin(), more.end());
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

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
  check_tables(parsed.value, mesh.data);
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
