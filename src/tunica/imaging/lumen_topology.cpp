#include "tunica/imaging/lumen_topology.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/imaging/distance.hpp"

namespace tunica::imaging {

namespace {

constexpr double short_way = 15e-3;      // m; rings that are no longer are roughness
constexpr double film = 3.5;             // square of its width over its area
constexpr double largest_loss = 0.3e-6;  // m^3; of a lumen, by filter and least flap
constexpr float shut = 0.25F;            // of the field where it is raised: about half a voxel of wall on each side

std::vector<float> depth_in(const ImageFrame& frame, const VoxelSet& set) {
  auto depth = signed_distance(frame, set);
  for (auto& d : depth) d = -d;
  return depth;
}

/// Of a layer of voxels, one thick [m^2].
double area_of(const ImageFrame& frame, const std::vector<std::int64_t>& voxels) {
  return frame.voxel_volume() / frame.largest_spacing() * static_cast<double>(voxels.size());
}

/// Rings of a few voxels, and those that close by less than two voxels or by a film along a wall.
bool is_rough(const ImageFrame& frame, const Handle& handle) {
  const double area = area_of(frame, handle.voxels);
  const auto middle = middle_of(frame, handle.voxels);
  double reach = 0;
  for (const auto i : handle.voxels) reach = std::max(reach, norm(frame.place(frame.voxel(i)) - middle));
  const double voxel = frame.largest_spacing();
  return handle.way <= short_way || area < 4 * voxel * voxel || std::pow(2 * reach + voxel, 2) > film * area;
}

OpenPlace place_of(const ImageFrame& frame, const std::vector<float>& depth, const std::vector<std::int64_t>& voxels) {
  OpenPlace place{area_of(frame, voxels), 0};
  for (const auto i : voxels) place.radius = std::max(place.radius, double{depth[i]});
  return place;
}

/// At most two voxels thick: the edge of a lumen that runs out in a wedge.
bool is_film(const ImageFrame& frame, const OpenPlace& place) { return place.radius < 1.2 * frame.largest_spacing(); }

class Settling {
 public:
  Settling(const FlapSides* sides, SmoothField& field) : sides_(sides), field_(field), frame_(field.frame) {
    true_.assign(field.values.size(), 0);
    false_ = true_;
    for (std::int64_t i = 0; i < frame_.count(); ++i)
      if (field.values[i] < 0) (side_of(i) ? true_ : false_)[i] = 1;
    // Simple voxels are told from all around them.
    for (std::int64_t i = 0; i < frame_.count(); ++i)
      if ((true_[i] || false_[i]) && at_border(i)) true_[i] = false_[i] = 0;
  }

  /// One label for both lumens.
  void settle_single(std::int64_t rings, const Log& log) {
    make_ball(true_, "lumen", rings, log);
    take_fingers(log);
    write();
  }

  void settle_both(const std::vector<Contact>& tears, std::int64_t rings, const Log& log) {
    make_ball(true_, "true lumen", 0, log);
    part_from_true();
    make_ball(false_, "false lumen", rings, log);
    one_contact_each(tears, log);
    if (!tears.empty()) open_between(std::ssize(tears) - 1 + rings, log);
    fill_pits(log);
    take_fingers(log);
    write();
  }

 private:
  std::int64_t in_box(std::int64_t i) const {
    if (!sides_) return -1;
    const auto v = frame_.voxel(i);
    const Size3 w{v[0] - sides_->low[0], v[1] - sides_->low[1], v[2] - sides_->low[2]};
    return sides_->frame.holds(w[0], w[1], w[2]) ? sides_->frame.index(w[0], w[1], w[2]) : -1;
  }
  bool side_of(std::int64_t i) const {
    const auto b = in_box(i);
    return b < 0 || sides_->side[b] > 0;
  }
  double to_tear(std::int64_t i) const {
    const auto b = in_box(i);
    return b < 0 ? 1.0 : static_cast<double>(sides_->to_tear[b]);
  }
  bool at_border(std::int64_t i) const {
    const auto v = frame_.voxel(i);
    for (int d = 0; d < 3; ++d)
      if (v[d] == 0 || v[d] + 1 == frame_.size[d]) return true;
    return false;
  }
  template <class Visit>
  void for_each_joined(std::int64_t i, const Visit& visit) const {
    for_each_neighbour(frame_, i, [&](std::int64_t other, const Size3& step) {
      if (std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]) <= 2) visit(other);
    });
  }

  /// But for the `rings` that have the widest openings.
  void make_ball(VoxelSet& set, const char* name, std::int64_t rings, const Log& log) {
    const double voxel = frame_.voxel_volume();
    const double lost = voxel * static_cast<double>(keep_largest_part(frame_, set));
    if (lost > largest_loss)
      throw SolverError(
          fmt::format("{:.2f} ml of the {} are cut off from the rest where it is narrower than the voxels "
                      "can show; label it wider there, or give a smaller `smoothing`",
                      1e6 * lost, name));
    auto handles = remove_handles(frame_, depth_in(frame_, set), set);
    std::stable_sort(handles.begin(), handles.end(), [](const Handle& a, const Handle& b) {
      const bool longer = a.way > short_way, other = b.way > short_way;
      return longer != other ? longer : a.voxels.size() > b.voxels.size();
    });
    const auto kept = std::min(rings, std::ssize(handles));
    for (auto handle = handles.begin(); handle != handles.begin() + kept; ++handle)
      for (const auto i : handle->voxels) set[i] = 1;
    for (auto handle = handles.begin() + kept; handle != handles.end(); ++handle)
      if (handle->way > short_way)
        log(fmt::format("{}: walls of vessels that the filter had joined are kept apart at {}, {:.1f} mm^2", name,
                        in_mm(middle_of(frame_, handle->voxels)), 1e6 * area_of(frame_, handle->voxels)));
    if (kept < std::ssize(handles))
      log(fmt::format("{}: {} handles of the filtered labels opened", name, std::ssize(handles) - kept));
  }

  /// Beside a tear the lumens may touch, nowhere else.
  void part_from_true() {
    const double zone = 2 * width_of_rim(frame_.largest_spacing());
    for (std::int64_t i = 0; i < frame_.count(); ++i) {
      if (!false_[i] || to_tear(i) <= zone) continue;
      bool touches = false;
      for_each_joined(i, [&](std::int64_t other) { touches |= true_[other] != 0; });
      if (touches) false_[i] = 0;
    }
  }

  /// Voxels of the false lumen beside the true one: their largest part at each tear stays.
  void one_contact_each(const std::vector<Contact>& tears, const Log& log) {
    std::vector<std::vector<std::int64_t>> parts;
    std::vector<bool> seen(false_.size(), false);
    const auto touches = [&](std::int64_t i) {
      if (!false_[i]) return false;
      bool found = false;
      for_each_joined(i, [&](std::int64_t other) { found |= true_[other] != 0; });
      return found;
    };
    for (std::int64_t start = 0; start < frame_.count(); ++start) {
      if (seen[start] || !touches(start)) continue;
      auto& part = parts.emplace_back(1, start);
      seen[start] = true;
      for (std::size_t next = 0; next < part.size(); ++next)
        for_each_joined(part[next], [&](std::int64_t other) {
          if (seen[other] || !touches(other)) return;
          seen[other] = true;
          part.push_back(other);
        });
    }
    std::sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
    std::vector<bool> open(tears.size(), false);
    for (const auto& part : parts) {
      const auto nearest = nearest_tear(tears, part);
      if (nearest < tears.size() && !open[nearest]) {
        open[nearest] = true;
        continue;
      }
      for (const auto i : part) false_[i] = 0;
    }
    for (std::size_t t = 0; t < tears.size(); ++t)
      if (!open[t])
        log(fmt::format("warning: the tear of {:.0f} mm^2 at {} was closed by the filter", 1e6 * tears[t].area,
                        in_mm(tears[t].centre)));
  }

  /// Where a tear holds specks of tissue, the lumens that touch around them make rings.
  void open_between(std::int64_t rings, const Log& log) {
    auto both = lumen();
    make_ball(both, "lumen", rings, log);
    for (std::size_t i = 0; i < both.size(); ++i)
      if (!both[i]) true_[i] = false_[i] = 0;
  }

  std::size_t nearest_tear(const std::vector<Contact>& tears, const std::vector<std::int64_t>& part) const {
    std::size_t best = tears.size();
    double least = 1;
    for (std::size_t t = 0; t < tears.size(); ++t)
      for (const auto i : tears[t].voxels)
        for (const auto p : {part.front(), part[part.size() / 2]}) {
          const double distance = norm(frame_.place(frame_.voxel(i)) - frame_.place(frame_.voxel(p)));
          if (distance >= least) continue;
          least = distance;
          best = t;
        }
    return best;
  }

  VoxelSet lumen() const {
    auto both = true_;
    for (std::size_t i = 0; i < both.size(); ++i) both[i] |= false_[i];
    return both;
  }

  /// No mesh can follow lumen that is thinner than two voxels; blood hardly moves there.
  void take_fingers(const Log& log) {
    auto both = lumen();
    const auto taken = take_thin_ends(frame_, both);
    for (std::size_t i = 0; i < both.size(); ++i)
      if (!both[i]) true_[i] = false_[i] = 0;
    if (taken > 0)
      log(fmt::format("{} voxels of lumen, {:.2f} ml, lie in ends thinner than two voxels and become wall", taken,
                      1e6 * frame_.voxel_volume() * static_cast<double>(taken)));
  }

  /// Pits of the wall of the true lumen, with narrow mouths where the labels are rough. The flap has thin ends at its
  /// tears, which stay.
  void fill_pits(const Log& log) {
    constexpr int steps = 2;
    auto both = lumen();
    const double flap = 4 * frame_.largest_spacing();
    const auto away_from_flap = [&](std::int64_t i) {
      const auto b = in_box(i);
      return b < 0 || sides_->side[b] > flap;
    };
    const auto filled = fill_thin_pits(frame_, away_from_flap, steps, both);
    for (std::size_t i = 0; i < both.size(); ++i)
      if (both[i] && !false_[i]) true_[i] = 1;
    if (filled > 0)
      log(fmt::format("{} voxels in pits of the wall thinner than two voxels become lumen, {:.2f} ml", filled,
                      1e6 * frame_.voxel_volume() * static_cast<double>(filled)));
  }

  void write() {
    for (std::int64_t i = 0; i < frame_.count(); ++i) {
      const bool lumen = true_[i] || false_[i];
      if (lumen && field_.values[i] >= 0) field_.values[i] = -shut;
      if (!lumen && field_.values[i] < 0) field_.values[i] = shut;
    }
  }

  const FlapSides* sides_;
  SmoothField& field_;
  const ImageFrame& frame_;
  VoxelSet true_, false_;
};

}  // namespace

std::int64_t open_rings(LumenMask& mask, const SurfaceSettings& settings, const Log& log) {
  const bool dissected = settings.labels.false_lumen.has_value();
  const auto& bounds = settings.tears;
  std::int64_t kept = 0;
  std::vector<Problem> problems;
  for (const auto kind : {Kind::true_lumen, Kind::false_lumen}) {
    auto set = voxels_of(mask.kinds, kind);
    if (std::count(set.begin(), set.end(), 1) == 0) continue;
    const auto depth = depth_in(mask.frame, set);
    auto handles = remove_handles(mask.frame, depth, set);
    std::stable_sort(handles.begin(), handles.end(),
                     [](const Handle& a, const Handle& b) { return a.voxels.size() > b.voxels.size(); });
    // Vessels alone make rings where they are joined; in a false lumen, or where both have one label, rings are open.
    const bool vessels = dissected && kind == Kind::true_lumen;
    std::vector<OpenPlace> places;
    std::vector<Handle> rings;
    for (auto& handle : handles) {
      // Most roughness the filter takes away; `settle` does the rest.
      if (vessels ? is_rough(mask.frame, handle) : handle.way <= short_way) continue;
      places.push_back(place_of(mask.frame, depth, handle.voxels));
      rings.push_back(std::move(handle));
    }
    const double noise = bounds.noise_among(places, mask.frame.largest_spacing());
    std::vector<OpenPlace> closed;
    for (std::size_t h = 0; h < rings.size(); ++h) {
      const auto& voxels = rings[h].voxels;
      const auto place = in_mm(middle_of(mask.frame, voxels));
      if (!vessels && bounds.is_tear(places[h], noise) && !(settings.flap.insert && is_film(mask.frame, places[h]))) {
        ++kept;
        log(fmt::format("the {}lumen makes a ring of {}{:.0f} mm, whose narrowest place is at {}, {:.0f} mm^2{}",
                        dissected ? "false " : "", rings[h].way < longest_way ? "" : "at least ", 1e3 * rings[h].way,
                        place, 1e6 * places[h].area, dissected ? "" : ": a tear"));
        continue;
      }
      if (vessels && !settings.repairs[Repair::bridges]) {
        problems.push_back(
            {"image",
             fmt::format("the true lumen makes a ring of {}{:.0f} mm: vessels are joined by a bridge at {}, "
                         "{:.1f} mm^2",
                         rings[h].way < longest_way ? "" : "at least ", 1e3 * rings[h].way, place,
                         1e6 * places[h].area),
             "part them in the segmentation, or have the bridge cut by `repair: [bridges]`"});
        continue;
      }
      for (const auto i : voxels) mask.kinds[i] = Kind::tissue;
      if (!vessels) closed.push_back(places[h]);
      if (closed.size() <= most_listed)
        log(fmt::format("{} at {} closed, {:.1f} mm^2",
                        vessels     ? "bridge between vessels"
                        : dissected ? "ring of the false lumen"
                                    : "hole in the flap",
                        place, 1e6 * places[h].area));
    }
    if (closed.size() > most_listed) log(fmt::format("and {} smaller ones", closed.size() - most_listed));
    warn_of_closed(closed, "rings", bounds, log);
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return kept;
}

void settle(const FlapSides* sides, const std::vector<Contact>& tears, std::int64_t rings, SmoothField& field,
            const Log& log) {
  Settling settling(sides, field);
  if (sides)
    settling.settle_both(tears, rings, log);
  else
    settling.settle_single(rings, log);
}

}  // namespace tunica::imaging
