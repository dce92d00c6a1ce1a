// All that `tunica post` has found, on rank 0, before it becomes files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/analysis/cycle.hpp"
#include "tunica/analysis/frame_figures.hpp"
#include "tunica/artifacts/dissipation.hpp"
#include "tunica/artifacts/manifest.hpp"
#include "tunica/case/case.hpp"
#include "tunica/stages/post/lumen_flows.hpp"

namespace tunica::stages::post {

/// The part of the results that is looked at.
struct Window {
  double from = 0, until = 0;        ///< first and last instant [s]
  std::size_t first = 0, count = 0;  ///< frames of the series
};

/// Throws InputError when the results do not cover it, or fewer than three fields lie in it. Adds a warning where its
/// ends lie between two fields.
Window choose_window(const std::vector<double>& times, const analysis::PostSettings& settings,
                     const std::string& results, std::vector<std::string>& warnings);

/// An opening over the window, from the history with every step.
struct OpeningHistory {
  std::string name;
  std::vector<double> times, flow, pressure;  ///< s, m^3/s outwards, Pa
};
/// Throws InputError when faces.csv is missing or does not cover the window.
std::vector<OpeningHistory> read_openings(const std::filesystem::path& results, const case_file::Case& c,
                                          const analysis::Vessel& vessel, const Window& window);

/// What the run has written of its lumens. None, with the reason in `why`, where it has not written it for the window.
/// Throws InputError when a file does not read or lacks steps of the window.
std::optional<artifacts::LumenSeries> read_lumens(const std::filesystem::path& results, const Window& window,
                                                  std::string& why);

struct Findings {
  artifacts::ProgramVersion program;
  std::filesystem::path case_file, results;
  std::string title;
  const analysis::PostSettings& settings;
  const mesh::MeshData& data;
  const analysis::Vessel& vessel;
  Window window;
  std::vector<double> times;  ///< of the frames in the window [s]
  const analysis::FigureTable& figures;
  const analysis::FrameFigures& frames;
  const analysis::CycleFields& fields;
  std::vector<OpeningHistory> openings;
  std::vector<analysis::LeftOut> left_out;
  std::vector<std::string> warnings;
  double seconds = 0;
  std::optional<artifacts::Dissipation> dissipation{};  ///< over the window; none without flow
  std::optional<LumenFlows> lumens{};                   ///< none where lumens are not told apart

  bool has_stations() const { return !vessel.stations.empty(); }
  bool has_flap() const { return figures.has(analysis::column::flap_mean); }
  /// Frame with the highest mean pressure at the inlet; without flow that with the highest mean stress of the wall.
  std::size_t peak() const;
  /// Those of `parts` of the lumen in which the scheme takes more from the flow than it may
  /// (artifacts/dissipation.hpp), of all parts where none is named. Where the run told no parts apart, the whole lumen.
  std::vector<std::string> too_dissipative(const std::vector<std::string>& parts = {}) const;
};

}  // namespace tunica::stages::post
