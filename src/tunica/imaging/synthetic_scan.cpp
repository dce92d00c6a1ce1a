#include "tunica/imaging/synthetic_scan.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "tunica/imaging/gaussian.hpp"

namespace tunica::imaging {

namespace {

/// Axes turned about (1, 1, 1), and a grid that holds the whole box.
ImageFrame frame_around(const geometry::Box& box, double voxel, double tilt) {
  const double c = std::cos(tilt), s = std::sin(tilt) / std::sqrt(3.0), t = (1 - c) / 3;
  const Vec3<double> axes[3] = {{{c + t, t + s, t - s}}, {{t - s, c + t, t + s}}, {{t + s, t - s, c + t}}};
  const Point middle = 0.5 * (box.low + box.high);
  ImageFrame frame;
  frame.origin = middle;
  for (int a = 0; a < 3; ++a) {
    double half = 0;
    for (int d = 0; d < 3; ++d) half += 0.5 * std::abs(axes[a][d]) * (box.high[d] - box.low[d]);
    frame.size[a] = 2 * static_cast<std::int64_t>(half / voxel) + 2;
    frame.steps[a] = voxel * axes[a];
    frame.origin = frame.origin - (0.5 * static_cast<double>(frame.size[a] - 1)) * frame.steps[a];
  }
  return frame;
}

/// Share of each voxel that the lumen takes. A distance tells it where the surface is nearly plane: in eighths of a
/// voxel.
std::vector<float> shares_of_lumen(const geometry::DissectionModel& model, const ImageFrame& frame, double voxel) {
  const auto ramp = [](double distance, double width) { return std::clamp(0.5 - distance / width, 0.0, 1.0); };
  std::vector<float> distance(frame.count()), share(frame.count());
  for (std::int64_t i = 0; i < frame.count(); ++i)
    distance[i] = static_cast<float>(model.at(frame.place(frame.voxel(i))).lumen);
  for (std::int64_t i = 0; i < frame.count(); ++i) {
    const auto v = frame.voxel(i);
    bool mixed = std::abs(distance[i]) < 0.9 * voxel;
    // Where vessels end the function jumps.
    for_each_face_neighbour(frame, i, [&](std::int64_t other) { mixed |= (distance[other] < 0) != (distance[i] < 0); });
    double sum = 0;
    for (int part = 0; mixed && part < 8; ++part) {
      Point at;
      for (int d = 0; d < 3; ++d) at[d] = static_cast<double>(v[d]) + ((part >> d & 1) ? 0.25 : -0.25);
      sum += ramp(model.at(frame.place(at)).lumen, 0.5 * voxel) / 8;
    }
    share[i] = mixed ? static_cast<float>(sum) : distance[i] < 0 ? 1.0F : 0.0F;
  }
  return share;
}

}  // namespace

void ScanSettings::add_to(config::Schema<ScanSettings>& schema) {
  using S = ScanSettings;
  using namespace config;
  schema.quantity("voxel", &S::voxel, dimension::length, range(0.2e-3, 2e-3), "Edge length of the voxels")
      .by_default("0.7 mm")
      .quantity("blur", &S::blur, dimension::length, range(0, 3e-3),
                "Full width at half maximum of the scanner's point-spread function, a Gaussian")
      .by_default("0.8 mm")
      .number("noise", &S::noise, range(0, 0.4),
              "Standard deviation of the noise of a voxel, as a share of the contrast between blood and wall")
      .by_default()
      .quantity("tilt", &S::tilt, dimension::angle, range(0, 2), "Of the image axes about the direction (1, 1, 1)")
      .by_default("0 deg")
      .integer("seed", &S::seed, range(0, 1e9), "Another one gives other noise")
      .by_default();
}

void blur_as_seen(const ImageFrame& frame, const ScanSettings& settings, std::vector<float>& values) {
  const double widths_per_sigma = 2 * std::sqrt(2 * std::log(2.0));
  if (settings.blur > 0) blur(frame, settings.blur / widths_per_sigma / settings.voxel, values);
}

std::vector<std::uint8_t> seen_as_lumen(const ImageFrame& frame, std::vector<float> shares,
                                        const ScanSettings& settings) {
  blur_as_seen(frame, settings, shares);
  std::mt19937_64 random(static_cast<std::uint64_t>(settings.seed));
  std::normal_distribution<double> noise(0, settings.noise);
  std::vector<std::uint8_t> lumen;
  lumen.reserve(shares.size());
  for (const auto share : shares)
    lumen.push_back(static_cast<double>(share) + (settings.noise > 0 ? noise(random) : 0) < 0.5 ? 0 : 1);
  return lumen;
}

LabelImage scan(const geometry::DissectionModel& model, const ScanSettings& settings) {
  LabelImage image{frame_around(model.box(), settings.voxel, settings.tilt), {}};
  const auto& frame = image.frame;
  const auto lumen = seen_as_lumen(frame, shares_of_lumen(model, frame, settings.voxel), settings);
  image.labels.resize(lumen.size());
  for (std::int64_t i = 0; i < frame.count(); ++i) {
    if (lumen[i] == 0 && !model.has_thrombus()) continue;
    const auto values = model.at(frame.place(frame.voxel(i)));
    if (lumen[i] != 0)
      image.labels[i] = values.side > 0 ? scan_true_lumen : scan_false_lumen;
    else if (values.vessel < 0 && values.lumen >= 0)
      image.labels[i] = scan_thrombus;
  }
  return image;
}

}  // namespace tunica::imaging
