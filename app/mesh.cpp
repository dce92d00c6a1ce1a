// tunica mesh: from a geometry to the mesh of a case, for one file or many.
#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "file_command.hpp"
#include "tunica/pipeline/chain.hpp"
#include "tunica/stages/meshing/mesh_batch.hpp"
#include "tunica/stages/meshing/mesh_case.hpp"
#include "tunica/stages/meshing/preview.hpp"
#include "version.hpp"

namespace tunica::app {
namespace {

struct MeshRequest {
  std::vector<std::string> files;
  std::string output, table;
  bool overwrite = false, preview = false;
};

void say(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

/// The mesh of one file, or its preview; returns what was made in a line.
std::string make(const std::string& file, const MeshRequest& request) {
  auto parsed = case_file::read_mesh_case(file);
  print_warnings(parsed.warnings);
  if (!request.output.empty()) parsed.value.output = request.output;
  const std::string folder = parsed.value.output.string();
  if (request.preview) {
    const auto text = stages::preview_to_files(parsed.value, say);
    say("\n" + text + "\nwritten to " + folder + ": preview.html, preview.png");
    return "preview in " + folder;
  }
  pipeline::OwnRecord record("mesh", file, folder, 1, {version(), commit()});
  const auto made = stages::mesh_to_files(parsed.value, request.overwrite, say, [&] { record.begin(); });
  record.done();
  say("\n" + made.text + "\nwritten to " + folder +
      ": lumen/, wall/, meshes.yaml (the section `meshes` of a case file), report.json, report.html");
  return made.summary;
}

/// All files, whatever becomes of each, and one table at the end.
void make_all(const MeshRequest& request) {
  if (!request.output.empty())
    throw InputError("--output", "names one folder for several meshes", "let each file name its own `output`");
  const auto outcomes = stages::attempt_all(request.files, [&](const std::string& file) {
    say("== " + file);
    return make(file, request);
  });
  say("\n" + stages::outcome_text(outcomes));
  if (!request.table.empty()) stages::write_outcomes(outcomes, request.table);
  if (const int worst = stages::worst_of(outcomes); worst != 0) throw CLI::RuntimeError(worst);
}

}  // namespace

void add_mesh(CLI::App& app) {
  CLI::App* command = app.add_subcommand("mesh", "Mesh lumen and wall of a geometry, for a case file to run on");
  command->footer(
      "Examples:\n"
      "  tunica mesh mesh.yaml\n"
      "  tunica mesh --preview mesh.yaml              what will be meshed, in seconds\n"
      "  tunica mesh --table all.csv cohort/*.yaml    many, with one table of what became of each\n"
      "With several files the exit code is the largest one of all.\n"
      "Reference of the file: tunica schema --mesh");
  const auto request = std::make_shared<MeshRequest>();
  command->add_option("file", request->files, "What is meshed, and how finely; one file or several")->required();
  command->add_option("-o,--output", request->output, "Folder of the mesh, instead of the one that the file names")
      ->check(some_name());
  command->add_option("--table", request->table, "Table (.csv) of what became of each file")->check(some_name());
  command->add_flag("--overwrite", request->overwrite, "Replace a mesh that is there");
  command->add_flag("--preview", request->preview,
                    "Only pictures of lumen, ends and tears, before anything is remeshed: preview.html, preview.png");
  command->callback([=] {
    if (request->files.size() == 1 && request->table.empty())
      make(request->files.front(), *request);
    else
      make_all(*request);
  });
}

}  // namespace tunica::app
