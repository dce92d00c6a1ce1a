// svZeroDSolver's files, as far as they are outlets that tunica has built in.
#pragma once

#include <filesystem>
#include <string>

namespace tunica::peer_cases {

/// A Windkessel, or a resistance (`proximal` alone), in the units of the file.
struct ZeroDOutlet {
  std::string name;  ///< of the boundary condition
  bool rcr = false;
  double proximal = 0.0, capacitance = 0.0, distal = 0.0, distal_pressure = 0.0;
};

/// What hangs on the coupling block of that name. Throws InputError where the file does not read, has no such block, or
/// where anything but one Windkessel or resistance hangs on it.
ZeroDOutlet read_zerod_outlet(const std::filesystem::path& file, const std::string& block);

}  // namespace tunica::peer_cases
