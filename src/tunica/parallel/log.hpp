// Messages of a run, to the screen and to a log file, from rank 0.
#pragma once

#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace tunica::parallel {

/// Whether what is written to `stream` ends on a terminal. Under Open MPI's mpirun standard output is always a
/// pseudo-terminal, so there the standard output of mpirun itself decides.
bool is_terminal(std::FILE* stream);

/// Whether colours are wanted there: on a terminal, unless NO_COLOR is set (https://no-color.org) or TERM is `dumb`.
bool is_coloured(std::FILE* stream);

/// All ranks call alike and rank 0 speaks; a finding of another rank travels to rank 0 first. Lines reach the file at
/// once, so that a run that dies leaves its log. A screen that takes no more (a closed pipe, a terminal that is gone)
/// is left alone from then on, and the file says so. A log that cannot be written any more (the disk is full) does not
/// end the run either: what counts are the results, whose writers throw. That is said once, on the screen.
class Log {
 public:
  struct Targets {
    std::filesystem::path file = {};  ///< appended to, with the time of each line; empty: no file
    std::FILE* screen = stdout;       ///< not owned; nullptr: no screen
    bool verbose = false;             ///< details to the screen as well
  };

  /// Throws InputError on all ranks if the file cannot be written. Collective.
  Log(MPI_Comm comm, const Targets& targets);
  ~Log();
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  void info(std::string_view text);
  /// What is looked up rather than read: into the file, and to the screen of a verbose run.
  void detail(std::string_view text);
  void warning(std::string_view text);
  void error(std::string_view text);
  /// An error that the screen is told of elsewhere: into the file alone.
  void note_error(std::string_view text) { write_to_file("error", text); }

  /// One line kept below all others on a terminal and replaced by the next call; empty removes it. Never in the file,
  /// and nothing at all where the screen is no terminal.
  void status(std::string_view line);

  /// A line of its own kind on the screen, bold on a terminal; as info() in the file.
  void heading(std::string_view text);

  /// Same on all ranks.
  bool on_terminal() const { return on_terminal_; }
  /// Width of the terminal on rank 0, 80 if it does not tell.
  int columns() const;

 private:
  void write(std::string_view kind, std::string_view text);
  void write_to_screen(std::string_view kind, std::string_view text);
  std::string coloured(std::string_view kind, std::string_view text) const;
  void write_to_file(std::string_view kind, std::string_view text);
  void give_up_screen(int error);
  void give_up_file(int error);

  std::filesystem::path name_;
  std::FILE* screen_ = nullptr;  // both null on ranks other than 0
  std::FILE* file_ = nullptr;
  bool on_terminal_ = false, verbose_ = false, coloured_ = false;
  std::string status_;
};

}  // namespace tunica::parallel
