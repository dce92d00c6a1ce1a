// Reads damaged files of a corpus: fuzz_<target> CORPUS [--runs N] [--seed S] [--first N] [--keep FOLDER]
//
// Every input is read in a child process, thousands in one. An input fails that ends the child (a signal, a report of a
// sanitizer, exit()), throws anything else than InputError or SolverError, takes longer than `longest_read` or memory
// beyond `most_memory`. It is kept (in tunica_fuzz of the folder for temporary files, unless FOLDER is named), the
// child is started again behind it, and the exit code is 1 in the end.
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <new>
#include <string_view>
#include <vector>

#include "fuzz/mutation.hpp"
#include "fuzz/target.hpp"
#include "tunica/base/error.hpp"

#ifdef __SANITIZE_ADDRESS__
constexpr bool sanitized = true;
// One allocation of a gigabyte is a report. A short quarantine, so that memory in use can be measured.
extern "C" const char* __asan_default_options() {
  return "max_allocation_size_mb=1024:quarantine_size_mb=16:handle_abort=1:allocator_may_return_null=0";
}
extern "C" const char* __ubsan_default_options() { return "print_stacktrace=1"; }
// VTK 9.1 loses the array that a damaged compressed block was to be unpacked to.
extern "C" const char* __lsan_default_suppressions() { return "leak:vtkUnsignedCharArray::New\n"; }
extern "C" int __lsan_do_recoverable_leak_check();
bool leaks() { return __lsan_do_recoverable_leak_check() != 0; }
#else
constexpr bool sanitized = false;
bool leaks() { return false; }
#endif

namespace tunica::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr int longest_read = 10;          // s, of one input; a sanitizer takes its share
constexpr long most_memory = 512 * 1024;  // KiB that one input may add
constexpr int most_failures = 10;

struct Entry {
  std::string kind, ending, bytes;
  fs::path path;
  bool whole;  ///< has to be accepted; those that a search has found need not
};

struct Options {
  fs::path corpus, keep = fs::temp_directory_path() / "tunica_fuzz";
  std::uint64_t runs = 1000, seed = 1, first = 0;
  bool leaks_each = false;
};

/// What the child tells its parent, in memory that they share.
struct Progress {
  std::uint64_t next = 0;  ///< input that is read, or will be
  std::uint64_t read = 0, refused = 0, slowest = 0;
  double slowest_seconds = 0;
  bool done = false;
  char why[1000] = {};  ///< empty: the child ended by itself
};

std::string slurp(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

/// All endings: ".nii.gz" of "tube.nii.gz".
std::string ending_of(const fs::path& file) {
  const auto name = file.filename().string();
  const auto dot = name.find('.');
  return dot == std::string::npos ? "" : name.substr(dot);
}

void add_entries(const fs::path& folder, bool whole, std::vector<Entry>& entries) {
  for (const auto& kind : fs::directory_iterator(folder)) {
    const auto name = kind.path().filename().string();
    if (!kind.is_directory() || name == "beside" || name == "found") continue;
    for (const auto& file : fs::directory_iterator(kind))
      entries.push_back({name, ending_of(file), slurp(file), file.path(), whole});
  }
}

std::vector<Entry> read_corpus(const fs::path& folder) {
  std::vector<Entry> entries;
  add_entries(folder, true, entries);
  if (fs::exists(folder / "found")) add_entries(folder / "found", false, entries);
  std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return entries;
}

struct Input {
  std::string kind, ending, bytes;
};

/// The corpus itself first, then what its seed and number make of it.
Input input(const std::vector<Entry>& corpus, std::uint64_t seed, std::uint64_t number) {
  if (number < corpus.size()) return {corpus[number].kind, corpus[number].ending, corpus[number].bytes};
  Random random(seed * 0x2545f4914f6cdd1dULL + number);
  const auto& entry = corpus[random.below(corpus.size())];
  std::vector<const Entry*> alike;
  for (const auto& other : corpus)
    if (other.kind == entry.kind && other.ending == entry.ending) alike.push_back(&other);
  const auto& other = *alike[random.below(alike.size())];
  return {entry.kind, entry.ending, mutated(entry.bytes, other.bytes, random)};
}

long peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

[[noreturn]] void fail(Progress& progress, const std::string& why) {
  std::snprintf(progress.why, sizeof progress.why, "%s", why.c_str());
  _exit(1);
}

/// Reads one file; why it is refused, empty when it is not.
std::string refusal(const fs::path& file, const std::string& kind, Progress& progress) {
  try {
    read_one(file, kind);
  } catch (const InputError& error) {
    return error.what();
  } catch (const SolverError& error) {
    return error.what();
  } catch (const std::exception& error) {
    fail(progress, std::string("another exception: ") + typeid(error).name() + ": " + error.what());
  } catch (...) {
    fail(progress, "an exception that is no std::exception");
  }
  return {};
}

void set_timer(int seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = seconds;
  setitimer(ITIMER_REAL, &timer, nullptr);
}

/// The child: all inputs from `progress.next` on.
[[noreturn]] void read_all(const std::vector<Entry>& corpus, const Options& options, const fs::path& folder,
                           Progress& progress) {
  using Clock = std::chrono::steady_clock;
  if (!sanitized) {
    // Sanitizers reserve terabytes of addresses; elsewhere a wild allocation shall fail as it does on a small machine.
    const rlimit addresses{std::size_t{4} << 30, std::size_t{4} << 30};
    setrlimit(RLIMIT_AS, &addresses);
  }
  fs::current_path(folder);  // a core file or what a reader writes stays here
  start_target();
  for (; progress.next < options.first + options.runs; ++progress.next) {
    const auto in = input(corpus, options.seed, progress.next);
    const auto file = folder / ("input" + in.ending);
    write(file, in.bytes);
    const long memory = peak_memory();
    const auto start = Clock::now();
    set_timer(longest_read);
    const auto refused = refusal(file, in.kind, progress);
    set_timer(0);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (!refused.empty() && progress.next < corpus.size() && corpus[progress.next].whole)
      fail(progress, "of the corpus is refused: " + refused);
    if (peak_memory() - memory > most_memory)
      fail(progress, "takes " + std::to_string((peak_memory() - memory) / 1024) + " MiB of memory");
    if (options.leaks_each && leaks()) fail(progress, "leaks memory");
    ++(refused.empty() ? progress.read : progress.refused);
    if (seconds > progress.slowest_seconds) progress.slowest_seconds = seconds, progress.slowest = progress.next;
  }
  progress.done = true;
  std::exit(0);  // LeakSanitizer looks at what is left
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
    return "takes longer than " + std::to_string(longest_read) + " s";
  if (WIFSIGNALED(status)) return std::string("ended by a signal: ") + strsignal(WTERMSIG(status));
  return "ended with exit code " + std::to_string(WEXITSTATUS(status)) + ", see the report above";
}

void keep(const std::vector<Entry>& corpus, const Options& options, std::uint64_t number, const std::string& why) {
  const auto in = input(corpus, options.seed, number);
  fs::create_directories(options.keep);
  const auto file = options.keep / ("failed_" + std::string(target_name) + "_" + in.kind + "_" +
                                    std::to_string(options.seed) + "_" + std::to_string(number) + in.ending);
  write(file, in.bytes);
  std::printf("FAILED: input %llu %s\n  kept in %s\n", static_cast<unsigned long long>(number), why.c_str(),
              file.c_str());
  if (number < corpus.size()) std::printf("  which is %s\n", corpus[number].path.c_str());
}

/// A folder for a child, with the files that inputs name and nothing that another child has left.
void prepare_folder(const fs::path& folder, const fs::path& beside) {
  fs::remove_all(folder);
  fs::create_directories(folder);
  if (fs::exists(beside)) fs::copy(beside, folder, fs::copy_options::recursive);
}

/// Runs children until all inputs are read; returns how many failed.
int run(const std::vector<Entry>& corpus, const Options& options, const fs::path& folder, Progress& progress) {
  int failures = 0;
  progress.next = options.first;
  while (!progress.done && failures < most_failures) {
    progress.why[0] = '\0';
    prepare_folder(folder, options.corpus / "beside");
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child < 0) throw SolverError(std::string("cannot start a process: ") + std::strerror(errno));
    if (child == 0) read_all(corpus, options, folder, progress);
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && progress.done) break;
    ++failures;
    if (progress.done)
      std::printf("FAILED: %s after the last input; --leaks-each tells which one leaks\n",
                  how_it_ended(status).c_str());
    else
      keep(corpus, options, progress.next++, progress.why[0] ? progress.why : how_it_ended(status));
  }
  return failures;
}

Options parse_options(int argc, char** argv) {
  Options options;
  const auto number = [&](int& i) {
    std::uint64_t value = 0;
    const std::string_view text = i + 1 < argc ? argv[++i] : "";
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc() || end != text.data() + text.size())
      throw InputError(argv[i], "is no number", "give one");
    return value;
  };
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--runs")
      options.runs = number(i);
    else if (argument == "--seed")
      options.seed = number(i);
    else if (argument == "--first")
      options.first = number(i);
    else if (argument == "--leaks-each")
      options.leaks_each = true;
    else if (argument == "--keep" && i + 1 < argc)
      options.keep = fs::absolute(argv[++i]);
    else
      options.corpus = fs::absolute(argument);
  }
  if (!fs::is_directory(options.corpus))
    throw InputError(
        options.corpus.string(), "is no folder",
        "fuzz_<target> CORPUS [--runs N] [--seed S] [--first N] [--keep FOLDER] [--leaks-each], or a file");
  return options;
}

/// A single file in place of a corpus: reads it in this process, for a debugger. Its folder is its kind.
int read_file(const fs::path& file, const std::string& kind) {
  start_target();
  try {
    read_one(fs::absolute(file), kind);
    std::printf("read\n");
  } catch (const InputError& error) {
    std::printf("refused: %s\n", error.what());
  } catch (const SolverError& error) {
    std::printf("refused: %s\n", error.what());
  }
  return 0;
}

int main(int argc, char** argv) {
  if (argc == 3 && fs::is_regular_file(argv[1])) return read_file(argv[1], argv[2]);
  const auto options = parse_options(argc, argv);
  const auto corpus = read_corpus(options.corpus);
  if (corpus.empty()) throw InputError(options.corpus.string(), "holds no entries", "add one: <kind>/<name>.<ending>");
  void* shared = mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) throw SolverError("no memory to share");
  auto& progress = *new (shared) Progress;
  const auto folder = fs::temp_directory_path() / ("tunica_fuzz_" + std::to_string(getpid()));
  const int failures = run(corpus, options, folder, progress);
  fs::remove_all(folder);
  std::printf(
      "fuzz %s, seed %llu: %llu inputs of %zu files, %llu read, %llu refused, %d failed; slowest %.2f s (%llu)\n",
      target_name, static_cast<unsigned long long>(options.seed),
      static_cast<unsigned long long>(progress.next - options.first), corpus.size(),
      static_cast<unsigned long long>(progress.read), static_cast<unsigned long long>(progress.refused), failures,
      progress.slowest_seconds, static_cast<unsigned long long>(progress.slowest));
  return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace tunica::fuzz

int main(int argc, char** argv) {
  try {
    return tunica::fuzz::main(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
