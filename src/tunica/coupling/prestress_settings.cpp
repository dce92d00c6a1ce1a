#include "tunica/config/schema.hpp"
#include "tunica/coupling/settings.hpp"

namespace tunica::coupling {

namespace {

using Method = PrestressSettings::Method;
using Update = PrestressSettings::Update;
using Fallback = PrestressSettings::Fallback;

void check_inverse(const PrestressSettings& settings, config::Problems& problems) {
  if (settings.method == Method::inverse && !settings.exclude.empty())
    problems.add("exclude", "an unloaded shape is one of the whole wall", "remove `exclude`, or use another `method`");
  if (settings.method != Method::inverse && settings.fallback)
    problems.add("fallback", "only `method: inverse` can need one", "remove it");
}

}  // namespace

config::Schema<PrestressSettings> PrestressSettings::schema() {
  using namespace config;
  return Schema<PrestressSettings>("prestress", "Fixed point for the prestress of the imaged wall.")
      .choice("method", &PrestressSettings::method,
              {{"stress", Method::stress}, {"stretch", Method::stretch}, {"inverse", Method::inverse}},
              "stress: S0 is added to the stress of the law; stretch: the law sees the imaged shape as stretched, so "
              "that fibres are recruited in it; inverse: stretched from an unloaded shape, which is found and written")
      .by_default()
      .choice("update", &PrestressSettings::update,
              {{"first_piola", Update::first_piola}, {"second_piola", Update::second_piola}},
              "Method stress: the symmetric part of the first Piola-Kirchhoff stress of the loaded wall becomes S0, or "
              "its second one (Hsu & Bazilevs 2011)")
      .by_default()
      .choice("fallback", &PrestressSettings::fallback, {{"stress", Fallback::stress}, {"stretch", Fallback::stretch}},
              "Method that takes over, with a warning, where `inverse` finds no unloaded shape; else that is an error")
      .texts("exclude", &PrestressSettings::exclude, "Wall regions that stay free of prestress, such as the flap")
      .by_default()
      .quantity("tolerance", &PrestressSettings::tolerance, dimension::length, above(0),
                "Largest displacement of the prestressed wall under its load")
      .by_default()
      .plausible("1e-6 mm", "0.1 mm")
      .integer("max_iterations", &PrestressSettings::max_iterations, range(1, 10000), "Of the fixed point")
      .by_default()
      .number("relaxation", &PrestressSettings::relaxation, range(0.01, 1),
              "Share of an update that is taken; halved by itself where the displacement grows")
      .by_default()
      .integer("load_steps", &PrestressSettings::load_steps, range(1, 256),
               "Equal steps in which the load grows, with an update after each; doubled by itself where that fails")
      .by_default()
      .check(check_inverse);
}

}  // namespace tunica::coupling
