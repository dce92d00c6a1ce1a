// A wall with two helical families of dispersed fibres.
#pragma once

#include "verification/wall/solid.hpp"

namespace tunica::verification {

/// Two helical families in the plane of the wall, bivariate von Mises.
inline wall::DfdParameters helical(double poisson_ratio) {
  wall::DfdParameters p;
  p.elastic.shear_modulus = 40e3;
  p.elastic.poisson_ratio = poisson_ratio;
  for (const double angle : {0.6, -0.6}) {
    wall::dfd::Family family;
    family.energy = {60e3, 5.0};
    family.orientation = wall::dfd::Bivariate{2.5, 15.0, angle};
    p.families.push_back(family);
  }
  return p;
}

inline ProblemInput fibre_input(Element element, const wall::LawParameters& material,
                                std::vector<std::pair<std::string, bc::Condition>> conditions) {
  ProblemInput in = solid_input({element}, std::move(conditions));
  in.wall->material = material;
  in.wall->fibre_frame = wall::CylindricalFrame{};
  return in;
}

}  // namespace tunica::verification
