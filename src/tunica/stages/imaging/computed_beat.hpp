// A beat that was computed, at any of its times: what synthetic images are made of.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/analysis/field_series.hpp"
#include "tunica/case/measured_settings.hpp"
#include "tunica/config/schema.hpp"

namespace tunica::stages {

/// Which beat is imaged, and where its truth is told.
struct ImagedBeat {
  std::filesystem::path case_file;
  std::optional<std::filesystem::path> results;  ///< folder of the fields, instead of that of the case
  double period = 0;                             ///< s
  std::optional<double> until;                   ///< end of the beat [s]; none: the last field
  std::vector<std::pair<std::string, case_file::MeasuredPlane>> planes;

  static config::Schema<ImagedBeat> schema();
};

/// Velocity and displacement of a run, between its fields by straight lines.
class ComputedBeat {
 public:
  /// `series` must outlive this; `results`: its folder, for messages. Throws InputError where the fields do not cover
  /// the beat.
  ComputedBeat(analysis::FieldSeries& series, double from, double until, const std::filesystem::path& results);

  struct State {
    std::vector<double> velocity, displacement;  ///< [node][3], m/s and m
  };
  /// Before the first field it is that one.
  State at(double t);

 private:
  /// References last until a later frame is asked for that lies two or more behind.
  const analysis::FieldFrame& frame(std::size_t number);

  analysis::FieldSeries& series_;
  std::map<std::size_t, analysis::FieldFrame> held_;
};

}  // namespace tunica::stages
