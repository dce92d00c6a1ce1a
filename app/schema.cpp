// tunica schema: the reference of the case file and of the material file.
#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "tunica/stages/case.hpp"
#include "tunica/stages/imaging/scan_case.hpp"
#include "tunica/stages/material_case.hpp"
#include "tunica/stages/meshing/mesh_case.hpp"

namespace tunica::app {

void add_schema(CLI::App& app) {
  CLI::App* command = app.add_subcommand("schema", "Print the reference of the case file");
  command->footer(
      "Examples:\n  tunica schema > case-file.md\n  tunica schema --json > tunica.schema.json\n"
      "An editor that knows YAML completes and checks case files that begin with the line\n"
      "  # yaml-language-server: $schema=tunica.schema.json");
  const auto json = std::make_shared<bool>(false), material = std::make_shared<bool>(false),
             mesh = std::make_shared<bool>(false), image = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "As JSON Schema instead of Markdown");
  auto* of_material = command->add_flag("--material", *material, "Of the file of `tunica material` instead");
  auto* of_mesh = command->add_flag("--mesh", *mesh, "Of the file of `tunica mesh` instead")->excludes(of_material);
  command->add_flag("--image", *image, "Of the file of `tunica image` instead")
      ->excludes(of_material)
      ->excludes(of_mesh);
  command->callback([json, material, mesh, image] {
    const auto description = *material ? stages::MaterialCase::schema().description()
                             : *mesh   ? stages::meshing::MeshCase::schema().description()
                             : *image  ? stages::imaging::ScanCase::schema().description()
                                       : stages::Case::schema().description();
    std::fputs((*json ? config::json_schema(*description) : config::markdown(*description)).c_str(), stdout);
  });
}

}  // namespace tunica::app
