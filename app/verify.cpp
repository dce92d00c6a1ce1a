// tunica verify: the dispersed fibres against their analytic solution.
#include <memory>

#include "commands.hpp"
#include "tunica/parallel/petsc.hpp"
#include "tunica/stages/material/commands.hpp"

namespace tunica::app {

void add_verify(CLI::App& app) {
  CLI::App* command = app.add_subcommand("verify", "Check the wall with dispersed fibres against analytic solutions");
  command->footer(
      "A unit cube of 32 tetrahedra with two fibre families in 256 directions, in uniaxial extension to 1.2 and in\n"
      "simple shear to 0.5, with and without fibres under compression, in both wall elements. Compared are finite\n"
      "elements, the sum over the directions at one point, and the continuous density integrated adaptively.\n"
      "Example:\n  tunica verify -o verification\n"
      "writes tables (.csv) and figures (.svg). Exit codes: 0 all passed, 3 a comparison failed.");
  const auto folder = std::make_shared<std::string>("verification");
  command->add_option("-o,--output", *folder, "Folder of tables and figures")
      ->capture_default_str()
      ->check(some_name());
  command->callback([folder] {
    bool passed = false;
    {
      const parallel::Session session;
      passed = stages::verify(*folder, stdout);
    }
    if (!passed) throw CLI::RuntimeError(3);
  });
}

}  // namespace tunica::app
