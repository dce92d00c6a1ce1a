// A moving mesh as gated CT and a segmentation would show it: labelled images with a known truth.
#pragma once

#include <span>
#include <vector>

#include "tunica/imaging/label_image.hpp"
#include "tunica/imaging/scan_settings.hpp"
#include "tunica/mesh/mesh_data.hpp"

namespace tunica::motion_imaging {

/// Partial volume of each voxel, blurred, with noise, cut at half the contrast: 1 in the lumen, or in the true one, 2
/// where `side`, a value of each node, is negative (empty: there is one lumen). `points`: where the nodes of the mesh
/// are at this phase [m]; `phase`: each has noise of its own.
imaging::LabelImage phase_image(const mesh::MeshData& data, std::span<const Vec3<double>> points,
                                std::span<const double> side, const imaging::ImageFrame& frame,
                                const imaging::ScanSettings& settings, std::uint64_t phase);

}  // namespace tunica::motion_imaging
