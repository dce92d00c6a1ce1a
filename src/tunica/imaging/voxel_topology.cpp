#include "tunica/imaging/voxel_topology.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <limits>
#include <queue>

namespace tunica::imaging {

namespace {

/// The 27 voxels around one, x fastest, as bits; 13 is the middle.
using Around = std::uint32_t;
constexpr int middle = 13;

struct Tables {
  std::array<Around, 27> by_face{}, by_edge{};  ///< neighbours within the 27: by faces; by faces and edges
  Around faces = 0, edges = 0;                  ///< of the middle: those by a face; by a face or an edge
};

constexpr int steps_between(int a, int b, int& largest) {
  int sum = 0;
  largest = 0;
  for (int d = 0, divisor = 1; d < 3; ++d, divisor *= 3) {
    const int off = a / divisor % 3 - b / divisor % 3, size = off < 0 ? -off : off;
    sum += size;
    largest = size > largest ? size : largest;
  }
  return sum;
}

constexpr Tables make_tables() {
  Tables t;
  for (int a = 0; a < 27; ++a)
    for (int b = 0; b < 27; ++b) {
      int largest = 0;
      const int sum = steps_between(a, b, largest);
      if (sum == 1) t.by_face[a] |= Around{1} << b;
      if (largest == 1 && sum <= 2) t.by_edge[a] |= Around{1} << b;
    }
  t.faces = t.by_face[middle];
  t.edges = t.by_edge[middle];
  return t;
}
constexpr Tables tables = make_tables();

Around spread(Around from, const std::array<Around, 27>& next) {
  Around result = from;
  for (Around left = from; left != 0; left &= left - 1) result |= next[std::countr_zero(left)];
  return result;
}

/// Parts of `within` that are reached from `start`, without the middle.
int parts(Around start, Around within, const std::array<Around, 27>& next) {
  int count = 0;
  for (Around left = start; left != 0; ++count) {
    Around part = left & (~left + 1);
    for (Around before = 0; part != before;) {
      before = part;
      part = spread(part, next) & within;
    }
    left &= ~part;
  }
  return count;
}

Around around(const ImageFrame& frame, const VoxelSet& set, std::int64_t index) {
  Around bits = 0;
  int bit = 0;
  const std::int64_t row = frame.size[0], slice = row * frame.size[1];
  for (int k = -1; k <= 1; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i, ++bit) bits |= Around{set[index + i + j * row + k * slice]} << bit;
  return bits & ~(Around{1} << middle);
}

bool simple(Around in) {
  const Around out = ~in & ((Around{1} << 27) - 1) & ~(Around{1} << middle);
  // Of the set: what shares a face or an edge with the voxel, and what hangs on that by one step.
  const Around near_in = in & tables.edges;
  if (near_in == 0 || (out & tables.faces) == 0) return false;
  const Around reached_in = spread(near_in, tables.by_edge) & in;
  if (parts(near_in, reached_in, tables.by_edge) != 1) return false;
  // Of the rest: what shares a face with it, and what is reached by three steps from it.
  const Around near_out = out & tables.faces;
  Around reached_out = near_out;
  for (int step = 0; step < 2; ++step) reached_out = spread(reached_out, tables.by_face) & out;
  return parts(near_out, reached_out, tables.by_face) == 1;
}

template <class Visit>
void for_each_joined(const ImageFrame& frame, std::int64_t index, const Visit& visit) {
  for_each_neighbour(frame, index, [&](std::int64_t other, const Size3& step) {
    if (std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]) <= 2) visit(other);
  });
}

/// Grows from the deepest voxel; what cannot be taken now is looked at again when something beside it was.
VoxelSet grown_ball(const ImageFrame& frame, const std::vector<float>& depth, const VoxelSet& set) {
  VoxelSet ball(set.size(), 0);
  using Entry = std::pair<float, std::int64_t>;
  std::priority_queue<Entry> queue;
  std::vector<bool> waiting(set.size(), false);
  const auto push = [&](std::int64_t i) {
    if (!set[i] || ball[i] || waiting[i]) return;
    waiting[i] = true;
    queue.emplace(depth[i], i);
  };
  std::int64_t deepest = -1;
  for (std::int64_t i = 0; i < std::ssize(set); ++i)
    if (set[i] && (deepest < 0 || depth[i] > depth[deepest])) deepest = i;
  if (deepest < 0) return ball;
  ball[deepest] = 1;
  for_each_neighbour(frame, deepest, [&](std::int64_t other, const Size3&) { push(other); });
  while (!queue.empty()) {
    const auto i = queue.top().second;
    queue.pop();
    waiting[i] = false;
    if (!is_simple(frame, ball, i)) continue;
    ball[i] = 1;
    for_each_neighbour(frame, i, [&](std::int64_t other, const Size3&) { push(other); });
  }
  return ball;
}

/// Ways within a set about voxels that were cut out of it.
class WaysAround {
 public:
  WaysAround(const ImageFrame& frame, const VoxelSet& set) : frame_(frame), set_(set), mark_(set.size(), 0) {}

  /// Longest of the shortest ways from one voxel beside `cut` to the others [m], at most `longest_way`.
  double around(const std::vector<std::int64_t>& cut) {
    const auto rim_mark = ++last_, seen_mark = ++last_;
    std::int64_t left = 0, first = -1;
    for (const auto i : cut)
      for_each_joined(frame_, i, [&](std::int64_t other) {
        if (!set_[other] || mark_[other] == rim_mark) return;
        mark_[other] = rim_mark;
        ++left;
        first = other;
      });
    if (left == 0) return 0;
    const double step = frame_.largest_spacing();
    double farthest = 0;
    std::vector<std::int64_t> front{first};
    mark_[first] = seen_mark;
    --left;
    for (double at = step; !front.empty() && left > 0; at += step) {
      if (at >= longest_way) return longest_way;
      std::vector<std::int64_t> next;
      for (const auto i : front)
        for_each_joined(frame_, i, [&](std::int64_t other) {
          if (!set_[other] || mark_[other] == seen_mark) return;
          if (mark_[other] == rim_mark) {
            --left;
            farthest = at;
          }
          mark_[other] = seen_mark;
          next.push_back(other);
        });
      front = std::move(next);
    }
    return farthest;
  }

 private:
  const ImageFrame& frame_;
  const VoxelSet& set_;
  std::vector<std::int32_t> mark_;  ///< of the last search that came to each voxel
  std::int32_t last_ = 0;
};

/// Voxels of a value in blocks of 2 x 2 x 2 voxels of this value.
VoxelSet voxels_in_blocks(const ImageFrame& frame, const VoxelSet& set, std::uint8_t value) {
  VoxelSet thick(set.size(), 0);
  const std::int64_t row = frame.size[0], slice = row * frame.size[1];
  const std::array<std::int64_t, 8> block{0, 1, row, row + 1, slice, slice + 1, slice + row, slice + row + 1};
  for (std::int64_t i = 0; i + block.back() < std::ssize(set); ++i)
    if (set[i] == value && std::all_of(block.begin(), block.end(), [&](auto step) { return set[i + step] == value; }))
      for (const auto step : block) thick[i + step] = 1;
  return thick;
}

bool at_border(const ImageFrame& frame, std::int64_t i) {
  const auto v = frame.voxel(i);
  for (int d = 0; d < 3; ++d)
    if (v[d] == 0 || v[d] + 1 == frame.size[d]) return true;
  return false;
}

/// Turns simple voxels of a value that are in no block into the other value, `rounds` times from the free ends on.
template <class May>
std::int64_t turn_thin(const ImageFrame& frame, std::uint8_t value, int rounds, const May& may, VoxelSet& set) {
  const auto thick = voxels_in_blocks(frame, set, value);
  std::vector<std::int64_t> front;
  for (std::int64_t i = 0; i < std::ssize(set); ++i)
    if (set[i] == value && !thick[i] && !at_border(frame, i) && may(i)) front.push_back(i);
  std::int64_t turned = 0;
  for (int round = 0; round < rounds && !front.empty(); ++round) {
    std::vector<std::int64_t> next;
    // Only what is free now: the next ones are for the next round.
    std::erase_if(front, [&](auto i) { return set[i] != value || !is_simple(frame, set, i); });
    for (const auto i : front) {
      if (set[i] != value || !is_simple(frame, set, i)) continue;
      set[i] = static_cast<std::uint8_t>(1 - value);
      ++turned;
      for_each_neighbour(frame, i, [&](std::int64_t other, const Size3&) {
        if (set[other] == value && !thick[other] && !at_border(frame, other) && may(other)) next.push_back(other);
      });
    }
    front = std::move(next);
  }
  return turned;
}

}  // namespace

bool is_simple(const ImageFrame& frame, const VoxelSet& set, std::int64_t index) {
  return simple(around(frame, set, index));
}

std::vector<Handle> remove_handles(const ImageFrame& frame, const std::vector<float>& depth, VoxelSet& set) {
  const auto ball = grown_ball(frame, depth, set);
  std::vector<Handle> handles;
  std::vector<bool> seen(set.size(), false);
  WaysAround ways(frame, ball);
  for (std::int64_t start = 0; start < std::ssize(set); ++start) {
    if (!set[start] || ball[start] || seen[start]) continue;
    Handle handle{{start}, 0};
    seen[start] = true;
    for (std::size_t next = 0; next < handle.voxels.size(); ++next)
      for_each_neighbour(frame, handle.voxels[next], [&](std::int64_t other, const Size3&) {
        if (!set[other] || ball[other] || seen[other]) return;
        seen[other] = true;
        handle.voxels.push_back(other);
      });
    handle.way = ways.around(handle.voxels);
    if (handle.way > 0) handles.push_back(std::move(handle));
  }
  set = ball;
  return handles;
}

std::int64_t take_thin_ends(const ImageFrame& frame, VoxelSet& set) {
  return turn_thin(
      frame, 1, std::numeric_limits<int>::max(), [](std::int64_t) { return true; }, set);
}

std::int64_t fill_thin_pits(const ImageFrame& frame, const std::function<bool(std::int64_t)>& may, int steps,
                            VoxelSet& set) {
  return turn_thin(frame, 0, steps, may, set);
}

std::int64_t keep_largest_part(const ImageFrame& frame, VoxelSet& set) {
  std::vector<std::int32_t> part(set.size(), 0);
  std::vector<std::int64_t> voxels{0}, stack;
  for (std::int64_t start = 0; start < std::ssize(set); ++start) {
    if (!set[start] || part[start] != 0) continue;
    const auto number = static_cast<std::int32_t>(voxels.size());
    voxels.push_back(0);
    part[start] = number;
    stack.push_back(start);
    while (!stack.empty()) {
      const auto i = stack.back();
      stack.pop_back();
      ++voxels[number];
      for_each_joined(frame, i, [&](std::int64_t other) {
        if (!set[other] || part[other] != 0) return;
        part[other] = number;
        stack.push_back(other);
      });
    }
  }
  const auto largest = std::max_element(voxels.begin(), voxels.end()) - voxels.begin();
  std::int64_t dropped = 0;
  for (std::size_t i = 0; i < set.size(); ++i)
    if (set[i] && part[i] != largest) {
      set[i] = 0;
      ++dropped;
    }
  return dropped;
}

}  // namespace tunica::imaging
