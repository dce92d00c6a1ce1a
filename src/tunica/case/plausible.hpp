// Values that come from files, or follow from several keys: as unusual as a typed one may be, and likely a slip of the
// unit or the sign. The limits and their reasons are in docs/inputs.md.
#pragma once

#include <string>
#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/bc/waveform.hpp"

namespace tunica::case_file {

struct Case;

/// One warning for each thing: size and period of tables, sign of the inflow, pressure that inflow and outlets give
/// together, time constants of Windkessels, steps in a period, fineness of a mesh to be made. Reads the tables again.
/// Throws as bc::make_waveform.
std::vector<Problem> implausible_values(const Case& c);

/// The part of it that looks at the outlets, for those that were tuned.
std::vector<Problem> implausible_outlets(const Case& c);

/// Elements across the lumen that the velocity of the case needs (docs/meshing.md), and how to come to them.
double enough_across(const Case& c);
std::string remedy_across(const Case& c);

/// Largest size that a course reaches, in SI units, the ramp left aside. Reads its table, if it has one.
double largest_size(const bc::WaveformInput& input);

}  // namespace tunica::case_file
