#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "tunica/geometry/remesh.hpp"

namespace tunica::geometry {

namespace {

using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;
using Halfedge = Mesh::Halfedge_index;
using Edge = Mesh::Edge_index;
using Face = Mesh::Face_index;

// The usual bounds, between which neither a split nor a collapse pays.
constexpr double longest = 4.0 / 3, shortest = 4.0 / 5, tiny = 0.3;
// Cosines: largest turn of a triangle in one operation, and between a point and the original triangle it lies on.
constexpr double largest_turn = 0.5, same_side = 0.2, away = 0.3;

class Remesher {
 public:
  Remesher(const Remeshed& start, const Original& original, const RemeshOptions& options)
      : original_(original.tree),
        sizes_(original.sizes),
        options_(options),
        rims_(rims(original)),
        creases_(tree_of(original, original.creases)) {
    load(start);
    for (const auto v : mesh_.vertices()) settle(v);
    open_ears();
  }

  Remeshed run() {
    for (int sweep = 0; sweep < options_.sweeps; ++sweep) {
      const bool last = sweep + 2 >= options_.sweeps;
      split_long_edges();
      collapse_short_edges();
      flip_edges(!last);
      smooth();
    }
    collapse_tiny_edges();
    flip_edges(false);
    open_ears();
    for (int i = 0; i < 2; ++i) fit();
    return result();
  }

 private:
  /// What a point lies on and may move along.
  enum class Line { none, crease, rim };

  /// Lines of the original as triangles with two equal corners.
  static TriangleTree tree_of(const Original& original, const std::vector<Segment>& lines) {
    TriangleSurface flat{original.tree.surface().points, {}};
    for (const auto& [a, b] : lines) flat.triangles.push_back({a, b, b});
    return TriangleTree(std::move(flat));
  }
  static TriangleTree rims(const Original& original) {
    std::vector<Segment> lines;
    for (const auto& loop : boundary_loops(original.tree.surface()))
      for (std::size_t i = 0; i < loop.size(); ++i) lines.push_back({loop[i], loop[(i + 1) % loop.size()]});
    return tree_of(original, lines);
  }

  void load(const Remeshed& start) {
    crease_ = mesh_.add_property_map<Edge, bool>("e:crease", false).first;
    outward_ = mesh_.add_property_map<Vertex, Vec3<double>>("v:outward", {{0, 0, 0}}).first;
    size_ = mesh_.add_property_map<Vertex, double>("v:size", 0.0).first;
    std::vector<Vertex> vertices;
    for (const auto& p : start.surface.points) vertices.push_back(mesh_.add_vertex(p));
    for (const auto& t : start.surface.triangles) {
      [[maybe_unused]] const auto face = mesh_.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
      assert(face != Mesh::null_face());
    }
    for (const auto v : vertices)
      if (mesh_.is_isolated(v)) mesh_.remove_vertex(v);
    for (const auto& [a, b] : start.creases) crease_[mesh_.edge(mesh_.halfedge(vertices[a], vertices[b]))] = true;
  }

  Remeshed result() const {
    Remeshed whole;
    auto& out = whole.surface;
    std::vector<std::int64_t> number(mesh_.number_of_vertices() + mesh_.number_of_removed_vertices(), -1);
    for (const auto v : mesh_.vertices()) {
      number[v] = std::ssize(out.points);
      out.points.push_back(mesh_.point(v));
    }
    for (const auto f : mesh_.faces()) {
      const auto c = corners(f);
      out.triangles.push_back({number[c[0]], number[c[1]], number[c[2]]});
    }
    for (const auto e : mesh_.edges())
      if (crease_[e]) whole.creases.push_back({number[mesh_.vertex(e, 0)], number[mesh_.vertex(e, 1)]});
    return whole;
  }

  std::array<Vertex, 3> corners(Face f) const {
    const auto h = mesh_.halfedge(f);
    return {mesh_.source(h), mesh_.target(h), mesh_.target(mesh_.next(h))};
  }
  Vec3<double> area_of(Face f) const {
    const auto c = corners(f);
    return area_of(mesh_.point(c[0]), mesh_.point(c[1]), mesh_.point(c[2]));
  }
  static Vec3<double> area_of(const Point& a, const Point& b, const Point& c) { return 0.5 * cross(b - a, c - a); }
  static Vec3<double> unit(const Vec3<double>& a) {
    const double length = norm(a);
    return length > 0 ? (1 / length) * a : a;
  }
  Vec3<double> normal(Vertex v) const {
    Vec3<double> sum{{0, 0, 0}};
    for (const auto h : mesh_.halfedges_around_target(mesh_.halfedge(v)))
      if (!mesh_.is_border(h)) sum = sum + area_of(mesh_.face(h));
    return unit(sum);
  }
  double length(Edge e) const { return norm(mesh_.point(mesh_.vertex(e, 0)) - mesh_.point(mesh_.vertex(e, 1))); }
  double wanted(Edge e) const { return std::min(size_[mesh_.vertex(e, 0)], size_[mesh_.vertex(e, 1)]); }

  /// Nearest place of the original closer than `within`: on a line, or on the side of the surface that faces along `n`.
  /// Rims stay plane where a crease ends at them.
  SurfacePoint project(const Point& x, const Vec3<double>& n, Line line, double within) const {
    if (line != Line::none) return tree(line).nearest(x, within);
    return original_.nearest_if(
        x, within, [&](const SurfacePoint& q) { return dot(original_.normal(q.triangle), n) > same_side; });
  }
  /// Looks up what belongs to the place of a point.
  void settle(Vertex v) {
    constexpr double anywhere = std::numeric_limits<double>::infinity();
    auto at = project(mesh_.point(v), normal(v), Line::none, anywhere);
    if (!at) at = original_.nearest(mesh_.point(v));
    size_[v] = original_.interpolate(sizes_, at);
    outward_[v] = original_.smooth_normal(at);
  }

  Line line_of(Edge e) const { return mesh_.is_border(e) ? Line::rim : crease_[e] ? Line::crease : Line::none; }
  Line line_of(Vertex v) const { return mesh_.is_border(v) ? Line::rim : lines_at(v) > 0 ? Line::crease : Line::none; }
  const TriangleTree& tree(Line line) const {
    return line == Line::none ? original_ : line == Line::rim ? rims_ : creases_;
  }
  bool on_line(Edge e) const { return line_of(e) != Line::none; }
  /// Number of line edges at a point: 0 inside the surface, 2 along a line, others at its ends and crossings.
  int lines_at(Vertex v) const {
    int count = 0;
    for (const auto h : mesh_.halfedges_around_target(mesh_.halfedge(v))) count += on_line(mesh_.edge(h));
    return count;
  }
  static bool is_corner(int lines) { return lines == 1 || lines > 2; }

  bool frozen(Edge e) const { return options_.keep_boundary && mesh_.is_border(e); }
  bool frozen(Vertex v) const { return options_.keep_boundary && mesh_.is_border(v); }

  void split_long_edges() {
    for (int round = 0; round < 4; ++round) {
      std::vector<std::pair<double, Edge>> list;
      for (const auto e : mesh_.edges())
        if (const double ratio = length(e) / wanted(e); ratio > longest && !frozen(e)) list.emplace_back(ratio, e);
      if (list.empty()) return;
      std::sort(list.rbegin(), list.rend());
      for (const auto& [ratio, e] : list) split(e);
    }
  }

  void split(Edge e) {
    const auto line = line_of(e);
    const bool crease = crease_[e];
    const auto a = mesh_.vertex(e, 0), b = mesh_.vertex(e, 1);
    const Point middle = 0.5 * (mesh_.point(a) + mesh_.point(b));
    const auto n = unit(normal(a) + normal(b));
    const auto h = mesh_.halfedge(e);
    const auto added = CGAL::Euler::split_edge(h, mesh_);
    const auto v = mesh_.target(added);
    const auto back = mesh_.opposite(added);
    if (!mesh_.is_border(added)) CGAL::Euler::split_face(added, mesh_.next(mesh_.next(added)), mesh_);
    if (!mesh_.is_border(back)) CGAL::Euler::split_face(mesh_.prev(back), mesh_.next(back), mesh_);
    mesh_.point(v) = middle;
    size_[v] = 0.5 * (size_[a] + size_[b]);
    outward_[v] = unit(outward_[a] + outward_[b]);
    crease_[mesh_.edge(added)] = crease;  // the other half is the old edge
    move(v, middle, n, line);
  }

  void collapse_short_edges() {
    std::vector<std::pair<double, Edge>> list;
    for (const auto e : mesh_.edges())
      if (const double ratio = length(e) / wanted(e); ratio < shortest && !frozen(e)) list.emplace_back(ratio, e);
    std::sort(list.begin(), list.end());
    for (const auto& [ratio, e] : list) {
      if (mesh_.is_removed(e) || length(e) >= shortest * wanted(e)) continue;
      collapse(e);
    }
  }

  /// What lines and bounds have kept from collapsing, but is too short for any mesh.
  void collapse_tiny_edges() {
    std::vector<Edge> list;
    for (const auto e : mesh_.edges())
      if (length(e) < tiny * wanted(e) && !frozen(e)) list.push_back(e);
    for (const auto e : list)
      if (!mesh_.is_removed(e) && length(e) < tiny * wanted(e)) collapse(e);
  }

  void collapse(Edge e) {
    const auto a = mesh_.vertex(e, 0), b = mesh_.vertex(e, 1);
    const int rank_a = rank(a), rank_b = rank(b);
    const auto line = line_of(e);
    const bool is_tiny = length(e) < tiny * wanted(e), borders = mesh_.is_border(a) && mesh_.is_border(b);
    if (rank_a > 0 && rank_b > 0 && line == Line::none && (borders || !is_tiny)) return;
    if (rank_a == 2 && rank_b == 2 && !is_tiny) return;
    if (!CGAL::Euler::does_satisfy_link_condition(e, mesh_) || leaves_ear(e)) return;
    const bool rim_a = mesh_.is_border(a), rim_b = mesh_.is_border(b);
    // A point of a rim stays in its plane, whatever it merges with.
    const auto stays = rim_a != rim_b ? (rim_a ? a : b) : rank_a > rank_b ? a : b;
    const bool alike = rim_a == rim_b && rank_a == rank_b;
    Point place = mesh_.point(stays);
    if (alike && rank_a < 2) {
      const auto at = project(0.5 * (mesh_.point(a) + mesh_.point(b)), unit(normal(a) + normal(b)), line, wanted(e));
      if (!at) return;
      place = at.place;
    }
    if (!may_merge(a, b, place) || !may_merge(b, a, place)) return;
    const double size = alike ? std::min(size_[a], size_[b]) : size_[stays];
    const auto outward = alike ? unit(outward_[a] + outward_[b]) : outward_[stays];
    const auto creased = crease_neighbours(a, b);
    const auto kept = CGAL::Euler::collapse_edge(e, mesh_);
    mesh_.point(kept) = place;
    size_[kept] = size;
    outward_[kept] = outward;
    for (const auto end : creased) crease_[mesh_.edge(mesh_.halfedge(kept, end))] = true;
  }

  /// What a point gives way to: 0 inside the surface, 1 on a line, 2 a corner of lines.
  int rank(Vertex v) const {
    const int count = lines_at(v);
    return count == 0 ? 0 : is_corner(count) ? 2 : 1;
  }

  /// Other ends of the creases at both ends of an edge: its collapse merges edges and may drop their mark.
  std::vector<Vertex> crease_neighbours(Vertex a, Vertex b) const {
    std::vector<Vertex> result;
    for (const auto v : {a, b})
      for (const auto h : mesh_.halfedges_around_target(mesh_.halfedge(v)))
        if (const auto end = mesh_.source(h); crease_[mesh_.edge(h)] && end != a && end != b) result.push_back(end);
    return result;
  }

  /// Whether the triangles around `v` that do not contain `other` stay sound when v moves to `place`.
  bool may_merge(Vertex v, Vertex other, const Point& place) const {
    const double far = longest * (norm(mesh_.point(v) - mesh_.point(other)) < tiny * size_[v] ? 1.5 : 1.0);
    for (const auto h : mesh_.halfedges_around_target(mesh_.halfedge(v))) {
      const auto end = mesh_.source(h);
      if (end != other && norm(place - mesh_.point(end)) > far * std::min(size_[v], size_[end])) return false;
      if (mesh_.is_border(h)) continue;
      const auto c = mesh_.target(mesh_.next(h));
      if (end == other || c == other) continue;
      if (!sound(area_of(mesh_.face(h)), area_of(mesh_.point(end), place, mesh_.point(c)), {end, v, c})) return false;
    }
    return true;
  }
  /// Whether a triangle may change: it turns little, and does not turn away from the normals of the original at its
  /// corners, or less than before. A degenerate one has no direction to keep.
  bool sound(const Vec3<double>& before, const Vec3<double>& after, const std::array<Vertex, 3>& at) const {
    if (norm(after) == 0) return false;
    const auto out = outward_[at[0]] + outward_[at[1]] + outward_[at[2]];
    const double faces = dot(after, out) / norm(after);
    if (norm(before) == 0) return faces > 0;
    if (faces < away && faces * norm(before) < dot(before, out)) return false;
    return dot(before, after) > largest_turn * norm(before) * norm(after);
  }

  void flip_edges(bool by_valence) {
    for (int round = 0; round < (by_valence ? 1 : 3); ++round) {
      int flipped = 0;
      for (const auto e : mesh_.edges()) {
        if (on_line(e)) continue;
        const auto h = mesh_.halfedge(e);
        const auto a = mesh_.source(h), b = mesh_.target(h);
        const auto c = mesh_.target(mesh_.next(h)), d = mesh_.target(mesh_.next(mesh_.opposite(h)));
        if (!worth_flipping(a, b, c, d, by_valence)) continue;
        if (mesh_.halfedge(c, d) != Mesh::null_halfedge()) continue;
        CGAL::Euler::flip_edge(h, mesh_);
        ++flipped;
      }
      if (flipped == 0) return;
    }
  }

  /// Whether one triangle is all that a point of a rim would have: with its corners on the rim alone it lies in the
  /// plane of the opening.
  bool is_ear(Vertex v, int lost) const { return mesh_.is_border(v) && static_cast<int>(mesh_.degree(v)) - lost < 3; }

  bool leaves_ear(Edge e) const {
    for (const auto h : {mesh_.halfedge(e, 0), mesh_.halfedge(e, 1)})
      if (!mesh_.is_border(h) && is_ear(mesh_.target(mesh_.next(h)), 1)) return true;
    return false;
  }

  /// Joins the tip of an ear with the point behind it, or takes it away where it is flat.
  void open_ears() {
    if (options_.keep_boundary) return;
    std::vector<Vertex> tips;
    for (const auto v : mesh_.vertices())
      if (!mesh_.is_isolated(v) && is_ear(v, 0)) tips.push_back(v);
    for (const auto v : tips) {
      if (mesh_.is_removed(v) || !is_ear(v, 0)) continue;
      auto h = mesh_.halfedge(v);
      if (mesh_.is_border(h)) h = mesh_.opposite(mesh_.next(h));
      const auto base = mesh_.prev(h);  // the edge across from the tip
      const auto a = mesh_.source(base), b = mesh_.target(base);
      if (mesh_.is_border(mesh_.edge(base))) continue;  // a triangle of its own
      const auto behind = mesh_.target(mesh_.next(mesh_.opposite(base)));
      const auto n = unit(outward_[a] + outward_[b]);
      const auto faces = [&](Vertex p, Vertex q, Vertex r) {
        return dot(unit(area_of(mesh_.point(p), mesh_.point(q), mesh_.point(r))), n) > away;
      };
      if (mesh_.halfedge(v, behind) == Mesh::null_halfedge() && !is_ear(a, 1) && !is_ear(b, 1) && faces(v, a, behind) &&
          faces(behind, b, v)) {
        crease_[mesh_.edge(base)] = false;
        CGAL::Euler::flip_edge(base, mesh_);
      } else if (const auto e = mesh_.edge(h); CGAL::Euler::does_satisfy_link_condition(e, mesh_)) {
        const auto place = mesh_.point(mesh_.source(h));
        mesh_.point(CGAL::Euler::collapse_edge(e, mesh_)) = place;
      }
    }
  }

  bool worth_flipping(Vertex a, Vertex b, Vertex c, Vertex d, bool by_valence) const {
    if (is_ear(a, 1) || is_ear(b, 1)) return false;
    const auto &pa = mesh_.point(a), &pb = mesh_.point(b), &pc = mesh_.point(c), &pd = mesh_.point(d);
    const double before = std::min(angle(pa, pb, pc), angle(pb, pa, pd));
    const double after = std::min(angle(pc, pd, pb), angle(pd, pc, pa));
    constexpr double poor = 0.35;  // rad
    if (by_valence && before > poor) {
      if (after < poor) return false;
      const auto off = [&](Vertex v, int change) {
        return std::abs(static_cast<int>(mesh_.degree(v)) + change - (mesh_.is_border(v) ? 4 : 6));
      };
      if (off(a, -1) + off(b, -1) + off(c, 1) + off(d, 1) >= off(a, 0) + off(b, 0) + off(c, 0) + off(d, 0))
        return false;
    } else if (after <= before * 1.001) {
      return false;
    }
    const auto n1 = area_of(pa, pb, pc), n2 = area_of(pb, pa, pd);
    const auto n = n1 + n2;
    return sound(n, area_of(pc, pd, pb), {c, d, b}) && sound(n, area_of(pd, pc, pa), {d, c, a}) &&
           flat_enough(a, b, c, d, n1, n2);
  }

  /// The new edge must not cut a corner: it stays within a tenth of its wanted length of the old one.
  bool flat_enough(Vertex a, Vertex b, Vertex c, Vertex d, const Vec3<double>& n1, const Vec3<double>& n2) const {
    const auto n = unit(n1 + n2);
    const auto gap = 0.5 * (mesh_.point(a) + mesh_.point(b)) - 0.5 * (mesh_.point(c) + mesh_.point(d));
    return norm(n1) * norm(n2) == 0 || std::abs(dot(gap, n)) < 0.15 * std::min(size_[c], size_[d]);
  }

  static double angle(const Point& a, const Point& b, const Point& c) {
    return smallest_angle(TriangleSurface{{a, b, c}, {}}, {0, 1, 2});
  }

  void smooth() {
    for (const auto v : mesh_.vertices()) {
      if (frozen(v)) continue;
      const int count = lines_at(v);
      if (is_corner(count)) continue;
      const auto line = line_of(v);
      const auto n = normal(v);
      Point goal{{0, 0, 0}};
      double weights = 0;
      for (const auto h : mesh_.halfedges_around_target(mesh_.halfedge(v))) {
        if (line != Line::none) {
          if (line_of(mesh_.edge(h)) != line) continue;
          goal = goal + mesh_.point(mesh_.source(h));
          weights += 1;
        } else {
          const auto c = corners(mesh_.face(h));
          const double size = (size_[c[0]] + size_[c[1]] + size_[c[2]]) / 3;
          const double weight = norm(area_of(mesh_.face(h))) / (size * size * size);
          goal = goal + (weight / 3) * (mesh_.point(c[0]) + mesh_.point(c[1]) + mesh_.point(c[2]));
          weights += weight;
        }
      }
      if (!(weights > 0)) continue;
      auto step = (1 / weights) * goal - mesh_.point(v);
      if (line == Line::none) step = step - dot(step, n) * n;
      move(v, mesh_.point(v) + 0.7 * step, n, line);
    }
  }

  /// Moves a point to the place of the original next to `x`, unless a triangle would turn over.
  void move(Vertex v, const Point& x, const Vec3<double>& n, Line line) {
    const auto at = project(x, n, line, size_[v]);
    if (!at || !may_move(v, at.place)) return;
    mesh_.point(v) = at.place;
    size_[v] = tree(line).interpolate(sizes_, at);
    // On a line the triangle has two equal corners, so that the normal of the surface has to be looked up.
    outward_[v] = original_.smooth_normal(line == Line::none ? at : original_.nearest(at.place));
  }
  bool may_move(Vertex v, const Point& place) const {
    for (const auto h : mesh_.halfedges_around_target(mesh_.halfedge(v))) {
      if (mesh_.is_border(h)) continue;
      const auto &a = mesh_.point(mesh_.source(h)), &c = mesh_.point(mesh_.target(mesh_.next(h)));
      if (!sound(area_of(mesh_.face(h)), area_of(a, place, c), corners(mesh_.face(h)))) return false;
    }
    return true;
  }

  /// Vector from the middle of an edge to the original.
  Vec3<double> deviation(Edge e) const {
    const auto a = mesh_.vertex(e, 0), b = mesh_.vertex(e, 1);
    const Point middle = 0.5 * (mesh_.point(a) + mesh_.point(b));
    const auto at = project(middle, unit(normal(a) + normal(b)), line_of(e), wanted(e));
    return at ? at.place - middle : Vec3<double>{{0, 0, 0}};
  }

  /// Mean vector from an edge of a rim or crease to the original, by Simpson's rule.
  Vec3<double> line_deviation(Edge e, const Vec3<double>& middle) const {
    Vec3<double> sum = 4.0 * middle;
    for (const int end : {0, 1}) {
      const auto v = mesh_.vertex(e, end);
      if (const auto at = project(mesh_.point(v), normal(v), line_of(e), wanted(e)))
        sum = sum + (at.place - mesh_.point(v));
    }
    return (1.0 / 6) * sum;
  }

  /// Of a crease that bends on as the rim of a hole does; one of a rough surface does not.
  static bool alike(const std::vector<Vec3<double>>& gaps) {
    return gaps.size() == 2 && dot(gaps[0], gaps[1]) > 0.5 * std::max(dot(gaps[0], gaps[0]), dot(gaps[1], gaps[1]));
  }

  /// Edge midpoints integrate a quadratic deviation exactly, so its mean over a triangle is theirs.
  void fit() {
    if (options_.keep_boundary) return;
    std::vector<Vec3<double>> gap(mesh_.number_of_edges() + mesh_.number_of_removed_edges());
    for (const auto e : mesh_.edges()) gap[e] = deviation(e);
    std::vector<std::pair<Vertex, Point>> moves;
    for (const auto v : mesh_.vertices()) {
      const auto n = normal(v);
      const auto line = line_of(v);
      double sum = 0, weights = 0;
      Vec3<double> line_sum{{0, 0, 0}};
      std::vector<Vec3<double>> line_gaps;
      for (const auto h : mesh_.halfedges_around_target(mesh_.halfedge(v))) {
        if (line != Line::none && line_of(mesh_.edge(h)) == line) {
          line_gaps.push_back(line_deviation(mesh_.edge(h), gap[mesh_.edge(h)]));
          line_sum = line_sum + 0.5 * line_gaps.back();
        }
        if (mesh_.is_border(h)) continue;
        const double weight = norm(area_of(mesh_.face(h))) / 3;
        for (const auto side : mesh_.halfedges_around_face(h)) sum += weight * dot(gap[mesh_.edge(side)], n);
        weights += 3 * weight;
      }
      const int count = lines_at(v);
      if (is_corner(count)) continue;
      if (count > 0) {
        if (mesh_.is_border(v) || alike(line_gaps)) moves.emplace_back(v, mesh_.point(v) + line_sum);
      } else if (weights > 0)
        moves.emplace_back(v, mesh_.point(v) + (sum / weights) * n);
    }
    for (const auto& [v, place] : moves)
      if (may_move(v, place)) mesh_.point(v) = place;
  }

  Mesh mesh_;
  Mesh::Property_map<Vertex, double> size_;
  Mesh::Property_map<Vertex, Vec3<double>> outward_;  ///< unit normal of the original
  Mesh::Property_map<Edge, bool> crease_;
  const TriangleTree& original_;
  std::span<const double> sizes_;
  RemeshOptions options_;
  TriangleTree rims_, creases_;
};

}  // namespace

Remeshed remesh(const Remeshed& start, const Original& original, const RemeshOptions& options) {
  return Remesher(start, original, options).run();
}

}  // namespace tunica::geometry
