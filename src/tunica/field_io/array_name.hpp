// Names of arrays in results: the quantity and its unit.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace tunica::field_io {

/// "velocity [m s^-1]" for "velocity" and "m/s": HDF5 takes a slash for a folder, so divisors stand as negative powers.
std::string array_name(std::string_view quantity, std::string_view unit);

/// The two again: {"velocity", "m s^-1"}; no unit where none is given.
std::pair<std::string, std::string> name_and_unit(const std::string& array);

}  // namespace tunica::field_io
