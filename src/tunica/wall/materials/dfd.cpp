#include "tunica/wall/materials/dfd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/wall/materials/dfd_directions.hpp"

namespace tunica::wall {

namespace {

RuleChoice choose(const dfd::Rule& rule, const dfd::Family& family, bool tension_only) {
  const Density density = family.density();
  if (const auto* fixed = std::get_if<dfd::Octahedral>(&rule))
    return measured_rule(octahedral(density, fixed->count), fmt::format("octahedral {}", fixed->count), density,
                         family.energy.k2, tension_only);
  if (const auto* fixed = std::get_if<dfd::Product>(&rule))
    return measured_rule(product_rule(density, fixed->across, fixed->around),
                         fmt::format("product {} x {}", fixed->across, fixed->around), density, family.energy.k2,
                         tension_only);
  const double tolerance = std::get<dfd::Automatic>(rule).tolerance;
  RuleChoice choice = choose_rule(density, family.energy.k2, tolerance, tension_only);
  if (!(choice.error <= tolerance))
    throw InputError("material.dfd.directions",
                     fmt::format("no rule keeps the tolerance of {:.3g} of the stress; the best, {}, has {:.3g}",
                                 tolerance, choice.name, choice.error),
                     "allow a larger tolerance, or state the rule: octahedral or product");
  return choice;
}

void check_direction(const dfd::Symmetric& s, config::Problems& problems) {
  if (s.mean_angle.has_value() == s.mean_direction.has_value())
    problems.add("", s.mean_angle ? "mean_angle and mean_direction are both given" : "the mean direction is not given",
                 "give one of mean_angle and mean_direction");
  if (s.mean_direction && !(norm(*s.mean_direction) > 0.0))
    problems.add("mean_direction", "has length zero", "give a direction in the fibre frame, such as [1, 0, 0]");
}

void check_degradation(const dfd::Family& f, config::Problems& problems) {
  for (const Degradation& d : f.degradation)
    if (!(d.from < d.to))
      problems.add("degradation", fmt::format("has a range from {:.4g} to {:.4g} rad", d.from, d.to),
                   "let `from` be smaller than `to`, both between 0 (radial) and 90 deg (in the plane)");
}

config::Schema<Degradation> degradation_schema() {
  const config::Range angle = config::range(0.0, 1.5707963267949);
  return config::Schema<Degradation>("degradation",
                                     "Fibres weakened by the angle that they make with the radial direction.")
      .quantity("from", &Degradation::from, config::dimension::angle, angle,
                "Smallest angle from the radial direction e3")
      .quantity("to", &Degradation::to, config::dimension::angle, angle, "Largest angle from the radial direction e3")
      .number("factor", &Degradation::factor, config::range(0.0, 1.0), "What remains of them: 0 nothing, 1 all");
}

}  // namespace

config::Schema<dfd::Symmetric> dfd::Symmetric::schema() {
  return config::Schema<Symmetric>("von_mises", "Density that is rotationally symmetric about the mean direction.")
      .number("b", &Symmetric::concentration, config::at_least(0), "Concentration, 0 is isotropic")
      .plausible("0", "100")
      .quantity(
          "mean_angle", &Symmetric::mean_angle, config::dimension::angle, fibre_angle_range(),
          "Mean direction in the plane of the wall, from circumferential towards longitudinal; or give mean_direction")
      .quantities("mean_direction", &Symmetric::mean_direction, config::dimension::none, config::anything(),
                  "Mean direction as components along e1 (circumferential), e2 (longitudinal), e3 (radial)")
      .check(check_direction);
}

config::Schema<dfd::Bivariate> dfd::Bivariate::schema() {
  return config::Schema<Bivariate>("bivariate_von_mises",
                                   "Density with its own concentration in and out of the plane of the wall.")
      .number("a", &Bivariate::in_plane, config::at_least(0), "Concentration in the plane, 0 is isotropic there")
      .plausible("0", "100")
      .number("b", &Bivariate::out_of_plane, config::at_least(0), "Concentration about the plane, 0 is isotropic")
      .plausible("0", "500")
      .quantity("mean_angle", &Bivariate::mean_angle, config::dimension::angle, fibre_angle_range(),
                "Mean direction, from circumferential towards longitudinal");
}

config::Schema<dfd::Family> dfd::Family::schema() {
  return config::Schema<Family>("family", "Dispersed fibres.")
      .include(&Family::energy, fibre_energy_schema())
      .include(&Family::orientation, config::Schema<Orientation>("orientation", "Orientation density.")
                                         .one_of()
                                         .alternative(Symmetric::schema())
                                         .alternative(Bivariate::schema()))
      .list("degradation", &Family::degradation, degradation_schema(),
            "Ranges of directions whose fibres are weakened (Rolf-Pissarczyk et al. 2021)")
      .by_default()
      .check(check_degradation);
}

config::Schema<dfd::Automatic> dfd::Automatic::schema() {
  return config::Schema<Automatic>("auto", "The cheapest product rule that keeps the tolerance.")
      .number("tolerance", &Automatic::tolerance, config::range(1e-6, 0.1),
              "Largest relative error of the fibre stress")
      .by_default();
}

config::Schema<dfd::Octahedral> dfd::Octahedral::schema() {
  return config::Schema<Octahedral>("octahedral", "Spherical triangles of a refined octahedron.")
      .integer("count", &Octahedral::count, config::range(4, 65536),
               "Directions on the hemisphere: 16, 64, 256, 1024 ...")
      .by_default()
      .check([](const Octahedral& o, config::Problems& problems) {
        if (!is_octahedral_size(o.count))
          problems.add("count", fmt::format("is {}, no power of four", o.count), "use 16, 64, 256 or 1024");
      });
}

config::Schema<dfd::Product> dfd::Product::schema() {
  return config::Schema<Product>("product", "Gauss points fitted to the density, times equidistant ones around.")
      .integer("across", &Product::across, config::range(1, 64), "Gauss points across the plane, or away from the mean")
      .integer("around", &Product::around, config::range(3, 256), "Points around");
}

config::Schema<DfdParameters> DfdParameters::schema() {
  using P = DfdParameters;
  return config::Schema<P>("dfd", "Matrix with families of dispersed fibres, represented by directions.")
      .include(&P::elastic, ElasticConstants::schema())
      .include(&P::options, FibreOptions::schema())
      .section("directions", &P::rule,
               config::Schema<dfd::Rule>("directions", "Rule of directions.")
                   .one_of()
                   .alternative(dfd::Automatic::schema())
                   .alternative(dfd::Octahedral::schema())
                   .alternative(dfd::Product::schema()),
               "How the density is represented")
      .by_default("auto")
      .list("families", &P::families, dfd::Family::schema(), "Families of fibres")
      .check([](const P& p, config::Problems& problems) { check_families(p.families.size(), problems); });
}

Density dfd::Family::density() const {
  if (const auto* b = std::get_if<Bivariate>(&orientation))
    return BivariateVonMises{b->in_plane, b->out_of_plane, b->mean_angle};
  const auto& s = std::get<Symmetric>(orientation);
  const Vec3<double> M =
      s.mean_direction ? *s.mean_direction : Vec3<double>{{std::cos(*s.mean_angle), std::sin(*s.mean_angle), 0.0}};
  return VonMises{s.concentration, (1.0 / norm(M)) * M};
}

namespace {

/// `direction_set`: of a family, undegraded.
template <class DirectionSetOf>
DiscreteFibreLaw assembled(const DfdParameters& p, const DirectionSetOf& direction_set) {
  DiscreteFibreLaw result;
  result.matrix.shear_modulus = p.elastic.shear();
  result.unsplit = p.options.unsplit;
  result.fibres.tension_only = p.options.tension_only;
  // Families of equal energy share one bundle, and common directions are summed.
  std::vector<std::pair<FibreEnergy, std::vector<DirectionSet>>> bundles;
  for (const dfd::Family& family : p.families) {
    DirectionSet set = direction_set(family);
    degrade(set, family.degradation);
    auto equal = std::find_if(bundles.begin(), bundles.end(), [&](const auto& b) {
      return b.first.k1 == family.energy.k1 && b.first.k2 == family.energy.k2;
    });
    if (equal == bundles.end()) equal = bundles.insert(bundles.end(), {family.energy, {}});
    equal->second.push_back(std::move(set));
  }
  for (const auto& [energy, sets] : bundles) {
    const DirectionSet merged = merge(sets);
    result.fibres.bundles.push_back(FibreBundle::make(energy, merged.directions, merged.weights));
  }
  return result;
}

}  // namespace

DiscreteFibreLaw DfdParameters::law() const {
  std::vector<std::string> notes;
  DiscreteFibreLaw result = assembled(*this, [&](const dfd::Family& family) {
    RuleChoice choice = choose(rule, family, options.tension_only);
    notes.push_back(fmt::format("family {}: {}, {} directions, error of the fibre stress {:.2g} %", notes.size() + 1,
                                choice.name, choice.set.directions.size(), 100.0 * choice.error));
    return std::move(choice.set);
  });
  notes.push_back(fmt::format("{} directions in all", result.fibres.directions()));
  result.notes = std::move(notes);
  return result;
}

DiscreteFibreLaw law_with(const DfdParameters& parameters, const RuleSize& directions) {
  return assembled(parameters, [&](const dfd::Family& family) {
    return product_rule(family.density(), directions.across, directions.around);
  });
}

RuleSize rule_size_for(const DfdParameters& parameters, double tolerance) {
  RuleSize largest;
  for (const dfd::Family& family : parameters.families) {
    const RuleSize size =
        choose_rule_size(family.density(), family.energy.k2, tolerance, parameters.options.tension_only);
    largest = {std::max(largest.across, size.across), std::max(largest.around, size.around)};
  }
  return largest;
}

}  // namespace tunica::wall
