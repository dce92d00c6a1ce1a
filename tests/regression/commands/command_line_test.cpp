// What the program says of itself: version, commands that were meant, silence, completions, the page of the manual.
#include "program.hpp"

namespace tunica::test {
namespace {

class CommandLine : public Program {
 protected:
  void expect_printed(const std::string& part) const {
    EXPECT_NE(printed().find(part), std::string::npos) << part << "\n" << printed();
  }
};

TEST_F(CommandLine, VersionTellsWhatTheProgramIsMadeOf) {
  EXPECT_EQ(tunica("--version"), 0);
  for (const char* part :
       {"tunica 0.", "\ncommit ", "\nPETSc 3.", "\nMPI ", "\nVTK 9.", "\ncompiler ", "\ninstruction set "})
    expect_printed(part);
}

TEST_F(CommandLine, AMistypedCommandIsAnsweredByTheOneThatWasMeant) {
  EXPECT_EQ(tunica("prestres case.yaml"), 2);
  expect_printed("prestres: is no command of tunica");
  expect_printed("did you mean `tunica prestress`?");
  EXPECT_EQ(tunica("banana"), 2);
  expect_printed("see `tunica --help`");
  EXPECT_EQ(tunica("--banana"), 2);
}

TEST_F(CommandLine, QuietPrintsNothingButErrors) {
  write("material.yaml",
        "material: {neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.3}}\ntests: {pull: {uniaxial: {to: 1.2}}}\n");
  EXPECT_EQ(tunica("material material.yaml --quiet"), 0);
  EXPECT_EQ(printed(), "");
  EXPECT_TRUE(fs::exists(folder_ / "results" / "pull.csv"));
  EXPECT_EQ(tunica("material -q missing.yaml"), 2);
  expect_printed("missing.yaml");
  EXPECT_EQ(tunica("schema --quiet"), 2);  // its result is what it prints
}

TEST_F(CommandLine, CompletionsKnowCommandsAndOptions) {
  for (const char* shell : {"bash", "zsh", "fish"}) {
    EXPECT_EQ(tunica(std::string("completion ") + shell), 0);
    for (const char* part : {"prestress", "keep-flow", "restart"}) expect_printed(part);
  }
  EXPECT_EQ(tunica("completion csh"), 2);
}

TEST_F(CommandLine, TheManualHasEveryCommand) {
  EXPECT_EQ(tunica("manual"), 0);
  for (const char* part : {".TH TUNICA 1", ".SS tunica run", "\\-\\-restart", ".SS tunica view", "EXIT STATUS"})
    expect_printed(part);
}

}  // namespace
}  // namespace tunica::test
