// Who owns a folder of results, and writes that fail: as a user meets them.
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <numbers>
#include <sstream>
#include <thread>

#include "program.hpp"

namespace tunica::test {
namespace {

class Ownership : public Program {
 protected:
  static constexpr const char* tube =
      "title: Tube\n"
      "analysis: fsi\nelements: linear\n"
      "meshes:\n"
      "  tube: {radius: 5 mm, length: 20 mm, wall_thickness: 1 mm, cells_around: 8, cells_radial: 1, cells_along: 4}\n"
      "  interface: {lumen: lumen_wall, wall: wall_inner}\n"
      "fluid: {}\n"
      "wall: {density: 1100 kg/m^3, material: {neo_hooke: {young_modulus: 3e5 Pa, poisson_ratio: 0.49}}}\n"
      "boundary:\n"
      "  lumen_inlet: {flow: 20 ml/s}\n"
      "  lumen_outlet: {resistance: 5e8 Pa s/m^3}\n"
      "  \"wall_*\": fixed\n"
      "  wall_outer: free\n";

  void write_case(const std::string& name, int steps, const std::string& more = "") const {
    write(name, tube + fmt::format("time: {{step: 1 ms, steps: {}, rho_infinity: 0.2}}\n"
                                   "output: {{directory: out, every: 1, checkpoint_every: 2}}\n{}",
                                   steps, more));
  }
  void expect_printed(const std::string& text) const {
    EXPECT_NE(printed().find(text), std::string::npos) << text << "\nin\n" << printed();
  }
  void wait_for(const std::string& file) const {
    for (int k = 0; k < 6000 && !fs::exists(folder_ / file); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_TRUE(fs::exists(folder_ / file)) << printed();
  }
  /// Runs a line of the shell in the folder; `$T` is the program.
  int shell(const std::string& line) const {
    const std::string command =
        fmt::format("cd {} && T={} && ( {} ) > out.txt 2>&1", folder_.string(), TUNICA_PROGRAM, line);
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  /// No file is cut off under its name.
  void expect_whole_files(const std::string& name) const {
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / name)) {
      const auto ending = entry.path().extension();
      EXPECT_NE(ending, ".part") << entry.path();
      if (!entry.is_regular_file()) continue;
      const std::string text = slurp(entry.path());
      const bool whole = ending == ".xdmf"                      ? text.ends_with("</Xdmf>\n")
                         : ending == ".series"                  ? text.ends_with("}\n")
                         : ending == ".vtu" || ending == ".vtp" ? text.rfind("</VTKFile>") != std::string::npos
                                                                : true;
      EXPECT_TRUE(whole) << entry.path();
    }
  }
};

TEST_F(Ownership, ASecondProcessIsRefusedWhateverItAsks) {
  write_case("case.yaml", 100000);
  const pid_t first = start("run case.yaml");
  wait_for("out/checkpoints");
  for (const char* arguments : {"run case.yaml", "run case.yaml --restart", "run case.yaml --overwrite",
                                "run other.yaml -o out", "post case.yaml --results out -o out --overwrite"}) {
    write_case("other.yaml", 3);
    const std::string line = fmt::format("$T {} > second.txt 2>&1", arguments);
    EXPECT_EQ(shell(line), 2) << arguments << read("second.txt");
    EXPECT_NE(read("second.txt").find(fmt::format("(process {} on", first)), std::string::npos) << read("second.txt");
  }
  kill(first, SIGTERM);
  EXPECT_EQ(exit_code(first), 128 + SIGTERM);
  EXPECT_FALSE(fs::exists(folder_ / "out/.tunica.lock"));
  long step = 0;
  std::istringstream lines(read("out/steps.csv"));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) EXPECT_EQ(std::stol(line), ++step);
  EXPECT_GT(step, 1);
}

TEST_F(Ownership, AKilledProcessOwnsNothing) {
  write_case("case.yaml", 100000);
  const pid_t first = start("run case.yaml");
  wait_for("out/checkpoints");
  kill(first, SIGKILL);
  EXPECT_EQ(exit_code(first), -SIGKILL);
  EXPECT_TRUE(fs::exists(folder_ / "out/.tunica.lock"));
  ASSERT_EQ(tunica("run case.yaml --overwrite --until 1"), 0) << printed();
  expect_printed(fmt::format("was left locked by `{} run case.yaml` (process {}", TUNICA_PROGRAM, first));
  EXPECT_FALSE(fs::exists(folder_ / "out/.tunica.lock"));
}

TEST_F(Ownership, AChainAsksForAllItsFoldersBeforeItBegins) {
  write_case("case.yaml", 2,
             "prestress: {flow: {pressure: 80 mmHg, inflow: 20 ml/s, step: 1 ms, steps: 20}, tolerance: 0.01 mm}\n"
             "report: {pictures: false}\n");
  write_case("alone.yaml", 100000);
  const pid_t other = start("run alone.yaml -o out/run");
  wait_for("out/run/manifest.json");
  EXPECT_EQ(shell("$T run case.yaml > second.txt 2>&1"), 2);
  EXPECT_NE(read("second.txt").find("out/run: is being written by"), std::string::npos) << read("second.txt");
  EXPECT_FALSE(fs::exists(folder_ / "out/prestress")) << "nothing is begun";
  kill(other, SIGKILL);
  exit_code(other);
  ASSERT_EQ(tunica("run case.yaml --overwrite"), 0) << printed();  // and its own locks are not in its way
  expect_printed("run         done");
  const pid_t chain = start("run case.yaml --overwrite");
  wait_for("out/.tunica.lock");
  kill(chain, SIGSTOP);  // it must still be at work when the other one asks
  EXPECT_EQ(shell("$T run case.yaml > second.txt 2>&1"), 2) << read("second.txt");
  kill(chain, SIGCONT);
  EXPECT_EQ(exit_code(chain), 0) << printed();
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out"))
    EXPECT_FALSE(entry.path().filename().string().starts_with(".tunica")) << entry.path();
}

TEST_F(Ownership, ManyProcessesOfAnotherLauncherAreRefused) {
  write_case("case.yaml", 1);
  EXPECT_EQ(shell("MV2_COMM_WORLD_SIZE=4 MV2_COMM_WORLD_RANK=0 $T run case.yaml"), 2);
  expect_printed("has started several processes (MV2_COMM_WORLD_SIZE=4)");
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  EXPECT_EQ(shell("SLURM_NTASKS=4 $T run case.yaml"), 0) << printed();
}

// Limits of several sizes meet fields, checkpoints, histories and the manifest.
TEST_F(Ownership, ALimitOfFileSizeEndsTheRunWithFileAndStep) {
  write_case("case.yaml", 60);
  for (const rlim_t kilobytes : {1, 4, 8, 12, 16}) {
    fs::remove_all(folder_ / "out");
    const pid_t run = start("run case.yaml");
    // Not from the beginning: the MPI has large files of its own.
    wait_for("out/.tunica.lock");
    const rlimit limit{1024 * kilobytes, 1024 * kilobytes};
    prlimit(run, RLIMIT_FSIZE, &limit, nullptr);
    const int code = exit_code(run);
    const std::string said = printed();
    EXPECT_TRUE(code == 2 || code == 3) << code << said;
    // What it prints goes into a file too, which takes no more than the limit.
    EXPECT_TRUE(said.size() + 500 >= limit.rlim_cur || said.find("File too large") != std::string::npos) << said;
    expect_whole_files("out");
  }
}

TEST_F(Ownership, AFullDiskEndsTheRunWithFileAndStep) {
  write_case("case.yaml", 50);
  fs::create_directory(folder_ / "out");
  const std::string disk = (folder_ / "out").string();
  if (mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=300k") != 0)
    GTEST_SKIP() << "no file system can be mounted here: " << std::strerror(errno);
  const int code = tunica("run case.yaml");
  const std::string said = printed();
  expect_whole_files("out");
  umount2(disk.c_str(), MNT_DETACH);
  EXPECT_EQ(code, 3) << said;
  EXPECT_NE(said.find("No space left on device"), std::string::npos) << said;
  EXPECT_NE(said.find("step "), std::string::npos) << said;
}

TEST_F(Ownership, NamesThatCannotBeWrittenAreFoundBeforeTheWork) {
  write_case("case.yaml", 100000);
  write("a_file", "");
  fs::create_directories(folder_ / "taken/faces.csv");
  fs::create_directories(folder_ / "file_below");
  write("file_below/checkpoints", "");
  const std::string longest(300, 'n');
  for (const std::string& output :
       {std::string("a_file"), std::string("a_file/below"), longest, "new/" + longest, std::string("taken"),
        std::string("file_below"), std::string("/proc/self/fd"), std::string("/dev/full")}) {
    EXPECT_EQ(tunica("run case.yaml -o " + output), 2) << output << printed();
    EXPECT_EQ(printed().find("step 1/"), std::string::npos) << output << printed();
  }
}

TEST_F(Ownership, FoldersInPlaceOfFilesAreNamed) {
  write_case("case.yaml", 2);
  for (const char* file : {"manifest.json", ".tunica.lock"}) {
    fs::remove_all(folder_ / "out");
    fs::create_directories(folder_ / "out" / file);
    for (const char* command : {"run", "check"}) {
      if (std::string(command) == "check" && *file == '.') continue;  // writes nothing
      EXPECT_EQ(tunica(std::string(command) + " case.yaml"), 2) << printed();
      expect_printed(std::string("out/") + file + ": is a folder, though tunica keeps a file of that name");
    }
  }
  fs::remove_all(folder_ / "out");
  write_case("chain.yaml", 2, "post: {}\n");
  fs::create_directories(folder_ / "out/run/stage.json");
  EXPECT_EQ(tunica("run chain.yaml"), 2) << printed();
  expect_printed("out/run/stage.json: is a folder");
}

TEST_F(Ownership, EmptyNamesOfFoldersAreRefused) {
  write_case("case.yaml", 2);
  for (const char* command : {"run case.yaml -o ''", "post case.yaml --results ''", "post case.yaml -o ''",
                              "prestress case.yaml -o ''", "tune case.yaml -o ''", "mesh case.yaml -o ''"}) {
    EXPECT_EQ(shell(std::string("$T ") + command), 2) << command << "\n" << printed();
    expect_printed("the name is empty");
  }
}

TEST_F(Ownership, TextThatIsCutOffIsNoSuccess) {
  EXPECT_EQ(shell("$T schema > /dev/full"), 3);
  expect_printed("the standard output was cut off: No space left on device");
  EXPECT_EQ(shell("$T schema | head -1"), 0);
  write_case("case.yaml", 2);
  EXPECT_EQ(shell("$T check case.yaml > /dev/full"), 3);  // here PETSc comes to its end first
  expect_printed("the standard output was cut off: No space left on device");
  EXPECT_EQ(printed().find("PETSC"), std::string::npos) << printed();
  write("faces.csv", "time [s],a\n0,1\n1,2\n");
  EXPECT_EQ(shell("ln -s /dev/full a.svg; $T plot faces.csv a -x 'time [s]' -o a.svg"), 3);
  expect_printed("a.svg: No space left on device");
  EXPECT_EQ(shell("ln -s /dev/full a.png; $T plot faces.csv a -x 'time [s]' -o a.png"), 3);
  EXPECT_EQ(shell("$T plot faces.csv a -x 'time [s]' -o none/a.svg"), 2);
}

// The run counts, and its log is said to be incomplete.
TEST_F(Ownership, ALogThatCannotBeWrittenIsAWarning) {
  write_case("case.yaml", 2);
  fs::create_directory(folder_ / "out");
  fs::create_symlink("/dev/full", folder_ / "out/run.log");
  ASSERT_EQ(tunica("run case.yaml"), 0) << printed();
  expect_printed("warning: the log out/run.log cannot be written any more (No space left on device)");
}

/// A tube along z, open at its ends [mm].
std::string tube_surface() {
  constexpr int around = 20, along = 10;
  constexpr double radius = 5, length = 24;
  std::string text;
  for (int i = 0; i <= along; ++i)
    for (int k = 0; k < around; ++k)
      text += fmt::format("v {:.6f} {:.6f} {:.6f}\n", radius * std::cos(2 * std::numbers::pi * k / around),
                          radius * std::sin(2 * std::numbers::pi * k / around), length * i / along);
  const auto number = [](int i, int k) { return i * around + k % around + 1; };
  for (int k = 0; k < around; ++k) {
    for (int i = 0; i < along; ++i)
      text += fmt::format("f {0} {1} {2}\nf {0} {2} {3}\n", number(i, k), number(i, k + 1), number(i + 1, k + 1),
                          number(i + 1, k));
  }
  return text;
}

TEST_F(Ownership, AMeshThatCannotBeWrittenIsNoMesh) {
  write("tube.obj", tube_surface());
  write("mesh.yaml",
        "geometry:\n  surfaces: {lumen: tube.obj, length_unit: mm, wall: {per_radius: 0.2, thinnest: 1 mm, thickest: 2 "
        "mm}}\nsize: {edge: 2 mm}\noutput: mesh\n");
  write("mesh", "a file");
  EXPECT_EQ(tunica("mesh mesh.yaml"), 2) << printed();
  EXPECT_EQ(printed().find("surfaces"), std::string::npos) << printed();
  fs::remove(folder_ / "mesh");
  fs::create_directories(folder_ / "mesh/report.html");
  EXPECT_EQ(tunica("mesh mesh.yaml"), 2) << printed();
  EXPECT_EQ(printed().find("surfaces"), std::string::npos) << printed();
  fs::remove_all(folder_ / "mesh");
  EXPECT_EQ(shell("ulimit -f 60 && $T mesh mesh.yaml > /dev/null"), 3) << printed();
  expect_printed("File too large");
  expect_printed("mesh-complete.mesh.vtu");
  expect_whole_files("mesh");
  EXPECT_FALSE(fs::exists(folder_ / "mesh/report.json"));
  EXPECT_FALSE(fs::exists(folder_ / "mesh/.tunica.lock"));
  const pid_t first = start("mesh mesh.yaml");
  wait_for("mesh/.tunica.lock");
  EXPECT_EQ(shell("$T mesh mesh.yaml --overwrite > second.txt 2>&1"), 2) << read("second.txt");
  EXPECT_EQ(exit_code(first), 0) << printed();
}

}  // namespace
}  // namespace tunica::test
