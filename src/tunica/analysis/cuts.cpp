#include "tunica/analysis/cuts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "tunica/fluid/boundary.hpp"
#include "tunica/mesh/boundary.hpp"

namespace tunica::analysis {

namespace {

Barycentric corner(int k) {
  Barycentric b{};
  b[k] = 1;
  return b;
}

/// The point of the straight line from a to b where a linear function with these values there is zero.
Barycentric between(const Barycentric& a, double at_a, const Barycentric& b, double at_b) {
  const double t = at_a / (at_a - at_b);
  Barycentric point;
  for (int i = 0; i < 4; ++i) point[i] = (1 - t) * a[i] + t * b[i];
  return point;
}

double value_at(const std::array<double, 4>& values, const Barycentric& b) {
  return values[0] * b[0] + values[1] * b[1] + values[2] * b[2] + values[3] * b[3];
}

/// Volume of a tetrahedron as a share of that of the element: |det| of its barycentric coordinates.
double share(const Barycentric& a, const Barycentric& b, const Barycentric& c, const Barycentric& d) {
  const auto edge = [&](const Barycentric& p) { return Vec3<double>{{p[1] - a[1], p[2] - a[2], p[3] - a[3]}}; };
  return std::abs(dot(edge(b), cross(edge(c), edge(d))));
}

/// Corners of the element on the two sides of zero.
struct Sides {
  std::array<int, 4> positive, negative;
  int positives = 0, negatives = 0;
  explicit Sides(const std::array<double, 4>& values) {
    for (int k = 0; k < 4; ++k) (values[k] > 0 ? positive[positives++] : negative[negatives++]) = k;
  }
};

Vec3<double> nodal_vector(std::span<const double> field, std::int64_t node) {
  if (field.empty()) return {{0, 0, 0}};
  const double* v = field.data() + 3 * static_cast<std::size_t>(node);
  return {{v[0], v[1], v[2]}};
}

Vec3<double> interpolate(const Element& nodes, const Barycentric& at, std::span<const double> field) {
  Vec3<double> v{{0, 0, 0}};
  for (int a = 0; a < 4; ++a) v = v + at[a] * nodal_vector(field, nodes[a]);
  return v;
}

}  // namespace

Polygon cut_element(const std::array<double, 4>& values, double level) {
  std::array<double, 4> f;
  for (int k = 0; k < 4; ++k) f[k] = values[k] - level;
  const Sides sides(f);
  Polygon polygon;
  // To and fro, so that neighbours in the list lie on a common face and the corners go round.
  for (int i = 0; i < sides.positives; ++i)
    for (int j = 0; j < sides.negatives; ++j) {
      const int a = sides.positive[i], b = sides.negative[i % 2 == 0 ? j : sides.negatives - 1 - j];
      polygon.push_back(between(corner(a), f[a], corner(b), f[b]));
    }
  return polygon;
}

Polygon clip(const Polygon& polygon, const std::array<double, 4>& values, bool positive) {
  Polygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const auto &here = polygon[k], &next = polygon[(k + 1) % polygon.size()];
    const double at_here = value_at(values, here), at_next = value_at(values, next);
    if ((at_here > 0) == positive) kept.push_back(here);
    if ((at_here > 0) != (at_next > 0)) kept.push_back(between(here, at_here, next, at_next));
  }
  return kept.size() < 3 ? Polygon{} : kept;
}

double negative_share(const std::array<double, 4>& values) {
  const Sides s(values);
  if (s.negatives == 0) return 0;
  if (s.positives == 0) return 1;
  const auto tip = [&](int k) {  // of the part around one corner
    double product = 1;
    for (int j = 0; j < 4; ++j)
      if (j != k) product *= values[k] / (values[k] - values[j]);
    return product;
  };
  if (s.negatives == 1) return tip(s.negative[0]);
  if (s.positives == 1) return 1 - tip(s.positive[0]);
  // A prism between the two triangles around the negative corners.
  std::array<std::array<Barycentric, 3>, 2> t;
  for (int i = 0; i < 2; ++i) {
    const int a = s.negative[i];
    t[i][0] = corner(a);
    for (int j = 0; j < 2; ++j) {
      const int b = s.positive[j];
      t[i][1 + j] = between(corner(a), values[a], corner(b), values[b]);
    }
  }
  return share(t[0][0], t[0][1], t[0][2], t[1][2]) + share(t[0][0], t[0][1], t[1][1], t[1][2]) +
         share(t[0][0], t[1][0], t[1][1], t[1][2]);
}

void append_triangles(const Polygon& polygon, const Element& nodes, const std::array<double, 4>& values,
                      const std::vector<Vec3<double>>& points, std::vector<CutTriangle>& triangles) {
  const NodalFields reference{.points = &points};
  Vec3<double> x[4];
  for (int a = 0; a < 4; ++a) x[a] = points[nodes[a]];
  const auto shape = fe::gradients(x);
  Vec3<double> rise{{0, 0, 0}};
  for (int a = 0; a < 4; ++a) rise = rise + values[a] * shape.dN[a];
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    CutTriangle t{nodes, {polygon[0], polygon[k - 1], polygon[k]}};
    Vec3<double> y[3];
    for (int i = 0; i < 3; ++i) y[i] = position(nodes, t.corners[i], reference);
    if (dot(fluid::area_vector(y), rise) < 0) std::swap(t.corners[1], t.corners[2]);
    triangles.push_back(t);
  }
}

std::vector<int> connected_groups(std::span<const Element> elements) {
  std::vector<int> parent(elements.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int e) {
    while (parent[e] != e) e = parent[e] = parent[parent[e]];
    return e;
  };
  std::map<std::array<std::int64_t, 3>, int> open;
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const auto& f : mesh::tetrahedron_faces) {
      std::array<std::int64_t, 3> face{elements[e][f[0]], elements[e][f[1]], elements[e][f[2]]};
      std::sort(face.begin(), face.end());
      const auto [other, is_new] = open.emplace(face, static_cast<int>(e));
      if (is_new) continue;
      const int a = root(static_cast<int>(e)), b = root(other->second);
      parent[std::max(a, b)] = std::min(a, b);
    }
  std::vector<int> group(elements.size()), number(elements.size(), -1);
  int groups = 0;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const int r = root(static_cast<int>(e));
    if (number[r] < 0) number[r] = groups++;
    group[e] = number[r];
  }
  return group;
}

Vec3<double> position(const Element& nodes, const Barycentric& at, const NodalFields& fields) {
  Vec3<double> x = interpolate(nodes, at, fields.displacement);
  for (int a = 0; a < 4; ++a) x = x + at[a] * (*fields.points)[nodes[a]];
  return x;
}

SurfaceFigures evaluate(std::span<const CutTriangle> surface, const NodalFields& fields) {
  SurfaceFigures sums;
  double force = 0;
  for (const auto& t : surface) {
    Vec3<double> x[3], v[3], w[3];
    double p[3] = {0, 0, 0};
    for (int i = 0; i < 3; ++i) {
      x[i] = position(t.nodes, t.corners[i], fields);
      v[i] = interpolate(t.nodes, t.corners[i], fields.velocity);
      w[i] = interpolate(t.nodes, t.corners[i], fields.mesh_velocity);
      for (int a = 0; a < 4 && !fields.pressure.empty(); ++a)
        p[i] += t.corners[i][a] * fields.pressure[static_cast<std::size_t>(t.nodes[a])];
    }
    const double area = fluid::area(x);
    sums.area = sums.area + fluid::area_vector(x);
    sums.size += area;
    sums.flow += fluid::flow(x, v, w);
    sums.centre = sums.centre + (area / 3) * (x[0] + x[1] + x[2]);
    force += fluid::integrated_pressure(x, p);
  }
  if (sums.size > 0) {
    sums.mean_pressure = force / sums.size;
    sums.centre = (1 / sums.size) * sums.centre;
  }
  return sums;
}

}  // namespace tunica::analysis
