#include "tunica/drawing/movie.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "tunica/base/error.hpp"

extern char** environ;

namespace tunica::drawing {

namespace fs = std::filesystem;

void Movie::demand_encoder() {
  std::istringstream folders(std::getenv("PATH") ? std::getenv("PATH") : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((fs::path(folder) / "ffmpeg").c_str(), X_OK) == 0) return;
  throw SolverError(
      "movies are encoded by ffmpeg, which is not installed: apt-get install ffmpeg, or write single pictures (.png)");
}

Movie::Movie(std::string file, int width, int height, double frames_per_second)
    : file_(std::move(file)), partial_(file_ + ".part") {
  const bool gif = file_.ends_with(".gif");
  const std::string size = fmt::format("{}x{}", width, height), rate = fmt::format("{:g}", frames_per_second);
  std::vector<std::string> words = {
      "ffmpeg", "-y",          "-loglevel", "error",      "-f", "rawvideo", "-pixel_format",
      "rgb24",  "-video_size", size,        "-framerate", rate, "-i",       "-"};
  const std::vector<std::string> kind =
      gif ? std::vector<std::string>{"-filter_complex", "split[a][b];[a]palettegen[p];[b][p]paletteuse", "-f", "gif"}
          : std::vector<std::string>{"-c:v", "libvpx-vp9", "-crf",    "28", "-b:v",
                                     "0",    "-pix_fmt",   "yuv420p", "-f", "webm"};
  words.insert(words.end(), kind.begin(), kind.end());
  words.push_back(partial_);
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw SolverError(fmt::format("no pipe to ffmpeg: {}", std::strerror(errno)));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  const int failed = posix_spawnp(&encoder_, "ffmpeg", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  pipe_ = ends[1];
  if (failed != 0) {
    encoder_ = -1;
    throw SolverError(fmt::format("ffmpeg cannot be started: {}", std::strerror(failed)));
  }
}

Movie::~Movie() {
  if (pipe_ >= 0) close(pipe_);
  if (encoder_ > 0) waitpid(encoder_, nullptr, 0);
  std::error_code ignored;
  fs::remove(partial_, ignored);
}

void Movie::add(const std::vector<std::uint8_t>& pixels) {
  // An encoder that has ended is an error of write(), not the end of this program.
  struct sigaction ignore = {}, before = {};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &ignore, &before);
  std::size_t done = 0;
  int error = 0;
  while (done < pixels.size() && error == 0) {
    const ssize_t wrote = write(pipe_, pixels.data() + done, pixels.size() - done);
    if (wrote >= 0)
      done += static_cast<std::size_t>(wrote);
    else if (errno != EINTR)
      error = errno;
  }
  sigaction(SIGPIPE, &before, nullptr);
  if (error != 0) throw SolverError(fmt::format("{}: ffmpeg has ended early: {}", file_, std::strerror(error)));
}

void Movie::finish() {
  close(pipe_);
  pipe_ = -1;
  int status = 0;
  waitpid(encoder_, &status, 0);
  encoder_ = -1;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw SolverError(fmt::format("{}: ffmpeg has failed, its message stands above", file_));
  fs::rename(partial_, file_);
}

}  // namespace tunica::drawing
