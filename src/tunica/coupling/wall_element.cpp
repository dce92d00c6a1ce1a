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

/// Displacement, acceleration and pressure of the corners.
template <class Element>
void gather_corners(const FieldsView& fields, const std::array<std::int32_t, 4>& nodes, Element& element) {
  gather_motion(fields, nodes, 0, element);
  for (int a = 0; a < 4; ++a) element.pressure[a] = fields.velocity_pressure[at(nodes[a]) + 3];
}

FieldsView view(const State& state) {
  return {.velocity_pressure = state.velocity_pressure.data(),
          .acceleration = state.acceleration.data(),
          .displacement = state.displacement.data()};
}

wall::ElementState<double> linear_wall_element(const distributed::DistributedMesh& mesh, const WallModel& model,
                                               const FieldsView& fields, std::size_t region, std::int32_t element) {
  const auto& nodes = mesh.regions[region].elements[element];
  const Vec3<double> X[4] = {mesh.points[nodes[0]], mesh.points[nodes[1]], mesh.points[nodes[2]],
                             mesh.points[nodes[3]]};
  wall::ElementState<double> e = model.at_rest(region, element, X);
  gather_corners(fields, nodes, e);
  return e;
}

wall::Symmetric<double> stress_of_law(const WallModel& model, const WallModel::ElementMaterial& material,
                                      const wall::ElementState<double>& state) {
  const auto& [law, body] = material;
  return model.mixed() ? wall::mixed_cauchy_stress(state, law) : wall::displacement_cauchy_stress(state, law, body);
}

}  // namespace

wall::quadratic::ElementState<double> quadratic_wall_element(const distributed::DistributedMesh& mesh,
                                                             const WallModel& model, const FieldsView& fields,
                                                             std::size_t region, std::int32_t element) {
  const auto& nodes = mesh.regions[region].elements[element];
  const Vec3<double> X[4] = {mesh.points[nodes[0]], mesh.points[nodes[1]], mesh.points[nodes[2]],
                             mesh.points[nodes[3]]};
  const auto shape = model.imaged(region, element, X);
  wall::quadratic::ElementState<double> e;
  e.reference = shape.reference;
  e.axes = shape.axes;
  gather_corners(fields, nodes, e);
  gather_motion(fields, mesh.regions[region].edges[element], 4, e);
  return e;
}

wall::ElementState<double> wall_element(const distributed::DistributedMesh& mesh, const WallModel& model,
                                        const FieldsView& fields, std::size_t region, std::int32_t element) {
  if (!mesh.quadratic) return linear_wall_element(mesh, model, fields, region, element);
  return wall::quadratic::at_centroid(quadratic_wall_element(mesh, model, fields, region, element),
                                      model.point_prestress(region, element));
}

wall::ElementState<double> wall_element(const distributed::DistributedMesh& mesh, const WallModel& model,
                                        const State& state, std::size_t region, std::int32_t element) {
  return wall_element(mesh, model, view(state), region, element);
}

wall::ElementState<double> wall_point(const distributed::DistributedMesh& mesh, const WallModel& model,
                                      const State& state, std::size_t region, std::int32_t element, int point) {
  if (!mesh.quadratic) return linear_wall_element(mesh, model, view(state), region, element);
  return wall::quadratic::at_point(quadratic_wall_element(mesh, model, view(state), region, element), point,
                                   model.point_prestress(region, element));
}

wall::Symmetric<double> cauchy_stress(const WallModel& model, std::size_t region, std::int32_t element,
                                      const wall::ElementState<double>& state) {
  const auto sigma = stress_of_law(model, model.material(region, element), state);
  if (model.prestress().kind != wall::PrestressKind::stress) return sigma;
  wall::Symmetric<double> sum{};
  for (int q = 0; q < model.prestress_points(); ++q) sum = sum + model.prestress(region, element, q);
  return sigma + wall::prestress_cauchy_stress(state, (1.0 / model.prestress_points()) * sum);
}

wall::Symmetric<double> point_cauchy_stress(const WallModel& model, std::size_t region, std::int32_t element, int point,
                                            const wall::ElementState<double>& state) {
  const auto sigma = stress_of_law(model, model.material(region, element, point), state);
  if (model.prestress().kind != wall::PrestressKind::stress) return sigma;
  return sigma + wall::prestress_cauchy_stress(state, model.prestress(region, element, point));
}

}  // namespace tunica::coupling
