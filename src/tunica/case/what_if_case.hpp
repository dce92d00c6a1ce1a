// The file of `tunica what-if`: one case with another anatomy or other loads.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/config/schema.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::case_file {

/// A hole in the flap.
struct NewTear {
  double position = 0;  ///< along the aorta from the inlet [m]
  double area = 0;      ///< m^2
};

/// A stretch of the wall with a law of its own, sealed towards the false lumen.
struct Sleeve {
  double from = 0, to = 0;                                      ///< along the aorta from the inlet [m]
  std::vector<std::string> regions{"true_lumen_wall", "flap"};  ///< of the wall, that it lines
  wall::RegionMaterial material;                                ///< of wall and graft together
};

/// What is other than in the case. Factors are none where they are not given.
struct WhatIf {
  std::vector<std::string> close_tears{};  ///< tear_1, tear_2, ... downstream
  std::vector<NewTear> open_tears{};
  std::optional<Sleeve> sleeve{};
  std::optional<double> pressure{}, heart_rate{}, stroke_volume{};
  std::vector<std::string> set{};  ///< "key.of.the.case=value"

  bool changes_mesh() const { return !close_tears.empty() || !open_tears.empty() || sleeve; }
};

inline constexpr const char* sleeve_region = "sleeve";

struct WhatIfCase {
  std::string title;
  std::filesystem::path case_file;
  std::vector<std::pair<std::string, WhatIf>> variants{};
  std::filesystem::path output;

  static config::Schema<WhatIfCase> schema();
};

/// Throws InputError with all problems of the file.
config::Parsed<WhatIfCase> read_what_if_case(const std::filesystem::path& file);

}  // namespace tunica::case_file
