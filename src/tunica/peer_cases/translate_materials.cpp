// wall: densities, laws, fibres.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tunica/base/text.hpp"
#include "tunica/peer_cases/problem.hpp"
#include "tunica/peer_cases/values.hpp"

namespace tunica::peer_cases {

namespace {

enum class LawKind {
  neo_hooke,
  st_venant_kirchhoff,
  mooney_rivlin,
  hgo,
  guccione,
  holzapfel_ogden,
  unsplit_holzapfel_ogden
};

struct LawName {
  const char* name;
  std::optional<LawKind> law;
  const char* physics;  ///< of one that tunica does not have
};

constexpr double degrees = 180 / std::numbers::pi;

constexpr const char *modified_stvk = "the modified law of St. Venant and Kirchhoff",
                     *full_invariants = "HGO with fibres that follow the strain as it is (HGO-ma)",
                     *network = "a law as a neural network";

const LawName law_names[] = {
    {"nHK", LawKind::neo_hooke, ""},
    {"nHK91", LawKind::neo_hooke, ""},
    {"neoHookean", LawKind::neo_hooke, ""},
    {"neoHookeanSimo91", LawKind::neo_hooke, ""},
    {"stVK", LawKind::st_venant_kirchhoff, ""},
    {"stVenantKirchhoff", LawKind::st_venant_kirchhoff, ""},
    {"MR", LawKind::mooney_rivlin, ""},
    {"Mooney-Rivlin", LawKind::mooney_rivlin, ""},
    {"HGO", LawKind::hgo, ""},
    {"HGO-d", LawKind::hgo, ""},
    {"HGO-decoupled", LawKind::hgo, ""},
    {"Guccione", LawKind::guccione, ""},
    {"Gucci", LawKind::guccione, ""},
    {"HGO-ma", {}, full_invariants},
    {"HGO-modified", {}, full_invariants},
    {"lin", {}, "a stress in proportion to nothing but the shear modulus"},
    {"linear", {}, "a stress in proportion to nothing but the shear modulus"},
    {"m-stVK", {}, modified_stvk},
    {"modified-stVK", {}, modified_stvk},
    {"modified-stVenantKirchhoff", {}, modified_stvk},
    {"HO", LawKind::holzapfel_ogden, ""},
    {"Holzapfel", LawKind::holzapfel_ogden, ""},
    {"HO-d", LawKind::holzapfel_ogden, ""},
    {"HO-decoupled", LawKind::holzapfel_ogden, ""},
    {"HolzapfelOgden", LawKind::holzapfel_ogden, ""},
    {"HO_ma", LawKind::unsplit_holzapfel_ogden, ""},
    {"HO-ma", LawKind::unsplit_holzapfel_ogden, ""},
    {"HO-modified", LawKind::unsplit_holzapfel_ogden, ""},
    {"HolzapfelOgden-ModifiedAnisotropy", LawKind::unsplit_holzapfel_ogden, ""},
    {"LS", {}, "the law of Lee and Sacks"},
    {"Lee-Sacks", {}, "the law of Lee and Sacks"},
    {"CANN", {}, network},
    {"AnisoHyper", {}, network},
};

/// Elastic constants of a domain.
struct Constants {
  const Entry *modulus, *poisson, *penalty;
  double E = 0.0, nu = 0.0;
  bool incompressible() const { return std::abs(nu - 0.5) < 1e-12; }
};

std::optional<Constants> constants_of(Context& context, const DomainPart& part) {
  const Entry& properties = *part.properties;
  Constants constants{properties.find("Elasticity_modulus"), properties.find("Poisson_ratio"),
                      properties.find("Penalty_parameter")};
  if (constants.modulus == nullptr) {
    context.refuse(properties,
                   fmt::format("has no Elasticity_modulus; {} would take 1e7 in whatever unit", context.peer()),
                   "write it");
    return std::nullopt;
  }
  constants.E = context.number(properties, "Elasticity_modulus").value_or(0);
  constants.nu = context.number(properties, "Poisson_ratio").value_or(0.3);
  if (constants.poisson == nullptr)
    context.defaulted(properties, "Poisson_ratio", fmt::format("0.3, the default of {}", context.peer()));
  if (constants.incompressible() && constants.penalty == nullptr && part.equation == Equation::structure) {
    context.refuse(properties, "is incompressible, which struct cannot be",
                   "give a Penalty_parameter, a Poisson_ratio below 0.5, or the equation ustruct");
    return std::nullopt;
  }
  return constants;
}

/// Resistance to a change of volume, of a law whose other constants are not E and nu.
void add_compressibility(Context& context, const Constants& c, CaseKey& law) {
  if (c.penalty != nullptr)
    law.add("bulk_modulus", context.quantity(*c.penalty, context.units.pressure), c.penalty->where());
  else if (c.incompressible())
    law.add("poisson_ratio", "0.5", c.poisson->where());
  else
    law.add("bulk_modulus", with_unit(c.E / (3 * (1 - 2 * c.nu)), context.units.pressure),
            fmt::format("E / (3 (1 - 2 nu)) of {} and nu = {}", c.modulus->where(), number_text(c.nu)));
}

/// Shear modulus and resistance to a change of volume.
void add_constants(Context& context, const Constants& c, CaseKey& law) {
  if (c.penalty == nullptr) {
    law.add("young_modulus", context.quantity(*c.modulus, context.units.pressure), c.modulus->where());
    law.add("poisson_ratio", number_text(c.nu),
            c.poisson != nullptr ? c.poisson->where() : fmt::format("the default of {}", context.peer()));
    return;
  }
  law.add("shear_modulus", with_unit(c.E / (2 * (1 + c.nu)), context.units.pressure),
          fmt::format("E / (2 (1 + nu)) of {} and nu = {}", c.modulus->where(), number_text(c.nu)));
  add_compressibility(context, c, law);
}

/// The two Fiber_direction of a mesh.
struct Directions {
  std::vector<double> first, second;
  double cosine;  ///< of the angle between them; NaN where one of them is zero
};

/// None where they have not three components each.
std::optional<Directions> read_directions(const Context& context, const std::vector<const Entry*>& entries) {
  Directions d{read_vector(entries[0]->value, context.file.dialect).values,
               read_vector(entries[1]->value, context.file.dialect).values, 0.0};
  if (d.first.size() != 3 || d.second.size() != 3) return std::nullopt;
  double fs = 0, ff = 0, ss = 0;
  for (int i = 0; i < 3; ++i) {
    fs += d.first[i] * d.second[i];
    ff += d.first[i] * d.first[i];
    ss += d.second[i] * d.second[i];
  }
  d.cosine = fs / std::sqrt(ff * ss);
  return d;
}

/// The angle of the second family of fibres from the first, which is the direction e1 of the frame [rad]; 0 where it is
/// not known: of files until these have been looked at, else translate_frame() reports it.
double angle_of_families(Context& context, const PosedProblem& problem, std::size_t fibre_class) {
  const auto entries = problem.wall->all("Fiber_direction"), files = problem.wall->all("Fiber_direction_file_path");
  if (entries.size() == 2) {
    const auto d = read_directions(context, entries);
    return d ? std::acos(std::clamp(d->cosine, -1.0, 1.0)) : 0.0;
  }
  if (files.size() != 2) return 0.0;
  context.fibres = FibreFiles{context.located(*files[0]), context.located(*files[1]), files[1]->where()};
  const auto& angles = context.findings.fibre_angles;
  return fibre_class < angles.size() ? angles[fibre_class] : 0.0;
}

void translate_hgo(Context& context, const PosedProblem& problem, const Entry& law, const Constants& c,
                   std::size_t fibre_class, CaseKey& material) {
  const double angle = angle_of_families(context, problem, fibre_class);
  auto& section = material.section("goh", law.where() + " " + law.label);
  add_constants(context, c, section);
  section.add("exclusion", "none", fmt::format("{} counts fibres under compression", context.peer()));
  section.add("fibre_energy", "isochoric", fmt::format("as in {}", context.peer()));
  auto& families = section.section("families", "");
  constexpr const char* keys[2][2] = {{"a4", "b4"}, {"a6", "b6"}};
  for (int f = 0; f < 2; ++f) {
    auto& family = families.section("", fmt::format("family {}: k1 = {}, k2 = {}", f + 1, keys[f][0], keys[f][1]));
    family.add("mean_angle", with_unit(f == 0 ? 0.0 : angle, "rad"),
               f == 0 ? "along the first fibre direction" : "of the second fibre direction from the first");
    context.add_required(law, "kappa", "", family, "kappa");
    context.add_required(law, keys[f][0], context.units.pressure, family, "k1");
    context.add_required(law, keys[f][1], "", family, "k2");
  }
}

void translate_guccione(Context& context, const Entry& law, const Constants& c, CaseKey& material) {
  auto& section = material.section("fung", law.where() + " " + law.label + ", with f = c, s = l, n = r");
  context.add_required(law, "c", context.units.pressure, section, "c");
  context.add_required(law, "bf", "", section, "b_cc");
  context.add_required(law, "bt", "", section, "b_ll");
  context.add_required(law, "bt", "", section, "b_rr");
  for (const char* none : {"b_cl", "b_lr", "b_rc"}) section.add(none, "0", "has no such term");
  constexpr std::pair<const char*, const char*> shears[] = {{"bfs", "g_cl"}, {"bt", "g_lr"}, {"bfs", "g_rc"}};
  for (const auto& [theirs, ours] : shears)
    if (const auto value = context.number(law, theirs))
      section.add(ours, number_text(2 * *value), fmt::format("twice {}", law.find(theirs)->where()));
    else
      context.refuse(law, fmt::format("has no {}", theirs), "write it: the law needs it");
  add_compressibility(context, c, section);
}

void translate_holzapfel_ogden(Context& context, const Entry& law, const Constants& c, bool unsplit,
                               CaseKey& material) {
  auto& section = material.section("holzapfel_ogden", law.where() + " " + law.label + ", with f = e1, s = e2");
  constexpr std::pair<const char*, const char*> stresses[] = {{"a", "a"},
                                                              {"a4f", "a_f"},
                                                              {"a4s", "a_s"},
                                                              {"afs", "a_fs"}},
                                                stiffenings[] = {
                                                    {"b", "b"}, {"b4f", "b_f"}, {"b4s", "b_s"}, {"bfs", "b_fs"}};
  for (const auto& [theirs, ours] : stresses) context.add_required(law, theirs, context.units.pressure, section, ours);
  for (const auto& [theirs, ours] : stiffenings) context.add_required(law, theirs, "", section, ours);
  section.add("fibre_energy", unsplit ? "unsplit" : "isochoric", fmt::format("as in {}", law.label));
  context.changed(law,
                  "fibres and sheets are left out as soon as they are shorter than at rest, not by the smooth "
                  "switch 1 / (1 + exp(-k (I - 1)))");
  add_compressibility(context, c, section);
}

/// Is it a law of the directions e1 and e2, which has no families?
bool is_orthotropic(LawKind kind) {
  return kind == LawKind::guccione || kind == LawKind::holzapfel_ogden || kind == LawKind::unsplit_holzapfel_ogden;
}
bool needs_fibres(LawKind kind) { return kind == LawKind::hgo || is_orthotropic(kind); }

std::optional<LawKind> kind_of(Context& context, const Entry& properties) {
  const Entry* law = properties.find("Constitutive_model");
  if (law == nullptr) {
    context.defaulted(properties, "Constitutive_model", fmt::format("neo-Hooke, the default of {}", context.peer()));
    return LawKind::neo_hooke;
  }
  for (const LawName& known : law_names) {
    if (law->label != known.name) continue;
    if (!known.law) context.missing(*law, fmt::format("{} ({})", known.physics, known.name), "choose another law");
    return known.law;
  }
  context.refuse(
      *law, fmt::format("is of the type `{}`, which {} does not have", text::printable(law->label), context.peer()),
      "write neoHookean, stVK, Mooney-Rivlin, HGO, Guccione or HolzapfelOgden");
  return std::nullopt;
}

void translate_law(Context& context, const PosedProblem& problem, const DomainPart& part, std::size_t fibre_class,
                   CaseKey& to) {
  const auto kind = kind_of(context, *part.properties);
  const auto constants = constants_of(context, part);
  if (!kind || !constants) return;
  const Entry* law = part.properties->find("Constitutive_model");
  auto& material = to.section("material", part.properties->where());
  const std::string source =
      law == nullptr ? fmt::format("the default of {}", context.peer()) : law->where() + " " + law->label;
  if (*kind == LawKind::neo_hooke) {
    add_constants(context, *constants, material.section("neo_hooke", source));
  } else if (*kind == LawKind::st_venant_kirchhoff) {
    add_constants(context, *constants, material.section("st_venant_kirchhoff", source));
    context.changed(*law, fmt::format("a change of volume costs U(J) of Dilational_penalty_model in the place of "
                                      "lambda/2 (tr E)^2 and what {} adds to it; both agree for small strains",
                                      context.peer()));
  } else if (*kind == LawKind::mooney_rivlin) {
    auto& section = material.section("mooney_rivlin", source);
    context.add_required(*law, "c1", context.units.pressure, section, "c1");
    context.add_required(*law, "c2", context.units.pressure, section, "c2");
    add_compressibility(context, *constants, section);
  } else if (*kind == LawKind::hgo) {
    translate_hgo(context, problem, *law, *constants, fibre_class, material);
  } else if (*kind == LawKind::guccione) {
    translate_guccione(context, *law, *constants, material);
  } else {
    translate_holzapfel_ogden(context, *law, *constants, *kind == LawKind::unsplit_holzapfel_ogden, material);
  }
}

void translate_volumetric(Context& context, const PosedProblem& problem, CaseKey& wall) {
  constexpr std::pair<const char*, const char*> names[] = {{"quad", "quadratic"},      {"Quad", "quadratic"},
                                                           {"quadratic", "quadratic"}, {"Quadratic", "quadratic"},
                                                           {"ST91", "simo_taylor"},    {"Simo-Taylor91", "simo_taylor"},
                                                           {"M94", "miehe"},           {"Miehe94", "miehe"}};
  std::string first;
  for (const DomainPart& part : problem.walls) {
    const Entry* entry = part.properties->find("Dilational_penalty_model");
    std::string ours = "simo_taylor";
    if (entry != nullptr) {
      const auto known = std::find_if(std::begin(names), std::end(names),
                                      [&](const auto& name) { return entry->value == name.first; });
      if (known == std::end(names))
        return context.refuse(
            *entry, fmt::format("is `{}`, which {} does not have", text::printable(entry->value), context.peer()),
            "write quad, ST91 or M94");
      ours = known->second;
    } else {
      context.defaulted(*part.properties, "Dilational_penalty_model",
                        fmt::format("ST91, the default of {}", context.peer()));
    }
    if (first.empty()) {
      first = ours;
      wall.add("volumetric_energy", ours,
               entry != nullptr ? entry->where() : fmt::format("ST91, the default of {}", context.peer()));
    } else if (ours != first) {
      context.missing(*part.properties, "regions with volumetric energies of their own",
                      "give all Domains the same Dilational_penalty_model");
    }
  }
}

std::string vector_text(const std::vector<double>& v) {
  return fmt::format("[{}, {}, {}]", number_text(v[0]), number_text(v[1]), number_text(v[2]));
}

/// Any direction across `v`.
std::vector<double> across(const std::vector<double>& v) {
  const auto least = std::min_element(v.begin(), v.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  std::vector<double> result(3, 0.0);
  result[least - v.begin()] = 1.0;
  return result;
}

void translate_constant_frame(Context& context, const std::vector<const Entry*>& entries, bool orthotropic,
                              CaseKey& wall) {
  auto d = read_directions(context, entries);
  if (!d) return context.refuse(*entries[0], "and the next one have not three components each", "write (x, y, z)");
  if (!std::isfinite(d->cosine)) return context.refuse(*entries[0], "or the next one is zero", "write directions");
  if (orthotropic && std::abs(d->cosine) > 1e-6)
    return context.missing(*entries[1], "fibres and sheets that are not at right angles", "correct the directions");
  if (std::abs(d->cosine) > 1 - 1e-12) d->second = across(d->first);
  auto& frame = wall.section("fibre_frame", "").section("constant", "");
  frame.add("e1", vector_text(d->first), entries[0]->where());
  frame.add("e2", vector_text(d->second), entries[1]->where() + ", its part along e1 is taken off");
}

void translate_frame(Context& context, const PosedProblem& problem, bool orthotropic, CaseKey& wall) {
  if (problem.wall == nullptr) return;
  const auto directions = problem.wall->all("Fiber_direction"), files = problem.wall->all("Fiber_direction_file_path");
  if (directions.size() + files.size() != 2 || (directions.size() == 1))
    return context.refuse(*problem.wall,
                          fmt::format("has {} fibre directions, the law needs two", directions.size() + files.size()),
                          "give two Fiber_direction or two Fiber_direction_file_path");
  if (!directions.empty()) return translate_constant_frame(context, directions, orthotropic, wall);
  auto& frame = wall.section("fibre_frame", "").section("mesh", "");
  frame.add("e1", "fibre_1", files[0]->where());
  frame.add("e2", "fibre_2", files[1]->where() + ", its part along e1 is taken off");
}

/// Of all domains of the wall alike.
void translate_wall_viscosity(Context& context, const PosedProblem& problem, CaseKey& wall) {
  const Entry* first = nullptr;
  for (const DomainPart& part : problem.walls) {
    const Entry* viscosity = part.properties->find("Viscosity");
    if (viscosity != nullptr && context.number(*viscosity, "Value").value_or(0) == 0) viscosity = nullptr;
    if (&part == &problem.walls[0]) first = viscosity;
    const bool same =
        (viscosity == nullptr) == (first == nullptr) &&
        (viscosity == nullptr ||
         (viscosity->label == first->label && context.number(*viscosity, "Value") == context.number(*first, "Value")));
    if (!same)
      context.missing(viscosity != nullptr ? *viscosity : *part.properties, "walls with a viscosity of each Domain",
                      "give all Domains of the wall the same Viscosity");
  }
  if (first == nullptr) return;
  const std::string model = text::lower(first->label);
  const bool potential = model == "potential" || model == "pot";
  if (!potential && model != "newtonian" && model != "newt")
    return context.refuse(*first,
                          fmt::format("is of the model `{}`, which {} does not have for walls",
                                      text::printable(first->label), context.peer()),
                          "write Newtonian or Potential");
  auto& viscosity = wall.section("viscosity", first->where() + " " + first->label);
  viscosity.add("value", context.quantity(*first->find("Value"), context.units.viscosity),
                first->find("Value")->where());
  viscosity.add("law", potential ? "potential" : "newtonian", "");
}

void translate_density(Context& context, const PosedProblem& problem, const DomainPart& part, CaseKey& to) {
  const Entry* density = part.properties->find("Density");
  if (density == nullptr) {
    to.add("density", "1000 kg/m^3", fmt::format("not written; {} would take 0.5", context.peer()));
    return context.defaulted(*part.properties, "Density",
                             fmt::format("1000 kg/m^3, about that of tissue; {} would take 0.5", context.peer()));
  }
  // Without mass the wall is computed in equilibrium, in which the density has no meaning.
  if (context.number(*part.properties, "Density") != 0.0)
    to.add("density", context.quantity(*density, context.units.density), density->where());
  else if (!massless(context, problem))
    context.missing(*density, "a wall without mass that moves with blood, or with parts that have mass",
                    "write the density of the wall");
  else
    to.add("density", "1000 kg/m^3", density->where() + " 0: no inertia, see `analysis`");
}

/// Nodal stress becomes that of the elements, in a file that is made beside the case.
void translate_prestress(Context& context, const PosedProblem& problem, CaseKey& wall) {
  const Entry* file = problem.wall == nullptr ? nullptr : problem.wall->find("Prestress_file_path");
  if (file == nullptr) return;
  context.path(*file);  // warns when it is not there
  const std::string name = std::filesystem::path(file->value).stem().string() + "_of_elements.vtu";
  context.prestress = NodalPrestress{context.located(*file), name};
  wall.add("prestress", yaml_text(name), file->where());
  context.changed(*file, "each element gets the mean of its nodes, in the file " + name);
}

}  // namespace

void translate_wall(Context& context, const PosedProblem& problem, CaseKey& top) {
  if (problem.walls.empty()) return;
  const DomainPart& first = problem.walls[0];
  auto& wall = top.section("wall", first.properties->where());
  const bool mixed = first.equation == Equation::mixed_structure;
  wall.add(
      "element", mixed ? "mixed" : "displacement",
      fmt::format("{}: {}", problem.coupled() ? context.source(*first.properties, "Equation") : problem.main->where(),
                  mixed ? "ustruct" : "struct"));
  translate_density(context, problem, first, wall);
  bool fibres = false, orthotropic = false;
  for (const DomainPart& part : problem.walls) {
    const Entry* law = part.properties->find("Constitutive_model");
    for (const LawName& known : law_names)
      if (law != nullptr && known.law && law->label == known.name) {
        fibres |= needs_fibres(*known.law);
        orthotropic |= is_orthotropic(*known.law);
      }
    for (const char* key : {"Momentum_stabilization_coefficient", "Continuity_stabilization_coefficient"})
      if (context.number(*part.properties, key).value_or(0) != 0)
        context.changed(*part.properties->find(key), "tunica's mixed element has a stabilisation of its own");
  }
  translate_law(context, problem, first, 0, wall);
  translate_volumetric(context, problem, wall);
  translate_wall_viscosity(context, problem, wall);
  if (const auto parts = wall_parts(context, problem).regions; parts.size() > 1) {
    auto& regions = wall.section("regions", "");
    for (const WallRegion& part : parts) {
      auto& region = regions.section(part.name, part.part->properties->where());
      translate_density(context, problem, *part.part, region);
      translate_law(context, problem, *part.part, part.fibre_class, region);
    }
    wall.add("smoothing_length", with_unit(0.0, context.units.length),
             fmt::format("materials jump, as in {}", context.peer()));
  }
  if (const auto& angles = context.findings.fibre_angles; angles.size() > 1)
    context.remarks.changed.push_back(fmt::format(
        "{}: the angle between the families, {:.2f} to {:.2f} degrees, is that of {} classes of elements; the second "
        "family of an element is turned by at most {:.2f} degrees",
        context.fibres->where, angles.front() * degrees, angles.back() * degrees, angles.size(),
        context.findings.fibre_deviation * degrees));
  translate_prestress(context, problem, wall);
  if (fibres)
    translate_frame(context, problem, orthotropic, wall);
  else if (problem.wall != nullptr)
    for (const char* key : {"Fiber_direction", "Fiber_direction_file_path"})
      for (const Entry* entry : problem.wall->all(key))
        context.remarks.dropped.push_back(entry->where() + ": no law of the wall has fibres");
}

}  // namespace tunica::peer_cases
