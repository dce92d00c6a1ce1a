// Laws of blood and wall, and the directions of fibres.
#include <algorithm>
#include <cmath>

#include "tunica/fluid/parameters.hpp"
#include "tunica/stages/export/exported.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::stages {

namespace dimension = config::dimension;
using peer_cases::add_key;
using peer_cases::add_section;
using peer_cases::Entry;

namespace {

/// Writes the viscosity of blood.
struct ViscosityExport {
  const Exported& e;
  Entry& domain;

  void operator()(const fluid::Newtonian& law) const {
    add_key(add_section(domain, "Viscosity", "Constant"), "Value", viscosity(law.mu));
  }
  void operator()(const fluid::CarreauYasuda& law) const {
    Entry& section = add_section(domain, "Viscosity", "Carreau-Yasuda");
    add_key(section, "Limiting_high_shear_rate_viscosity", viscosity(law.mu_infinity));
    add_key(section, "Limiting_low_shear_rate_viscosity", viscosity(law.mu_zero));
    add_key(section, "Shear_rate_tensor_multiplier", number(law.lambda));
    add_key(section, "Shear_rate_tensor_exponent", number(law.a));
    add_key(section, "Power_law_index", number(law.n));
  }
  void operator()(const fluid::Casson& law) const {
    Entry& section = add_section(domain, "Viscosity", "Cassons");
    const auto root = [](double value, const char* unit, const config::Dimension& due) {
      return number(std::sqrt(value / config::unit_factor(unit, due)));
    };
    add_key(section, "Asymptotic_viscosity_parameter",
            root(law.mu_infinity, e.units.viscosity, dimension::dynamic_viscosity));
    add_key(section, "Yield_stress_parameter", root(law.yield_stress, e.units.pressure, dimension::pressure));
    add_key(section, "Low_shear_rate_threshold", number(law.regularising_shear_rate));
  }

 private:
  std::string viscosity(double mu) const { return e.in(e.units.viscosity, dimension::dynamic_viscosity, mu); }
};

/// Writes a law of the wall.
struct LawExport {
  Exported& e;
  const std::string& where;
  Entry& domain;

  void operator()(const wall::NeoHookeParameters&) { law("neoHookean"); }
  void operator()(const wall::StVenantKirchhoffParameters&) {
    law("stVK");
    e.change(where, "svMultiPhysics adds the energy of a change of volume to the whole of St. Venant and Kirchhoff's");
  }
  void operator()(const wall::MooneyRivlinParameters& p) {
    Entry& section = law("Mooney-Rivlin");
    add_key(section, "c1", e.pressure(p.c1));
    add_key(section, "c2", e.pressure(p.c2));
  }
  void operator()(const wall::HgoParameters& p) {
    std::vector<double> kappas(p.families.size(), 0.0);
    fibres(p.options, p.families, kappas);
  }
  void operator()(const wall::GohParameters& p) {
    std::vector<double> kappas;
    for (const auto& family : p.families)
      if (family.kappa)
        kappas.push_back(*family.kappa);
      else
        return e.missing(where, "a dispersion in the plane and out of it", "give `kappa`");
    fibres(p.options, p.families, kappas);
  }
  void operator()(const wall::FungParameters& p) {
    const bool guccione =
        p.b_ll == p.b_rr && p.g_lr == 2 * p.b_ll && p.g_cl == p.g_rc && p.b_cl == 0 && p.b_lr == 0 && p.b_rc == 0;
    if (!guccione)
      return e.missing(where, "a law of Fung's type but Guccione's",
                       "set b_ll = b_rr, g_lr = 2 b_ll, g_cl = g_rc, b_cl = b_lr = b_rc = 0");
    Entry& section = law("Guccione");
    add_key(section, "c", e.pressure(p.c));
    add_key(section, "bf", number(p.b_cc));
    add_key(section, "bt", number(p.b_ll));
    add_key(section, "bfs", number(0.5 * p.g_cl));
  }
  void operator()(const wall::HolzapfelOgdenParameters& p) {
    Entry& section = law(p.options.unsplit ? "HO-ma" : "HolzapfelOgden");
    const std::pair<const char*, double> stresses[] = {{"a", p.a}, {"a4f", p.a_f}, {"a4s", p.a_s}, {"afs", p.a_fs}},
                                         numbers[] = {{"b", p.b}, {"b4f", p.b_f}, {"b4s", p.b_s}, {"bfs", p.b_fs}};
    for (const auto& [key, value] : stresses) add_key(section, key, e.pressure(value));
    for (const auto& [key, value] : numbers) add_key(section, key, number(value));
    if (!p.options.tension_only)
      return e.missing(where + ".exclusion", "fibres of this law under compression", "set `exclusion: tension_only`");
    e.change(where, "svMultiPhysics leaves fibres out by a smooth switch about their length at rest");
  }
  void operator()(const wall::DfdParameters&) {
    e.missing(where, "discrete fibre dispersion", "choose goh with a kappa and `exclusion: none`");
  }

 private:
  Entry& law(const char* name) { return add_section(domain, "Constitutive_model", name); }

  template <class Families>
  void fibres(const wall::FibreOptions& options, const Families& families, const std::vector<double>& kappas) {
    if (families.size() != 2) return e.missing(where + ".families", "a law of other than two families", "give two");
    if (options.tension_only)
      return e.missing(where + ".exclusion", "fibres that are left out under compression", "set `exclusion: none`");
    if (options.unsplit)
      return e.missing(where + ".fibre_energy", "fibres that follow the strain as it is", "set `isochoric`");
    if (kappas[0] != kappas[1])
      return e.missing(where + ".families", "families with a dispersion each", "give both the same kappa");
    Entry& section = law("HGO");
    add_key(section, "a4", e.pressure(families[0].energy.k1));
    add_key(section, "b4", number(families[0].energy.k2));
    add_key(section, "a6", e.pressure(families[1].energy.k1));
    add_key(section, "b6", number(families[1].energy.k2));
    add_key(section, "kappa", number(kappas[0]));
  }
};

const char* name(wall::VolumetricEnergy energy) {
  switch (energy) {
    case wall::VolumetricEnergy::quadratic:
      return "quad";
    case wall::VolumetricEnergy::miehe:
      return "M94";
    case wall::VolumetricEnergy::simo_taylor:
      break;
  }
  return "ST91";
}

/// Angles of the two directions that the laws of the wall want from e1 towards e2 [rad].
std::vector<double> angles(const wall::LawParameters& material) {
  std::vector<double> angles{0.0, std::acos(0.0)};  // fibres and sheets
  std::visit(
      [&](const auto& p) {
        if constexpr (requires { p.families[0].mean_angle; })
          if (p.families.size() == 2) angles = {p.families[0].mean_angle, p.families[1].mean_angle};
      },
      material);
  return angles;
}

/// The frame of every wall element, NaN elsewhere.
std::vector<wall::FibreFrame> frames(const Exported& e) {
  std::vector<wall::FibreFrame> result(e.data.tetrahedra.size());
  const auto* names = std::get_if<wall::MeshFrame>(&*e.c.wall->fibre_frame);
  const auto vector_of = [&](const std::string& array, std::size_t element) {
    for (const auto& field : e.data.fields)
      if (field.name == array) {
        const double* v = field.values.data() + 3 * element;
        return Vec3<double>{{v[0], v[1], v[2]}};
      }
    throw InputError("wall.fibre_frame", "the mesh has no array " + array, "name arrays of the wall");
  };
  for (const auto& region : e.data.regions)
    for (auto k = region.first_element; k < region.end_element && region.kind == mesh::RegionKind::wall; ++k) {
      const auto element = static_cast<std::size_t>(k);
      Vec3<double> centre{};
      for (const auto node : e.data.tetrahedra[element]) centre = centre + 0.25 * e.data.points[node];
      if (names != nullptr)
        result[element] = wall::orthonormal_frame(vector_of(names->e1, element), vector_of(names->e2, element),
                                                  fmt::format("element {}", k + 1));
      else if (const auto* constant = std::get_if<wall::ConstantFrame>(&*e.c.wall->fibre_frame))
        result[element] = constant->frame();
      else
        result[element] = std::get<wall::CylindricalFrame>(*e.c.wall->fibre_frame).at(centre);
    }
  return result;
}

}  // namespace

void export_blood(Exported& exported, Entry& domain) {
  const fluid::Parameters& fluid = *exported.c.fluid;
  add_key(domain, "Density", exported.in(exported.units.density, dimension::density, fluid.density));
  std::visit(ViscosityExport{exported, domain}, fluid.viscosity);
  add_key(domain, "Backflow_stabilization_coefficient", number(fluid.backflow));
  if (fluid.stabilisation != fluid::Stabilisation::vms_classic)
    exported.change("fluid.stabilisation", "svMultiPhysics has the rate of the step in tau_C: `vms_classic`");
}

void export_material(Exported& exported, const wall::LawParameters& material, double density, const std::string& where,
                     Entry& domain) {
  const bool statics = std::holds_alternative<case_file::StaticWall>(exported.c.analysis);
  add_key(domain, "Density", statics ? "0" : exported.in(exported.units.density, dimension::density, density));
  std::visit(LawExport{exported, where, domain}, material);
  add_key(domain, "Dilational_penalty_model", name(exported.c.wall->volumetric_energy));
  // The matrix of a law that has E and nu, and the resistance to a change of volume of every law.
  const double mu = wall::matrix_shear_modulus(material), K = wall::bulk_modulus(material);
  const bool incompressible = !std::isfinite(K);
  add_key(domain, "Elasticity_modulus", exported.pressure(incompressible ? 3 * mu : 9 * K * mu / (3 * K + mu)));
  add_key(domain, "Poisson_ratio", number(incompressible ? 0.5 : (3 * K - 2 * mu) / (2 * (3 * K + mu))));
  if (const auto& viscosity = exported.c.wall->viscosity) {
    const bool potential = viscosity->law == wall::Viscosity::Law::potential;
    add_key(add_section(domain, "Viscosity", potential ? "Potential" : "Newtonian"), "Value",
            exported.in(exported.units.viscosity, dimension::dynamic_viscosity, viscosity->value));
  }
}

void export_fibres(Exported& exported, Entry& mesh) {
  const auto& wall = *exported.c.wall;
  const auto is_anisotropic = [](const auto& region) { return wall::is_anisotropic(region.second.material); };
  if (!wall::is_anisotropic(wall.material) && std::none_of(wall.regions.begin(), wall.regions.end(), is_anisotropic))
    return;
  const auto axes = frames(exported);
  std::vector<std::vector<double>> of_elements(axes.size(), angles(wall.material));
  for (const auto& region : exported.data.regions)
    for (const auto& [name, own] : wall.regions)
      if (name == region.name && region.kind == mesh::RegionKind::wall)
        std::fill(of_elements.begin() + region.first_element, of_elements.begin() + region.end_element,
                  angles(own.material));
  for (std::size_t n = 0; n < 2; ++n) {
    mesh_io::VolumeArray array{.name = "FIB_DIR", .components = 3};
    for (std::size_t e = 0; e < axes.size(); ++e) {
      const double angle = of_elements[e][n];
      const Vec3<double> direction = std::cos(angle) * axes[e].e1 + std::sin(angle) * axes[e].e2;
      array.values.insert(array.values.end(), {direction[0], direction[1], direction[2]});
    }
    const std::string file = fmt::format("fibres_{}.vtu", n + 1);
    exported.wall_arrays.emplace_back(file, std::move(array));
    add_key(mesh, "Fiber_direction_file_path", "mesh/" + file);
  }
}

}  // namespace tunica::stages
