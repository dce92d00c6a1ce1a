#include "tunica/stages/imaging/lumen_mask.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tunica/base/error.hpp"

namespace tunica::stages::imaging {

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

/// Voxels that hang together by their faces, and what they are.
struct Piece {
  bool lumen;
  std::vector<std::int64_t> voxels;
};

std::vector<Piece> pieces_of(const LumenMask& mask) {
  std::vector<Piece> pieces;
  std::vector<bool> seen(mask.kinds.size(), false);
  for (std::int64_t start = 0; start < std::ssize(mask.kinds); ++start) {
    if (seen[start]) continue;
    auto& piece = pieces.emplace_back(Piece{mask.is_lumen(start), {start}});
    seen[start] = true;
    for (std::size_t next = 0; next < piece.voxels.size(); ++next)
      for_each_face_neighbour(mask.frame, piece.voxels[next], [&](std::int64_t other) {
        if (seen[other] || mask.is_lumen(other) != piece.lumen) return;
        seen[other] = true;
        piece.voxels.push_back(other);
      });
  }
  return pieces;
}

/// The kind of most voxels around a hole.
Kind kind_around(const LumenMask& mask, const std::vector<std::int64_t>& voxels) {
  std::map<Kind, std::int64_t> counts;
  for (const auto v : voxels)
    for_each_face_neighbour(mask.frame, v, [&](std::int64_t other) {
      if (mask.is_lumen(other)) ++counts[mask.kinds[other]];
    });
  return counts[Kind::true_lumen] >= counts[Kind::false_lumen] ? Kind::true_lumen : Kind::false_lumen;
}

std::int64_t count_of(const LumenMask& mask, Kind kind) {
  return std::count(mask.kinds.begin(), mask.kinds.end(), kind);
}

void clean(LumenMask& mask, const Log& log) {
  const auto pieces = pieces_of(mask);
  const Piece* largest = nullptr;
  for (const auto& piece : pieces)
    if (piece.lumen && (!largest || piece.voxels.size() > largest->voxels.size())) largest = &piece;
  const double voxel = mask.frame.voxel_volume();
  std::int64_t dropped = 0, dropped_voxels = 0, filled = 0, filled_voxels = 0;
  for (const auto& piece : pieces) {
    if (&piece == largest || piece.voxels.front() == 0) continue;  // the first voxel lies in the tissue around all
    const Kind kind = piece.lumen ? Kind::tissue : kind_around(mask, piece.voxels);
    for (const auto v : piece.voxels) mask.kinds[v] = kind;
    ++(piece.lumen ? dropped : filled);
    (piece.lumen ? dropped_voxels : filled_voxels) += std::ssize(piece.voxels);
  }
  if (dropped > 0)
    log(fmt::format("{} separate pieces of lumen dropped, {:.3f} ml together", dropped,
                    ml(voxel * static_cast<double>(dropped_voxels))));
  if (filled > 0)
    log(fmt::format("{} holes in the lumen filled, {:.3f} ml together", filled,
                    ml(voxel * static_cast<double>(filled_voxels))));
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

}  // namespace tunica::stages::imaging
