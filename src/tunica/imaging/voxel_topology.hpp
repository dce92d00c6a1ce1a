// The topology of a set of voxels, as the surface between its voxels and the others has it: `geometry::zero_surface`
// joins voxels of the set that share a face or an edge, and others that share a face.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "tunica/imaging/label_image.hpp"

namespace tunica::imaging {

/// Voxels that are in a set, one entry each; those at the border of the frame are not.
using VoxelSet = std::vector<std::uint8_t>;

/// Adding or removing a voxel that is simple changes neither parts nor cavities nor handles of the set (Bertrand &
/// Malandain 1994, Pattern Recognit. Lett. 15, 169-175: one part of the set and one of the rest beside it). `index` is
/// not at the border of the frame.
bool is_simple(const ImageFrame& frame, const VoxelSet& set, std::int64_t index);

inline constexpr double longest_way = 0.1;  // m; the way round a handle is not looked for farther

/// A place where a set closes to a ring, with the voxels that have to be taken out to open it.
struct Handle {
  std::vector<std::int64_t> voxels;
  double way = 0;  ///< from one side to the other, not through these voxels [m], up to `longest_way`; 0: none was found
};

/// Grows a ball to the largest part of `set` that has neither handles nor cavities, deep voxels first, so that a ring
/// is opened where it is thinnest. `depth`: of each voxel, larger inside. `set` becomes the result, which holds the
/// deepest voxel.
/// Returns what was left out though it hangs together with the rest.
std::vector<Handle> remove_handles(const ImageFrame& frame, const std::vector<float>& depth, VoxelSet& set);

/// Takes away fingers and lamellae that are thinner than two voxels (in no block of 2 x 2 x 2 voxels of the set), from
/// their free ends on, by simple voxels: the topology stays. Returns how many there were.
std::int64_t take_thin_ends(const ImageFrame& frame, VoxelSet& set);

/// The same for what pokes into the set: pits and notches thinner than two voxels, of voxels that `may` be filled, but
/// from their bottom no more than `steps` voxels on, so that vessels side by side are not joined.
std::int64_t fill_thin_pits(const ImageFrame& frame, const std::function<bool(std::int64_t)>& may, int steps,
                            VoxelSet& set);

/// Leaves the part of the set that has most voxels, joined by faces and edges; returns how many the others had.
std::int64_t keep_largest_part(const ImageFrame& frame, VoxelSet& set);

}  // namespace tunica::imaging
