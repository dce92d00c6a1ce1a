#include "small_cases.hpp"

#include "tunica/wall/parameters.hpp"

namespace tunica::test {

wall::Parameters soft_wall(wall::Element element) {
  wall::Parameters p;
  p.element = element;
  p.density = 1100;
  p.volumetric_energy = wall::VolumetricEnergy::miehe;
  auto& elastic = std::get<0>(p.material).elastic;
  elastic.young_modulus = 4e5;
  elastic.poisson_ratio = element == wall::Element::mixed ? 0.45 : 0.3;
  return p;
}

coupling::ProblemInput fsi_input(bc::Condition inlet, bc::Condition outlet) {
  coupling::ProblemInput in;
  in.fluid = blood();
  in.wall = soft_wall(wall::Element::mixed);
  in.boundary.fluid = in.fluid;
  in.boundary.interfaces = {{"lumen_wall", "wall_inner"}};
  in.boundary.conditions = {{"lumen_inlet", std::move(inlet)},
                            {"lumen_outlet", std::move(outlet)},
                            {"wall_inlet", bc::Fixed{}},
                            {"wall_outlet", bc::Fixed{}},
                            {"wall_outer", bc::Support{.stiffness = 1e7, .damping = 1e3}}};
  in.newton.relative_tolerance = 1e-6;
  in.linear.tolerance = in.linear.first_tolerance = 1e-6;
  return in;
}

}  // namespace tunica::test
