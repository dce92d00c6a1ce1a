#include "tunica/flow_imaging/synthetic_series.hpp"

#include <cmath>
#include <complex>
#include <random>

#include "tunica/flow_imaging/lumen_samples.hpp"

namespace tunica::flow_imaging {

namespace {

using Signal = std::complex<double>;

/// Mean signals of the voxels, one reference without encoding and one for each axis. [voxel][4]
std::vector<Signal> signals(const ImageFrame& frame, const mesh::MeshData& data, const PhaseContrast& s,
                            const Instant& instant, const std::array<Vec3<double>, 3>& axes) {
  constexpr double tissue_parts = samples_in_voxel;
  std::vector<Signal> sums(4 * static_cast<std::size_t>(frame.count()), Signal(s.tissue_signal, 0));
  for (const auto& region : data.regions) {
    if (region.kind != mesh::RegionKind::lumen) continue;
    const auto elements = std::span(data.tetrahedra)
                              .subspan(static_cast<std::size_t>(region.first_element),
                                       static_cast<std::size_t>(region.end_element - region.first_element));
    for (const auto& sample : lumen_samples(frame, instant.points, elements)) {
      Vec3<double> v{};
      const auto& nodes = elements[static_cast<std::size_t>(sample.element)];
      for (std::size_t a = 0; a < 4; ++a)
        v = v + sample.barycentric[a] * instant.velocity[static_cast<std::size_t>(nodes[a])];
      auto* of_voxel = sums.data() + 4 * static_cast<std::size_t>(sample.voxel);
      of_voxel[0] += (1 - s.tissue_signal) / tissue_parts;
      for (std::size_t a = 0; a < 3; ++a)
        of_voxel[1 + a] += (std::polar(1.0, M_PI * dot(axes[a], v) / s.encoding) - s.tissue_signal) / tissue_parts;
    }
  }
  return sums;
}

}  // namespace

void PhaseContrast::add_to(config::Schema<PhaseContrast>& schema) {
  using S = PhaseContrast;
  using namespace config;
  schema.quantity("voxel", &S::voxel, dimension::length, range(0.5e-3, 5e-3), "Edge length of the voxels")
      .by_default("2 mm")
      .integer("frames", &S::frames, range(4, 100), "Frames over the beat")
      .by_default()
      .quantity("encoding", &S::encoding, dimension::velocity, range(0.1, 10),
                "Encoding velocity of all three axes; what is faster wraps")
      .by_default("150 cm/s")
      .number("signal_to_noise", &S::signal_to_noise, range(1, 1e6), "Of the magnitude of a voxel full of blood")
      .by_default()
      .number("tissue_signal", &S::tissue_signal, range(0, 2), "Magnitude of static tissue over that of blood")
      .by_default()
      .quantity("margin", &S::margin, dimension::length, range(0, 0.1), "Tissue around the vessel")
      .by_default("12 mm")
      .quantity("tilt", &S::tilt, dimension::angle, range(0, 2), "Of the image axes about the direction (1, 1, 1)")
      .by_default("0 deg")
      .quantity("background", &S::background, dimension::velocity, range(0, 1),
                "Offset by eddy currents at the corners of the image; it is linear in space")
      .by_default("0 cm/s")
      .integer("seed", &S::seed, range(0, 1e9), "Another one gives other noise")
      .by_default();
}

VelocitySeries phase_contrast(const mesh::MeshData& data, const PhaseContrast& s, double period,
                              const std::function<Instant(std::size_t)>& at) {
  VelocitySeries series;
  series.period = period;
  series.encoding = s.encoding;
  std::mt19937_64 random(static_cast<std::uint64_t>(s.seed));
  // In the real and the imaginary part of each signal.
  std::normal_distribution<double> noise(0, 1 / s.signal_to_noise);
  for (std::int64_t k = 0; k < s.frames; ++k) {
    const auto instant = at(static_cast<std::size_t>(k));
    if (k == 0) {
      series.frame = imaging::frame_about(instant.points, s.voxel, s.margin, s.tilt);
      for (std::size_t a = 0; a < 3; ++a) series.encoded[a] = (1 / s.voxel) * series.frame.steps[a];
      series.magnitude.assign(static_cast<std::size_t>(series.voxels()), 0.0F);
    }
    series.times.push_back(period * static_cast<double>(k) / static_cast<double>(s.frames));
    const auto mean = signals(series.frame, data, s, instant, series.encoded);
    auto& v = series.velocity.emplace_back();
    for (auto& component : v) component.assign(static_cast<std::size_t>(series.voxels()), 0.0F);
    for (std::int64_t n = 0; n < series.voxels(); ++n) {
      const auto index = static_cast<std::size_t>(n);
      const auto place = series.frame.voxel(n);
      Signal with_noise[4];
      for (std::size_t a = 0; a < 4; ++a) with_noise[a] = mean[4 * index + a] + Signal(noise(random), noise(random));
      series.magnitude[index] += static_cast<float>(std::abs(with_noise[0]) / static_cast<double>(s.frames));
      Vec3<double> u{};
      for (std::size_t a = 0; a < 3; ++a) {
        // The offset along an axis grows along the next one.
        const auto next = (a + 1) % 3;
        const double along =
            2 * static_cast<double>(place[next]) / static_cast<double>(series.frame.size[next] - 1) - 1;
        const Signal shifted = std::polar(1.0, M_PI * s.background * along / s.encoding);
        const double measured = s.encoding / M_PI * std::arg(with_noise[1 + a] * shifted * std::conj(with_noise[0]));
        u = u + measured * series.encoded[a];
      }
      for (std::size_t d = 0; d < 3; ++d) v[d][index] = static_cast<float>(u[static_cast<int>(d)]);
    }
  }
  return series;
}

}  // namespace tunica::flow_imaging
