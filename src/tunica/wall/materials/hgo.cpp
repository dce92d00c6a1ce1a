#include "tunica/wall/materials/hgo.hpp"

#include <cmath>

namespace tunica::wall {

namespace {

/// M (x) M of the direction at `angle` from e1 towards e2.
Symmetric<double> aligned(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c * c, s * s, 0.0, c * s, 0.0, 0.0}};
}

StructureTensorLaw reinforced(const ElasticConstants& elastic, const FibreOptions& options) {
  return {.matrix = {elastic.shear()},
          .unsplit = options.unsplit,
          .fibres = {.families = {}, .tension_only = options.tension_only}};
}

template <class Parameters>
config::Schema<Parameters> fibre_law(const char* name, const char* help) {
  return config::Schema<Parameters>(name, help)
      .include(&Parameters::elastic, ElasticConstants::schema())
      .include(&Parameters::options, FibreOptions::schema())
      .list("families", &Parameters::families, Parameters::Family::schema(), "Families of fibres")
      .check([](const Parameters& p, config::Problems& problems) { check_families(p.families.size(), problems); });
}

void check_dispersion(const GohParameters::Family& f, config::Problems& problems) {
  const bool bivariate = f.kappa_ip && f.kappa_op, partly = f.kappa_ip || f.kappa_op;
  if (f.kappa ? partly : !bivariate)
    problems.add("", f.kappa ? "kappa and kappa_ip or kappa_op are given" : "the dispersion is not given",
                 "give kappa, or both of kappa_ip and kappa_op");
}

}  // namespace

config::Schema<HgoParameters::Family> HgoParameters::Family::schema() {
  return config::Schema<Family>("family", "Aligned fibres.")
      .include(&Family::energy, fibre_energy_schema())
      .quantity("mean_angle", &Family::mean_angle, config::dimension::angle, fibre_angle_range(),
                "Direction, from circumferential towards longitudinal");
}

config::Schema<GohParameters::Family> GohParameters::Family::schema() {
  return config::Schema<Family>("family", "Dispersed fibres.")
      .include(&Family::energy, fibre_energy_schema())
      .quantity("mean_angle", &Family::mean_angle, config::dimension::angle, fibre_angle_range(),
                "Mean direction, from circumferential towards longitudinal")
      .number("kappa", &Family::kappa, config::range(0.0, 1.0 / 3.0),
              "Rotationally symmetric dispersion: 0 aligned, 1/3 isotropic; or give kappa_ip and kappa_op")
      .number("kappa_ip", &Family::kappa_ip, config::range(0.0, 1.0), "In-plane dispersion: 0 aligned, 1/2 isotropic")
      .number("kappa_op", &Family::kappa_op, config::range(0.0, 0.5),
              "Out-of-plane dispersion: 1/2 planar, 1/3 isotropic")
      .check(check_dispersion);
}

config::Schema<HgoParameters> HgoParameters::schema() {
  return fibre_law<HgoParameters>("hgo", "Matrix with families of aligned fibres (Holzapfel, Gasser & Ogden 2000).");
}

config::Schema<GohParameters> GohParameters::schema() {
  return fibre_law<GohParameters>("goh",
                                  "Matrix with families of dispersed fibres by generalised structure tensors (Gasser, "
                                  "Ogden & Holzapfel 2006; Holzapfel et al. 2015).");
}

StructureTensorLaw HgoParameters::law() const {
  StructureTensorLaw law = reinforced(elastic, options);
  for (const Family& f : families) law.fibres.families.push_back({f.energy, aligned(f.mean_angle)});
  return law;
}

StructureTensorLaw GohParameters::law() const {
  StructureTensorLaw law = reinforced(elastic, options);
  for (const Family& f : families) {
    const double A = f.kappa ? *f.kappa : 2.0 * *f.kappa_op * *f.kappa_ip;
    const double B = f.kappa ? 1.0 - 3.0 * A : 2.0 * *f.kappa_op * (1.0 - 2.0 * *f.kappa_ip);
    Symmetric<double> H = B * aligned(f.mean_angle);
    for (int n = 0; n < 3; ++n) H[n] += A;
    H[2] += 1.0 - 3.0 * A - B;
    law.fibres.families.push_back({f.energy, H});
  }
  return law;
}

}  // namespace tunica::wall
