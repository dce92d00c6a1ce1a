// From a labelled image to the lumen surface that a wall is grown around.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/config/schema.hpp"
#include "tunica/imaging/flap.hpp"
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
  std::optional<double> smoothing_length{};                      ///< the same [m], in place of it
  std::vector<std::pair<std::string, ImageOpening>> openings{};  ///< none: all ends that are found
  std::string inlet{};  ///< name of an opening; empty: the first one, or the widest end
  FlapSettings flap{};
  TearBounds tears{};
  Repairs repairs{};
  std::optional<int> genus{};  ///< of the lumen; none: one less than there are tears

  static void add_to(config::Schema<SurfaceSettings>& schema);
};

struct LabelSurface {
  geometry::TriangleSurface lumen;             ///< open at the vessel ends, with plane rims and outward normals
  std::vector<VesselEnd> ends;                 ///< in the order of the openings that were given
  std::vector<Contact> tears;                  ///< as the labels have them
  std::vector<double> tear_areas{};            ///< in the surface [m^2]
  int parts = 1;                               ///< 2: true and false lumen are apart
  std::vector<std::uint8_t> of_false_lumen{};  ///< is each point of the lumen at the false one?
  std::optional<geometry::TriangleSurface>
      with_thrombus{};  ///< around lumen and thrombus together, where there is some
};

/// The lumen's surface between the voxels, smooth, cut open at the vessel ends. The log gets what was cleaned, where
/// ends and tears are. InputError for labels that are missing, unknown or not connected, that touch all along or make
/// rings, for ends that cannot be found, vessels that run out of the image elsewhere, an end wider than the inlet that
/// is not opened, and an inlet without true lumen; SolverError for vessels that cannot be cut apart and a surface whose
/// genus is not that of the tears.
LabelSurface surface_of(const LabelImage& image, const SurfaceSettings& settings, const Log& log);

}  // namespace tunica::imaging
