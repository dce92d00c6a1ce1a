#include "tunica/quantities/moment.hpp"

#include <algorithm>
#include <array>
#include <variant>

#include "tunica/coupling/nodal.hpp"
#include "tunica/coupling/wall_element.hpp"
#include "tunica/fe/quadratic_tetrahedron.hpp"
#include "tunica/fluid/boundary.hpp"

namespace tunica::quantities {

using coupling::vector_at;

namespace {

/// grad v of a lumen element at one of its points, by barycentric coordinates.
Mat3<double> gradient_at(const fe::Gradients<double>& shape, const double* velocity,
                         const std::array<std::int32_t, 4>& corners, const std::array<std::int32_t, 6>& edges,
                         const std::array<double, 4>& barycentric) {
  const auto point = fe::quadratic_point(barycentric, 1.0);
  Mat3<double> gradient{};
  for (int b = 0; b < fe::quadratic_nodes; ++b)
    fluid::detail::add_outer(gradient, vector_at(velocity, b < 4 ? corners[b] : edges[b - 4]),
                             fe::quadratic_gradient(shape.dN, point, b));
  return gradient;
}

/// Calls add(node, grad v) for the nodes of an element that `wanted` takes: all ten of a quadratic one.
template <class Wanted, class Add>
void at_nodes(const Moment& moment, const std::array<std::int32_t, 4>& corners,
              const std::array<std::int32_t, 6>& edges, const fe::Gradients<double>& shape, const Wanted& wanted,
              const Add& add) {
  const double* velocity = moment.state().velocity_pressure.data();
  if (!moment.mesh().quadratic) {
    Mat3<double> gradient{};
    for (int a = 0; a < 4; ++a) fluid::detail::add_outer(gradient, vector_at(velocity, corners[a]), shape.dN[a]);
    for (const auto node : corners)
      if (wanted(node)) add(node, gradient);
    return;
  }
  for (std::size_t a = 0; a < 4; ++a) {
    std::array<double, 4> l{};
    l[a] = 1.0;
    if (wanted(corners[a])) add(corners[a], gradient_at(shape, velocity, corners, edges, l));
  }
  for (std::size_t e = 0; e < 6; ++e) {
    const auto first = static_cast<std::size_t>(fe::edge_ends[e][0]),
               second = static_cast<std::size_t>(fe::edge_ends[e][1]);
    std::array<double, 4> l{};
    l[first] = l[second] = 0.5;
    if (wanted(corners[first]) && wanted(corners[second]))
      add(edges[e], gradient_at(shape, velocity, corners, edges, l));
  }
}

fe::Gradients<double> shape_now(const Moment& moment, const std::array<std::int32_t, 4>& corners) {
  Vec3<double> x[4];
  for (int a = 0; a < 4; ++a) x[a] = moment.position(corners[a]);
  return fe::gradients(x);
}

Vec3<double> area_vector_now(const Moment& moment, const std::array<std::int32_t, 3>& nodes) {
  Vec3<double> x[3];
  for (int a = 0; a < 3; ++a) x[a] = moment.position(nodes[a]);
  return fluid::area_vector(x);
}

}  // namespace

Vec3<double> Moment::position(std::int32_t node) const {
  return mesh().points[node] + vector_at(state_.displacement.data(), node);
}

const std::vector<WallPoint>& Moment::wall_points(std::size_t region) {
  const auto [found, is_new] = wall_points_.try_emplace(region);
  auto& points = found->second;
  if (!is_new) return points;
  const auto& model = problem_.wall_model();
  points.resize(static_cast<std::size_t>(mesh().regions[region].owned_elements));
  for (std::size_t e = 0; e < points.size(); ++e) {
    const auto index = static_cast<std::int32_t>(e);
    const auto element = coupling::wall_element(mesh(), model, wall_, region, index);
    points[e] = {wall::deformation_gradient(element), coupling::cauchy_stress(model, region, index, element)};
  }
  return points;
}

// Every element at an owned node is present.
const std::vector<double>& Moment::velocity_gradients() {
  if (!velocity_gradients_.empty()) return velocity_gradients_;
  auto& sum = velocity_gradients_;
  sum.assign(9 * static_cast<std::size_t>(mesh().nodes()), 0.0);
  std::vector<double> weight(static_cast<std::size_t>(mesh().nodes()), 0.0);
  for (const auto& region : mesh().regions) {
    if (region.kind != mesh::RegionKind::lumen) continue;
    for (std::size_t e = 0; e < region.elements.size(); ++e) {
      const auto shape = shape_now(*this, region.elements[e]);
      const auto edges = mesh().quadratic ? region.edges[e] : std::array<std::int32_t, 6>{};
      at_nodes(
          *this, region.elements[e], edges, shape, [](std::int32_t) { return true; },
          [&](std::int32_t node, const Mat3<double>& gradient) {
            weight[node] += shape.volume;
            for (int i = 0; i < 3; ++i)
              for (int j = 0; j < 3; ++j)
                sum[9 * static_cast<std::size_t>(node) + static_cast<std::size_t>(3 * i + j)] +=
                    shape.volume * gradient(i, j);
          });
    }
  }
  for (std::int32_t node = 0; node < mesh().owned_nodes; ++node)
    for (std::size_t c = 0; c < 9 && weight[node] > 0; ++c) sum[9 * static_cast<std::size_t>(node) + c] /= weight[node];
  mesh().halo.update(sum, 9);
  return sum;
}

// Every triangle at an owned node is present.
const std::vector<double>& Moment::wall_shear_stresses() {
  if (!wall_shear_.empty()) return wall_shear_;
  wall_shear_.assign(3 * static_cast<std::size_t>(mesh().nodes()), 0.0);
  std::vector<double> weight(static_cast<std::size_t>(mesh().nodes()), 0.0);
  for (const auto& triangle : inside_) {
    const auto shape = shape_now(*this, triangle.element);
    const Vec3<double> n = area_vector_now(*this, triangle.nodes);
    const double area = norm(n);
    const auto on_triangle = [&](std::int32_t corner) {
      return std::find(triangle.nodes.begin(), triangle.nodes.end(), corner) != triangle.nodes.end();
    };
    at_nodes(*this, triangle.element, triangle.edges, shape, on_triangle,
             [&](std::int32_t node, const Mat3<double>& gradient) {
               const double mu = std::visit([&](const auto& law) { return law.viscosity(fluid::shear_rate(gradient)); },
                                            problem_.input().fluid->viscosity);
               // What the flow does to the wall: the opposite of what the wall does to the flow.
               const Vec3<double> stress = (-1.0) * fluid::wall_shear_traction(gradient, mu, (1.0 / area) * n);
               weight[node] += area;
               for (int i = 0; i < 3; ++i) wall_shear_[3 * static_cast<std::size_t>(node) + i] += area * stress[i];
             });
  }
  for (std::int32_t node = 0; node < mesh().owned_nodes; ++node)
    for (int i = 0; i < 3 && weight[node] > 0; ++i) wall_shear_[3 * static_cast<std::size_t>(node) + i] /= weight[node];
  mesh().halo.update(wall_shear_, 3);
  return wall_shear_;
}

const std::vector<double>& Moment::inside_normals() {
  if (!normals_.empty()) return normals_;
  normals_.assign(3 * static_cast<std::size_t>(mesh().nodes()), 0.0);
  const auto add = [&](std::int32_t node, const Vec3<double>& n) {
    for (int i = 0; i < 3; ++i) normals_[3 * static_cast<std::size_t>(node) + i] += n[i];
  };
  for (const auto& triangle : inside_) {
    const Vec3<double> n = area_vector_now(*this, triangle.nodes);
    for (const auto node : triangle.nodes) add(node, n);
    if (!mesh().quadratic) continue;
    const auto on_triangle = [&](int corner) {
      return std::find(triangle.nodes.begin(), triangle.nodes.end(), triangle.element[corner]) != triangle.nodes.end();
    };
    for (std::size_t e = 0; e < 6; ++e)
      if (on_triangle(fe::edge_ends[e][0]) && on_triangle(fe::edge_ends[e][1])) add(triangle.edges[e], n);
  }
  for (std::int32_t node = 0; node < mesh().owned_nodes; ++node) {
    double* n = normals_.data() + 3 * static_cast<std::size_t>(node);
    const double size = norm(Vec3<double>{{n[0], n[1], n[2]}});
    for (int i = 0; i < 3 && size > 0; ++i) n[i] /= size;
  }
  mesh().halo.update(normals_, 3);
  return normals_;
}

}  // namespace tunica::quantities
