#include "tunica/imaging/missing_slices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tunica/base/error.hpp"
#include "tunica/imaging/resampling.hpp"

namespace tunica::imaging {

namespace {

constexpr std::int64_t longest_gap = 3;     // slices
constexpr double smallest_section = 20e-6;  // m^2; of a vessel that is missing
constexpr double missing_share = 0.7;       // of its cross-section in the slice before that is tissue here

/// Slices `first` to `first + count - 1` across an axis lack a vessel.
struct Gap {
  int axis;
  std::int64_t first, count;
  Point place;  ///< in the first of them [m]
};

/// The length of the gap that begins at a voxel of tissue: lumen before it and, of the same kind, behind; 0: none.
std::int64_t gap_at(const LumenMask& mask, std::int64_t index, std::int64_t at, int axis, std::int64_t stride) {
  const auto before = mask.kinds[index - stride];
  if (before == Kind::tissue || mask.kinds[index] != Kind::tissue) return 0;
  for (std::int64_t n = 1; n <= longest_gap && at + n < mask.frame.size[axis]; ++n) {
    const auto kind = mask.kinds[index + n * stride];
    if (kind != Kind::tissue) return kind == before ? n : 0;
  }
  return 0;
}

class SliceSearch {
 public:
  SliceSearch(const LumenMask& mask, int axis)
      : mask_(mask), axis_(axis), a_(axis == 0 ? 1 : 0), b_(axis == 2 ? 1 : 2), seen_(mask.kinds.size(), false) {
    const auto& size = mask.frame.size;
    const std::int64_t strides[3] = {1, size[0], size[0] * size[1]};
    stride_ = strides[axis];
    along_a_ = strides[a_];
    along_b_ = strides[b_];
  }

  /// Vessels that slice `at` lacks, by the sections in the slice before.
  void look(std::int64_t at, bool whole_slices, std::vector<Gap>& gaps) {
    const auto& size = mask_.frame.size;
    if (whole_slices && !lacks_most(at)) return;
    for (std::int64_t j = 0; j < size[b_]; ++j)
      for (std::int64_t i = 0; i < size[a_]; ++i) {
        const auto here = at * stride_ + i * along_a_ + j * along_b_;
        if (!mask_.is_lumen(here - stride_) || seen_[here - stride_]) continue;
        flood(here, at, gaps);
      }
  }

 private:
  bool lacks_most(std::int64_t at) const {
    std::int64_t before = 0, missing = 0;
    for (std::int64_t j = 0; j < mask_.frame.size[b_]; ++j)
      for (std::int64_t i = 0; i < mask_.frame.size[a_]; ++i) {
        const auto here = at * stride_ + i * along_a_ + j * along_b_;
        before += mask_.is_lumen(here - stride_);
        missing += gap_at(mask_, here, at, axis_, stride_) > 0;
      }
    return static_cast<double>(missing) > missing_share * static_cast<double>(before);
  }

  void flood(std::int64_t start, std::int64_t at, std::vector<Gap>& gaps) {
    std::vector<std::int64_t> section{start};
    seen_[start - stride_] = true;
    std::map<std::int64_t, std::int64_t> counts;
    for (std::size_t next = 0; next < section.size(); ++next) {
      const auto i = section[next];
      if (const auto n = gap_at(mask_, i, at, axis_, stride_); n > 0) ++counts[n];
      const auto v = mask_.frame.voxel(i);
      const auto push = [&](bool inside, std::int64_t other) {
        if (!inside || !mask_.is_lumen(other - stride_) || seen_[other - stride_]) return;
        seen_[other - stride_] = true;
        section.push_back(other);
      };
      push(v[a_] > 0, i - along_a_);
      push(v[a_] + 1 < mask_.frame.size[a_], i + along_a_);
      push(v[b_] > 0, i - along_b_);
      push(v[b_] + 1 < mask_.frame.size[b_], i + along_b_);
    }
    const double voxel = norm(cross(mask_.frame.steps[a_], mask_.frame.steps[b_]));
    const auto all = static_cast<double>(section.size());
    if (all * voxel < smallest_section) return;
    for (const auto& [n, count] : counts)
      if (static_cast<double>(count) > missing_share * all)
        gaps.push_back({axis_, at, n, mask_.frame.place(mask_.frame.voxel(section[section.size() / 2]))});
  }

  const LumenMask& mask_;
  int axis_, a_, b_;
  std::int64_t stride_ = 0, along_a_ = 0, along_b_ = 0;
  std::vector<bool> seen_;
};

/// `whole_slices`: only where a slice lacks most of the lumen.
std::vector<Gap> find_gaps(const LumenMask& mask, bool whole_slices) {
  std::vector<Gap> gaps;
  for (int axis = 0; axis < 3; ++axis) {
    SliceSearch search(mask, axis);
    for (std::int64_t at = 1; at + 1 < mask.frame.size[axis]; ++at) search.look(at, whole_slices, gaps);
  }
  return gaps;
}

void fill(const Gap& gap, LumenMask& mask) {
  auto slice = mask.frame;
  slice.size[gap.axis] = 1;
  const auto voxels_at = [&](std::int64_t at) {
    std::vector<std::int64_t> result(slice.count());
    for (std::int64_t i = 0; i < slice.count(); ++i) {
      auto v = slice.voxel(i);
      v[gap.axis] = at;
      result[i] = mask.frame.index(v[0], v[1], v[2]);
    }
    return result;
  };
  const auto kinds_at = [&](std::int64_t at) {
    std::vector<Kind> kinds;
    for (const auto i : voxels_at(at)) kinds.push_back(mask.kinds[i]);
    return kinds;
  };
  const auto before = kinds_at(gap.first - 1), behind = kinds_at(gap.first + gap.count);
  for (std::int64_t n = 0; n < gap.count; ++n) {
    const double share = static_cast<double>(n + 1) / static_cast<double>(gap.count + 1);
    const auto kinds = between_slices(slice, before, behind, gap.axis, share);
    const auto voxels = voxels_at(gap.first + n);
    for (std::size_t i = 0; i < kinds.size(); ++i)
      if (mask.kinds[voxels[i]] == Kind::tissue) mask.kinds[voxels[i]] = kinds[i];
  }
}

std::string described(const Gap& gap, const LumenMask& mask) {
  // Numbers as viewers have them, from 0 in the image.
  const auto first = gap.first - mask.image_low[gap.axis], last = first + gap.count - 1;
  return fmt::format("{} along axis {} (at {})",
                     first == last ? fmt::format("slice {}", first) : fmt::format("slices {} to {}", first, last),
                     gap.axis + 1, in_mm(gap.place));
}

}  // namespace

void mend_slices(LumenMask& mask, bool one_label, bool repair, const Log& log) {
  const auto gaps = find_gaps(mask, one_label);
  std::vector<Problem> problems;
  for (const auto& gap : gaps) {
    if (repair) {
      fill(gap, mask);
      log("a vessel is missing in " + described(gap, mask) + ", filled by interpolation");
    } else {
      problems.push_back({"image", "a vessel that the slices beside have is missing in " + described(gap, mask),
                          "label it there, or have it interpolated by `repair: [slices]`"});
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace tunica::imaging
