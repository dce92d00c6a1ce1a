#include "tunica/wall/elastic_constants.hpp"

#include <string>

namespace tunica::wall {

double Compressibility::bulk(double shear_modulus) const {
  if (bulk_modulus) return *bulk_modulus;
  const double compressible = 1.0 - 2.0 * *poisson_ratio;
  if (!(compressible > 0.0)) return std::numeric_limits<double>::infinity();
  return 2.0 * shear_modulus * (1.0 + *poisson_ratio) / (3.0 * compressible);
}

void Compressibility::check(config::Problems& problems) const {
  if (poisson_ratio.has_value() == bulk_modulus.has_value())
    problems.add("", poisson_ratio ? "poisson_ratio and bulk_modulus are both given" : "no compressibility is given",
                 "give one of poisson_ratio (0.5 is incompressible) and bulk_modulus");
}

config::Schema<Compressibility> Compressibility::schema() {
  return config::Schema<Compressibility>("compressibility", "Stiffness against a change of volume.")
      .number(
          "poisson_ratio", &Compressibility::poisson_ratio, config::range(0.0, 0.5),
          "Poisson's ratio at small strain, 0.5 is incompressible and needs the mixed element; or give bulk_modulus")
      .quantity("bulk_modulus", &Compressibility::bulk_modulus, config::dimension::pressure, config::above(0),
                "Bulk modulus; or give poisson_ratio")
      .check([](const Compressibility& c, config::Problems& problems) { c.check(problems); });
}

double ElasticConstants::shear() const {
  if (shear_modulus) return *shear_modulus;
  const double E = *young_modulus;
  if (poisson_ratio) return E / (2.0 * (1.0 + *poisson_ratio));
  return 3.0 * *bulk_modulus * E / (9.0 * *bulk_modulus - E);
}

double ElasticConstants::bulk() const { return Compressibility{poisson_ratio, bulk_modulus}.bulk(shear()); }

void ElasticConstants::check(config::Problems& problems) const {
  if (young_modulus.has_value() == shear_modulus.has_value())
    problems.add("", young_modulus ? "young_modulus and shear_modulus are both given" : "no stiffness is given",
                 "give one of young_modulus and shear_modulus");
  Compressibility{poisson_ratio, bulk_modulus}.check(problems);
  if (young_modulus && bulk_modulus && !(*young_modulus < 9.0 * *bulk_modulus))
    problems.add("bulk_modulus",
                 "is " + std::to_string(*bulk_modulus) + " Pa, but must exceed young_modulus / 9 = " +
                     std::to_string(*young_modulus / 9.0) + " Pa, else the shear modulus is not positive",
                 "check both moduli and their units");
}

config::Schema<ElasticConstants> ElasticConstants::schema() {
  using config::above, config::range;
  namespace dimension = config::dimension;
  return config::Schema<ElasticConstants>("elastic_constants", "Stiffness at small strain.")
      .quantity("young_modulus", &ElasticConstants::young_modulus, dimension::pressure, above(0),
                "Young's modulus; or give shear_modulus")
      .plausible("1 kPa", "1 GPa")
      .quantity("shear_modulus", &ElasticConstants::shear_modulus, dimension::pressure, above(0),
                "Shear modulus; or give young_modulus")
      .plausible("0.3 kPa", "1 GPa")
      .number("poisson_ratio", &ElasticConstants::poisson_ratio, range(0.0, 0.5),
              "Poisson's ratio, 0.5 is incompressible and needs the mixed element; or give bulk_modulus")
      .quantity("bulk_modulus", &ElasticConstants::bulk_modulus, dimension::pressure, above(0),
                "Bulk modulus; or give poisson_ratio")
      .check([](const ElasticConstants& c, config::Problems& problems) { c.check(problems); });
}

}  // namespace tunica::wall
