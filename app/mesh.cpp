// tunica mesh: from a geometry to the mesh of a case.
#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "tunica/stages/meshing/mesh_case.hpp"

namespace tunica::app {
namespace {

void mesh(const std::string& file, const std::string& output, bool overwrite) {
  auto parsed = stages::meshing::read_mesh_case(file);
  for (const Problem& warning : parsed.warnings) std::printf("warning: %s\n", format(warning).c_str());
  if (!output.empty()) parsed.value.output = output;
  const auto say = [](const std::string& line) {
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
  };
  const auto report = stages::meshing::mesh_to_files(parsed.value, overwrite, say);
  std::printf(
      "\n%s\nwritten to %s: lumen/, wall/, meshes.yaml (the section `meshes` of a case file), report.json, "
      "report.html\n",
      report.c_str(), parsed.value.output.c_str());
}

}  // namespace

void add_mesh(CLI::App& app) {
  CLI::App* command = app.add_subcommand("mesh", "Mesh lumen and wall of a geometry, for a case file to run on");
  command->footer("Example:\n  tunica mesh mesh.yaml\nReference of the file: tunica schema --mesh");
  const auto file = std::make_shared<std::string>(), output = std::make_shared<std::string>();
  const auto overwrite = std::make_shared<bool>(false);
  command->add_option("file", *file, "What is meshed, and how finely")->required();
  command->add_option("-o,--output", *output, "Folder of the mesh, instead of the one that the file names");
  command->add_flag("--overwrite", *overwrite, "Replace a mesh that is there");
  command->callback([=] { mesh(*file, *output, *overwrite); });
}

}  // namespace tunica::app
