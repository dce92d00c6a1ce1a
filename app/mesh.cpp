// tunica mesh: from a geometry to the mesh of a case.
#include <cstdio>

#include "commands.hpp"
#include "file_command.hpp"
#include "tunica/pipeline/chain.hpp"
#include "tunica/stages/meshing/mesh_case.hpp"
#include "version.hpp"

namespace tunica::app {
namespace {

void mesh(const FileRequest& request) {
  auto parsed = case_file::read_mesh_case(request.file);
  print_warnings(parsed.warnings);
  if (!request.output.empty()) parsed.value.output = request.output;
  const auto say = [](const std::string& line) {
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
  };
  pipeline::OwnRecord record("mesh", request.file, parsed.value.output, 1, {version(), commit()});
  const auto report = stages::mesh_to_files(parsed.value, request.overwrite, say, [&] { record.begin(); });
  record.done();
  std::printf(
      "\n%s\nwritten to %s: lumen/, wall/, meshes.yaml (the section `meshes` of a case file), report.json, "
      "report.html\n",
      report.c_str(), parsed.value.output.c_str());
}

}  // namespace

void add_mesh(CLI::App& app) {
  CLI::App* command = app.add_subcommand("mesh", "Mesh lumen and wall of a geometry, for a case file to run on");
  command->footer("Example:\n  tunica mesh mesh.yaml\nReference of the file: tunica schema --mesh");
  add_file_arguments(*command,
                     {.file = "What is meshed, and how finely",
                      .output = "Folder of the mesh, instead of the one that the file names",
                      .overwrite = "Replace a mesh that is there"},
                     mesh);
}

}  // namespace tunica::app
