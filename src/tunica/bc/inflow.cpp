#include "tunica/bc/inflow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tunica/base/error.hpp"
#include "tunica/fe/tetrahedron.hpp"

namespace tunica::bc {

namespace {

/// Symmetric matrix by compressed rows, every entry stored.
struct Laplacian {
  std::vector<std::size_t> start;
  std::vector<std::int32_t> column;
  std::vector<double> value, diagonal;

  void multiply(const std::vector<double>& x, std::vector<double>& y) const {
    for (std::size_t i = 0; i + 1 < start.size(); ++i) {
      double sum = 0.0;
      for (std::size_t k = start[i]; k < start[i + 1]; ++k) sum += value[k] * x[column[k]];
      y[i] = sum;
    }
  }
};

struct Entry {
  std::int32_t row, column;
  double value;
};

/// Nodes of a triangle and its stiffness. With e_a the edge opposite corner a and grad l_a . grad l_b = e_a . e_b / (4
/// A^2), linear elements have K_ab = e_a . e_b / (4 A); quadratic ones are integrated exactly by the points of the
/// edges.
struct TriangleStiffness {
  std::array<std::int32_t, 6> nodes;
  int count;
  double k[6][6];
};

TriangleStiffness triangle_stiffness(const FaceMesh& face, std::size_t t) {
  const auto& corners = face.triangles[t];
  Vec3<double> edge[3];
  for (int a = 0; a < 3; ++a) edge[a] = face.points[corners[(a + 2) % 3]] - face.points[corners[(a + 1) % 3]];
  const double twice_area = norm(cross(edge[0], edge[1]));
  double linear[3][3];
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) linear[a][b] = dot(edge[a], edge[b]) / (2.0 * twice_area);
  TriangleStiffness s{{corners[0], corners[1], corners[2]}, 3, {}};
  if (face.edges.empty()) {
    for (int a = 0; a < 3; ++a) std::copy(linear[a], linear[a] + 3, s.k[a]);
    return s;
  }
  s.count = 6;
  std::copy(face.edges[t].begin(), face.edges[t].end(), s.nodes.begin() + 3);
  for (const auto& point : fe::three_points) {
    double slope[6][3] = {};  // grad N_a = sum_m slope[a][m] grad l_m
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3;
      slope[a][a] = 4 * point.barycentric[a] - 1;
      slope[3 + a][a] = 4 * point.barycentric[b];
      slope[3 + a][b] = 4 * point.barycentric[a];
    }
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b)
        for (int m = 0; m < 3; ++m)
          for (int n = 0; n < 3; ++n) s.k[a][b] += point.weight * slope[a][m] * slope[b][n] * linear[m][n];
  }
  return s;
}

/// Rim nodes are left out (identity rows), so the matrix is positive definite.
Laplacian surface_laplacian(const FaceMesh& face, const std::vector<bool>& rim) {
  std::vector<Entry> entries;
  entries.reserve((face.edges.empty() ? 9 : 36) * face.triangles.size() + face.points.size());
  for (std::size_t i = 0; i < rim.size(); ++i)
    if (rim[i]) entries.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(i), 1.0});
  for (std::size_t t = 0; t < face.triangles.size(); ++t) {
    const TriangleStiffness s = triangle_stiffness(face, t);
    for (int a = 0; a < s.count; ++a)
      for (int b = 0; b < s.count; ++b)
        if (!rim[s.nodes[a]] && !rim[s.nodes[b]]) entries.push_back({s.nodes[a], s.nodes[b], s.k[a][b]});
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.row != b.row ? a.row < b.row : a.column < b.column; });
  Laplacian matrix;
  matrix.diagonal.assign(face.points.size(), 1.0);
  std::int32_t row = -1;
  for (const auto& e : entries) {
    const bool same = row == e.row && matrix.column.back() == e.column;
    for (; row < e.row; ++row) matrix.start.push_back(matrix.column.size());
    if (!same) {
      matrix.column.push_back(e.column);
      matrix.value.push_back(0.0);
    }
    matrix.value.back() += e.value;
    if (e.row == e.column) matrix.diagonal[e.row] = matrix.value.back();
  }
  matrix.start.resize(face.points.size() + 1, matrix.column.size());
  return matrix;
}

double inner(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Conjugate gradients with the diagonal as preconditioner, to 1e-13 of the right-hand side.
std::vector<double> solve(const Laplacian& matrix, std::vector<double> r, const std::string& name) {
  const std::size_t n = r.size();
  std::vector<double> x(n, 0.0), z(n), q(n);
  const auto precondition = [&] {
    for (std::size_t i = 0; i < n; ++i) z[i] = r[i] / matrix.diagonal[i];
  };
  precondition();
  auto p = z;
  double rho = inner(r, z);
  const double target = 1e-26 * rho;
  for (std::size_t iteration = 0; iteration < 10 * n + 100; ++iteration) {
    if (rho <= target) return x;
    matrix.multiply(p, q);
    const double alpha = rho / inner(p, q);
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += alpha * p[i];
      r[i] -= alpha * q[i];
    }
    precondition();
    const double next = inner(r, z);
    for (std::size_t i = 0; i < n; ++i) p[i] = z[i] + next / rho * p[i];
    rho = next;
  }
  throw SolverError(
      fmt::format("inflow profile of face {}: conjugate gradients stopped at a relative residual of {:.2e} "
                  "after {} iterations; the triangles of the face are too distorted",
                  name, std::sqrt(rho / target) * 1e-13, 10 * n + 100));
}

void require_one_patch(const FaceMesh& face) {
  std::vector<std::int32_t> parent(face.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const auto& t : face.triangles)
    for (int k = 1; k < 3; ++k) parent[root(t[k])] = root(t[0]);
  int patches = 0;
  std::vector<bool> seen(face.points.size(), false);
  for (const auto& t : face.triangles) {
    const auto r = root(t[0]);
    if (!seen[r]) ++patches;
    seen[r] = true;
  }
  if (patches > 1)
    throw InputError("face " + face.name, fmt::format("a flow is prescribed on {} separate patches", patches),
                     "name each opening as a face of its own with its own flow");
}

void require_sound_triangles(const FaceMesh& face, const FaceShape& shape) {
  const double mean = shape.area / static_cast<double>(face.triangles.size());
  for (std::size_t i = 0; i < face.triangles.size(); ++i) {
    const auto& t = face.triangles[i];
    const auto &a = face.points[t[0]], &b = face.points[t[1]], &c = face.points[t[2]];
    const double area = 0.5 * norm(cross(b - a, c - a));
    if (!(area > 1e-9 * mean))
      throw InputError("face " + face.name,
                       fmt::format("triangle {} at ({:.6g}, {:.6g}, {:.6g}) m has no area ({:.3g} m^2, mean {:.3g})", i,
                                   a[0], a[1], a[2], area, mean),
                       "repair or remesh the face");
  }
}

struct NodeWeights {
  std::vector<double> load;  // of -Laplace(phi) = 1
  std::vector<double> flow;  // sum over the node's triangles of n . a_T / 3: its part in the flow through the face
  std::vector<bool> rim;     // velocity zero: rim, and nodes without a triangle
};

NodeWeights node_weights(const FaceMesh& face, const Vec3<double>& normal, const SymmetryMarks& symmetry) {
  const std::size_t n = face.points.size();
  NodeWeights weights{std::vector<double>(n, 0.0), std::vector<double>(n, 0.0), rim_nodes(face, symmetry)};
  if (std::find(weights.rim.begin(), weights.rim.end(), true) == weights.rim.end())
    throw InputError("face " + face.name, "it has no rim where the velocity can vanish",
                     "prescribe a flow on an opening, not on a closed surface");
  std::vector<bool> used(n, false);
  for (std::size_t k = 0; k < face.triangles.size(); ++k) {
    const auto& t = face.triangles[k];
    const auto &a = face.points[t[0]], &b = face.points[t[1]], &c = face.points[t[2]];
    const Vec3<double> area_vector = 0.5 * cross(b - a, c - a);
    for (const auto node : t) used[node] = true;
    // Quadratic shape functions of corners have no integral, those of edges a third of the area.
    for (const auto node : face.edges.empty() ? t : face.edges[k]) {
      used[node] = true;
      weights.flow[node] += dot(area_vector, normal) / 3.0;
      if (!weights.rim[node]) weights.load[node] += norm(area_vector) / 3.0;
    }
  }
  for (std::size_t i = 0; i < n; ++i) weights.rim[i] = weights.rim[i] || !used[i];
  if (std::find(weights.rim.begin(), weights.rim.end(), false) == weights.rim.end())
    throw InputError("face " + face.name, "all its nodes lie on the rim, so no flow can pass",
                     "refine the mesh at this opening");
  return weights;
}

}  // namespace

InflowProfile inflow_profile(const FaceMesh& face, Profile profile, const SymmetryMarks& symmetry) {
  InflowProfile result;
  result.shape = face_shape(face);
  require_sound_triangles(face, result.shape);
  require_one_patch(face);
  result.normal = mean_normal(face.name, result.shape);
  const NodeWeights weights = node_weights(face, result.normal, symmetry);
  if (profile == Profile::parabolic) {
    result.phi = solve(surface_laplacian(face, weights.rim), weights.load, face.name);
  } else {
    for (const bool rim : weights.rim) result.phi.push_back(rim ? 0.0 : 1.0);
  }
  const double flow = inner(result.phi, weights.flow);
  if (!(flow > 0.0))
    throw InputError("face " + face.name, "its triangles are folded so far that no flow passes along its mean normal",
                     "repair the face or cut the opening by a plane");
  for (auto& phi : result.phi) phi /= flow;
  return result;
}

}  // namespace tunica::bc
