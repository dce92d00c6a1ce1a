// Pictures one after the other as a movie, by the program ffmpeg.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace tunica::drawing {

/// Pixels go through a pipe to ffmpeg, which writes beside the file and is taken over when it is whole.
class Movie {
 public:
  /// `file`: .webm (VP9) or .gif (256 colours chosen for the movie); sizes are even. Throws SolverError.
  Movie(std::string file, int width, int height, double frames_per_second);
  ~Movie();
  Movie(const Movie&) = delete;
  Movie& operator=(const Movie&) = delete;

  /// Rows from the top, three bytes a pixel. Throws SolverError where ffmpeg has ended.
  void add(const std::vector<std::uint8_t>& pixels);
  /// The file is there, or SolverError says why not.
  void finish();

  /// Throws SolverError where there is no ffmpeg in the path.
  static void demand_encoder();

 private:
  std::string file_, partial_;
  int pipe_ = -1;
  pid_t encoder_ = -1;
};

}  // namespace tunica::drawing
