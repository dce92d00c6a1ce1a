#include "tunica/meshing/local_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/mesh/boundary.hpp"

namespace tunica::meshing {

double worst_sine(const geometry::Point& a, const geometry::Point& b, const geometry::Point& c,
                  const geometry::Point& d) {
  const geometry::Point ab = b - a, ac = c - a, ad = d - a, bc = c - b, bd = d - b, cd = d - c;
  // Normals of the faces opposite to a, b, c, d, twice the area long.
  const geometry::Point na = cross(bc, bd), nb = cross(ac, ad), nc = cross(ab, ad), nd = cross(ab, ac);
  const double six_v = dot(ab, cross(ac, ad));
  const double aa = dot(na, na), bb = dot(nb, nb), cc = dot(nc, nc), dd = dot(nd, nd);
  // The sine at an edge is 6 V times its length by the product of the two normals.
  const double smallest = std::min({dot(ab, ab) / (cc * dd), dot(ac, ac) / (bb * dd), dot(ad, ad) / (bb * cc),
                                    dot(bc, bc) / (aa * dd), dot(bd, bd) / (aa * cc), dot(cd, cd) / (aa * bb)});
  const double sine = six_v * std::sqrt(smallest);
  return std::isfinite(sine) ? sine : 0.0;
}

LocalMesh::LocalMesh(const geometry::Tetrahedra& mesh) : points_(mesh.points) {
  corners_.reserve(mesh.elements.size());
  stars_.resize(points_.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    Corners c;
    for (int a = 0; a < 4; ++a) {
      c[a] = static_cast<Node>(mesh.elements[e][a]);
      stars_[c[a]].push_back(static_cast<Cell>(e));
    }
    corners_.push_back(c);
    labels_.push_back(static_cast<std::int8_t>(mesh.labels[e]));
    sines_.push_back(static_cast<float>(cell_sine(c)));
  }
  find_places(mesh);
}

void LocalMesh::find_places(const geometry::Tetrahedra& mesh) {
  places_.assign(points_.size(), Place::inner);
  sides_.assign(points_.size(), {0, 0});
  for (const auto& t : geometry::surface_triangles(mesh)) {
    const std::array<int, 2> sides = {t.label, t.neighbour_label};
    for (const auto n : t.nodes) {
      if (places_[n] == Place::inner) {
        places_[n] = Place::surface;
        sides_[n] = sides;
      } else if (sides_[n] != sides) {
        places_[n] = Place::curve;
      }
    }
  }
  for (std::size_t n = 0; n < points_.size(); ++n)
    if (mesh.on_curve[n]) places_[n] = Place::curve;
}

geometry::Tetrahedra LocalMesh::extract() const {
  geometry::Tetrahedra mesh;
  std::vector<geometry::Index> number(points_.size(), -1);
  for (std::size_t n = 0; n < points_.size(); ++n) {
    if (stars_[n].empty()) continue;
    number[n] = std::ssize(mesh.points);
    mesh.points.push_back(points_[n]);
    mesh.on_curve.push_back(places_[n] == Place::curve);
  }
  for (Cell c = 0; c < cells(); ++c) {
    if (!alive(c)) continue;
    mesh.elements.push_back(
        {number[corners_[c][0]], number[corners_[c][1]], number[corners_[c][2]], number[corners_[c][3]]});
    mesh.labels.push_back(labels_[c]);
  }
  return mesh;
}

std::vector<std::array<LocalMesh::Node, 3>> LocalMesh::faces_at(Node n) const {
  std::vector<std::array<Node, 3>> triangles;
  const auto [from, to] = sides_[n];
  for (const Cell c : stars_[n]) {
    if (labels_[c] != from) continue;
    const auto& k = corners_[c];
    for (int f = 0; f < 4; ++f) {
      if (k[f] == n) continue;
      const Cell other = across(c, f);
      if ((other < 0 ? geometry::outside_label : labels_[other]) != to) continue;
      const auto& t = mesh::tetrahedron_faces[f];
      triangles.push_back({k[t[0]], k[t[1]], k[t[2]]});
    }
  }
  return triangles;
}

geometry::Point LocalMesh::normal(Node n) const {
  geometry::Point sum{{0, 0, 0}};
  for (const auto& t : faces_at(n)) {
    const geometry::Point& a = points_[t[0]];
    sum = sum + cross(points_[t[1]] - a, points_[t[2]] - a);
  }
  const double length = norm(sum);
  return length > 0 ? (1 / length) * sum : sum;
}

double LocalMesh::star_sine(Node n, const geometry::Point& p, double enough) const {
  double worst = 1;
  for (const Cell c : stars_[n]) {
    const auto& k = corners_[c];
    const geometry::Point* x[4];
    for (int a = 0; a < 4; ++a) x[a] = k[a] == n ? &p : &points_[k[a]];
    worst = std::min(worst, worst_sine(*x[0], *x[1], *x[2], *x[3]));
    if (worst < enough) break;
  }
  return worst;
}

void LocalMesh::move(Node n, const geometry::Point& p) {
  points_[n] = p;
  for (const Cell c : stars_[n]) sines_[c] = static_cast<float>(cell_sine(corners_[c]));
}

void LocalMesh::replace(const std::vector<Cell>& old, const std::vector<NewCell>& fresh) {
  for (const Cell c : old) {
    for (const Node n : corners_[c]) std::erase(stars_[n], c);
    labels_[c] = -1;
    unused_.push_back(c);
  }
  for (const auto& f : fresh) {
    Cell c = cells();
    if (unused_.empty()) {
      corners_.emplace_back();
      labels_.emplace_back();
      sines_.emplace_back();
    } else {
      c = unused_.back();
      unused_.pop_back();
    }
    corners_[c] = f.corners;
    labels_[c] = static_cast<std::int8_t>(f.label);
    sines_[c] = static_cast<float>(cell_sine(f.corners));
    for (const Node n : f.corners) stars_[n].push_back(c);
  }
}

bool LocalMesh::is_edge(Node a, Node b) const {
  return std::any_of(stars_[a].begin(), stars_[a].end(),
                     [&](Cell c) { return std::find(corners_[c].begin(), corners_[c].end(), b) != corners_[c].end(); });
}

LocalMesh::Cell LocalMesh::across(Cell c, int f) const {
  const auto& t = mesh::tetrahedron_faces[f];
  const auto& k = corners_[c];
  for (const Cell other : stars_[k[t[0]]]) {
    if (other == c) continue;
    const auto& o = corners_[other];
    const auto has = [&](Node n) { return o[0] == n || o[1] == n || o[2] == n || o[3] == n; };
    if (has(k[t[1]]) && has(k[t[2]])) return other;
  }
  return -1;
}

std::optional<LocalMesh::Ring> LocalMesh::ring(Node a, Node b) const {
  // Each element around the edge goes from one node to the next, counter-clockwise seen from b.
  struct Link {
    Cell cell;
    Node from, to;
  };
  std::vector<Link> links;
  for (const Cell c : stars_[a]) {
    const auto& k = corners_[c];
    if (std::find(k.begin(), k.end(), b) == k.end()) continue;
    Node other[2];
    int count = 0;
    for (const Node n : k)
      if (n != a && n != b) other[count++] = n;
    // Positive orientation of (a, b, from, to), by the parity of the permutation.
    int position[4];
    const Node wanted[4] = {a, b, other[0], other[1]};
    for (int i = 0; i < 4; ++i) position[i] = static_cast<int>(std::find(k.begin(), k.end(), wanted[i]) - k.begin());
    int inversions = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) inversions += position[i] > position[j];
    if (inversions % 2 == 1) std::swap(other[0], other[1]);
    links.push_back({c, other[0], other[1]});
  }
  if (links.empty()) return std::nullopt;
  // Begin where nothing comes before, if there is such a place.
  std::size_t first = 0;
  for (std::size_t i = 0; i < links.size(); ++i)
    if (std::none_of(links.begin(), links.end(), [&](const Link& l) { return l.to == links[i].from; })) first = i;
  Ring ring{{}, {links[first].from}, false};
  Node at = links[first].from;
  while (ring.cells.size() < links.size()) {
    const auto next = std::find_if(links.begin(), links.end(), [&](const Link& l) { return l.from == at; });
    if (next == links.end()) return std::nullopt;
    ring.cells.push_back(next->cell);
    at = next->to;
    if (at == ring.nodes.front()) {
      ring.closed = true;
      break;
    }
    ring.nodes.push_back(at);
  }
  if (ring.cells.size() != links.size()) return std::nullopt;
  return ring;
}

LocalMesh::Node LocalMesh::split(Node a, Node b) {
  const auto around = ring(a, b);
  std::vector<Cell> old = around ? around->cells : std::vector<Cell>{};
  if (!around)
    for (const Cell c : stars_[a])
      if (std::find(corners_[c].begin(), corners_[c].end(), b) != corners_[c].end()) old.push_back(c);
  std::array<int, 2> sides = {labels_[old.front()], labels_[old.front()]};
  for (const Cell c : old) sides = {std::min<int>(sides[0], labels_[c]), std::max<int>(sides[1], labels_[c])};
  const bool open = around && !around->closed;
  const auto middle = static_cast<Node>(points_.size());
  points_.push_back(0.5 * (points_[a] + points_[b]));
  stars_.emplace_back();
  places_.push_back(open && sides[0] != sides[1]   ? Place::curve
                    : open || sides[0] != sides[1] ? Place::surface
                                                   : Place::inner);
  sides_.push_back(open ? std::array<int, 2>{sides[0], geometry::outside_label} : sides);
  std::vector<NewCell> fresh;
  for (const Cell c : old)
    for (const Node gone : {a, b}) {
      Corners k = corners_[c];
      std::replace(k.begin(), k.end(), gone, middle);
      fresh.push_back({k, labels_[c]});
    }
  replace(old, fresh);
  return middle;
}

}  // namespace tunica::meshing
