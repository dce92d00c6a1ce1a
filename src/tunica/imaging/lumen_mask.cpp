#include "tunica/imaging/lumen_mask.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tunica/base/error.hpp"

namespace tunica::imaging {

namespace {

double ml(double cubic_metres) { return 1e6 * cubic_metres; }

void check_labels(const LabelImage& image, const LumenLabels& labels) {
  std::map<int, std::int64_t> counts;
  for (const auto label : image.labels) ++counts[label];
  std::string there;
  for (const auto& [label, count] : counts) there += fmt::format("{}{}", there.empty() ? "" : ", ", label);
  std::vector<Problem> problems;
  const auto check = [&](const char* key, int label) {
    if (!counts.contains(label))
      problems.push_back({key, fmt::format("no voxel has the label {}; the image has {}", label, there),
                          "give the number that the segmentation uses"});
  };
  check("true_lumen", labels.true_lumen);
  if (labels.false_lumen) check("false_lumen", *labels.false_lumen);
  if (labels.false_lumen == labels.true_lumen)
    problems.push_back({"false_lumen", "has the label of the true lumen", "give each lumen a label of its own"});
  if (!problems.empty()) throw InputError(std::move(problems));
}

LumenMask cropped(const LabelImage& image, const LumenLabels& labels, std::int64_t margin) {
  const auto& from = image.frame;
  const auto kind = [&](std::int64_t index) {
    const int label = image.labels[index];
    return label == labels.true_lumen                           ? Kind::true_lumen
           : labels.false_lumen && label == *labels.false_lumen ? Kind::false_lumen
                                                                : Kind::tissue;
  };
  Size3 low = from.size, high{0, 0, 0};
  for (std::int64_t i = 0; i < from.count(); ++i) {
    if (kind(i) == Kind::tissue) continue;
    const auto v = from.voxel(i);
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], v[d]);
      high[d] = std::max(high[d], v[d]);
    }
  }
  LumenMask mask{from, {}, {}, {}};
  for (int d = 0; d < 3; ++d) {
    low[d] -= margin;
    mask.frame.size[d] = high[d] + margin + 1 - low[d];
    mask.image_low[d] = -low[d];
    mask.image_high[d] = from.size[d] - 1 - low[d];
  }
  mask.frame.origin = from.place(low);
  mask.kinds.assign(mask.frame.count(), Kind::tissue);
  for (std::int64_t i = 0; i < mask.frame.count(); ++i) {
    const auto v = mask.frame.voxel(i);
    const Size3 w{v[0] + low[0], v[1] + low[1], v[2] + low[2]};
    if (from.holds(w[0], w[1], w[2])) mask.kinds[i] = kind(from.index(w[0], w[1], w[2]));
  }
  return mask;
}

/// Pieces of lumen or tissue that hang together by the faces of their voxels.
struct Pieces {
  std::vector<std::int32_t> of;      ///< piece of each voxel; that of the first voxel, outside of all, is 0
  std::vector<std::int64_t> first;   ///< a voxel of each piece
  std::vector<std::int64_t> voxels;  ///< how many it has
  std::vector<std::int64_t> true_neighbours, false_neighbours;  ///< faces on voxels of the lumens, of tissue
};

Pieces pieces_of(const LumenMask& mask) {
  Pieces pieces{std::vector<std::int32_t>(mask.kinds.size(), -1), {}, {}, {}, {}};
  std::vector<std::int64_t> stack;
  for (std::int64_t start = 0; start < std::ssize(mask.kinds); ++start) {
    if (pieces.of[start] >= 0) continue;
    const auto piece = static_cast<std::int32_t>(pieces.first.size());
    pieces.first.push_back(start);
    for (auto* counts : {&pieces.voxels, &pieces.true_neighbours, &pieces.false_neighbours}) counts->push_back(0);
    pieces.of[start] = piece;
    stack.push_back(start);
    while (!stack.empty()) {
      const auto index = stack.back();
      stack.pop_back();
      ++pieces.voxels[piece];
      for_each_face_neighbour(mask.frame, index, [&](std::int64_t other) {
        if (mask.is_lumen(other) != mask.is_lumen(start)) {
          pieces.true_neighbours[piece] += mask.kinds[other] == Kind::true_lumen;
          pieces.false_neighbours[piece] += mask.kinds[other] == Kind::false_lumen;
        } else if (pieces.of[other] < 0) {
          pieces.of[other] = piece;
          stack.push_back(other);
        }
      });
    }
  }
  return pieces;
}

std::int64_t count_of(const LumenMask& mask, Kind kind) {
  return std::count(mask.kinds.begin(), mask.kinds.end(), kind);
}

void clean(LumenMask& mask, const Log& log) {
  const auto pieces = pieces_of(mask);
  std::size_t largest = 0;  // the tissue around all, so never the answer
  for (std::size_t p = 1; p < pieces.first.size(); ++p)
    if (mask.is_lumen(pieces.first[p]) && (largest == 0 || pieces.voxels[p] > pieces.voxels[largest])) largest = p;
  // What each piece becomes.
  std::vector<std::optional<Kind>> change(pieces.first.size());
  std::int64_t dropped = 0, filled = 0;
  double dropped_volume = 0, filled_volume = 0;
  for (std::size_t p = 1; p < change.size(); ++p) {
    if (p == largest) continue;
    const bool lumen = mask.is_lumen(pieces.first[p]);
    change[p] = lumen                                                     ? Kind::tissue
                : pieces.true_neighbours[p] >= pieces.false_neighbours[p] ? Kind::true_lumen
                                                                          : Kind::false_lumen;
    ++(lumen ? dropped : filled);
    (lumen ? dropped_volume : filled_volume) += mask.frame.voxel_volume() * static_cast<double>(pieces.voxels[p]);
  }
  for (std::size_t i = 0; i < mask.kinds.size(); ++i)
    if (const auto& kind = change[pieces.of[i]]) mask.kinds[i] = *kind;
  if (dropped > 0)
    log(fmt::format("{} separate pieces of lumen dropped, {:.3f} ml together", dropped, ml(dropped_volume)));
  if (filled > 0) log(fmt::format("{} holes in the lumen filled, {:.3f} ml together", filled, ml(filled_volume)));
}

/// Dropping pieces must not take away a lumen.
void check_connected(const LumenMask& mask, Kind kind, const char* name, std::int64_t before) {
  const auto left = count_of(mask, kind);
  if (2 * left > before) return;
  throw InputError(fmt::format("{} lumen", name),
                   fmt::format("only {:.2f} of its {:.2f} ml hang together with the other lumen: no tear is open",
                               ml(mask.frame.voxel_volume() * static_cast<double>(left)),
                               ml(mask.frame.voxel_volume() * static_cast<double>(before))),
                   "label the blood in the tears as lumen, so that the voxels of both lumens touch there");
}

}  // namespace

LumenMask lumen_mask(const LabelImage& image, const LumenLabels& labels, std::int64_t margin, const Log& log) {
  check_labels(image, labels);
  auto mask = cropped(image, labels, margin);
  const auto true_before = count_of(mask, Kind::true_lumen), false_before = count_of(mask, Kind::false_lumen);
  clean(mask, log);
  check_connected(mask, Kind::true_lumen, "true", true_before);
  if (labels.false_lumen) check_connected(mask, Kind::false_lumen, "false", false_before);
  return mask;
}

std::vector<Contact> find_contacts(const LumenMask& mask, double smallest) {
  const auto& frame = mask.frame;
  // Area vectors of the faces across each axis.
  Vec3<double> faces[3];
  for (int d = 0; d < 3; ++d) faces[d] = cross(frame.steps[(d + 1) % 3], frame.steps[(d + 2) % 3]);
  std::map<std::int64_t, Vec3<double>> touching;  // voxels of the false lumen: area towards the true one
  for (std::int64_t i = 0; i < std::ssize(mask.kinds); ++i) {
    if (mask.kinds[i] != Kind::false_lumen) continue;
    const auto v = frame.voxel(i);
    for_each_face_neighbour(frame, i, [&](std::int64_t other) {
      if (mask.kinds[other] != Kind::true_lumen) return;
      const auto w = frame.voxel(other);
      for (int d = 0; d < 3; ++d) touching[i] = touching[i] + static_cast<double>(w[d] - v[d]) * faces[d];
    });
  }
  std::vector<Contact> contacts;
  while (!touching.empty()) {
    std::vector<std::int64_t> stack{touching.begin()->first};
    Vec3<double> area = touching.begin()->second;
    Point sum{{0, 0, 0}};
    touching.erase(touching.begin());
    double count = 0;
    while (!stack.empty()) {
      const auto i = stack.back();
      stack.pop_back();
      sum = sum + frame.place(frame.voxel(i));
      ++count;
      for_each_neighbour(frame, i, [&](std::int64_t other, const Size3&) {
        const auto found = touching.find(other);
        if (found == touching.end()) return;
        area = area + found->second;
        touching.erase(found);
        stack.push_back(other);
      });
    }
    if (norm(area) >= smallest) contacts.push_back({(1 / count) * sum, norm(area)});
  }
  std::sort(contacts.begin(), contacts.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
  return contacts;
}

}  // namespace tunica::imaging
