#include "tunica/meshing/reconnect.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/mesh/boundary.hpp"

namespace tunica::meshing {

namespace {

using Node = LocalMesh::Node;
using Cell = LocalMesh::Cell;
using Corners = LocalMesh::Corners;
using Place = LocalMesh::Place;

constexpr double least_gain = 1.02;  // of the worst sine: smaller ones are not worth a change

/// A set of elements and what would replace them.
struct Change {
  std::vector<Cell> old;
  std::vector<LocalMesh::NewCell> fresh;
  double sine = -1;                        ///< worst of `fresh`
  std::array<Node, 2> on_surface{-1, -1};  ///< a new edge that lies on a surface
};

double worst_of(const LocalMesh& mesh, const std::vector<Cell>& cells) {
  double worst = 1;
  for (const Cell c : cells) worst = std::min<double>(worst, mesh.sine(c));
  return worst;
}

/// The best triangulation of a polygon around the edge (a, b), whose triangles each make one element with a and one
/// with b (Klincsek 1980, Ann. Discrete Math. 9, 121-123). Returns the worst sine and appends the elements.
double fill_polygon(const LocalMesh& mesh, const std::vector<Node>& polygon, Node a, Node b, int label,
                    std::vector<LocalMesh::NewCell>& fresh) {
  const int n = static_cast<int>(polygon.size());
  constexpr int most = 10;
  if (n > most) return -1;
  double best[most][most];
  int apex[most][most];
  // Of the pair above and below the triangle (i, j, k); nodes run counter-clockwise seen from b.
  const auto above = [&](int i, int j, int k) { return Corners{polygon[i], polygon[j], polygon[k], b}; };
  const auto below = [&](int i, int j, int k) { return Corners{polygon[i], polygon[k], polygon[j], a}; };
  for (int i = 0; i + 1 < n; ++i) best[i][i + 1] = 1;
  for (int span = 2; span < n; ++span)
    for (int i = 0; i + span < n; ++i) {
      const int k = i + span;
      best[i][k] = -2;
      for (int j = i + 1; j < k; ++j) {
        double value = std::min(best[i][j], best[j][k]);
        if (value <= best[i][k]) continue;
        value = std::min({value, mesh.cell_sine(above(i, j, k)), mesh.cell_sine(below(i, j, k))});
        if (value > best[i][k]) {
          best[i][k] = value;
          apex[i][k] = j;
        }
      }
      if (best[i][k] <= 0) best[i][k] = -2;
    }
  if (n >= 3 && best[0][n - 1] <= 0) return -1;
  std::vector<std::pair<int, int>> open = {{0, n - 1}};
  while (!open.empty()) {
    const auto [i, k] = open.back();
    open.pop_back();
    if (k - i < 2) continue;
    const int j = apex[i][k];
    fresh.push_back({above(i, j, k), label});
    fresh.push_back({below(i, j, k), label});
    open.emplace_back(i, j);
    open.emplace_back(j, k);
  }
  return n >= 3 ? best[0][n - 1] : 1;
}

/// Where the label changes along the ring: positions of nodes.
std::vector<std::size_t> label_changes(const LocalMesh& mesh, const LocalMesh::Ring& ring) {
  std::vector<std::size_t> at;
  const std::size_t n = ring.cells.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = i == 0 ? n - 1 : i - 1;
    if (i == 0 && !ring.closed) continue;
    if (mesh.label(ring.cells[i]) != mesh.label(ring.cells[before])) at.push_back(i);
  }
  return at;
}

/// May the two surface triangles at the edge (a, b) with opposite nodes p, q be replaced by those at (p, q)? The
/// surface must hardly bend. An edge from p to q may exist only where a flat element between the four nodes is what
/// goes.
bool may_turn(const LocalMesh& mesh, Node a, Node b, Node p, Node q, bool one_between) {
  if (mesh.is_edge(p, q)) {
    const auto around = mesh.ring(p, q);
    if (!one_between || !around || !around->closed || !label_changes(mesh, *around).empty()) return false;
  }
  const auto area = [&](Node x, Node y, Node z) {
    return cross(mesh.point(y) - mesh.point(x), mesh.point(z) - mesh.point(x));
  };
  constexpr double flat = 0.978;  // cosine of 12 degrees
  const auto alike = [](const geometry::Point& x, const geometry::Point& y) {
    return dot(x, y) > flat * norm(x) * norm(y);
  };
  const geometry::Point old_1 = area(a, b, p), old_2 = area(b, a, q), new_1 = area(p, q, b), new_2 = area(q, p, a);
  // A flat element between may also be a fold of the surface, whose two sides lie on each other and cancel.
  return (one_between || alike(old_1, old_2)) && alike(new_1, new_2) && alike(old_1 + old_2, new_1) &&
         alike(old_1 + old_2, new_2);
}

Change remove_edge(const LocalMesh& mesh, Node a, Node b) {
  Change change;
  auto ring = mesh.ring(a, b);
  if (!ring) return change;
  const auto changes = label_changes(mesh, *ring);
  if (ring->closed ? changes.size() != 0 && changes.size() != 2 : !changes.empty()) return change;
  change.old = ring->cells;
  const auto& nodes = ring->nodes;
  if (ring->closed && changes.empty()) {
    if (nodes.size() < 3) return change;
    change.sine = fill_polygon(mesh, nodes, a, b, mesh.label(ring->cells[0]), change.fresh);
    return change;
  }
  if (!ring->closed) {
    if (!may_turn(mesh, a, b, nodes.back(), nodes.front(), ring->cells.size() == 1)) return change;
    change.on_surface = {nodes.back(), nodes.front()};
    change.sine = fill_polygon(mesh, nodes, a, b, mesh.label(ring->cells[0]), change.fresh);
    return change;
  }
  const std::size_t n = nodes.size(), inside = changes[1] - changes[0];
  if (!may_turn(mesh, a, b, nodes[changes[0]], nodes[changes[1]], inside == 1 || inside == n - 1)) return change;
  change.on_surface = {nodes[changes[0]], nodes[changes[1]]};
  double sine = 1;
  for (int side = 0; side < 2 && sine > 0; ++side) {
    const std::size_t first = changes[side], last = changes[1 - side];
    std::vector<Node> polygon;
    for (std::size_t i = first;; i = (i + 1) % n) {
      polygon.push_back(nodes[i]);
      if (i == last) break;
    }
    sine = std::min(sine, fill_polygon(mesh, polygon, a, b, mesh.label(ring->cells[first]), change.fresh));
  }
  change.sine = sine;
  return change;
}

/// Two elements that share a face become three around the edge between the nodes opposite to it.
Change replace_face(const LocalMesh& mesh, Cell cell, int f) {
  Change change;
  const Cell other = mesh.across(cell, f);
  if (other < 0 || mesh.label(other) != mesh.label(cell)) return change;
  const auto& k = mesh.corners(cell);
  const auto& t = mesh::tetrahedron_faces[f];
  const Node a = k[f];
  Node b = -1;
  for (const Node n : mesh.corners(other))
    if (n != k[t[0]] && n != k[t[1]] && n != k[t[2]]) b = n;
  change.old = {cell, other};
  change.sine = 1;
  for (int i = 0; i < 3; ++i) {
    // The face is counter-clockwise seen from b.
    const Corners corners = {a, k[t[i]], k[t[(i + 1) % 3]], b};
    change.sine = std::min(change.sine, mesh.cell_sine(corners));
    change.fresh.push_back({corners, mesh.label(cell)});
  }
  return change;
}

/// Does the change join nodes of the surfaces of the wall that were not joined before?
bool makes_bridge(const LocalMesh& mesh, const Change& change) {
  for (const auto& f : change.fresh) {
    if (f.label != geometry::wall_label) continue;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) {
        const Node a = f.corners[i], b = f.corners[j];
        if (mesh.place(a) == Place::inner || mesh.place(b) == Place::inner) continue;
        const bool on_surface = (change.on_surface[0] == a && change.on_surface[1] == b) ||
                                (change.on_surface[0] == b && change.on_surface[1] == a);
        if (!on_surface && !mesh.is_edge(a, b)) return true;
      }
  }
  return false;
}

bool worth_it(const LocalMesh& mesh, const Change& change, const ReconnectOptions& options) {
  return change.sine > 0 && change.sine > least_gain * worst_of(mesh, change.old) &&
         !(options.keep_surface && change.on_surface[0] >= 0) && !(options.keep_layers && makes_bridge(mesh, change));
}

/// The node `gone` moves into `kept`.
Change move_into(const LocalMesh& mesh, Node gone, Node kept, double enough) {
  Change change{mesh.star(gone), {}, 1};
  for (const Cell c : mesh.star(gone)) {
    Corners corners = mesh.corners(c);
    if (std::find(corners.begin(), corners.end(), kept) != corners.end()) continue;
    std::replace(corners.begin(), corners.end(), gone, kept);
    change.sine = std::min(change.sine, mesh.cell_sine(corners));
    if (change.sine <= enough) break;
    change.fresh.push_back({corners, mesh.label(c)});
  }
  return change;
}

}  // namespace

bool reconnect(LocalMesh& mesh, Cell cell, const ReconnectOptions& options) {
  const Corners k = mesh.corners(cell);
  Change best;
  const auto offer = [&](Change&& change) {
    if (change.sine > best.sine && worth_it(mesh, change, options)) best = std::move(change);
  };
  for (int a = 0; a < 4; ++a)
    for (int b = a + 1; b < 4; ++b) offer(remove_edge(mesh, k[a], k[b]));
  for (int f = 0; f < 4; ++f) offer(replace_face(mesh, cell, f));
  if (best.sine <= 0) return false;
  mesh.replace(best.old, best.fresh);
  return true;
}

bool collapse(LocalMesh& mesh, Cell cell, const ReconnectOptions& options) {
  const Corners k = mesh.corners(cell);
  Change best;
  for (const Node gone : k) {
    if (mesh.place(gone) != Place::inner) continue;
    for (const Node kept : k) {
      if (kept == gone) continue;
      Change change = move_into(mesh, gone, kept, best.sine);
      if (change.sine > best.sine && worth_it(mesh, change, options)) best = std::move(change);
    }
  }
  if (best.sine <= 0) return false;
  mesh.replace(best.old, best.fresh);
  return true;
}

bool merge_into_neighbour(LocalMesh& mesh, Node node, double least_sine) {
  if (mesh.place(node) != Place::inner) return false;
  std::vector<Node> others;
  for (const Cell c : mesh.star(node))
    for (const Node n : mesh.corners(c))
      if (n != node && mesh.place(n) == Place::inner) others.push_back(n);
  std::sort(others.begin(), others.end());
  others.erase(std::unique(others.begin(), others.end()), others.end());
  Change best;
  for (const Node kept : others) {
    Change change = move_into(mesh, node, kept, best.sine);
    if (change.sine > best.sine) best = std::move(change);
  }
  if (best.sine <= 0 || best.sine < std::min(least_sine, worst_of(mesh, best.old))) return false;
  mesh.replace(best.old, best.fresh);
  return true;
}

}  // namespace tunica::meshing
