// The file of `tunica study`: which keys of a case take which values, and what is looked at.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tunica/config/schema.hpp"

namespace tunica::case_file {

enum class Spacing { linear, log };

/// The values of one key: exactly one of `values`, `from`/`to`/`count`, `between`.
struct VariedKey {
  std::vector<std::string> values{};    ///< YAML, as the case would have them
  std::optional<std::string> from, to;  ///< with unit
  std::optional<int> count;
  std::vector<std::string> between{};  ///< two ends, with unit
  Spacing scale = Spacing::linear;
};

struct GridDesign {};  ///< every value of each key with every value of the others
struct ListDesign {};  ///< the first values of all keys, the second ones, ...
struct LatinHypercubeDesign {
  int points = 0;
  std::int64_t seed = 1;
};
struct SobolDesign {
  int points = 0;
  std::int64_t seed = 1;
};
struct SaltelliDesign {
  int points = 0;  ///< of each of its blocks
  std::int64_t seed = 1;
};
using Design = std::variant<GridDesign, ListDesign, LatinHypercubeDesign, SobolDesign, SaltelliDesign>;

struct StudyCase {
  std::string title;
  std::filesystem::path case_file;
  std::vector<std::pair<std::string, VariedKey>> vary{};
  Design design = GridDesign{};
  std::vector<std::string> quantities{};  ///< patterns of paths in post.json; empty: those of `tunica converge`
  std::filesystem::path output;

  static config::Schema<StudyCase> schema();
};

/// Throws InputError with all problems of the file.
config::Parsed<StudyCase> read_study_case(const std::filesystem::path& file);

/// A number as text, and what follows it: "1.5 mm" is 1.5 and "mm". None where the text does not begin with a number.
std::optional<std::pair<double, std::string>> number_and_unit(const std::string& text);

/// One key in all points.
struct VariedAxis {
  std::string key;       ///< with dots
  bool numeric = false;  ///< all its values are numbers with the same unit
  bool log = false;      ///< spaced so
  std::string unit{};    ///< of numbers; empty: none

  std::string label() const;  ///< "wall.density [kg/m^3]"
};

struct StudyPoint {
  std::vector<std::string> values;  ///< one for each key, in YAML, units kept
  std::vector<double> numbers;      ///< the same in the unit of the axis; its place among the names, from 1, else

  /// "wall.density = 1100 kg/m^3, time.step = 1 ms".
  std::string text(const std::vector<VariedAxis>& axes) const;
};

struct StudyPoints {
  std::vector<VariedAxis> axes;
  std::vector<StudyPoint> points;
};

/// Points of the design, in an order that depends on the file alone: in a grid the last key changes fastest. Throws
/// InputError with all problems: ends with different units or in the wrong order, keys that do not go with the design,
/// lists of different length, equal points, more than 10 000 of them.
StudyPoints study_points(const StudyCase& study);

}  // namespace tunica::case_file
