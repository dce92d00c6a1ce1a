#include <algorithm>
#include <cmath>
#include <queue>

#include "tunica/flow_imaging/corrections.hpp"

namespace tunica::flow_imaging {

namespace {

/// Voxels of the mask at all frames, as the nodes of a graph: [voxel][frame].
class Nodes {
 public:
  Nodes(const VelocitySeries& series, const std::vector<std::uint8_t>& mask)
      : series_(series), frames_(static_cast<std::int64_t>(series.frames())), number_(mask.size(), -1) {
    for (std::size_t v = 0; v < mask.size(); ++v)
      if (mask[v]) {
        number_[v] = std::ssize(voxels);
        voxels.push_back(static_cast<std::int64_t>(v));
      }
  }
  std::int64_t count() const { return std::ssize(voxels) * frames_; }
  std::int64_t frame(std::int64_t node) const { return node % frames_; }
  std::int64_t voxel(std::int64_t node) const { return voxels[static_cast<std::size_t>(node / frames_)]; }

  template <class Visit>
  void for_each_neighbour(std::int64_t node, const Visit& visit) const {
    const auto place = node / frames_, t = node % frames_;
    imaging::for_each_face_neighbour(series_.frame, voxel(node), [&](std::int64_t other) {
      if (const auto n = number_[static_cast<std::size_t>(other)]; n >= 0) visit(n * frames_ + t);
    });
    if (frames_ < 3) return;
    visit(place * frames_ + (t + 1) % frames_);
    visit(place * frames_ + (t + frames_ - 1) % frames_);
  }

  std::vector<std::int64_t> voxels;

 private:
  const VelocitySeries& series_;
  std::int64_t frames_;
  std::vector<std::int64_t> number_;
};

/// One component at the nodes, in periods of wrapping.
class Growth {
 public:
  Growth(const Nodes& nodes, std::vector<double> values) : nodes_(nodes), values_(std::move(values)) {
    turns.assign(values_.size(), 0);
    done_.assign(values_.size(), 0);
  }

  /// Grows over all that hangs together with the slowest node of the slowest frame that is left.
  void run(const std::vector<std::int64_t>& by_speed) {
    for (const auto seed : by_speed) {
      if (done_[static_cast<std::size_t>(seed)]) continue;
      grow(seed);
    }
  }

  std::vector<int> turns;

 private:
  struct Step {
    double difference;
    std::int64_t from, to;
    bool operator<(const Step& other) const {  // the queue gives the largest first
      return difference != other.difference ? difference > other.difference : to > other.to;
    }
  };
  double value(std::int64_t n) const {
    return values_[static_cast<std::size_t>(n)] + turns[static_cast<std::size_t>(n)];
  }
  void grow(std::int64_t seed) {
    std::priority_queue<Step> queue;
    const auto take = [&](std::int64_t node) {
      done_[static_cast<std::size_t>(node)] = 1;
      nodes_.for_each_neighbour(node, [&](std::int64_t other) {
        if (done_[static_cast<std::size_t>(other)]) return;
        const double d = values_[static_cast<std::size_t>(other)] - values_[static_cast<std::size_t>(node)];
        queue.push({std::abs(d - std::round(d)), node, other});
      });
    };
    take(seed);
    while (!queue.empty()) {
      const auto step = queue.top();
      queue.pop();
      if (done_[static_cast<std::size_t>(step.to)]) continue;
      const auto to = static_cast<std::size_t>(step.to);
      turns[to] = static_cast<int>(std::round(value(step.from) - values_[to]));
      take(step.to);
    }
  }

  const Nodes& nodes_;
  std::vector<double> values_;
  std::vector<char> done_;
};

/// Nodes of the frame with the lowest mean speed first, in it the slowest one first.
std::vector<std::int64_t> seeds(const Nodes& nodes, const std::vector<double>& values, std::size_t frames) {
  std::vector<double> speed(frames, 0.0);
  for (std::int64_t n = 0; n < nodes.count(); ++n)
    speed[static_cast<std::size_t>(nodes.frame(n))] += std::abs(values[static_cast<std::size_t>(n)]);
  const auto quiet = std::min_element(speed.begin(), speed.end()) - speed.begin();
  std::vector<std::int64_t> order;
  for (std::int64_t n = 0; n < nodes.count(); ++n)
    if (nodes.frame(n) == quiet) order.push_back(n);
  std::stable_sort(order.begin(), order.end(), [&](std::int64_t a, std::int64_t b) {
    return std::abs(values[static_cast<std::size_t>(a)]) < std::abs(values[static_cast<std::size_t>(b)]);
  });
  return order;
}

}  // namespace

std::int64_t unwrap(VelocitySeries& series, const std::vector<std::uint8_t>& mask) {
  if (!series.encoding) return 0;
  const double period = 2 * *series.encoding;
  const Nodes nodes(series, mask);
  std::int64_t changed = 0;
  for (const auto& axis : series.encoded) {
    std::vector<double> values(static_cast<std::size_t>(nodes.count()));
    for (std::int64_t n = 0; n < nodes.count(); ++n) {
      const auto& v = series.velocity[static_cast<std::size_t>(nodes.frame(n))];
      const auto at = static_cast<std::size_t>(nodes.voxel(n));
      values[static_cast<std::size_t>(n)] =
          (axis[0] * static_cast<double>(v[0][at]) + axis[1] * static_cast<double>(v[1][at]) +
           axis[2] * static_cast<double>(v[2][at])) /
          period;
    }
    Growth growth(nodes, values);
    growth.run(seeds(nodes, values, series.frames()));
    for (std::int64_t n = 0; n < nodes.count(); ++n) {
      const int turns = growth.turns[static_cast<std::size_t>(n)];
      if (turns == 0) continue;
      ++changed;
      auto& v = series.velocity[static_cast<std::size_t>(nodes.frame(n))];
      const auto at = static_cast<std::size_t>(nodes.voxel(n));
      for (int d = 0; d < 3; ++d) v[static_cast<std::size_t>(d)][at] += static_cast<float>(turns * period * axis[d]);
    }
  }
  return changed;
}

}  // namespace tunica::flow_imaging
