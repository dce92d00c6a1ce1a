// tunica fit: parameters of wall laws from tests of specimens.
#include "tunica/stages/fit/fit.hpp"

#include <cstdio>
#include <memory>
#include <optional>

#include "commands.hpp"

namespace tunica::app {

void add_fit(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("fit", "Find the parameters of wall laws from tests, and what these determine");
  command->footer(
      "Example of a file; `tunica schema --fit` prints the reference:\n"
      "  specimens:\n"
      "    flap:\n"
      "      tests:\n"
      "        sheet: {biaxial: {along: e1, across: e2}, file: flap.csv, protocol: protocol, load: stretch_1,\n"
      "                load_across: stretch_2, stress: P_11_kPa, stress_across: P_22_kPa, unit: kPa,\n"
      "                measure: first_piola_kirchhoff}\n"
      "  laws: {dfd: dfd, goh: goh, neo_hooke: neo_hooke}\n"
      "Writes fit.html (fit, intervals, profiles, ranking), fit.json and for each law <law>.yaml, which a case reads\n"
      "by `material: {fitted: <law>.yaml}`.");
  const auto file = std::make_shared<std::string>(), directory = std::make_shared<std::string>();
  command->add_option("file", *file, "The file of the fit")->required();
  auto* given = command->add_option("-o,--output", *directory, "Folder of the results, instead of that in the file")
                    ->check(some_name());
  command->callback([=] {
    std::optional<std::filesystem::path> folder;
    if (given->count() > 0) folder = *directory;
    stages::run_fit(*file, folder, stdout);
  });
}

}  // namespace tunica::app
