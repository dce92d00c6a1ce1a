// Label images of the idealised dissection, disturbed as observers, networks and scanners disturb them.
#pragma once

#include <map>
#include <random>
#include <string>
#include <vector>

#include "tunica/geometry/dissection_model.hpp"
#include "tunica/imaging/label_surface.hpp"

namespace tunica::imaging::trials {

/// What a case has to become.
enum class Right { mesh, error };

struct Disturbed {
  LabelImage image;
  SurfaceSettings settings;
  Right right = Right::mesh;
  std::string what;  ///< was done, in words
};

/// The undisturbed dissection, shorter than the default one, with two tears.
struct Body {
  geometry::ParametricDissection shape;
  geometry::DissectionModel model;
  explicit Body(std::mt19937& random);
};

using Disturb = Disturbed (*)(const Body& body, std::mt19937& random);

/// All kinds by name.
const std::map<std::string, Disturb>& kinds();

}  // namespace tunica::imaging::trials
