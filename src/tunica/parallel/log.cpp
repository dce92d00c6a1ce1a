#include "tunica/parallel/log.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <system_error>
#include <utility>

#include "tunica/base/error.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::parallel {

namespace {

constexpr const char* erase_line = "\r\033[K";

std::string time_stamp() { return fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(std::time(nullptr))); }

/// Error number, 0: none. Unlike fmt::print it does not throw: no log is worth a run.
int put(std::FILE* stream, const std::string& text) {
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), stream) == text.size() && std::fflush(stream) == 0;
  return written ? 0 : errno;
}

}  // namespace

bool is_terminal(std::FILE* stream) {
  if (isatty(fileno(stream)) == 0) return false;
  if (stream != stdout || std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) return true;
  // The parent is mpirun, or on another node its daemon, which writes to no terminal.
  std::error_code unreadable;
  const auto target = std::filesystem::read_symlink(fmt::format("/proc/{}/fd/1", getppid()), unreadable).string();
  return !unreadable && (target.starts_with("/dev/pts/") || target.starts_with("/dev/tty"));
}

bool is_coloured(std::FILE* stream) {
  const char *none = std::getenv("NO_COLOR"), *term = std::getenv("TERM");
  return is_terminal(stream) && (none == nullptr || *none == '\0') && (term == nullptr || std::string(term) != "dumb");
}

Log::Log(MPI_Comm comm, const Targets& targets) : verbose_(targets.verbose) {
  on_root(comm, [&] {
    screen_ = targets.screen;
    coloured_ = screen_ != nullptr && is_coloured(screen_);
    on_terminal_ = screen_ != nullptr && is_terminal(screen_);
    if (targets.file.empty()) return;
    name_ = targets.file;
    file_ = std::fopen(targets.file.c_str(), "a");
    if (file_ == nullptr)
      throw InputError(targets.file.string(), fmt::format("the log file cannot be written ({})", std::strerror(errno)),
                       "choose a folder that exists and is writable");
  });
  broadcast(comm, on_terminal_);
}

Log::~Log() {
  status("");
  if (file_ != nullptr && std::fclose(std::exchange(file_, nullptr)) != 0) give_up_file(errno);
}

void Log::info(std::string_view text) { write("info", text); }
void Log::detail(std::string_view text) {
  if (verbose_) write_to_screen("info", text);
  write_to_file("info", text);
}
void Log::heading(std::string_view text) {
  write_to_screen("heading", text);
  write_to_file("info", text);
}
void Log::warning(std::string_view text) { write("warning", text); }
void Log::error(std::string_view text) { write("error", text); }

std::string Log::coloured(std::string_view kind, std::string_view text) const {
  const bool named = kind != "info" && kind != "heading";
  const std::string plain = named ? fmt::format("{}: {}", kind, text) : std::string(text);
  if (!coloured_ || kind == "info") return plain;
  if (kind == "heading") return fmt::format("\033[1m{}\033[0m", plain);
  return fmt::format("\033[{}m{}:\033[0m {}", kind == "error" ? "1;31" : "1;33", kind, text);  // red, yellow
}

void Log::write_to_screen(std::string_view kind, std::string_view text) {
  if (screen_ == nullptr) return;
  const std::string line = fmt::format("{}{}\n{}", status_.empty() ? "" : erase_line, coloured(kind, text), status_);
  if (const int error = put(screen_, line); error != 0) give_up_screen(error);
}

void Log::write(std::string_view kind, std::string_view text) {
  write_to_screen(kind, text);
  write_to_file(kind, text);
}

void Log::give_up_screen(int error) {
  screen_ = nullptr;
  write_to_file("warning", fmt::format("the screen takes no more messages ({}): they are in this file alone",
                                       std::strerror(error)));
}

void Log::write_to_file(std::string_view kind, std::string_view text) {
  if (file_ == nullptr) return;
  if (const int error = put(file_, fmt::format("{} {:7} {}\n", time_stamp(), kind, text)); error != 0)
    give_up_file(error);
}

void Log::give_up_file(int error) {
  if (file_ != nullptr) std::fclose(std::exchange(file_, nullptr));
  write_to_screen("warning", fmt::format("the log {} cannot be written any more ({}); the lines from here on are "
                                         "missing in it, and the run goes on",
                                         name_.string(), std::strerror(error)));
}

void Log::status(std::string_view line) {
  if (screen_ == nullptr || !on_terminal_ || (line.empty() && status_.empty())) return;
  status_ = line;
  if (const int error = put(screen_, fmt::format("{}{}", erase_line, status_)); error != 0) give_up_screen(error);
}

int Log::columns() const {
  winsize size{};
  const bool known = screen_ != nullptr && ioctl(fileno(screen_), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

}  // namespace tunica::parallel
