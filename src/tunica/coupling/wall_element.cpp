#include "tunica/coupling/wall_element.hpp"

#include "tunica/coupling/nodal.hpp"
#include "tunica/wall/output.hpp"

namespace tunica::coupling {

namespace {

template <class Element, std::size_t N>
void gather_motion(const FieldsView& fields, const std::array<std::int32_t, N>& nodes, std::size_t first,
                   Element& element) {
  for (std::size_t a = 0; a < N; ++a) {
    element.displacement[first + a] = vector_at(fields.displacement, nodes[a]);
    element.acceleration[first + a] = vector_at(fields.acceleration, nodes[a]);
  }
}

wall::ElementState<double> linear_wall_element(const distributed::DistributedMesh& mesh, const WallModel& model,
                                               const FieldsView& fields, std::size_t region, std::int32_t element) {
  const auto& nodes = mesh.regions[region].elements[element];
  const Vec3<double> X[4] = {mesh.points[nodes[0]], mesh.points[nodes[1]], mesh.points[nodes[2]],
                             mesh.points[nodes[3]]};
  wall::ElementState<double> e = model.at_rest(region, element, X);
  gather_motion(fields, nodes, 0, e);
  for (int a = 0; a < 4; ++a) e.pressure[a] = fields.velocity_pressure[at(nodes[a]) + 3];
  return e;
}

}  // namespace

wall::quadratic::ElementState<double> quadratic_wall_element(const distributed::DistributedMesh& mesh,
                                                             const WallModel& model, const FieldsView& fields,
                                                             std::size_t region, std::int32_t element) {
  const auto corners = linear_wall_element(mesh, model, fields, region, element);
  wall::quadratic::ElementState<double> e;
  e.reference = corners.reference;
  e.axes = corners.axes;
  for (int a = 0; a < 4; ++a) {
    e.displacement[a] = corners.displacement[a];
    e.acceleration[a] = corners.acceleration[a];
    e.pressure[a] = corners.pressure[a];
  }
  gather_motion(fields, mesh.regions[region].edges[element], 4, e);
  return e;
}

wall::ElementState<double> wall_element(const distributed::DistributedMesh& mesh, const WallModel& model,
                                        const State& state, std::size_t region, std::int32_t element) {
  const FieldsView fields{.velocity_pressure = state.velocity_pressure.data(),
                          .acceleration = state.acceleration.data(),
                          .displacement = state.displacement.data()};
  if (mesh.quadratic) return wall::quadratic::at_centroid(quadratic_wall_element(mesh, model, fields, region, element));
  return linear_wall_element(mesh, model, fields, region, element);
}

wall::Symmetric<double> cauchy_stress(const WallModel& model, std::size_t region, std::int32_t element,
                                      const wall::ElementState<double>& state) {
  const auto [law, body] = model.material(region, element);
  const auto sigma =
      model.mixed() ? wall::mixed_cauchy_stress(state, law) : wall::displacement_cauchy_stress(state, law, body);
  if (model.prestress().kind != wall::PrestressKind::stress) return sigma;
  return sigma + wall::prestress_cauchy_stress(state, model.prestress(region, element));
}

}  // namespace tunica::coupling
