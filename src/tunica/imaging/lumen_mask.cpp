#include "tunica/imaging/lumen_mask.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tunica/base/error.hpp"
#include "tunica/imaging/missing_slices.hpp"
#include "tunica/imaging/voxel_topology.hpp"

namespace tunica::imaging {

namespace {

double ml(double cubic_metres) { return 1e6 * cubic_metres; }

/// How much of each label there is, and what it becomes.
void check_labels(const LabelImage& image, const LumenLabels& labels, const Log& log) {
  std::map<int, std::int64_t> counts;
  for (const auto label : image.labels) ++counts[label];
  std::string there;
  std::vector<Problem> problems;
  for (const auto& [label, count] : counts) {
    there += fmt::format("{}{}", there.empty() ? "" : ", ", label);
    const bool is_tissue = std::find(labels.tissue.begin(), labels.tissue.end(), label) != labels.tissue.end();
    const char* role = label == labels.true_lumen    ? "true lumen"
                       : label == labels.false_lumen ? "false lumen"
                       : label == labels.thrombus    ? "thrombus: wall, which goes around it"
                       : is_tissue                   ? "tissue: wall where the wall grows there, else outside"
                       : label == 0                  ? "outside"
                                                     : nullptr;
    const double volume = ml(image.frame.voxel_volume() * static_cast<double>(count));
    log(fmt::format("label {}: {:.2f} ml, {}", label, volume, role ? role : "not named"));
    if (!role)
      problems.push_back(
          {fmt::format("label {}", label),
           fmt::format("{:.2f} ml of the image have it, and nothing says what they are", volume),
           fmt::format(
               "give `thrombus: {}` for clotted blood, which the wall goes around, `tissue: [{}]` for what else "
               "is no flowing blood (wall, other organs), or join it with a lumen",
               label, label)});
  }
  const auto check = [&](const char* key, int label) {
    if (!counts.contains(label))
      problems.push_back({key, fmt::format("no voxel has the label {}; the image has {}", label, there),
                          "give the number that the segmentation uses"});
  };
  check("true_lumen", labels.true_lumen);
  if (labels.false_lumen) check("false_lumen", *labels.false_lumen);
  if (labels.thrombus) check("thrombus", *labels.thrombus);
  if (labels.thrombus && (labels.thrombus == labels.true_lumen || labels.thrombus == labels.false_lumen))
    problems.push_back({"thrombus", fmt::format("label {} is a lumen", *labels.thrombus),
                        "give the label of the clotted blood alone"});
  if (labels.false_lumen == labels.true_lumen)
    problems.push_back({"false_lumen", "has the label of the true lumen", "give each lumen a label of its own"});
  for (const double label : labels.tissue)
    if (label == labels.true_lumen || label == labels.false_lumen)
      problems.push_back({"tissue", fmt::format("label {} is a lumen", label), "take it out of the list"});
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
  const double smallest = std::min({norm(from.steps[0]), norm(from.steps[1]), norm(from.steps[2])});
  for (int d = 0; d < 3; ++d) {
    // Long voxels take fewer.
    const double share = smallest / norm(from.steps[d]);
    const auto around = std::min(margin, 3 + static_cast<std::int64_t>(std::ceil(share * static_cast<double>(margin))));
    low[d] -= around;
    mask.frame.size[d] = high[d] + around + 1 - low[d];
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

/// Separate pieces that are too large to be noise of the segmentation.
constexpr double largest_speck = 1e-6;  // m^3

void check_pieces(const LumenMask& mask, const Pieces& pieces, std::size_t largest) {
  std::vector<Problem> problems;
  const auto of_false = count_of(mask, Kind::false_lumen);
  for (std::size_t p = 1; p < pieces.first.size(); ++p) {
    const double volume = mask.frame.voxel_volume() * static_cast<double>(pieces.voxels[p]);
    if (p == largest || !mask.is_lumen(pieces.first[p]) || volume < largest_speck) continue;
    if (mask.kinds[pieces.first[p]] == Kind::false_lumen && 2 * pieces.voxels[p] > of_false) {
      problems.push_back({"false lumen",
                          fmt::format("{:.1f} of its {:.1f} ml touch the true lumen nowhere: no tear joins the lumens",
                                      ml(volume), ml(mask.frame.voxel_volume() * static_cast<double>(of_false))),
                          "label the blood in the tears as lumen, so that the voxels of both lumens touch there"});
      continue;
    }
    problems.push_back({"image",
                        fmt::format("a piece of lumen of {:.1f} ml at {} is separate from the rest", ml(volume),
                                    in_mm(mask.frame.place(mask.frame.voxel(pieces.first[p])))),
                        "join it in the segmentation, or drop such pieces by `repair: [pieces]`"});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

/// Leaves the largest piece, and another one of the other lumen where the lumens are `apart`.
void clean(LumenMask& mask, const Repairs& repairs, bool apart, const Log& log) {
  const auto pieces = pieces_of(mask);
  std::size_t largest = 0;  // the tissue around all, so never the answer
  for (std::size_t p = 1; p < pieces.first.size(); ++p)
    if (mask.is_lumen(pieces.first[p]) && (largest == 0 || pieces.voxels[p] > pieces.voxels[largest])) largest = p;
  if (!apart && !repairs[Repair::pieces]) check_pieces(mask, pieces, largest);
  std::size_t second = 0;
  for (std::size_t p = 1; apart && p < pieces.first.size(); ++p)
    if (mask.is_lumen(pieces.first[p]) && mask.kinds[pieces.first[p]] != mask.kinds[pieces.first[largest]] &&
        (second == 0 || pieces.voxels[p] > pieces.voxels[second]))
      second = p;
  // What each piece becomes.
  std::vector<std::optional<Kind>> change(pieces.first.size());
  std::int64_t dropped = 0, filled = 0;
  double dropped_volume = 0, filled_volume = 0;
  for (std::size_t p = 1; p < change.size(); ++p) {
    if (p == largest || p == second) continue;
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

/// A false lumen is one: another large part of it is no speck that may become true lumen.
void check_parts(const LumenMask& mask, VoxelSet others) {
  keep_largest_part(mask.frame, others);
  std::vector<std::int64_t> voxels;
  for (std::int64_t i = 0; i < std::ssize(others); ++i)
    if (others[i]) voxels.push_back(i);
  const double volume = mask.frame.voxel_volume() * static_cast<double>(voxels.size());
  if (volume < largest_speck) return;
  throw InputError(
      "false lumen",
      fmt::format("{:.1f} ml of it about {} hang together with the rest through the true lumen only: there "
                  "are two false lumens, and one can be meshed",
                  ml(volume), in_mm(middle_of(mask.frame, voxels))),
      "join its parts in the segmentation, give one of them the label of the true lumen, or count the "
      "smaller one as true lumen by `repair: [pieces]`");
}

/// Parts of a lumen that hang on the rest only through the other lumen belong to that: specks of the wrong label, and
/// branches of the false lumen that bear the label of all branches.
void rename_parts(LumenMask& mask, const Repairs& repairs, const Log& log) {
  for (const auto kind : {Kind::true_lumen, Kind::false_lumen}) {
    auto set = voxels_of(mask.kinds, kind);
    const auto all = set;
    const auto changed = keep_largest_part(mask.frame, set);
    if (changed == 0) continue;
    const bool to_false = kind == Kind::true_lumen;
    if (!to_false && !repairs[Repair::pieces]) {
      auto others = all;
      for (std::size_t i = 0; i < set.size(); ++i) others[i] = all[i] && !set[i];
      check_parts(mask, std::move(others));
    }
    for (std::size_t i = 0; i < set.size(); ++i)
      if (all[i] && !set[i]) mask.kinds[i] = to_false ? Kind::false_lumen : Kind::true_lumen;
    log(fmt::format("{:.3f} ml of the {} lumen hang on the other lumen only, and count as {} lumen",
                    ml(mask.frame.voxel_volume() * static_cast<double>(changed)), to_false ? "true" : "false",
                    to_false ? "false" : "true"));
  }
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

VoxelSet voxels_of(const std::vector<Kind>& kinds, Kind kind) {
  VoxelSet set(kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) set[i] = kinds[i] == kind;
  return set;
}

std::string in_mm(const Point& p) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f}) mm", 1e3 * p[0], 1e3 * p[1], 1e3 * p[2]);
}

Point middle_of(const ImageFrame& frame, const std::vector<std::int64_t>& voxels) {
  Point sum{{0, 0, 0}};
  for (const auto i : voxels) sum = sum + frame.place(frame.voxel(i));
  return (1 / static_cast<double>(voxels.size())) * sum;
}

LumenMask lumen_mask(const LabelImage& image, const LumenLabels& labels, std::int64_t margin, const Log& log,
                     const Repairs& repairs, bool apart) {
  check_labels(image, labels, log);
  auto mask = cropped(image, labels, margin);
  mend_slices(mask, !labels.false_lumen, repairs[Repair::slices], log);
  const auto true_before = count_of(mask, Kind::true_lumen), false_before = count_of(mask, Kind::false_lumen);
  clean(mask, repairs, apart, log);
  check_connected(mask, Kind::true_lumen, "true", true_before);
  if (labels.false_lumen) {
    check_connected(mask, Kind::false_lumen, "false", false_before);
    rename_parts(mask, repairs, log);
  }
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
    double faces_area = norm(area);
    Point sum{{0, 0, 0}};
    touching.erase(touching.begin());
    double count = 0;
    std::vector<std::int64_t> voxels;
    while (!stack.empty()) {
      const auto i = stack.back();
      stack.pop_back();
      voxels.push_back(i);
      sum = sum + frame.place(frame.voxel(i));
      ++count;
      for_each_neighbour(frame, i, [&](std::int64_t other, const Size3&) {
        const auto found = touching.find(other);
        if (found == touching.end()) return;
        area = area + found->second;
        faces_area += norm(found->second);
        touching.erase(found);
        stack.push_back(other);
      });
    }
    if (norm(area) >= smallest) contacts.push_back({(1 / count) * sum, norm(area), std::move(voxels), faces_area});
  }
  std::sort(contacts.begin(), contacts.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
  return contacts;
}

}  // namespace tunica::imaging
