#include "tunica/flow_imaging/flow_curves.hpp"

#include <cmath>

namespace tunica::flow_imaging {

double FlowCurve::mean() const {
  double sum = 0;
  for (std::size_t k = 0; k < flow.size(); ++k) sum += weights[k] * flow[k];
  return sum;
}

double FlowCurve::mean_deviation() const { return std::hypot(deviation_of_mean, unresolved * mean()); }

double FlowCurve::deviation_at(std::size_t frame) const {
  return std::hypot(deviation[frame], unresolved * flow[frame]);
}

double FlowCurve::deviation_by_noise() const {
  double squares = 0;
  for (const double d : deviation) squares += d * d / static_cast<double>(deviation.size());
  return std::sqrt(squares);
}

std::vector<double> frame_weights(const std::vector<double>& times, double period) {
  const auto n = times.size();
  if (n < 2) return std::vector<double>(n, 1.0);
  std::vector<double> weights;
  for (std::size_t k = 0; k < n; ++k) {
    const double before = k == 0 ? times[n - 1] - period : times[k - 1],
                 after = k + 1 == n ? times[0] + period : times[k + 1];
    weights.push_back((after - before) / (2 * period));
  }
  return weights;
}

FlowCurve flow_curve(const VelocitySeries& series, const ProfileFit& fit, const CrossSection& section) {
  FlowCurve curve{.name = section.name,
                  .centre = section.centre,
                  .normal = section.normal,
                  .area = section.area,
                  .voxels = fit.voxels(),
                  .flow = fit.flow(),
                  .deviation = {},
                  .deviation_of_mean = 0,
                  .unresolved = 0.5 * std::pow(series.frame.largest_spacing(), 2) * M_PI / section.area,
                  .weights = frame_weights(series.times, series.period)};
  curve.deviation_of_mean = fit.flow_deviation(curve.weights);
  for (std::size_t frame = 0; frame < series.frames(); ++frame) {
    std::vector<double> one(series.frames(), 0.0);
    one[frame] = 1;
    curve.deviation.push_back(fit.flow_deviation(one));
  }
  return curve;
}

double balance_means(std::span<FlowCurve> curves, std::span<const int> signs) {
  double sum = 0, variances = 0;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    sum += signs[k] * curves[k].mean();
    variances += signs[k] == 0 ? 0 : std::pow(curves[k].mean_deviation(), 2);
  }
  if (!(variances > 0)) return sum;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const double shift = signs[k] * sum * std::pow(curves[k].mean_deviation(), 2) / variances;
    for (auto& q : curves[k].flow) q -= shift;
  }
  return sum;
}

}  // namespace tunica::flow_imaging
