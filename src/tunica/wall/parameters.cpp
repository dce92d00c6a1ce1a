#include "tunica/wall/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tunica::wall {

namespace {

void check_compressibility(const LawParameters& material, const std::string& where, config::Problems& problems) {
  const double bulk = bulk_modulus(material), shear = matrix_shear_modulus(material);
  if (!std::isfinite(bulk)) {
    problems.add("element", "is displacement, which needs a finite bulk modulus, but " + where + " is incompressible",
                 "use element: mixed, or poisson_ratio below 0.5");
    return;
  }
  const double nu = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear));
  if (nu > 0.45)
    problems.warn("element",
                  fmt::format("is displacement, and {} has a Poisson's ratio of {:.6g}, where it locks", where, nu),
                  "use element: mixed");
}

void check_regions(const Parameters& p, config::Problems& problems) {
  const auto each = [&](const auto& visit) {
    visit(p.material, std::string("the material"));
    for (const auto* further : p.composition.further()) visit(*further, std::string("a further material"));
    for (const auto& [name, region] : p.regions) {
      visit(region.material, "the material of region " + name);
      for (const auto* further : region.composition.further()) visit(*further, "a further material of region " + name);
    }
  };
  if (p.element == Element::displacement)
    each([&](const LawParameters& m, const std::string& where) { check_compressibility(m, where, problems); });
  if (!p.fibre_frame)
    each([&](const LawParameters& m, const std::string& where) {
      if (is_anisotropic(m))
        problems.add("fibre_frame", "is not given, but " + where + " has directions",
                     "say where circumferential and longitudinal are, for example `fibre_frame: {cylindrical: {origin: "
                     "[0 mm, 0 mm, 0 mm], axis: [0, 0, 1]}}`");
    });
  if (!p.regions.empty() && !p.smoothing_length)
    problems.add(
        "smoothing_length", "is not given, but the regions have materials of their own",
        "give the length over which one turns into the next, about one wall thickness; 0 lets them jump, which "
        "makes peaks of stress");
}

}  // namespace

std::vector<std::string> Parameters::cell_arrays() const {
  std::vector<std::string> names = fibre_frame ? frame_arrays(*fibre_frame) : std::vector<std::string>();
  const auto add = [&](const Composition& of) {
    for (auto& name : of.arrays())
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
  };
  add(composition);
  for (const auto& [name, region] : regions) add(region.composition);
  return names;
}

Body Parameters::body() const {
  return {
      .density = density, .volumetric = {volumetric_energy, bulk_modulus(material)}, .stabilisation = stabilisation};
}

config::Schema<RegionMaterial> RegionMaterial::schema() {
  return config::Schema<RegionMaterial>("region_material", "A region with a material of its own.")
      .quantity("density", &RegionMaterial::density, config::dimension::density, config::above(0),
                "Density in the reference state; that of the wall when left out")
      .section("material", &RegionMaterial::material, law_schema(), "Law of the region and its parameters")
      .include(&RegionMaterial::composition, Composition::schema());
}

config::Schema<VolumetricEnergy> volumetric_energy_schema() {
  return config::Schema<VolumetricEnergy>("volumetric_energy", "Energy of a change of volume.")
      .choice(
          "volumetric_energy", [](VolumetricEnergy& energy) -> VolumetricEnergy& { return energy; },
          {{"simo_taylor", VolumetricEnergy::simo_taylor},
           {"quadratic", VolumetricEnergy::quadratic},
           {"miehe", VolumetricEnergy::miehe}},
          "K/4 (J^2 - 1 - 2 ln J), K/2 (J - 1)^2 or K (J - ln J - 1)")
      .by_default();
}

config::Schema<Viscosity> Viscosity::schema() {
  return config::Schema<Viscosity>("viscosity", "Viscous stress of the wall, beside that of its law (Kelvin-Voigt).")
      .quantity("value", &Viscosity::value, config::dimension::dynamic_viscosity, config::at_least(0), "eta")
      .plausible("0.1 Pa s", "1e5 Pa s")
      .choice(
          "law", &Viscosity::law, {{"newtonian", Law::newtonian}, {"potential", Law::potential}},
          "Cauchy stress 2 eta dev d with the rate of deformation d, or second Piola-Kirchhoff stress eta dE/dt with "
          "the Green-Lagrange strain E")
      .by_default()
      .shorthand("value");
}

config::Schema<Parameters> Parameters::schema() {
  return config::Schema<Parameters>("wall", "Solid wall.")
      .choice("element", &Parameters::element, {{"mixed", Element::mixed}, {"displacement", Element::displacement}},
              "Displacement and pressure, right up to incompressibility, or displacement alone, which locks there")
      .by_default()
      .quantity("density", &Parameters::density, config::dimension::density, config::above(0),
                "Density in the reference state")
      .plausible("500 kg/m^3", "3000 kg/m^3")
      .section("material", &Parameters::material, law_schema(), "Law of the wall and its parameters")
      .include(&Parameters::composition, Composition::schema())
      .map("regions", &Parameters::regions, RegionMaterial::schema(),
           "Wall regions of the mesh with a material of their own, by name")
      .by_default()
      .quantity(
          "smoothing_length", &Parameters::smoothing_length, config::dimension::length, config::at_least(0),
          "Length over which the material of one region turns into that of the next, about one wall thickness; 0: "
          "it jumps")
      .section("fibre_frame", &Parameters::fibre_frame, frame_schema(),
               "Circumferential, longitudinal and radial direction; for laws with fibres")
      .section("viscosity", &Parameters::viscosity, Viscosity::schema(),
               "Kelvin-Voigt: viscous stress beside that of the laws; none when left out, and in statics")
      .path("prestress", &Parameters::prestress,
            "Prestress of the imaged shape: the file wall.vtu that `tunica prestress` has written")
      .include(&Parameters::volumetric_energy, volumetric_energy_schema())
      .number("stabilisation", &Parameters::stabilisation, config::above(0),
              "Constant c of the mixed element's subscale, c h^2 / mu; larger damps pressure oscillations more")
      .by_default()
      .plausible("0.005", "2")
      .check(check_regions);
}

}  // namespace tunica::wall
