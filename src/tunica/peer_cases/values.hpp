// Values as the peers read them, and the traps in that.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tunica/peer_cases/entry.hpp"

namespace tunica::peer_cases {

/// What is wrong with a text that should be a value.
struct ValueError {
  std::string what, remedy;
};

struct ReadNumber {
  double value = 0.0;
  std::optional<ValueError> error = {};
};
struct ReadVector {
  std::vector<double> values = {};
  std::optional<ValueError> error = {};
};
struct ReadFlag {
  bool value = false;
  std::optional<ValueError> error = {};
};

/// The whole text is one finite number. An exponent after D is one in .inp files, which Fortran reads; svMultiPhysics
/// stops in front of it and takes 1.5D-4 for 1.5, so there it is an error.
ReadNumber read_number(std::string_view text, Dialect dialect);
/// The whole text is an integer of the peers, digits alone with a sign or without. svMultiPhysics stops in front of
/// anything else and takes 1e3 for 1.
ReadNumber read_integer(std::string_view text, Dialect dialect);
/// Has a file of numbers one with an exponent after D? Not where there is no file.
bool holds_fortran_exponents(const std::filesystem::path& file);
/// Numbers between commas, semicolons or blanks, with or without ( ) or { } around.
ReadVector read_vector(std::string_view text, Dialect dialect,
                       ReadNumber (*component)(std::string_view, Dialect) = read_number);
/// true, false, 1, 0; in .inp files also t, f, and all in either case.
ReadFlag read_flag(std::string_view text, Dialect dialect);

/// A number as case files have it: the digits of the file where they read the same there.
std::string number_text(double value);

}  // namespace tunica::peer_cases
