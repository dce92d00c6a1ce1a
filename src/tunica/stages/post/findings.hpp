// All that `tunica post` has found, on rank 0, before it becomes files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/stages/manifest.hpp"
#include "tunica/stages/post/cycle.hpp"
#include "tunica/stages/post/frame_figures.hpp"

namespace tunica::stages::post {

/// The part of the results that is looked at.
struct Window {
  double from = 0, until = 0;        ///< first and last instant [s]
  std::size_t first = 0, count = 0;  ///< frames of the series
};

/// Throws InputError when the results do not cover it, or fewer than three fields lie in it. Adds a warning where its
/// ends lie between two fields.
Window choose_window(const std::vector<double>& times, const PostSettings& settings, const std::string& results,
                     std::vector<std::string>& warnings);

/// An opening over the window, from the history with every step.
struct OpeningHistory {
  std::string name;
  std::vector<double> times, flow, pressure;  ///< s, m^3/s outwards, Pa
};
/// Throws InputError when faces.csv is missing or does not cover the window.
std::vector<OpeningHistory> read_openings(const std::filesystem::path& results, const Case& c, const Vessel& vessel,
                                          const Window& window);

struct Findings {
  ProgramVersion program;
  std::filesystem::path case_file, results;
  std::string title;
  const PostSettings& settings;
  const mesh::MeshData& data;
  const Vessel& vessel;
  Window window;
  std::vector<double> times;  ///< of the frames in the window [s]
  const FigureTable& figures;
  const FrameFigures& frames;
  const CycleFields& fields;
  std::vector<OpeningHistory> openings;
  std::vector<LeftOut> left_out;
  std::vector<std::string> warnings;
  double seconds = 0;

  bool has_stations() const { return !vessel.stations.empty(); }
  bool has_flap() const { return figures.has(column::flap_mean); }
  /// Frame with the highest mean pressure at the inlet; without flow that with the highest mean stress of the wall.
  std::size_t peak() const;
  /// Course of the net flow through all tears into the false lumen, and through its openings out of it [m^3/s].
  std::vector<double> flow_through_tears() const;
  std::vector<double> flow_out_of_false_lumen() const;
  /// Index in vessel.tears of the one with the largest volume into the false lumen.
  std::size_t entry_tear() const;
};

}  // namespace tunica::stages::post
