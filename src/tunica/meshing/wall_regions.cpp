#include "tunica/meshing/wall_regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "tunica/base/disjoint_sets.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/boundary.hpp"

namespace tunica::meshing {

namespace {

using mesh::centroid;

/// A straight way through the wall, from one triangle of the interface to where it comes out.
struct Passage {
  geometry::LabelledTriangle from;
  std::vector<geometry::Index> elements;  ///< crossed
  bool to_lumen = false;                  ///< else it comes out of the body, or got lost
  std::array<geometry::Index, 3> to{};    ///< nodes where it comes out
  double length = 0;                      ///< m
};

/// Across which face and after which length the ray leaves the element.
std::pair<int, double> leave(const geometry::Tetrahedra& mesh, geometry::Index element, const geometry::Point& from,
                             const geometry::Point& direction) {
  int face = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (int f = 0; f < 4; ++f) {
    const auto n = geometry::face_nodes(mesh, element, f);
    const geometry::Point& a = mesh.points[n[0]];
    const geometry::Point normal = cross(mesh.points[n[1]] - a, mesh.points[n[2]] - a);
    const double speed = dot(normal, direction);
    if (speed <= 1e-9 * norm(normal)) continue;  // behind, or along the face
    const double length = dot(normal, a - from) / speed;
    if (length < nearest) {
      nearest = length;
      face = f;
    }
  }
  return {face, nearest};
}

Passage pass(const geometry::Tetrahedra& mesh, const std::vector<std::array<geometry::Index, 4>>& adjacent,
             const geometry::LabelledTriangle& triangle) {
  Passage passage{triangle, {}, false, {}, 0};
  const auto& n = triangle.nodes;
  const geometry::Point from = centroid(mesh.points, n);
  geometry::Point direction = cross(mesh.points[n[1]] - mesh.points[n[0]], mesh.points[n[2]] - mesh.points[n[0]]);
  direction = (1 / norm(direction)) * direction;
  constexpr int most = 1000;  // rounding can make a ray run in circles about an edge
  for (geometry::Index element = triangle.neighbour; passage.elements.size() < most;) {
    passage.elements.push_back(element);
    const auto [face, length] = leave(mesh, element, from, direction);
    if (face < 0) break;
    passage.length = length;
    passage.to = geometry::face_nodes(mesh, element, face);
    element = adjacent[element][face];
    if (element < 0) break;
    if (mesh.labels[element] == geometry::lumen_label) {
      passage.to_lumen = true;
      break;
    }
  }
  return passage;
}

std::vector<Passage> pass_everywhere(const geometry::Tetrahedra& mesh,
                                     const std::vector<std::array<geometry::Index, 4>>& adjacent) {
  std::vector<Passage> passages;
  for (const auto& triangle : geometry::surface_triangles(mesh))
    if (triangle.label == geometry::lumen_label && triangle.neighbour_label == geometry::wall_label)
      passages.push_back(pass(mesh, adjacent, triangle));
  return passages;
}

/// Pairs of nodes whose values want to be equal (weight > 0) or opposite (weight < 0).
struct Tie {
  geometry::Index a, b;
  double weight;
};

std::vector<Tie> make_ties(const geometry::Tetrahedra& mesh, const std::vector<Passage>& passages,
                           double thickest_flap) {
  std::vector<Tie> ties;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (mesh.labels[e] != geometry::lumen_label) continue;
    const auto& t = mesh.elements[e];
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b) {
        // About the conductance of the element along this edge: cross-section by length.
        const double length = norm(mesh.points[t[a]] - mesh.points[t[b]]);
        ties.push_back({t[a], t[b], 0.05 * length});
      }
  }
  for (const auto& p : passages) {
    if (!p.to_lumen || p.length > thickest_flap) continue;
    const auto& n = p.from.nodes;
    const double area = norm(mesh::area_vector(mesh.points, n));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) ties.push_back({n[i], p.to[j], -area / 9 / p.length});
  }
  return ties;
}

/// Minimises the sum of |weight| (x_a -+ x_b)^2 with x = `held` where that is not 0: conjugate gradients, diagonal
/// scaling.
class SignedLaplacian {
 public:
  SignedLaplacian(const std::vector<Tie>& ties, const std::vector<double>& held)
      : held_(held), diagonal_(held.size(), 0.0), rows_(held.size() + 1, 0) {
    for (const auto& t : ties) {
      diagonal_[t.a] += std::abs(t.weight);
      diagonal_[t.b] += std::abs(t.weight);
      ++rows_[t.a + 1];
      ++rows_[t.b + 1];
    }
    for (std::size_t i = 0; i < held.size(); ++i) rows_[i + 1] += rows_[i];
    entries_.resize(rows_.back());
    auto next = rows_;
    for (const auto& t : ties) {
      entries_[next[t.a]++] = {t.b, t.weight};
      entries_[next[t.b]++] = {t.a, t.weight};
    }
    merge_entries();
  }

  std::vector<double> solve() const {
    const std::size_t n = held_.size();
    std::vector<double> x = held_, z(n), q(n), r(n);
    multiply(x, r);
    for (auto& v : r) v = -v;
    double old = scale(r, z);
    // Only signs are used, and they are clear but within a tear.
    const double target = 1e-12 * old;
    std::vector<double> p = z;
    constexpr int most = 5000;
    for (int k = 0; k < most && old > target; ++k) {
      multiply(p, q);
      double pq = 0;
      for (std::size_t i = 0; i < n; ++i) pq += p[i] * q[i];
      const double step = old / pq;
      for (std::size_t i = 0; i < n; ++i) {
        x[i] += step * p[i];
        r[i] -= step * q[i];
      }
      const double now = scale(r, z);
      for (std::size_t i = 0; i < n; ++i) p[i] = z[i] + now / old * p[i];
      old = now;
    }
    return x;
  }

 private:
  struct Entry {
    geometry::Index column;
    double weight;
  };

  /// Several elements share an edge.
  void merge_entries() {
    geometry::Index end = 0;
    for (std::size_t i = 0; i + 1 < rows_.size(); ++i) {
      const auto first = entries_.begin() + rows_[i], last = entries_.begin() + rows_[i + 1];
      std::sort(first, last, [](const Entry& a, const Entry& b) { return a.column < b.column; });
      rows_[i] = end;
      for (auto e = first; e != last; ++e)
        if (end > rows_[i] && entries_[end - 1].column == e->column)
          entries_[end - 1].weight += e->weight;
        else
          entries_[end++] = *e;
    }
    rows_.back() = end;
    entries_.resize(end);
  }

  /// Rows of held nodes are left out.
  void multiply(const std::vector<double>& x, std::vector<double>& y) const {
    for (std::size_t i = 0; i < y.size(); ++i) {
      double sum = diagonal_[i] * x[i];
      for (geometry::Index k = rows_[i]; k < rows_[i + 1]; ++k) sum -= entries_[k].weight * x[entries_[k].column];
      y[i] = held_[i] != 0 ? 0 : sum;
    }
  }
  double scale(const std::vector<double>& r, std::vector<double>& z) const {
    double sum = 0;
    for (std::size_t i = 0; i < r.size(); ++i) {
      z[i] = diagonal_[i] > 0 ? r[i] / diagonal_[i] : 0;
      sum += r[i] * z[i];
    }
    return sum;
  }

  const std::vector<double>& held_;
  std::vector<double> diagonal_;
  std::vector<geometry::Index> rows_;
  std::vector<Entry> entries_;
};

double mean_side(const std::vector<double>& side, const std::array<geometry::Index, 3>& nodes) {
  return (side[nodes[0]] + side[nodes[1]] + side[nodes[2]]) / 3;
}

/// Lumen elements by their distance from a cap, along the mesh, as far as `reach` says on the way.
class Flood {
 public:
  Flood(const geometry::Tetrahedra& mesh, const std::vector<std::array<geometry::Index, 4>>& adjacent)
      : mesh_(mesh), adjacent_(adjacent), distance_(mesh.elements.size(), far) {}

  struct Reached {
    double distance, volume;
    geometry::Index element;
  };
  /// All elements in ascending order of distance, until `stop(reached)` is true.
  template <class Stop>
  std::vector<Reached> run(const std::vector<geometry::Index>& seeds, const Stop& stop) {
    using Entry = std::pair<double, geometry::Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const auto e : seeds) {
      distance_[e] = 0;
      queue.emplace(0.0, e);
    }
    std::vector<Reached> reached;
    std::vector<geometry::Index> touched = seeds;
    while (!queue.empty()) {
      const auto [distance, e] = queue.top();
      queue.pop();
      if (distance > distance_[e]) continue;
      reached.push_back({distance, volume(e), e});
      if (stop(reached)) break;
      for (const auto other : adjacent_[e]) {
        if (other < 0 || mesh_.labels[other] != geometry::lumen_label) continue;
        const double d = distance + norm(middle(e) - middle(other));
        if (d >= distance_[other]) continue;
        distance_[other] = d;
        touched.push_back(other);
        queue.emplace(d, other);
      }
    }
    for (const auto e : touched) distance_[e] = far;
    return reached;
  }

 private:
  static constexpr double far = 1e300;
  geometry::Point middle(geometry::Index e) const { return centroid(mesh_.points, mesh_.elements[e]); }
  double volume(geometry::Index e) const { return mesh::volume(mesh_.points, mesh_.elements[e]); }
  const geometry::Tetrahedra& mesh_;
  const std::vector<std::array<geometry::Index, 4>>& adjacent_;
  std::vector<double> distance_;
};

double area(const geometry::Tetrahedra& mesh, const Cap& cap) {
  double sum = 0;
  for (const auto& n : cap.triangles) sum += norm(mesh::area_vector(mesh.points, n));
  return sum;
}

/// Volume in each slice of the way from the cap tells the cross-section; the branch ends where it grows.
void mark_branch(const geometry::Tetrahedra& mesh, Flood& flood, const std::vector<geometry::Index>& seeds,
                 const Cap& cap, double widening, std::vector<bool>& in_branch) {
  const double slice = 0.8 * std::sqrt(area(mesh, cap) / 3.14159);
  std::vector<double> volumes;
  const auto reached = flood.run(seeds, [&](const std::vector<Flood::Reached>& all) {
    const auto k = static_cast<std::size_t>(all.back().distance / slice);
    if (k >= volumes.size()) {
      // The first slice is short of what lies before the first centroids; the second is the measure.
      if (volumes.size() > 2 && volumes.back() > widening * volumes[1]) return true;
      volumes.resize(k + 1, 0.0);
    }
    volumes[k] += all.back().volume;
    return false;
  });
  const double end = (static_cast<double>(volumes.size()) - 1) * slice;
  for (const auto& r : reached)
    if (r.distance < end) in_branch[r.element] = true;
}

std::vector<bool> find_branches(const geometry::Tetrahedra& mesh,
                                const std::vector<std::array<geometry::Index, 4>>& adjacent,
                                const std::vector<Cap>& caps, double widening) {
  std::vector<bool> in_branch(mesh.elements.size(), false);
  std::vector<int> cap_of_node(mesh.points.size(), -1);
  for (std::size_t c = 0; c < caps.size(); ++c)
    for (const auto& t : caps[c].triangles)
      for (const auto n : t) cap_of_node[n] = static_cast<int>(c);
  std::vector<std::vector<geometry::Index>> seeds(caps.size());
  for (geometry::Index e = 0; e < std::ssize(mesh.elements); ++e) {
    if (mesh.labels[e] != geometry::lumen_label) continue;
    int on = 0, cap = -1;
    for (const auto n : mesh.elements[e])
      if (cap_of_node[n] >= 0) {
        ++on;
        cap = cap_of_node[n];
      }
    if (on >= 3) seeds[cap].push_back(e);
  }
  Flood flood(mesh, adjacent);
  for (std::size_t c = 0; c < caps.size(); ++c)
    if (caps[c].branch) mark_branch(mesh, flood, seeds[c], caps[c], widening, in_branch);
  return in_branch;
}

/// Elements that no passage crossed take the region of a neighbour that has one, those nearest to one first.
void spread(const geometry::Tetrahedra& mesh, const std::vector<std::array<geometry::Index, 4>>& adjacent,
            std::vector<bool> known, std::vector<WallRegion>& regions) {
  std::queue<geometry::Index> queue;
  for (geometry::Index e = 0; e < std::ssize(mesh.elements); ++e)
    if (known[e]) queue.push(e);
  for (; !queue.empty(); queue.pop())
    for (const auto other : adjacent[queue.front()]) {
      if (other < 0 || known[other] || mesh.labels[other] == geometry::lumen_label) continue;
      known[other] = true;
      regions[other] = regions[queue.front()];
      queue.push(other);
    }
}

/// Takes the teeth out of the borders: an element most of whose neighbours are of one other region joins it.
void smooth_borders(const geometry::Tetrahedra& mesh, const std::vector<std::array<geometry::Index, 4>>& adjacent,
                    std::vector<WallRegion>& regions) {
  constexpr int sweeps = 4;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    // All at once: one after the other, a border could run through the whole wall.
    const auto before = regions;
    for (geometry::Index e = 0; e < std::ssize(mesh.elements); ++e) {
      if (mesh.labels[e] == geometry::lumen_label) continue;
      std::array<int, 4> count{};
      int neighbours_in_wall = 0;
      for (const auto other : adjacent[e])
        if (other >= 0 && mesh.labels[other] != geometry::lumen_label) {
          ++count[static_cast<int>(before[other])];
          ++neighbours_in_wall;
        }
      const auto most = std::max_element(count.begin(), count.end());
      if (2 * *most > neighbours_in_wall) regions[e] = static_cast<WallRegion>(most - count.begin());
    }
  }
}

/// Pockets of one sign within the other, where the way across a groove of the wall was taken for a flap, get the sign
/// around them.
void drop_pockets(const geometry::Tetrahedra& mesh, std::vector<double>& side) {
  constexpr double smallest = 0.01;  // of the largest piece of that sign
  base::DisjointSets pieces(std::ssize(side));
  const auto for_each_lumen_element = [&](const auto& visit) {
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      if (mesh.labels[e] == geometry::lumen_label) visit(mesh.elements[e]);
  };
  for_each_lumen_element([&](const auto& nodes) {
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b)
        if ((side[nodes[a]] > 0) == (side[nodes[b]] > 0)) pieces.join(nodes[a], nodes[b]);
  });
  std::vector<double> volumes(side.size(), 0.0);  // of a piece, at the node that stands for it
  for_each_lumen_element([&](const auto& nodes) {
    for (const auto n : nodes) volumes[pieces.set_of(n)] += 0.25 * mesh::volume(mesh.points, nodes);
  });
  double largest[2] = {0, 0};
  for (std::size_t n = 0; n < side.size(); ++n) largest[side[n] > 0] = std::max(largest[side[n] > 0], volumes[n]);
  const auto before = side;
  for (std::size_t n = 0; n < side.size(); ++n)
    if (const double volume = volumes[pieces.set_of(static_cast<geometry::Index>(n))];
        volume > 0 && volume < smallest * largest[before[n] > 0])
      side[n] = -before[n];
}

/// Holds the corners of the lumen element nearest to each place.
void hold_near(const geometry::Tetrahedra& mesh, const std::vector<geometry::Point>& places, double value,
               std::vector<double>& held) {
  for (const auto& place : places) {
    std::pair<double, geometry::Index> nearest{std::numeric_limits<double>::infinity(), -1};
    for (geometry::Index e = 0; e < std::ssize(mesh.elements); ++e)
      if (mesh.labels[e] == geometry::lumen_label)
        nearest = std::min(nearest, {norm(centroid(mesh.points, mesh.elements[e]) - place), e});
    constexpr double reach = 20e-3;
    if (nearest.first > reach)
      throw InputError("lumens",
                       fmt::format("({:.1f}, {:.1f}, {:.1f}) mm is {:.0f} mm away from the lumen", 1e3 * place[0],
                                   1e3 * place[1], 1e3 * place[2], 1e3 * nearest.first),
                       "give a place in the lumen, with its unit");
    for (const auto n : mesh.elements[nearest.second]) held[n] = value;
  }
}

}  // namespace

WallRegions find_wall_regions(const geometry::Tetrahedra& mesh, const std::vector<Cap>& caps,
                              const WallRegionOptions& options) {
  if (caps.empty() || caps[0].triangles.empty())
    throw InputError("inlet", "has no triangle in the mesh", "mesh finer, or check where the inlet is");
  const auto adjacent = geometry::neighbours(mesh);
  const auto passages = pass_everywhere(mesh, adjacent);
  std::vector<double> held(mesh.points.size(), 0.0);
  if (options.true_lumen.empty() && options.false_lumen.empty())
    for (const auto& t : caps[0].triangles)
      for (const auto n : t) held[n] = 1;
  hold_near(mesh, options.true_lumen, 1, held);
  hold_near(mesh, options.false_lumen, -1, held);
  const auto ties = make_ties(mesh, passages, options.thickest_flap);
  WallRegions result{std::vector<WallRegion>(mesh.elements.size(), WallRegion::true_lumen_wall),
                     SignedLaplacian(ties, held).solve()};
  drop_pockets(mesh, result.side);
  const auto in_branch = find_branches(mesh, adjacent, caps, options.branch_widening);

  // Of the passages through an element the shortest one counts: from the rim of a tear some run along the flap.
  std::vector<double> shortest(mesh.elements.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> known(mesh.elements.size(), false);
  for (const auto& p : passages) {
    const double here = mean_side(result.side, p.from.nodes);
    const bool flap = p.to_lumen && p.length <= options.thickest_flap && here * mean_side(result.side, p.to) < 0;
    const WallRegion region = flap                        ? WallRegion::flap
                              : in_branch[p.from.element] ? WallRegion::branches
                              : here < 0                  ? WallRegion::false_lumen_wall
                                                          : WallRegion::true_lumen_wall;
    for (const auto e : p.elements) {
      if (p.length >= shortest[e]) continue;
      shortest[e] = p.length;
      result.of_element[e] = region;
      known[e] = true;
    }
  }
  spread(mesh, adjacent, std::move(known), result.of_element);
  smooth_borders(mesh, adjacent, result.of_element);
  return result;
}

}  // namespace tunica::meshing
