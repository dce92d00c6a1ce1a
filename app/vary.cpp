// tunica vary: a case file made from another one.
#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "tunica/case/variant.hpp"

namespace tunica::app {

void add_vary(CLI::App& app) {
  CLI::App* command = app.add_subcommand("vary", "A case file like another one, with other values of some keys");
  struct Given {
    std::string file, output;
    std::vector<std::string> settings, removed;
    bool overwrite = false;
  };
  const auto given = std::make_shared<Given>();
  command->add_option("case", given->file, "The case file to start from")->required();
  command->add_option("-o,--output", given->output, "The new case file")->required()->check(some_name());
  command->add_option("--set", given->settings, "Key and value, as often as wanted")->type_name("KEY=VALUE");
  command->add_option("--unset", given->removed, "Key that the new case does not have")->type_name("KEY");
  command->add_flag("--overwrite", given->overwrite, "Replace the new case file when it is there");
  command->footer(
      "Examples:\n"
      "  tunica vary case.yaml -o thin.yaml --set mesh.geometry.parametric.flap.thickness='1.5 mm'\n"
      "  tunica vary case.yaml -o sharp.yaml --set wall.smoothing_length='0 mm' --set prestress.load_steps=1\n"
      "  tunica vary case.yaml -o long.yaml --set 'time={step: 1 ms, cycles: {period: 0.8 s}}' --unset report\n"
      "Values are YAML. Results of the new case go into a folder beside it that bears its name, unless\n"
      "output.directory is set. Stages that it shares with another case can be shared: --set mesh.output=other/mesh");
  command->callback([given] {
    case_file::write_variant({.case_file = given->file,
                              .output = given->output,
                              .settings = given->settings,
                              .removed = given->removed,
                              .overwrite = given->overwrite});
    std::printf("%s\n", given->output.c_str());
  });
}

}  // namespace tunica::app
