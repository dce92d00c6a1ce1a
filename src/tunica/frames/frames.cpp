#include "tunica/frames/frames.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tunica/distributed/element_shape.hpp"
#include "tunica/frames/averaging.hpp"
#include "tunica/frames/symmetric_tensor.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::frames {

namespace {

/// Below this sine of the angle between gradient and normal, and this share of the mean gradient, e2 is undefined.
constexpr double parallel_sine = 0.02, no_gradient = 1e-3;
/// A gradient of this share of the mean and more is fully trusted.
constexpr double sound_gradient = 0.2;

Vec3<double> across(const Vec3<double>& v, const Vec3<double>& normal) { return v - dot(v, normal) * normal; }

/// Outlet faces of the domain, and which of them meet, as cap and ring of one opening do: those are one group.
class Outlets {
 public:
  Outlets(const distributed::DistributedMesh& mesh, const std::vector<std::string>& names, Domain domain)
      : mesh_(mesh), domain_(domain) {
    for (const auto& name : names)
      if (const auto& face = mesh.face(name); includes(domain, mesh.regions[face.region].kind)) faces_.push_back(&face);
  }

  /// Numbers the nodes of each group. Collective.
  void tie(LaplaceConditions& conditions) const {
    const auto n = faces_.size();
    std::vector<double> meet(n * n, 0.0);
    for (std::size_t f = 0; f < n; ++f)
      for_owned_nodes(f, [&](std::int32_t node) {
        if (const auto other = conditions.group[node]; other >= 0) meet[f * n + static_cast<std::size_t>(other)] = 1;
        conditions.group[node] = static_cast<double>(f);
      });
    parallel::global_sum(mesh_.comm, meet);
    std::vector<std::size_t> first(n);  // face of lowest number in the group
    std::iota(first.begin(), first.end(), std::size_t{0});
    for (std::size_t f = 0; f < n; ++f)
      for (std::size_t g = 0; g < f; ++g)
        if (meet[f * n + g] > 0) {
          const auto [low, high] = std::minmax(first[f], first[g]);
          std::replace(first.begin(), first.end(), std::size_t{high}, std::size_t{low});
        }
    for (std::size_t f = 0; f < n; ++f)
      for_owned_nodes(f, [&](std::int32_t node) { conditions.group[node] = static_cast<double>(first[f]); });
    // Unit flux on average; a number that only leads to another group has no nodes and takes nothing.
    conditions.flux.assign(n, 0.0);
    for (std::size_t f = 0; f < n; ++f) conditions.flux[first[f]] += area(*faces_[f]);
    parallel::global_sum(mesh_.comm, conditions.flux);
  }

 private:
  template <class Visit>
  void for_owned_nodes(std::size_t f, const Visit& visit) const {
    for (const auto& t : faces_[f]->triangles)
      for (const auto node : t)
        if (const auto row = carrier(mesh_, domain_, node); row < mesh_.owned_nodes) visit(row);
  }

  double area(const distributed::Face& face) const {
    double sum = 0;
    for (std::int32_t t = 0; t < face.owned_triangles; ++t)
      sum += norm(mesh::area_vector(mesh_.points, face.triangles[t]));
    return sum;
  }

  const distributed::DistributedMesh& mesh_;
  Domain domain_;
  std::vector<const distributed::Face*> faces_;
};

/// Conditions of the longitudinal potential, eq. (6.4). Collective.
LaplaceConditions conditions_of(const distributed::DistributedMesh& mesh, const FrameFaces& faces, Domain domain) {
  const auto outlets = parallel::agree(mesh.comm, [&] {
    for (const auto& name : faces.inlet) mesh.face(name);
    return Outlets(mesh, faces.outlets, domain);
  });
  LaplaceConditions conditions(mesh);
  outlets.tie(conditions);
  for (const auto& name : faces.inlet)
    for (const auto& t : mesh.face(name).triangles)
      for (const auto node : t) conditions.value[carrier(mesh, domain, node)] = 0;
  return conditions;
}

std::vector<double> longitudinal_gradient(const ElementGraph& graph, const LaplaceSolution& solution) {
  const auto& phi = solution.phi;
  std::vector<double> gradient;
  for (std::int32_t e = 0; e < graph.owned(); ++e) {
    const auto g = distributed::shape(graph.mesh(), graph.nodes(e));
    Vec3<double> v{{0, 0, 0}};
    for (int a = 0; a < 4; ++a) v = v + phi[graph.nodes(e)[a]] * g.dN[a];
    gradient.insert(gradient.end(), v.x, v.x + 3);
  }
  return gradient;
}

/// Mean length of the gradient over the volume of the wall.
double mean_length(const ElementGraph& graph, const std::vector<double>& gradient) {
  double sums[2] = {0, 0};
  for (std::int32_t e = 0; e < graph.owned(); ++e) {
    const double volume = distributed::shape(graph.mesh(), graph.nodes(e)).volume;
    sums[0] += volume * norm(vector_at(gradient, e));
    sums[1] += volume;
  }
  parallel::global_sum(graph.mesh().comm, sums);
  return sums[0] / sums[1];
}

/// Directions without sign of the elements where `tensors` holds nothing, from those around.
void fill_undefined(const ElementGraph& graph, const std::vector<double>& normals, std::vector<double>& e2) {
  std::vector<double> tensors;
  for (std::int32_t e = 0; e < graph.size(); ++e) {
    const auto d = dyad(vector_at(e2, e), 1.0);
    tensors.insert(tensors.end(), d.begin(), d.end());
  }
  carry_inwards(graph, tensors, 6, mean_dyad);
  for (std::int32_t e = 0; e < graph.owned(); ++e) {
    double* result = e2.data() + 3 * static_cast<std::size_t>(e);
    if (result[0] != 0 || result[1] != 0 || result[2] != 0) continue;
    SymmetricTensor s;
    std::copy_n(tensors.begin() + 6 * static_cast<std::ptrdiff_t>(e), 6, s.begin());
    auto v = across(principal(s).direction, vector_at(normals, e));
    // Nothing around tells a direction in this plane: any will do, and its confidence is 0.
    if (!(norm(v) > parallel_sine)) {
      const Vec3<double> x{{1, 0, 0}}, y{{0, 1, 0}};
      v = across(std::abs(normals[3 * static_cast<std::size_t>(e)]) < 0.7 ? x : y, vector_at(normals, e));
    }
    v = (1 / norm(v)) * v;
    std::copy(v.x, v.x + 3, result);
  }
}

double angle(const Vec3<double>& a, const Vec3<double>& b) { return std::acos(std::min(1.0, std::abs(dot(a, b)))); }

/// e2 and e3 with ghosts; jumps over all sides within the wall.
std::vector<double> jumps(const ElementGraph& graph, const std::vector<double>& e2, const std::vector<double>& e3) {
  std::vector<double> result(static_cast<std::size_t>(graph.owned()), 0.0);
  for (std::int32_t e = 0; e < graph.owned(); ++e)
    for (const auto n : graph.neighbours(e)) {
      const Vec3<double> a[2] = {vector_at(e2, e), vector_at(e3, e)}, b[2] = {vector_at(e2, n), vector_at(e3, n)};
      for (const double turn : {angle(a[0], b[0]), angle(a[1], b[1]), angle(cross(a[0], a[1]), cross(b[0], b[1]))})
        result[e] = std::max(result[e], turn);
    }
  return result;
}

}  // namespace

Frames make_frames(const ElementGraph& graph, const FrameFaces& faces, const FrameSettings& settings) {
  const auto& mesh = graph.mesh();
  const auto conditions = conditions_of(mesh, faces, settings.domain);
  const auto normals = wall_normals(graph, faces.inner, settings.normal);
  const auto solution = solve_laplace(mesh, settings.domain, conditions, "Longitudinal direction of the wall");
  const auto gradient = longitudinal_gradient(graph, solution);
  const double mean = mean_length(graph, gradient);

  Frames frames;
  frames.iterations = solution.iterations;
  std::vector<double> e2(3 * static_cast<std::size_t>(graph.size()), 0.0);
  for (std::int32_t e = 0; e < graph.owned(); ++e) {
    const auto g = vector_at(gradient, e), tangent = across(g, vector_at(normals.direction, e));
    const double length = norm(g), sine = norm(tangent) / length;
    const bool defined = length > no_gradient * mean && sine > parallel_sine;
    frames.confidence.push_back(defined ? normals.agreement[e] * sine * std::min(1.0, length / (sound_gradient * mean))
                                        : 0.0);
    frames.undefined += !defined;
    for (int i = 0; i < 3 && defined; ++i) e2[3 * static_cast<std::size_t>(e) + i] = tangent[i] / norm(tangent);
  }
  frames.undefined = parallel::global_sum(mesh.comm, frames.undefined);
  graph.update(e2, 3);
  if (frames.undefined > 0) {
    fill_undefined(graph, normals.direction, e2);
    graph.update(e2, 3);
  }
  for (std::int32_t e = 0; e < graph.owned(); ++e) {
    frames.e2.push_back(vector_at(e2, e));
    frames.e3.push_back(vector_at(normals.direction, e));
    frames.e1.push_back(cross(frames.e2.back(), frames.e3.back()));
  }
  frames.jump = jumps(graph, e2, normals.direction);
  return frames;
}

MeanDirections mean_directions(const Vec3<double>& e1, const Vec3<double>& e2, double angle) {
  const Vec3<double> along = std::cos(angle) * e1, rise = std::sin(angle) * e2;
  return {along + rise, along - rise};
}

}  // namespace tunica::frames
