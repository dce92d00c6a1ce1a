#include "tunica/motion_imaging/synthetic_phases.hpp"

#include "tunica/flow_imaging/lumen_samples.hpp"
#include "tunica/imaging/synthetic_scan.hpp"

namespace tunica::motion_imaging {

imaging::LabelImage phase_image(const mesh::MeshData& data, std::span<const Vec3<double>> points,
                                std::span<const double> side, const imaging::ImageFrame& frame,
                                const imaging::ScanSettings& settings, std::uint64_t phase) {
  const auto count = static_cast<std::size_t>(frame.count());
  std::vector<float> of_true(count), of_false(count);
  constexpr float part = 1.0F / flow_imaging::samples_in_voxel;
  for (const auto& region : data.regions) {
    if (region.kind != mesh::RegionKind::lumen) continue;
    const auto elements = std::span(data.tetrahedra)
                              .subspan(static_cast<std::size_t>(region.first_element),
                                       static_cast<std::size_t>(region.end_element - region.first_element));
    for (const auto& sample : flow_imaging::lumen_samples(frame, points, elements)) {
      double value = side.empty() ? 1 : 0;
      const auto& nodes = elements[static_cast<std::size_t>(sample.element)];
      for (std::size_t a = 0; a < 4 && !side.empty(); ++a)
        value += sample.barycentric[a] * side[static_cast<std::size_t>(nodes[a])];
      (value >= 0 ? of_true : of_false)[static_cast<std::size_t>(sample.voxel)] += part;
    }
  }
  std::vector<float> intensity(count);
  for (std::size_t n = 0; n < count; ++n) intensity[n] = of_true[n] + of_false[n];
  auto noisy = settings;
  noisy.seed += static_cast<std::int64_t>(phase);
  imaging::LabelImage image{frame, std::vector<std::int16_t>(count)};
  const auto lumen = imaging::seen_as_lumen(frame, std::move(intensity), noisy);
  if (side.empty()) {
    for (std::size_t n = 0; n < count; ++n) image.labels[n] = lumen[n] != 0 ? imaging::scan_true_lumen : 0;
    return image;
  }
  // Voxels that blur or noise have made lumen belong to the lumen that is nearer, as far as blur sees.
  imaging::blur_as_seen(frame, noisy, of_true);
  imaging::blur_as_seen(frame, noisy, of_false);
  for (std::size_t n = 0; n < count; ++n)
    if (lumen[n] != 0)
      image.labels[n] = of_true[n] >= of_false[n] ? imaging::scan_true_lumen : imaging::scan_false_lumen;
  return image;
}

}  // namespace tunica::motion_imaging
