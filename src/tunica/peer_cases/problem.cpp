#include "tunica/peer_cases/problem.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/base/text.hpp"

namespace tunica::peer_cases {

namespace fs = std::filesystem;

namespace {

struct EquationName {
  const char* name;
  std::optional<Equation> equation;
  const char* physics;  ///< of one that tunica does not have
};

constexpr const char *dye = "transport of heat or of a dye in the blood", *heat = "conduction of heat",
                     *electric = "electrophysiology of the heart", *linear = "linear elasticity",
                     *cmm = "the coupled momentum method", *stokes = "flow without inertia", *shell = "shells";

const EquationName equation_names[] = {
    {"fluid", Equation::fluid, ""},
    {"struct", Equation::structure, ""},
    {"structural", Equation::structure, ""},
    {"ustruct", Equation::mixed_structure, ""},
    {"structural_velocity_pressure", Equation::mixed_structure, ""},
    {"FSI", Equation::interaction, ""},
    {"fluid-solid-interaction", Equation::interaction, ""},
    {"advection_diffusion", {}, dye},
    {"AD", {}, dye},
    {"heatF", {}, dye},
    {"dyeTransport", {}, dye},
    {"scalarTransport", {}, dye},
    {"cardiac_electro_physiology", {}, electric},
    {"CEP", {}, electric},
    {"coupled_momentum", {}, cmm},
    {"CMM", {}, cmm},
    {"linear_elasticity", {}, linear},
    {"lElas", {}, linear},
    {"shell", {}, shell},
    {"solid_heat", {}, heat},
    {"heatS", {}, heat},
    {"laplace", {}, heat},
    {"poisson", {}, heat},
    {"stokes", {}, stokes},
};

const EquationName* find_equation(const std::string& name) {
  for (const EquationName& known : equation_names)
    if (name == known.name) return &known;
  return nullptr;
}

void unknown_equation(Context& context, const Entry& entry, const std::string& name) {
  context.refuse(entry,
                 fmt::format("is of the type `{}`, which {} does not have", text::printable(name), context.peer()),
                 "write fluid, struct, ustruct, FSI or mesh");
}

/// The equations, and those that tunica does not have.
bool find_equations(Context& context, PosedProblem& problem) {
  for (const Entry* entry : context.file.root.all("Add_equation")) {
    if (entry->label == "mesh") {
      problem.mesh_motion = entry;
      continue;
    }
    const EquationName* known = find_equation(entry->label);
    if (known == nullptr)
      unknown_equation(context, *entry, entry->label);
    else if (!known->equation)
      context.missing(*entry, fmt::format("{} (equation {})", known->physics, known->name),
                      "leave the equation out, where the rest is of use without it");
    else if (problem.main != nullptr)
      context.missing(*entry, fmt::format("a second equation beside that of line {}", problem.main->line),
                      "give each its own case, or couple them by the equation FSI");
    else {
      problem.main = entry;
      problem.equation = *known->equation;
    }
  }
  if (problem.mesh_motion != nullptr && problem.main != nullptr && !problem.coupled())
    context.missing(*problem.mesh_motion, "a mesh that moves without a wall", "leave the equation out");
  if (problem.main == nullptr && context.problems.empty())
    context.refuse(context.file.root, "has no equation", "add fluid, struct, ustruct or FSI");
  return problem.main != nullptr;
}

/// The peers keep domains as bits of a number.
constexpr int largest_domain = 31;

std::optional<int> integer(const std::string& text) {
  if (text.empty() || text.size() > 9 || text.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
  return std::stoi(text);
}

/// The domains of the equation; of one without any, its own properties.
void find_domains(Context& context, PosedProblem& problem) {
  const auto domains = problem.main->all("Domain");
  if (domains.empty() && problem.coupled())
    return context.refuse(*problem.main, "has no Domain of blood and none of wall",
                          "give both, with Equation fluid and Equation struct or ustruct");
  if (domains.empty()) {
    const DomainPart whole{problem.main, {}, problem.equation};
    if (problem.solves_fluid())
      problem.blood = whole;
    else
      problem.walls.push_back(whole);
    return;
  }
  for (const Entry* domain : domains) {
    const auto id = integer(domain->label);
    if (!id || *id > largest_domain) {
      context.refuse(
          *domain,
          fmt::format("has the id `{}`, no whole number from 0 to {}", text::printable(domain->label), largest_domain),
          "write the number that Add_mesh gives it");
      continue;
    }
    const std::string name = context.text(*domain, "Equation", problem.coupled() ? "" : problem.main->label);
    const EquationName* known = find_equation(name);
    if (known == nullptr || known->equation == Equation::interaction)
      unknown_equation(context, *domain, name);
    else if (!known->equation)
      context.missing(*domain, fmt::format("{} (equation {})", known->physics, name), "choose another equation");
    else if (*known->equation != Equation::fluid)
      problem.walls.push_back({domain, id, *known->equation});
    else if (problem.blood)
      context.missing(*domain, "blood with several properties", "keep one Domain of the equation fluid");
    else
      problem.blood = DomainPart{domain, id, Equation::fluid};
  }
}

/// Is the mesh in that domain, as a whole?
bool lies_in(const Context& context, const Entry& mesh, const DomainPart& domain) {
  return !domain.id || context.number(mesh, "Domain").value_or(0) == *domain.id;
}

void find_meshes(Context& context, PosedProblem& problem) {
  for (const Entry* mesh : context.file.root.all("Add_mesh")) {
    const bool several = mesh->find("Domain_file_path") != nullptr;
    bool lumen = problem.equation == Equation::fluid;
    if (problem.coupled()) {
      const bool blood = problem.blood && lies_in(context, *mesh, *problem.blood);
      const bool wall = std::any_of(problem.walls.begin(), problem.walls.end(),
                                    [&](const DomainPart& part) { return lies_in(context, *mesh, part); });
      if (several && problem.lumen != nullptr)
        lumen = false;  // the regions of the wall
      else if (!blood && !wall)
        context.refuse(*mesh, "lies in a Domain that the equation does not have", "give the equation that Domain");
      else
        lumen = blood;
    }
    const Entry*& place = lumen ? problem.lumen : problem.wall;
    if (place != nullptr)
      context.missing(
          *mesh, fmt::format("a second mesh of the {} beside that of line {}", lumen ? "blood" : "wall", place->line),
          "join the meshes to one");
    else
      place = mesh;
    if (several && lumen)
      context.missing(*mesh, "one mesh of several domains of blood, or of blood and wall",
                      "give blood and wall meshes of their own");
    for (const Entry* face : mesh->all("Add_face")) problem.faces.push_back({face, lumen});
  }
  const auto need = [&](bool wanted, const Entry* mesh, const char* what) {
    if (wanted && mesh == nullptr)
      context.refuse(*problem.main, fmt::format("has no mesh of the {}", what), "add it with Add_mesh");
  };
  need(problem.solves_fluid(), problem.lumen, "blood");
  need(problem.solves_wall(), problem.wall, "wall");
}

void refuse_twins(Context& context, const PosedProblem& problem) {
  for (std::size_t i = 0; i < problem.faces.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (problem.faces[i].face->label == problem.faces[j].face->label)
        context.refuse(*problem.faces[i].face,
                       fmt::format("{} is the name of the face of line {}, too", problem.faces[i].face->label,
                                   problem.faces[j].face->line),
                       "give every face its own name");
}

void find_interfaces(Context& context, PosedProblem& problem) {
  problem.projections = context.file.root.all("Add_projection");
  for (const Entry* projection : problem.projections) {
    FacePart* sides[2] = {};
    const std::string names[2] = {projection->label, context.text(*projection, "Project_from_face")};
    for (int s = 0; s < 2; ++s) {
      const auto found = std::find_if(problem.faces.begin(), problem.faces.end(),
                                      [&](const FacePart& part) { return part.face->label == names[s]; });
      if (found == problem.faces.end())
        context.refuse(*projection, fmt::format("names the face `{}`, which no mesh has", text::printable(names[s])),
                       "name a face of Add_face");
      else
        sides[s] = &*found;
    }
    if (sides[0] == nullptr || sides[1] == nullptr) continue;
    sides[0]->interface = sides[1]->interface = projection;
    if (sides[0]->lumen == sides[1]->lumen)
      context.missing(*projection, "faces of the same mesh, or of two meshes of the same kind, that are joined",
                      "join a face of the blood with one of the wall");
  }
  if (problem.coupled() && problem.projections.empty())
    context.refuse(*problem.main, "has no interface of blood and wall", "name it with Add_projection");
  if (!problem.coupled() && !problem.projections.empty())
    context.missing(*problem.projections[0], "meshes of the same equation that are joined", "join the meshes to one");
}

}  // namespace

const FacePart* PosedProblem::face(const std::string& name) const {
  for (const FacePart& part : faces)
    if (part.face->label == name) return &part;
  return nullptr;
}

bool massless(const Context& context, const PosedProblem& problem) {
  return !problem.solves_fluid() && !problem.walls.empty() &&
         std::all_of(problem.walls.begin(), problem.walls.end(),
                     [&](const DomainPart& part) { return context.number(*part.properties, "Density") == 0.0; });
}

WallParts wall_parts(const Context& context, const PosedProblem& problem) {
  WallParts parts;
  const Entry* domains = problem.wall == nullptr ? nullptr : problem.wall->find("Domain_file_path");
  const auto classes = std::max<std::size_t>(context.findings.fibre_angles.size(), 1);
  if (domains == nullptr && classes == 1) return parts;
  const bool list = domains != nullptr && text::lower(fs::path(domains->value).extension().string()) != ".vtu";
  parts.made = list || classes > 1;
  for (const DomainPart& part : problem.walls) {
    if (domains != nullptr && !part.id) continue;
    for (std::size_t k = 0; k < classes; ++k) {
      std::string name = domains != nullptr ? fmt::format("domain_{}", *part.id) : "";
      if (classes > 1) name += fmt::format("{}fibres_{}", name.empty() ? "" : "_", k + 1);
      const int domain = domains != nullptr ? *part.id : 0;
      parts.regions.push_back({&part, k, name, parts.made ? region_number(domain, k) : domain});
    }
  }
  return parts;
}

std::optional<PosedProblem> pose(Context& context) {
  PosedProblem problem;
  if (!find_equations(context, problem)) return std::nullopt;
  find_domains(context, problem);
  find_meshes(context, problem);
  refuse_twins(context, problem);
  find_interfaces(context, problem);
  if (problem.coupled() && (!problem.blood || problem.walls.empty()) && context.problems.empty())
    context.refuse(*problem.main, "has no Domain of blood, or none of wall", "give both");
  const bool mixed = std::any_of(problem.walls.begin(), problem.walls.end(),
                                 [](const DomainPart& part) { return part.equation == Equation::mixed_structure; });
  for (const DomainPart& part : problem.walls)
    if (mixed && part.equation == Equation::structure)
      context.missing(*part.properties, "struct and ustruct in one wall", "choose one of them for all domains");
  return problem;
}

}  // namespace tunica::peer_cases
