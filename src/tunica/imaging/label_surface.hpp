// From a labelled image to the lumen surface that a wall is grown around.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/config/schema.hpp"
#include "tunica/imaging/lumen_mask.hpp"
#include "tunica/imaging/vessel_ends.hpp"

namespace tunica::imaging {

/// A vessel end: the flat face nearest to `centre`, or, with a normal, where the vessel is to be cut.
struct ImageOpening {
  Point centre{};                      ///< m
  std::optional<Vec3<double>> normal;  ///< out of the vessel, of any length

  static config::Schema<ImageOpening> schema();
};

struct SurfaceSettings {
  LumenLabels labels;
  double smoothing = 0.85;                                       ///< standard deviation of the filter [voxels]
  std::vector<std::pair<std::string, ImageOpening>> openings{};  ///< none: all flat ends that are found
  std::string inlet{};  ///< name of an opening; empty: the first one, or the widest end

  static void add_to(config::Schema<SurfaceSettings>& schema);
};

struct LabelSurface {
  geometry::TriangleSurface lumen;  ///< open at the vessel ends, with plane rims and outward normals
  std::vector<VesselEnd> ends;      ///< in the order of the openings that were given
  std::vector<Contact> tears;
};

/// The lumen's surface between the voxels, smooth, cut open at the vessel ends. The log gets what was cleaned, where
/// ends and tears are, and a warning where the flap is not as the labels have it. InputError for labels that are
/// missing or not connected, for ends that cannot be found, vessels that run out of the image elsewhere, and an inlet
/// without true lumen; SolverError for vessels that cannot be cut apart.
LabelSurface surface_of(const LabelImage& image, const SurfaceSettings& settings, const Log& log);

}  // namespace tunica::imaging
