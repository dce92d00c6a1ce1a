#include "tunica/meshing/improve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tunica/meshing/local_mesh.hpp"
#include "tunica/meshing/reconnect.hpp"

namespace tunica::meshing {

namespace {

using Node = LocalMesh::Node;
using Cell = LocalMesh::Cell;
using Place = LocalMesh::Place;

/// Six axes and eight diagonals.
std::array<geometry::Point, 14> make_directions() {
  std::array<geometry::Point, 14> directions;
  int count = 0;
  for (int i = 0; i < 3; ++i)
    for (const double sign : {1.0, -1.0}) {
      geometry::Point d{{0, 0, 0}};
      d[i] = sign;
      directions[count++] = d;
    }
  const double third = 1 / std::sqrt(3.0);
  for (const double x : {third, -third})
    for (const double y : {third, -third})
      for (const double z : {third, -third}) directions[count++] = {{x, y, z}};
  return directions;
}

class Smoother {
 public:
  /// `enough`: a star whose worst sine is above it is left alone.
  Smoother(LocalMesh& mesh, const Projection& project, double enough, const ImproveOptions& options)
      : mesh_(mesh), project_(project), enough_(enough), options_(options) {}

  /// Looks for a better place of the node: a pattern search from where it is, with steps that get smaller.
  bool smooth(Node n, bool keep_surface) {
    const bool on_surface = mesh_.place(n) == Place::surface;
    if (mesh_.place(n) == Place::curve || (on_surface && keep_surface)) return false;
    const geometry::Point start = mesh_.point(n);
    const geometry::Point normal = on_surface ? mesh_.normal(n) : geometry::Point{{0, 0, 0}};
    const double size = shortest_edge(n);
    double best = mesh_.star_sine(n, start, -1);
    const double first = best;
    if (first >= enough_) return false;
    geometry::Point at = start;
    const auto attempt = [&](geometry::Point p) {
      if (on_surface) {
        p = p - dot(p - at, normal) * normal;
        const auto [from, to] = mesh_.sides(n);
        if (!project_(p, normal, from, to, 0.3 * size)) return false;
      }
      const double value = mesh_.star_sine(n, p, best);
      if (value <= best) return false;
      best = value;
      at = p;
      return true;
    };
    attempt(middle_of_star(n));
    for (double step = 0.2 * size; step > 0.02 * size && best < enough_; step *= 0.5) {
      bool found = true;
      for (int k = 0; found && k < 4 && best < enough_; ++k) {
        found = false;
        for (const geometry::Point& d : directions_) found = attempt(at + step * d) || found;
      }
    }
    if (best <= first + 1e-4) return false;
    const double allowed = on_surface ? std::max(1.0, deviation(n)) : 0;
    mesh_.move(n, at);
    if (on_surface && deviation(n) > allowed) {
      mesh_.move(n, start);
      return false;
    }
    return true;
  }

 private:
  /// Largest distance of the middles of the surface triangles at `n` from the surface over what is allowed there.
  double deviation(Node n) const {
    const auto [from, to] = mesh_.sides(n);
    double largest = 0;
    for (const auto& t : mesh_.faces_at(n)) {
      const geometry::Point &a = mesh_.point(t[0]), &b = mesh_.point(t[1]), &c = mesh_.point(t[2]);
      const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
      const geometry::Point normal = cross(b - a, c - a), middle = (1.0 / 3) * (a + b + c);
      geometry::Point on = middle;
      if (!project_(on, (1 / norm(normal)) * normal, from, to, longest)) return 1e300;
      largest =
          std::max(largest, norm(on - middle) / std::min(options_.deviation * longest, options_.largest_deviation));
    }
    return largest;
  }
  double shortest_edge(Node n) const {
    double least = 1e300;
    for (const Cell c : mesh_.star(n))
      for (const Node k : mesh_.corners(c))
        if (k != n) least = std::min(least, norm(mesh_.point(k) - mesh_.point(n)));
    return least;
  }
  geometry::Point middle_of_star(Node n) const {
    geometry::Point sum{{0, 0, 0}};
    double count = 0;
    const bool on_surface = mesh_.place(n) == Place::surface;
    for (const Cell c : mesh_.star(n))
      for (const Node k : mesh_.corners(c)) {
        if (k == n || (on_surface && mesh_.place(k) == Place::inner)) continue;
        sum = sum + mesh_.point(k);
        count += 1;
      }
    return (1 / count) * sum;
  }

  LocalMesh& mesh_;
  const Projection& project_;
  double enough_;
  const ImproveOptions& options_;
  std::array<geometry::Point, 14> directions_ = make_directions();
};

std::vector<Cell> worse_than(const LocalMesh& mesh, double sine) {
  std::vector<Cell> bad;
  for (Cell c = 0; c < mesh.cells(); ++c)
    if (mesh.alive(c) && mesh.sine(c) < sine) bad.push_back(c);
  std::sort(bad.begin(), bad.end(),
            [&](Cell a, Cell b) { return mesh.sine(a) != mesh.sine(b) ? mesh.sine(a) < mesh.sine(b) : a < b; });
  return bad;
}

double worst(const LocalMesh& mesh, const std::vector<Cell>& bad) { return bad.empty() ? 1 : mesh.sine(bad.front()); }

}  // namespace

Improvement improve(geometry::Tetrahedra& mesh, const Projection& project, const ImproveOptions& options,
                    const std::function<void(const std::string&)>& tell) {
  LocalMesh local(mesh);
  Improvement done;
  const double wanted = std::sin(options.wanted_dihedral * std::numbers::pi / 180);
  const double free_surface = std::sin(options.free_surface * std::numbers::pi / 180);
  Smoother smoother(local, project, 1.1 * wanted, options);
  std::size_t before = 0;
  for (; done.passes < options.most_passes; ++done.passes) {
    const auto bad = worse_than(local, wanted);
    tell(fmt::format("pass {}: {} elements below {:g}°, the worst {:.2f}°", done.passes + 1, bad.size(),
                     options.wanted_dihedral, std::asin(worst(local, bad)) * 180 / std::numbers::pi));
    if (bad.empty() || (done.passes > 2 && static_cast<double>(bad.size()) > 0.98 * static_cast<double>(before))) break;
    before = bad.size();
    for (const Cell c : bad) {
      if (!local.alive(c) || local.sine(c) >= wanted) continue;
      const auto corners = local.corners(c);
      const bool keep_surface = local.sine(c) >= free_surface;
      const ReconnectOptions reconnection{.keep_layers = options.keep_layers, .keep_surface = keep_surface};
      for (const Node n : corners) done.moves += smoother.smooth(n, keep_surface);
      if (local.sine(c) >= wanted) continue;
      if (reconnect(local, c, reconnection)) {
        ++done.reconnections;
      } else if (collapse(local, c, reconnection)) {
        ++done.collapses;
      } else {
        continue;
      }
      for (const Node n : corners)
        if (!local.star(n).empty()) done.moves += smoother.smooth(n, keep_surface);
    }
  }
  mesh = local.extract();
  return done;
}

}  // namespace tunica::meshing
