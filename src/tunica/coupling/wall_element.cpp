#include "tunica/coupling/wall_element.hpp"

#include "tunica/coupling/nodal.hpp"
#include "tunica/wall/output.hpp"

namespace tunica::coupling {

wall::ElementState<double> wall_element(const distributed::DistributedMesh& mesh, const WallModel& model,
                                        const State& state, std::size_t region, std::int32_t element) {
  const auto& nodes = mesh.regions[region].elements[element];
  const Vec3<double> X[4] = {mesh.points[nodes[0]], mesh.points[nodes[1]], mesh.points[nodes[2]],
                             mesh.points[nodes[3]]};
  wall::ElementState<double> e = model.at_rest(region, element, X);
  for (int a = 0; a < 4; ++a) {
    e.pressure[a] = state.velocity_pressure[at(nodes[a]) + 3];
    for (int c = 0; c < 3; ++c) {
      e.displacement[a][c] = state.displacement[at(nodes[a]) + c];
      e.acceleration[a][c] = state.acceleration[at(nodes[a]) + c];
    }
  }
  return e;
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
