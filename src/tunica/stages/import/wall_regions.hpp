// Parts of a wall with materials of their own, by domains and by the angle between two families of fibres.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "tunica/case/case.hpp"
#include "tunica/peer_cases/translate.hpp"

namespace tunica::stages {

/// The angles from the first direction to the second, 0 to pi, in classes. Where they are the same in all cells up to
/// single precision there is one.
struct FibreAngles {
  std::vector<double> angles;          ///< mean of each class [rad], increasing
  std::vector<std::int32_t> class_of;  ///< [cell]
  double largest_deviation = 0.0;      ///< of a cell from its class [rad]
};

/// Throws InputError where a file does not read or has no cell array FIB_DIR of three components, where one is zero,
/// and where both have another number of cells. Not collective.
FibreAngles fibre_angles(const peer_cases::FibreFiles& files);

/// Writes the file that `wanted` names, the cell array REGION on the wall of `meshes`: the number of the region
/// (peer_cases::region_number) of the domain and of the class of every element. `angles` may have no class at all.
/// Throws InputError for a list of domains that does not read or has another number of elements, or one that has no
/// properties, SolverError when the file cannot be written. Not collective.
void write_wall_regions(const peer_cases::WallRegions& wanted, const FibreAngles& angles,
                        case_file::MeshSettings meshes, const std::filesystem::path& folder);

}  // namespace tunica::stages
