#include "tunica/parallel/log.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/progress.hpp"

namespace tunica::parallel {
namespace {

/// A file name that all ranks share and that goes away with the object.
class SharedFile {
 public:
  SharedFile() {
    std::string name = (std::filesystem::temp_directory_path() / "tunica_log_XXXXXX").string();
    if (rank(MPI_COMM_WORLD) == 0) close(mkstemp(name.data()));
    broadcast(MPI_COMM_WORLD, name);
    path = name;
  }
  ~SharedFile() {
    MPI_Barrier(MPI_COMM_WORLD);  // others may be reading it
    if (rank(MPI_COMM_WORLD) == 0) std::filesystem::remove(path);
  }
  std::string text() const {
    std::ostringstream all;
    all << std::ifstream(path).rdbuf();
    return all.str();
  }
  std::filesystem::path path;
};

/// A terminal of our own to write to and read back.
class Terminal {
 public:
  Terminal() {
    int slave = -1;
    winsize size{24, 60, 0, 0};
    if (openpty(&master_, &slave, nullptr, nullptr, &size) != 0) throw std::runtime_error("no pseudo-terminal");
    stream = fdopen(slave, "w");
  }
  ~Terminal() {
    std::fclose(stream);
    close(master_);
  }
  /// All that has been written; a terminal hands it on in pieces, so it is waited for until it is silent.
  std::string text() const {
    std::string all;
    char buffer[4096];
    for (pollfd ready{master_, POLLIN, 0}; poll(&ready, 1, all.empty() ? 2000 : 50) > 0;) {
      const auto count = read(master_, buffer, sizeof buffer);
      if (count <= 0) break;
      all.append(buffer, static_cast<std::size_t>(count));
    }
    return all;
  }
  std::FILE* stream = nullptr;

 private:
  int master_ = -1;
};

TEST(Log, WritesEachLineOnceFromRankZero) {
  const SharedFile file;
  {
    Log log(MPI_COMM_WORLD, {.file = file.path, .screen = nullptr});
    log.info("step 1");
    log.warning("density 1.06 kg/m^3");
    log.status("never in the file");
    MPI_Barrier(MPI_COMM_WORLD);
    const std::string text = file.text();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
    EXPECT_NE(text.find("info    step 1\n"), std::string::npos) << text;
    EXPECT_NE(text.find("warning density"), std::string::npos) << text;
    EXPECT_EQ(text.find("never"), std::string::npos) << text;
    MPI_Barrier(MPI_COMM_WORLD);
  }
  Log again(MPI_COMM_WORLD, {.file = file.path, .screen = nullptr});
  again.info("step 2");
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_NE(file.text().find("step 1"), std::string::npos) << "a restart appends";
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(Log, RefusesAnUnwritableFileOnAllRanks) {
  EXPECT_THROW(Log(MPI_COMM_WORLD, {.file = "/nonexistent/folder/run.log", .screen = nullptr}), InputError);
}

/// The variables that decide on colours, put back at the end.
class Colours {
 public:
  Colours(const char* none, const char* term) : none_(of("NO_COLOR")), term_(of("TERM")) {
    set("NO_COLOR", none ? std::optional<std::string>(none) : std::nullopt);
    set("TERM", term);
  }
  ~Colours() {
    set("NO_COLOR", none_);
    set("TERM", term_);
  }

 private:
  static std::optional<std::string> of(const char* name) {
    const char* value = std::getenv(name);
    return value ? std::optional<std::string>(value) : std::nullopt;
  }
  static void set(const char* name, const std::optional<std::string>& value) {
    if (value)
      setenv(name, value->c_str(), 1);
    else
      unsetenv(name);
  }
  std::optional<std::string> none_, term_;
};

TEST(Log, ColoursOnATerminalUnlessTheyAreNotWanted) {
  const auto shown = [](const char* none, const char* term) {
    const Colours colours(none, term);
    const Terminal terminal;
    Log log(MPI_COMM_WORLD, {.screen = terminal.stream});
    if (rank(MPI_COMM_WORLD) != 0) return std::string();
    log.heading("a tube");
    log.warning("coarse");
    log.info("done");
    return terminal.text();
  };
  const std::string plain = rank(MPI_COMM_WORLD) == 0 ? "a tube\r\nwarning: coarse\r\ndone\r\n" : "";
  const std::string bright =
      rank(MPI_COMM_WORLD) == 0 ? "\033[1ma tube\033[0m\r\n\033[1;33mwarning:\033[0m coarse\r\ndone\r\n" : "";
  EXPECT_EQ(shown(nullptr, "xterm"), bright);
  EXPECT_EQ(shown("", "xterm"), bright) << "empty counts as not set, says no-color.org";
  EXPECT_EQ(shown("1", "xterm"), plain);
  EXPECT_EQ(shown(nullptr, "dumb"), plain);
}

TEST(Log, DetailsGoToTheFileAndToAVerboseScreen) {
  const SharedFile file;
  for (const bool verbose : {false, true}) {
    char* text = nullptr;
    std::size_t size = 0;
    std::FILE* screen = open_memstream(&text, &size);
    {
      Log log(MPI_COMM_WORLD, {.file = file.path, .screen = screen, .verbose = verbose});
      log.detail("newton 3");
      log.heading("a tube");
    }
    std::fclose(screen);
    if (rank(MPI_COMM_WORLD) == 0) {
      EXPECT_EQ(std::string(text, size), verbose ? "newton 3\na tube\n" : "a tube\n");
    }
    std::free(text);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  const std::string text = file.text();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4) << text;
}

TEST(Log, KeepsTheStatusLineBelowMessagesOnATerminal) {
  const Colours colours("1", "xterm");
  const Terminal terminal;
  Log log(MPI_COMM_WORLD, {.screen = terminal.stream});
  EXPECT_TRUE(log.on_terminal());
  if (rank(MPI_COMM_WORLD) != 0) return;
  EXPECT_EQ(log.columns(), 60);
  log.status("half way");
  EXPECT_EQ(terminal.text(), "\r\033[Khalf way");
  log.error("residual grows");
  EXPECT_EQ(terminal.text(), "\r\033[Kerror: residual grows\r\nhalf way");
  log.status("");
  EXPECT_EQ(terminal.text(), "\r\033[K");
  log.info("done");
  EXPECT_EQ(terminal.text(), "done\r\n");
}

TEST(Progress, FormatsDurations) {
  EXPECT_EQ(format_duration(7.4), "0:07");
  EXPECT_EQ(format_duration(59.7), "1:00");
  EXPECT_EQ(format_duration(11045), "3:04:05");
  EXPECT_EQ(format_duration(std::nullopt), "?");
}

TEST(Progress, FitsTheBarToTheTerminal) {
  EXPECT_EQ(format_bar("fsi", 0.5, 12.0, "t 4 ms", 46), "fsi [########.........]  50 % ETA 0:12 t 4 ms");
  EXPECT_EQ(format_bar("fsi", 0, std::nullopt, "", 200), "fsi [" + std::string(40, '.') + "]   0 % ETA ?");
  EXPECT_EQ(format_bar("fsi", 2, 0.0, "", 200), "fsi [" + std::string(40, '#') + "] 100 % ETA 0:00");
  EXPECT_LE(format_bar("fsi", 0.3, 1e5, std::string(500, 'x'), 80).size(), 79u);
}

TEST(Progress, WritesTenPlainLinesWhereThereIsNoTerminal) {
  const SharedFile file;
  double now = 0;
  {
    Log log(MPI_COMM_WORLD, {.file = file.path, .screen = nullptr});
    Progress progress(log, "fsi", 20, 120, [&] { return now; });  // continued at step 20
    for (int step = 21; step <= 120; ++step) {
      now += 0.5;
      progress.update(step, step == 120 ? "last" : "");
    }
  }
  MPI_Barrier(MPI_COMM_WORLD);
  const std::string text = file.text();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10) << text;
  EXPECT_NE(text.find("fsi 10 %, ETA 0:45\n"), std::string::npos) << text;
  EXPECT_NE(text.find("fsi 100 %, ETA 0:00, last\n"), std::string::npos) << text;
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(Progress, SpeaksAtLeastEveryMinute) {
  const SharedFile file;
  double now = 0;
  {
    Log log(MPI_COMM_WORLD, {.file = file.path, .screen = nullptr});
    Progress progress(log, "fsi", 0, 1000, [&] { return now; });
    for (int step = 1; step <= 6; ++step) {
      now += 25;
      progress.update(step);
    }
  }
  MPI_Barrier(MPI_COMM_WORLD);
  const std::string text = file.text();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(Progress, DrawsAndRemovesTheBarOnATerminal) {
  const Terminal terminal;
  Log log(MPI_COMM_WORLD, {.screen = terminal.stream});
  if (rank(MPI_COMM_WORLD) != 0) return;
  double now = 0;
  {
    Progress progress(log, "mesh", 0, 4, [&] { return now; });
    now = 10;
    progress.update(1);
    EXPECT_EQ(terminal.text(), "\r\033[K" + format_bar("mesh", 0.25, 30.0, "", 60));
    now = 10.01;
    progress.update(2);  // too soon after the last one to be drawn
  }
  EXPECT_EQ(terminal.text(), "\r\033[K");
}

TEST(Log, GoesOnWithoutAScreenThatTakesNoMore) {
  const SharedFile file;
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  const auto earlier = std::signal(SIGPIPE, SIG_IGN);
  std::FILE* screen = fdopen(ends[1], "w");
  {
    Log log(MPI_COMM_WORLD, {.file = file.path, .screen = screen});
    log.info("first");
    log.warning("second");
    log.note_error("third");
  }
  std::fclose(screen);
  std::signal(SIGPIPE, earlier);
  MPI_Barrier(MPI_COMM_WORLD);
  const std::string text = file.text();
  for (const char* line : {"first", "the screen takes no more messages (Broken pipe)", "second", "third"})
    EXPECT_NE(text.find(line), std::string::npos) << line << " in " << text;
  EXPECT_EQ(text.find("takes no more"), text.rfind("takes no more"));
}

}  // namespace
}  // namespace tunica::parallel
