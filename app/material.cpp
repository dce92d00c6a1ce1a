// tunica material: a wall law in the tests of an experimenter.
#include <cstdio>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "tunica/stages/material/commands.hpp"

namespace tunica::app {

void add_material(CLI::App& app) {
  CLI::App* command = app.add_subcommand("material", "Put a wall law through material tests: curves, stress, tangent");
  command->footer(
      "Example of a file; `tunica schema --material` prints the reference:\n"
      "  material:\n"
      "    hgo:\n"
      "      shear_modulus: 20 kPa\n"
      "      poisson_ratio: 0.5\n"
      "      families:\n"
      "        - {k1: 30 kPa, k2: 5, mean_angle: 35 deg}\n"
      "        - {k1: 30 kPa, k2: 5, mean_angle: -35 deg}\n"
      "  tests:\n"
      "    circumferential: {uniaxial: {along: e1, to: 1.3}}\n"
      "    sheet: {biaxial: {to: 1.2, ratio: 0.5}}\n"
      "    shear: {simple_shear: {along: e1, across: e3, to: 0.5}}\n"
      "    points: {gradients: {list: [[1.1, 0.1, 0, 0, 1, 0, 0, 0, 0.91]]}}\n"
      "Each test writes <name>.csv (F, J, Psi, stresses, tangent) and <name>.svg, or <name>.png\n"
      "with `output: {plots: png}`. Measured points are drawn over the\n"
      "curve with `data: {file: pull.csv, load: stretch, stress: force per area, unit: kPa}`.");
  const auto file = std::make_shared<std::string>(), directory = std::make_shared<std::string>();
  command->add_option("file", *file, "The material file")->required();
  auto* given = command->add_option("-o,--output", *directory, "Folder of the results, instead of that in the file")
                    ->check(some_name());
  command->callback([=] {
    std::optional<std::filesystem::path> folder;
    if (given->count() > 0) folder = *directory;
    stages::run_material(*file, folder, stdout);
  });
}

}  // namespace tunica::app
