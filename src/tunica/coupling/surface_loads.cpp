#include "tunica/coupling/surface_loads.hpp"

#include <algorithm>

#include "tunica/coupling/nodal.hpp"
#include "tunica/fe/quadratic_mass.hpp"
#include "tunica/fe/quadratic_triangle.hpp"
#include "tunica/fluid/boundary.hpp"
#include "tunica/wall/quadratic_surface.hpp"

namespace tunica::coupling {

struct SurfaceLoads::Sums {
  const assembly::BlockPattern& pattern;
  const FieldsView& fields;
  const LoadCoefficients& coefficients;
  std::span<double> residual;
  assembly::BlockMatrix* matrix;

  bool tangent() const { return matrix != nullptr; }
  template <class Vector>
  void add(std::int32_t node, const Vector& force) const {
    for (int i = 0; i < 3; ++i) residual[at(node) + i] += force[i];
  }
  template <class Kernel>
  void add_block(std::int32_t row, std::int32_t column, const Kernel& entry) const {
    float* block = matrix->blocks[pattern.slot(row, column)].a;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) block[4 * j + i] += static_cast<float>(entry(i, j));
  }
};

namespace {

std::array<std::int32_t, 6> quadratic_nodes(const distributed::Face& face, std::size_t t) {
  const auto &corners = face.triangles[t], &edges = face.edges[t];
  return {corners[0], corners[1], corners[2], edges[0], edges[1], edges[2]};
}

/// What a pressure that is linear between the values p at the corners gives to a corner, over a third of the area.
double share_of(const double (&p)[3], int corner) { return (p[0] + p[1] + p[2] + p[corner]) / 4; }

}  // namespace

NodalHistories::NodalHistories(const distributed::DistributedMesh& mesh, const distributed::Face& face,
                               bc::PointTable table)
    : table_(std::move(table)), slot_(static_cast<std::size_t>(mesh.nodes()), -1) {
  const auto look_up = [&](std::int32_t node) {
    auto& slot = slot_[static_cast<std::size_t>(node)];
    if (slot >= 0) return;
    slot = static_cast<std::int32_t>(histories_.size());
    histories_.push_back(table_.history(mesh.points[node]));
  };
  for (const auto& triangle : face.triangles) std::for_each(triangle.begin(), triangle.end(), look_up);
  for (const auto& edges : face.edges) std::for_each(edges.begin(), edges.end(), look_up);
}

std::vector<Vec3<double>> NodalHistories::values(double t) const {
  std::vector<Vec3<double>> values;
  values.reserve(histories_.size());
  for (const auto& history : histories_) values.push_back(table_.value(history, t));
  return values;
}

SurfaceLoads::SurfaceLoads(const distributed::DistributedMesh& mesh, const assembly::BlockPattern& pattern,
                           const std::optional<fluid::Parameters>& fluid)
    : mesh_(mesh), pattern_(pattern), fluid_(fluid) {}

void SurfaceLoads::add_lumen(const SurfaceLoad& load, double value, const Sums& sums) const {
  if (mesh_.quadratic) {
    add_quadratic_lumen(load, value, sums);
    return;
  }
  for (const auto& triangle : mesh_.faces[load.face].triangles) {
    Vec3<double> x[3], v[3], w[3];
    gather(sums.fields.position, triangle, x);
    gather(sums.fields.velocity_pressure, triangle, v);
    gather(sums.fields.mesh_velocity, triangle, w);
    fluid::TriangleVector<double> r{};
    fluid::TriangleMatrix<double> k{};
    if (load.kind == SurfaceLoad::Kind::lumen_pressure) {
      fluid::add_pressure(x, value, r);
    } else {
      const Vec3<double> force = (-value * fluid::area(x) / 3.0) * load.vector;
      for (auto& row : r.r) row = row + force;
    }
    fluid::add_backflow(x, v, w, *fluid_, r, sums.tangent() ? &k : nullptr, sums.coefficients.velocity);
    for (int a = 0; a < 3; ++a) {
      sums.add(triangle[a], r.r[a]);
      for (int b = 0; b < 3 && sums.tangent(); ++b) sums.add_block(triangle[a], triangle[b], k.k[a][b]);
    }
  }
}

// On a quadratic triangle a constant traction acts on the nodes of the edges alone: the integral of a corner's shape
// function vanishes.
void SurfaceLoads::add_quadratic_lumen(const SurfaceLoad& load, double value, const Sums& sums) const {
  const auto& face = mesh_.faces[load.face];
  for (std::size_t t = 0; t < face.triangles.size(); ++t) {
    const auto nodes = quadratic_nodes(face, t);
    Vec3<double> x[3], v[6], w[6], r[6] = {};
    gather(sums.fields.position, face.triangles[t], x);
    gather(sums.fields.velocity_pressure, nodes, v);
    gather(sums.fields.mesh_velocity, nodes, w);
    const Vec3<double> area = fluid::area_vector(x);
    const Vec3<double> force = load.kind == SurfaceLoad::Kind::lumen_pressure
                                   ? (value / 3.0) * area
                                   : (-value * norm(area) / 3.0) * load.vector;
    for (int a = 3; a < 6; ++a) r[a] = force;
    Mat3<double> k[6][6] = {};
    fluid::add_quadratic_backflow(area, v, w, *fluid_, r, sums.tangent() ? k : nullptr, sums.coefficients.velocity);
    for (int a = 0; a < 6; ++a) {
      sums.add(nodes[a], r[a]);
      for (int b = 0; b < 6 && sums.tangent(); ++b) sums.add_block(nodes[a], nodes[b], k[a][b]);
    }
  }
}

void SurfaceLoads::add_backflow(std::size_t face, const Sums& sums) const {
  add_lumen({.face = face, .kind = SurfaceLoad::Kind::lumen_pressure}, 0.0, sums);
}

void SurfaceLoads::add_traction(const TractionField& load, double t, double factor, const Sums& sums) const {
  const auto& face = mesh_.faces[load.face];
  for (std::size_t k = 0; k < face.triangles.size(); ++k) {
    Vec3<double> x[3];
    gather(sums.fields.position, face.triangles[k], x);
    const double area = factor * fluid::area(x);
    if (mesh_.quadratic) {
      const auto nodes = quadratic_nodes(face, k);
      Vec3<double> traction[6];
      for (int a = 0; a < 6; ++a) traction[a] = load.traction(mesh_.points[nodes[a]], t);
      for (const auto& point : fe::quadratic_seven_points)
        for (int a = 0; a < 6; ++a)
          for (int b = 0; b < 6; ++b)
            sums.add(nodes[a], (-area * point.weight * point.N[a] * point.N[b]) * traction[b]);
    } else {
      const auto& triangle = face.triangles[k];
      Vec3<double> traction[3];
      for (int a = 0; a < 3; ++a) traction[a] = load.traction(mesh_.points[triangle[a]], t);
      const Vec3<double> sum = traction[0] + traction[1] + traction[2];
      // The integral of N_a N_b is A/6 for a = b, else A/12.
      for (int a = 0; a < 3; ++a) sums.add(triangle[a], (-area / 12.0) * (sum + traction[a]));
    }
  }
  add_backflow(load.face, sums);
}

void SurfaceLoads::add_over_lumen(const SurfaceLoad& load, double value, double t, const Sums& sums) const {
  const auto& face = mesh_.faces[load.face];
  const auto values = load.over_face->values(t);
  const bool pressure = load.kind == SurfaceLoad::Kind::lumen_pressure;
  for (std::size_t k = 0; k < face.triangles.size(); ++k) {
    Vec3<double> x[3];
    gather(sums.fields.position, face.triangles[k], x);
    const Vec3<double> area = fluid::area_vector(x);
    const auto force = [&](std::int32_t node) {
      const Vec3<double>& v = load.over_face->at(values, node);
      return pressure ? (value * v[0]) * area : (-value * norm(area)) * v;
    };
    if (mesh_.quadratic) {
      const auto nodes = quadratic_nodes(face, k);
      for (std::size_t a = 0; a < nodes.size(); ++a)
        for (std::size_t b = 0; b < nodes.size(); ++b)
          sums.add(nodes[a], fe::quadratic_triangle_mass[a][b] * force(nodes[b]));
    } else {
      const auto& nodes = face.triangles[k];
      const Vec3<double> sum = force(nodes[0]) + force(nodes[1]) + force(nodes[2]);
      for (const auto node : nodes) sums.add(node, (1.0 / 12.0) * (sum + force(node)));
    }
  }
  add_backflow(load.face, sums);
}

void SurfaceLoads::add_over_wall(const SurfaceLoad& load, double value, double t, const Sums& sums) const {
  if (mesh_.quadratic) {
    add_over_quadratic_wall(load, value, t, sums);
    return;
  }
  const auto values = load.over_face->values(t);
  for (const auto& own : mesh_.faces[load.face].triangles) {
    const std::array<std::int32_t, 3> triangle{mesh_.host[own[0]], mesh_.host[own[1]], mesh_.host[own[2]]};
    const Vec3<double>* v[3];
    double p[3];
    for (std::size_t a = 0; a < 3; ++a) v[a] = &load.over_face->at(values, own[a]), p[a] = value * (*v[a])[0];
    Vec3<double> X[3], u[3];
    gather(sums.fields.reference_position, triangle, X);
    gather(sums.fields.displacement, triangle, u);
    if (load.kind == SurfaceLoad::Kind::dead_traction) {
      const double area = norm(wall::area_vector(X));
      const Vec3<double> sum = *v[0] + *v[1] + *v[2];
      for (std::size_t a = 0; a < 3; ++a) sums.add(triangle[a], (-value * area / 12.0) * (sum + *v[a]));
      continue;
    }
    const bool follower = load.kind == SurfaceLoad::Kind::follower_pressure;
    Vec3<double> x[3];
    for (int a = 0; a < 3; ++a) x[a] = follower ? X[a] + u[a] : X[a];
    const Vec3<double> third = (1.0 / 3.0) * wall::area_vector(x);
    wall::SurfaceMatrix<double> k{};
    if (follower && sums.tangent()) wall::add_pressure_tangent(x, 1.0, sums.coefficients.displacement, k);
    for (int a = 0; a < 3; ++a) {
      const double share = share_of(p, a);
      sums.add(triangle[static_cast<std::size_t>(a)], share * third);
      for (int b = 0; b < 3 && follower && sums.tangent(); ++b)
        sums.add_block(triangle[static_cast<std::size_t>(a)], triangle[static_cast<std::size_t>(b)],
                       [&](int i, int j) { return share * k.k[a][b][i][j]; });
    }
  }
}

void SurfaceLoads::add_over_quadratic_wall(const SurfaceLoad& load, double value, double t, const Sums& sums) const {
  namespace wq = wall::quadratic;
  const auto& face = mesh_.faces[load.face];
  const auto values = load.over_face->values(t);
  for (std::size_t k = 0; k < face.triangles.size(); ++k) {
    auto nodes = quadratic_nodes(face, k);
    Vec3<double> v[wq::triangle_nodes];
    double p[wq::triangle_nodes];
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      v[a] = value * load.over_face->at(values, nodes[a]);
      p[a] = v[a][0];
      nodes[a] = mesh_.host[nodes[a]];
    }
    wq::SurfaceState<double> s;
    gather(sums.fields.reference_position, nodes, s.X);
    gather(sums.fields.displacement, nodes, s.u);
    gather(sums.fields.velocity_pressure, nodes, s.velocity);
    wq::SurfaceVector<double> r{};
    wq::SurfaceMatrix<double> tangent{};
    const bool follower = load.kind == SurfaceLoad::Kind::follower_pressure;
    if (load.kind == SurfaceLoad::Kind::dead_traction)
      wq::add_dead_traction(s, v, r);
    else if (follower)
      wq::add_follower_pressure(s, p, sums.coefficients.displacement, r, sums.tangent() ? &tangent : nullptr);
    else
      wq::add_dead_pressure(s, p, r);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      sums.add(nodes[a], r.r[a]);
      for (std::size_t b = 0; b < nodes.size() && follower && sums.tangent(); ++b)
        sums.add_block(nodes[a], nodes[b], tangent.k[a][b]);
    }
  }
}

void SurfaceLoads::add_wall(const SurfaceLoad& load, double value, double factor, const Sums& sums) const {
  if (mesh_.quadratic) {
    add_quadratic_wall(load, value, factor, sums);
    return;
  }
  for (std::size_t t = 0; t < mesh_.faces[load.face].triangles.size(); ++t) {
    const auto& own = mesh_.faces[load.face].triangles[t];
    const std::array<std::int32_t, 3> triangle{mesh_.host[own[0]], mesh_.host[own[1]], mesh_.host[own[2]]};
    wall::SupportState<double> s;
    gather(sums.fields.reference_position, triangle, s.X);
    gather(sums.fields.displacement, triangle, s.u);
    gather(sums.fields.velocity_pressure, triangle, s.velocity);
    Vec3<double> x[3];
    for (int a = 0; a < 3; ++a) x[a] = s.X[a] + s.u[a];
    wall::SurfaceVector<double> r{};
    wall::SurfaceMatrix<double> k{};
    const double du = sums.coefficients.displacement;
    switch (load.kind) {
      case SurfaceLoad::Kind::dead_traction:
        wall::add_dead_traction(s.X, value * load.vector, r);
        break;
      case SurfaceLoad::Kind::dead_pressure:
        wall::add_pressure(s.X, value, r);
        break;
      case SurfaceLoad::Kind::follower_pressure: {
        const double pressure = load.pressures.empty() ? value : factor * load.pressures[t];
        wall::add_pressure(x, pressure, r);
        if (sums.tangent()) wall::add_pressure_tangent(x, pressure, du, k);
        break;
      }
      default: {
        wall::TissueSupport<double> support = load.support[t];
        support.pressure *= factor;
        wall::add_support(s, support, r);
        if (sums.tangent()) wall::add_support_tangent(s, support, du, sums.coefficients.velocity, k);
      }
    }
    for (int a = 0; a < 3; ++a) {
      sums.add(triangle[a], r.r[a]);
      for (int b = 0; b < 3 && sums.tangent(); ++b)
        sums.add_block(triangle[a], triangle[b], [&](int i, int j) { return k.k[a][b][i][j]; });
    }
  }
}

void SurfaceLoads::add_quadratic_wall(const SurfaceLoad& load, double value, double factor, const Sums& sums) const {
  namespace wq = wall::quadratic;
  const auto& face = mesh_.faces[load.face];
  for (std::size_t t = 0; t < face.triangles.size(); ++t) {
    auto nodes = quadratic_nodes(face, t);
    for (auto& node : nodes) node = mesh_.host[node];
    wq::SurfaceState<double> s;
    gather(sums.fields.reference_position, nodes, s.X);
    gather(sums.fields.displacement, nodes, s.u);
    gather(sums.fields.velocity_pressure, nodes, s.velocity);
    wq::SurfaceVector<double> r{};
    wq::SurfaceMatrix<double> k{};
    auto* tangent = sums.tangent() ? &k : nullptr;
    switch (load.kind) {
      case SurfaceLoad::Kind::dead_traction:
        wq::add_dead_traction(s, value * load.vector, r);
        tangent = nullptr;
        break;
      case SurfaceLoad::Kind::dead_pressure:
        wq::add_dead_pressure(s, value, r);
        tangent = nullptr;
        break;
      case SurfaceLoad::Kind::follower_pressure:
        wq::add_follower_pressure(s, load.pressures.empty() ? value : factor * load.pressures[t],
                                  sums.coefficients.displacement, r, tangent);
        break;
      default: {
        wall::TissueSupport<double> support = load.support[t];
        support.pressure *= factor;
        wq::add_support(s, support, sums.coefficients.displacement, sums.coefficients.velocity, r, tangent);
      }
    }
    for (int a = 0; a < wq::triangle_nodes; ++a) {
      for (int i = 0; i < 3; ++i) sums.residual[at(nodes[a]) + i] += r.r[a][i];
      for (int b = 0; b < wq::triangle_nodes && tangent != nullptr; ++b) sums.add_block(nodes[a], nodes[b], k.k[a][b]);
    }
  }
}

void SurfaceLoads::add(double t, double factor, const FieldsView& fields, const LoadCoefficients& coefficients,
                       std::span<double> residual, assembly::BlockMatrix* matrix) const {
  const Sums sums{pattern_, fields, coefficients, residual, matrix};
  for (const auto& load : loads_) {
    const double value = factor * load.course.value(t);
    const bool lumen = load.kind == SurfaceLoad::Kind::lumen_pressure || load.kind == SurfaceLoad::Kind::lumen_traction;
    if (load.over_face && lumen)
      add_over_lumen(load, value, t, sums);
    else if (load.over_face)
      add_over_wall(load, value, t, sums);
    else if (lumen)
      add_lumen(load, value, sums);
    else
      add_wall(load, value, factor, sums);
  }
  for (const auto& load : traction_fields_) add_traction(load, t, factor, sums);
  for (const auto face : open_faces_) add_backflow(face, sums);
}

}  // namespace tunica::coupling
