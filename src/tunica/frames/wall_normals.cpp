#include "tunica/frames/wall_normals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/frames/averaging.hpp"
#include "tunica/frames/symmetric_tensor.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::frames {

namespace {

Vec3<double> vector(const std::vector<double>& values, std::int32_t e) {
  const double* v = values.data() + 3 * static_cast<std::size_t>(e);
  return {{v[0], v[1], v[2]}};
}

/// The given faces as indices into mesh.faces. Throws InputError for a name that is none.
std::vector<char> chosen_faces(const mesh::DistributedMesh& mesh, const std::vector<std::string>& names) {
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

/// Dyads of all sides on the inner faces, weighted by area and of trace 1; zero for elements that have none.
std::vector<double> starting_dyads(const ElementGraph& graph, const std::vector<char>& inner) {
  std::vector<double> values(6 * static_cast<std::size_t>(graph.size()), 0.0);
  for (std::int32_t e = 0; e < graph.owned(); ++e) {
    double* value = values.data() + 6 * static_cast<std::size_t>(e);
    for (int side = 0; side < 4; ++side) {
      const auto face = graph.face(e, side);
      if (face < 0 || !inner[face]) continue;
      const auto area = graph.area_vector(e, side);
      const auto d = dyad(area, 1 / norm(area));
      for (int i = 0; i < 6; ++i) value[i] += d[i];
    }
    const double trace = value[0] + value[1] + value[2];
    if (trace > 0) std::transform(value, value + 6, value, [&](double x) { return x / trace; });
  }
  graph.update(values, 6);
  return values;
}

/// Mean of the vectors within the tolerance of the first one, eq. (6.2); its length before normalising.
double conditional_mean(const std::vector<double>& values, std::span<const std::int32_t> elements, double cosine,
                        double* result) {
  const auto first = vector(values, elements[0]);
  Vec3<double> sum{{0, 0, 0}};
  int count = 0;
  for (const auto e : elements) {
    const auto v = vector(values, e);
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

WallNormals normals_by(const ElementGraph& graph, const std::vector<char>& inner, const DyadicMean& method) {
  WallNormals normals{carried_vectors(graph, inner, ConditionalMean{}.tolerance), {}};
  auto dyads = starting_dyads(graph, inner);
  carry_inwards(graph, dyads, 6, mean_dyad);
  for (int cycle = 0; cycle < method.cycles; ++cycle) average(graph, dyads, 6, mean_dyad);
  for (std::int32_t e = 0; e < graph.owned(); ++e) {
    SymmetricTensor s;
    std::copy_n(dyads.begin() + 6 * static_cast<std::ptrdiff_t>(e), 6, s.begin());
    const auto p = principal(s);
    const double sign = dot(p.direction, vector(normals.direction, e)) < 0 ? -1 : 1;
    for (int i = 0; i < 3; ++i) normals.direction[3 * static_cast<std::size_t>(e) + i] = sign * p.direction[i];
    normals.agreement.push_back((p.largest - p.second) / p.largest);
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
