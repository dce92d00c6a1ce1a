#include "tunica/frames/depth.hpp"

#include "tunica/frames/laplace.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::frames {

std::vector<double> depths(const ElementGraph& graph, const std::vector<std::string>& inner,
                           const std::vector<std::string>& outer) {
  const auto& mesh = graph.mesh();
  LaplaceConditions conditions(mesh);
  const auto hold = [&](const std::vector<std::string>& faces, double value) {
    for (const auto& name : faces) {
      const auto& face = mesh.face(name);
      if (!includes(Domain::wall, mesh.regions[static_cast<std::size_t>(face.region)].kind)) continue;
      for (const auto& triangle : face.triangles)
        for (const auto node : triangle) conditions.value[static_cast<std::size_t>(node)] = value;
    }
  };
  parallel::agree(mesh.comm, [&] {
    hold(outer, 1.0);
    hold(inner, 0.0);  // a node of both is wetted
  });
  const auto solution = solve_laplace(mesh, Domain::wall, conditions, "depth in the wall");
  std::vector<double> depth;
  for (std::int32_t e = 0; e < graph.owned(); ++e)
    for (const auto node : graph.nodes(e)) depth.push_back(solution.phi[static_cast<std::size_t>(node)]);
  return depth;
}

}  // namespace tunica::frames
