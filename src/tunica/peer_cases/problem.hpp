// The parts of a peer's file that make one problem: which equation, which mesh, which domain belongs to what.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tunica/peer_cases/context.hpp"

namespace tunica::peer_cases {

enum class Equation { fluid, structure, mixed_structure, interaction };

/// A domain of blood or wall: the section that holds its properties.
struct DomainPart {
  const Entry* properties;  ///< a Domain section, or the equation
  std::optional<int> id;    ///< of a Domain section
  Equation equation;        ///< fluid, structure or mixed_structure
};

/// One face of a mesh.
struct FacePart {
  const Entry* face;  ///< Add_face
  bool lumen;
  const Entry* interface = nullptr;  ///< the Add_projection that it belongs to
};

/// A problem that tunica can pose, as far as its parts go.
struct PosedProblem {
  Equation equation = Equation::fluid;
  const Entry* main = nullptr;                    ///< Add_equation
  const Entry* mesh_motion = nullptr;             ///< Add_equation mesh
  const Entry *lumen = nullptr, *wall = nullptr;  ///< Add_mesh
  std::optional<DomainPart> blood;
  std::vector<DomainPart> walls;
  std::vector<FacePart> faces;
  std::vector<const Entry*> projections;

  bool coupled() const { return equation == Equation::interaction; }
  bool solves_fluid() const { return equation == Equation::fluid || coupled(); }
  bool solves_wall() const { return equation != Equation::fluid; }
  /// Is there a mesh of everything that is computed? Where not, that has been reported.
  bool has_meshes() const { return (lumen || !solves_fluid()) && (wall || !solves_wall()); }
  const FacePart* face(const std::string& name) const;
};

/// Has the wall of a case without blood no mass anywhere? Then it is in equilibrium with its loads.
bool massless(const Context& context, const PosedProblem& problem);

/// A part of the wall with a material of its own.
struct WallRegion {
  const DomainPart* part;
  std::size_t fibre_class;  ///< in Findings::fibre_angles
  std::string name;
  int number;  ///< in the array that tells regions apart
};
/// None where the wall is one. `made`: is that array in a file that import makes, REGION, or DOMAIN_ID of the peer?
struct WallParts {
  std::vector<WallRegion> regions;
  bool made = false;
};
WallParts wall_parts(const Context& context, const PosedProblem& problem);

/// Adds what is missing or beyond tunica to the problems of `context`; nothing when no equation is left to pose.
std::optional<PosedProblem> pose(Context& context);

// Each writes its sections of the case file into `top`.
void translate_meshes(Context& context, const PosedProblem& problem, CaseKey& top);
void translate_fluid(Context& context, const PosedProblem& problem, CaseKey& top);
void translate_wall(Context& context, const PosedProblem& problem, CaseKey& top);
void translate_start(Context& context, const PosedProblem& problem, CaseKey& top);
/// After translate_start(), which says what Windkessels start from.
void translate_conditions(Context& context, const PosedProblem& problem, CaseKey& top);

}  // namespace tunica::peer_cases
