#include "tunica/mesh/boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>

namespace tunica::mesh {

namespace {

/// A triangle of a tetrahedron, filed under its smallest node.
struct Side {
  std::uint32_t middle, largest;  ///< the other two nodes
  std::int64_t code;              ///< 4 * element + face number
  auto key() const { return std::pair(middle, largest); }
};

std::array<std::int64_t, 3> outward(const std::array<std::int64_t, 4>& t, int face) {
  return {t[tetrahedron_faces[face][0]], t[tetrahedron_faces[face][1]], t[tetrahedron_faces[face][2]]};
}

/// Whether `nodes` is an even permutation of its sorted order.
bool even(const std::array<std::int64_t, 3>& n) { return ((n[0] < n[1]) + (n[1] < n[2]) + (n[2] < n[0])) == 2; }

struct Sides {
  std::vector<std::int64_t> first;
  std::vector<Side> sides;
};

Sides file_under_smallest_node(std::span<const std::array<std::int64_t, 4>> tetrahedra, std::int64_t nodes) {
  Sides result{std::vector<std::int64_t>(nodes + 1, 0), std::vector<Side>(4 * tetrahedra.size())};
  for (const auto& t : tetrahedra)
    for (int f = 0; f < 4; ++f) ++result.first[sorted(outward(t, f))[0] + 1];
  for (std::int64_t n = 0; n < nodes; ++n) result.first[n + 1] += result.first[n];
  auto next = result.first;
  for (std::int64_t e = 0; e < std::ssize(tetrahedra); ++e)
    for (int f = 0; f < 4; ++f) {
      const auto s = sorted(outward(tetrahedra[e], f));
      result.sides[next[s[0]]++] = {static_cast<std::uint32_t>(s[1]), static_cast<std::uint32_t>(s[2]), 4 * e + f};
    }
  return result;
}

}  // namespace

Boundary::Boundary(std::span<const std::array<std::int64_t, 4>> tetrahedra, std::int64_t nodes,
                   const std::string& where)
    : first_(nodes + 1, 0) {
  assert(nodes < std::numeric_limits<std::uint32_t>::max());
  auto [first, sides] = file_under_smallest_node(tetrahedra, nodes);
  std::int64_t bad = 0, bad_element = -1;
  for (std::int64_t n = 0; n < nodes; ++n) {
    const auto begin = sides.begin() + first[n], end = sides.begin() + first[n + 1];
    std::sort(begin, end,
              [](const Side& a, const Side& b) { return std::pair(a.key(), a.code) < std::pair(b.key(), b.code); });
    for (auto run = begin; run != end;) {
      const auto last = std::find_if(run, end, [&](const Side& s) { return s.key() != run->key(); });
      const auto triangle = outward(tetrahedra[run->code / 4], run->code % 4);
      const bool same_side =
          last - run == 2 && even(triangle) == even(outward(tetrahedra[run[1].code / 4], run[1].code % 4));
      if (last - run == 1) triangles_.push_back({triangle, run->code / 4});
      if (last - run > 2 || same_side) {
        if (bad++ == 0) bad_element = run->code / 4;
      }
      run = last;
    }
    first_[n + 1] = std::ssize(triangles_);
  }
  if (bad > 0)
    throw InputError(where,
                     fmt::format("{} triangles are shared by more than two tetrahedra, or by two on the same side; the "
                                 "first one belongs to element {}",
                                 bad, bad_element + 1),
                     "remove duplicate or overlapping elements");
}

std::int64_t Boundary::find(const std::array<std::int64_t, 3>& nodes) const {
  const auto key = sorted(nodes);
  for (auto i = first_[key[0]]; i < first_[key[0] + 1]; ++i)
    if (sorted(triangles_[i].nodes) == key) return i;
  return -1;
}

std::string list_places(std::span<const Vec3<double>> places) {
  constexpr std::size_t shown = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(shown, places.size()); ++i)
    text += fmt::format("{}({:.6g}, {:.6g}, {:.6g}) m", i ? ", " : "", places[i][0], places[i][1], places[i][2]);
  if (places.size() > shown) text += fmt::format(" and {} more", places.size() - shown);
  return text;
}

std::string list_names(std::span<const std::string> names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

namespace {

/// Nodes of these triangles that lie where another one of them lies, within a thousandth of the shortest edge. Twins
/// are meant to.
std::vector<Vec3<double>> coinciding_nodes(const MeshData& data,
                                           std::span<const std::array<std::int64_t, 3>> triangles) {
  std::vector<std::int64_t> nodes;
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& t : triangles)
    for (int i = 0; i < 3; ++i) {
      nodes.push_back(t[i]);
      shortest = std::min(shortest, norm(data.points[t[i]] - data.points[t[(i + 1) % 3]]));
    }
  const auto& x = data.points;
  std::sort(nodes.begin(), nodes.end(), [&](auto a, auto b) { return std::pair(x[a][0], a) < std::pair(x[b][0], b); });
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const auto twins = [&](std::int64_t a, std::int64_t b) {
    const auto is = [&](const auto& pair) { return pair == std::pair(a, b) || pair == std::pair(b, a); };
    return std::any_of(data.twins.begin(), data.twins.end(), is);
  };
  const double tolerance = 1e-3 * shortest;
  std::vector<Vec3<double>> places;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (auto j = i + 1; j < nodes.size() && x[nodes[j]][0] - x[nodes[i]][0] <= tolerance; ++j)
      if (norm(x[nodes[j]] - x[nodes[i]]) <= tolerance && !twins(nodes[i], nodes[j])) {
        places.push_back(x[nodes[i]]);
        break;
      }
  return places;
}

}  // namespace

void orient_and_check_faces(MeshData& data, const Boundary& boundary, const std::string& where) {
  std::vector<Problem> problems;
  std::vector<std::array<std::int64_t, 3>> wrong;
  std::vector<std::int32_t> owner(boundary.triangles().size(), -1);
  for (std::int32_t f = 0; f < std::ssize(data.faces); ++f) {
    auto& face = data.faces[f];
    std::vector<Vec3<double>> inside, twice;
    std::string other;
    for (auto& triangle : face.triangles) {
      const auto i = boundary.find(triangle);
      if (i < 0) {
        inside.push_back(mesh::centroid(data.points, triangle));
        wrong.push_back(triangle);
      } else if (owner[i] >= 0) {
        twice.push_back(mesh::centroid(data.points, triangle));
        other = data.faces[owner[i]].name;
      } else {
        owner[i] = f;
        triangle = boundary.triangles()[i].nodes;
      }
    }
    if (!inside.empty())
      problems.push_back({where + ", face " + face.name,
                          fmt::format("{} of {} triangles do not lie on the boundary of the volume mesh: {}",
                                      inside.size(), face.triangles.size(), list_places(inside)),
                          "export the face from the same mesh as the volume"});
    if (!twice.empty())
      problems.push_back(
          {where + ", face " + face.name,
           fmt::format("{} triangles already belong to face {}: {}", twice.size(), other, list_places(twice)),
           "let every boundary triangle lie in exactly one face"});
  }
  std::vector<Vec3<double>> unnamed;
  for (std::size_t i = 0; i < owner.size(); ++i)
    if (owner[i] < 0) {
      wrong.push_back(boundary.triangles()[i].nodes);
      unnamed.push_back(mesh::centroid(data.points, wrong.back()));
    }
  if (const auto places = coinciding_nodes(data, wrong); !places.empty())
    problems.push_back(
        {where,
         fmt::format("{} nodes of the triangles below coincide with another node: parts of the mesh touch "
                     "without being joined: {}",
                     places.size(), list_places(places)),
         "merge the duplicate nodes, for example with ParaView's filter Clean to Grid or by meshing the "
         "parts together"});
  if (!unnamed.empty())
    problems.push_back({where,
                        fmt::format("{} of {} boundary triangles lie in no named face: {}", unnamed.size(),
                                    owner.size(), list_places(unnamed)),
                        "give every part of the boundary a named face"});
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace tunica::mesh
