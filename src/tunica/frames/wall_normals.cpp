#include "tunica/frames/wall_normals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tunica/assembly/wall_filter.hpp"
#include "tunica/base/error.hpp"
#include "tunica/frames/averaging.hpp"
#include "tunica/frames/symmetric_tensor.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::frames {

namespace {

/// The given faces as indices into mesh.faces. Throws InputError for a name that is none.
std::vector<char> chosen_faces(const distributed::DistributedMesh& mesh, const std::vector<std::string>& names) {
  std::vector<char> chosen(mesh.faces.size(), 0);
  for (const auto& name : names) chosen[&mesh.face(name) - mesh.faces.data()] = 1;
  return chosen;
}

/// Largest side on the inner faces, as a vector into the wall; zero for elements that have none.
std::vector<double> starting_vectors(const ElementGraph& graph, const std::vector<char>& inner) {
  std::vector<double> values(3 * static_cast<std::size_t>(graph.size()), 0.0);
  for (std::int32_t e = 0; e < graph.owned(); ++e) {
    double largest = 0;
    for (int side = 0; side < 4; ++side) {
      const auto face = graph.face(e, side);
      if (face < 0 || !inner[face]) continue;
      const auto area = graph.area_vector(e, side);
      const double size = norm(area);
      if (size <= largest) continue;
      largest = size;
      for (int i = 0; i < 3; ++i) values[3 * static_cast<std::size_t>(e) + i] = -area[i] / size;
    }
  }
  graph.update(values, 3);
  return values;
}

/// Mean of the vectors within the tolerance of the first one, eq. (6.2); its length before normalising.
double conditional_mean(const std::vector<double>& values, std::span<const std::int32_t> elements, double cosine,
                        double* result) {
  const auto first = vector_at(values, elements[0]);
  Vec3<double> sum{{0, 0, 0}};
  int count = 0;
  for (const auto e : elements) {
    const auto v = vector_at(values, e);
    if (dot(v, first) < cosine) continue;
    sum = sum + v;
    ++count;
  }
  const double length = norm(sum);
  // Vectors far apart may cancel; the first one then stands for all.
  const auto mean = length > 1e-6 ? (1 / length) * sum : first;
  std::copy(mean.x, mean.x + 3, result);
  return length / count;
}

/// Outward vectors without averaging: what gives the normals their sign.
std::vector<double> carried_vectors(const ElementGraph& graph, const std::vector<char>& inner, double tolerance) {
  auto vectors = starting_vectors(graph, inner);
  const double cosine = std::cos(tolerance);
  const auto unreached = carry_inwards(graph, vectors, 3, [&](const auto& values, const auto& known, double* result) {
    conditional_mean(values, known, cosine, result);
  });
  if (unreached > 0)
    throw InputError("interface of the wall",
                     fmt::format("{} elements of the wall cannot be reached from it", unreached),
                     "name all faces of the wall that touch the lumen, and join the parts of the wall");
  return vectors;
}

WallNormals normals_by(const ElementGraph& graph, const std::vector<char>& inner, const ConditionalMean& method) {
  WallNormals normals{carried_vectors(graph, inner, method.tolerance),
                      std::vector<double>(static_cast<std::size_t>(graph.owned()), 1.0)};
  const double cosine = std::cos(method.tolerance);
  for (int cycle = 0; cycle < method.cycles; ++cycle)
    average(graph, normals.direction, 3, [&](const auto& values, const auto& elements, double* result) {
      normals.agreement[elements[0]] = conditional_mean(values, elements, cosine, result);
    });
  return normals;
}

/// Integrals of one component of the dyads of the inner faces times each shape function, of owned nodes.
std::array<std::vector<double>, 6> dyad_loads(const distributed::DistributedMesh& mesh,
                                              const std::vector<char>& inner) {
  std::array<std::vector<double>, 6> loads;
  loads.fill(std::vector<double>(static_cast<std::size_t>(mesh.owned_nodes), 0.0));
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (!inner[f]) continue;
    for (const auto& t : mesh.faces[f].triangles) {
      const auto area = mesh::area_vector(mesh.points, t);
      const auto share = dyad(area, 1 / (3 * norm(area)));
      for (const auto node : t)
        for (int i = 0; i < 6 && node < mesh.owned_nodes; ++i) loads[i][node] += share[i];
    }
  }
  return loads;
}

WallNormals normals_by(const ElementGraph& graph, const std::vector<char>& inner, const FilteredDyads& method) {
  const auto& mesh = graph.mesh();
  WallNormals normals{carried_vectors(graph, inner, ConditionalMean{}.tolerance), {}};
  assembly::WallFilter filter(mesh, method.length, "Normals of the wall");
  std::array<std::vector<double>, 6> dyads;
  const auto loads = dyad_loads(mesh, inner);
  for (int i = 0; i < 6; ++i) dyads[i] = filter.apply(loads[i]);
  for (std::int32_t e = 0; e < graph.owned(); ++e) {
    SymmetricTensor s{};
    for (int i = 0; i < 6; ++i)
      for (const auto node : graph.nodes(e)) s[i] += dyads[i][node];
    const auto p = principal(s);
    const double sign = dot(p.direction, vector_at(normals.direction, e)) < 0 ? -1 : 1;
    for (int i = 0; i < 3; ++i) normals.direction[3 * static_cast<std::size_t>(e) + i] = sign * p.direction[i];
    // The direction is sure up to a second one of half the weight, which is what the curvature of a branch can bring.
    normals.agreement.push_back(std::clamp(2 * (p.largest - p.second) / p.largest, 0.0, 1.0));
  }
  graph.update(normals.direction, 3);
  return normals;
}

}  // namespace

WallNormals wall_normals(const ElementGraph& graph, const std::vector<std::string>& inner_faces,
                         const NormalMethod& method) {
  const auto inner = parallel::agree(graph.mesh().comm, [&] { return chosen_faces(graph.mesh(), inner_faces); });
  return std::visit([&](const auto& m) { return normals_by(graph, inner, m); }, method);
}

}  // namespace tunica::frames
