#include "tunica/bc/check.hpp"

#include <fmt/format.h>

#include <set>

#include "tunica/config/nearest.hpp"

namespace tunica::bc {

namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "(none)" : text;
}

std::string_view kind(Field field) { return field == Field::lumen ? "lumen" : "wall"; }

bool fits(const Condition& condition, Field field) {
  return field == Field::lumen ? fits_lumen(condition) : fits_wall(condition);
}

const char* allowed(Field field) {
  return field == Field::lumen ? "no_slip, symmetry, velocity, profile, flow, pressure, traction, resistance, rcr"
                               : "fixed, symmetry, free, pressure, traction, support";
}

class Checker {
 public:
  explicit Checker(const BoundaryCase& boundary) : boundary_(boundary) {
    for (const auto& face : boundary.faces) names_.push_back(face.name);
    for (const auto& [lumen, wall] : boundary.interfaces) coupled_.insert({lumen, wall});
  }

  std::vector<Problem> run() {
    check_interfaces();
    check_faces();
    for (const auto& [face, condition] : boundary_.conditions) check_condition(face, condition);
    check_pressure_level();
    if (boundary_.static_wall) check_wall_support();
    return std::move(problems_);
  }

 private:
  const BoundaryFace* find(const std::string& name) const {
    for (const auto& face : boundary_.faces)
      if (face.name == name) return &face;
    return nullptr;
  }

  std::string remedy_for_unknown(const std::string& name) const {
    const auto nearest = config::nearest(name, names_);
    return (nearest.empty() ? "" : fmt::format("did you mean '{}'? ", nearest)) +
           "faces of the mesh: " + listed(names_);
  }

  void check_interfaces() {
    const auto side = [this](const std::string& name, Field field) {
      const auto* face = find(name);
      if (!face)
        problems_.push_back({"interface", fmt::format("the mesh has no face '{}'", name), remedy_for_unknown(name)});
      else if (face->field != field)
        problems_.push_back({"interface",
                             fmt::format("'{}' bounds the {}, not the {}", name, kind(face->field), kind(field)),
                             "name the lumen face first and the wall face second"});
    };
    for (const auto& [lumen, wall] : boundary_.interfaces) {
      side(lumen, Field::lumen);
      side(wall, Field::wall);
    }
  }

  void check_faces() {
    for (const auto& face : boundary_.faces) {
      std::vector<std::string> found;
      for (const auto& [name, condition] : boundary_.conditions)
        if (name == face.name) found.emplace_back(bc::name(condition));
      const std::string where = "boundary." + face.name;
      const bool coupled = coupled_.contains(face.name);
      if (coupled && !found.empty())
        problems_.push_back({where,
                             fmt::format("the face is an interface between lumen and wall and has the condition "
                                         "{} as well",
                                         listed(found)),
                             "remove the condition: the coupling is the condition of this face"});
      else if (!coupled && found.empty())
        problems_.push_back({where, fmt::format("this {} face has no condition", kind(face.field)),
                             fmt::format("give it one of: {}", allowed(face.field))});
      else if (found.size() > 1)
        problems_.push_back({where,
                             fmt::format("{} conditions ({}), exactly one is allowed", found.size(), listed(found)),
                             "keep one of them"});
    }
  }

  void check_condition(const std::string& name, const Condition& condition) {
    const auto* face = find(name);
    if (!face) {
      problems_.push_back({"boundary." + name, "the mesh has no such face", remedy_for_unknown(name)});
    } else if (!fits(condition, face->field) && !coupled_.contains(name)) {
      problems_.push_back({"boundary." + name,
                           fmt::format("{} is not a condition for a {} face", bc::name(condition), kind(face->field)),
                           fmt::format("use one of: {}", allowed(face->field))});
    } else if (face->field == Field::lumen && held_axes(condition) != Axes{} && !coupled_.contains(name)) {
      problems_.push_back({fmt::format("boundary.{}.{}.fixed", name, bc::name(condition)),
                           "is given, but the face is one of the lumen", "remove it: it holds faces of walls"});
    }
    if (face && face->field == Field::lumen && undeforming(condition) && !coupled_.contains(name))
      problems_.push_back({fmt::format("boundary.{}.{}.undeforming", name, bc::name(condition)),
                           "is set, but the face is one of the lumen", "remove it: it is for faces of walls"});
  }

  /// A lumen face whose condition sets the pressure; empty when there is none.
  std::string face_with_pressure() const {
    for (const auto& [name, condition] : boundary_.conditions) {
      const auto* face = find(name);
      if (face && face->field == Field::lumen && fits_lumen(condition) && !prescribes_velocity(condition)) return name;
    }
    return {};
  }

  void check_pressure_level() {
    const std::string open = face_with_pressure();
    if (boundary_.pressure_point && !(boundary_.rigid_wall && open.empty()))
      problems_.push_back({"pressure_point",
                           open.empty()
                               ? std::string("is given, but the wall that moves with the blood sets its pressure")
                               : fmt::format("is given, but face {} sets the pressure", open),
                           "remove it: it is for blood that is enclosed by given velocities alone"});
    if (!boundary_.rigid_wall || boundary_.pressure_point || !open.empty()) return;
    std::vector<std::string> lumen;
    for (const auto& [name, condition] : boundary_.conditions)
      if (const auto* face = find(name); face && face->field == Field::lumen && fits_lumen(condition))
        lumen.push_back(name);
    if (!lumen.empty())
      problems_.push_back({"boundary",
                           fmt::format("every lumen face ({}) prescribes the velocity: the pressure is "
                                       "undetermined and the flows need not balance",
                                       listed(lumen)),
                           "give one opening a pressure, traction, resistance or rcr condition, or an enclosed flow a "
                           "`pressure_point`"});
  }

  /// Rigid motion can only be judged coarsely without the geometry: at least one face must hold the wall, and faces
  /// fixed along axes must together hold all three.
  void check_wall_support() {
    bool any_wall = false;
    std::array<bool, 3> held{false, false, false};
    for (const auto& [name, condition] : boundary_.conditions) {
      if (const auto* face = find(name); !face || face->field != Field::wall) continue;
      if (const auto* fixed = std::get_if<Fixed>(&condition); fixed && fixed->along_normal()) return;
      for (std::size_t i = 0; i < 3; ++i) held[i] = held[i] || held_axes(condition)[i];
      if (std::holds_alternative<Symmetry>(condition)) return;
      if (const auto* support = std::get_if<Support>(&condition); support && support->holds()) return;
    }
    for (const auto& face : boundary_.faces) any_wall = any_wall || face.field == Field::wall;
    if (!any_wall || (held[0] && held[1] && held[2])) return;
    std::string loose;
    for (int i = 0; i < 3; ++i)
      if (!held[i]) loose += (loose.empty() ? "" : ", ") + std::string(1, static_cast<char>('x' + i));
    problems_.push_back({"boundary",
                         fmt::format("nothing holds the wall against rigid motion along {} in a static "
                                     "analysis",
                                     loose),
                         "give a wall face `fixed`, or `support` with a stiffness > 0"});
  }

  const BoundaryCase& boundary_;
  std::vector<std::string> names_;
  std::set<std::string> coupled_;
  std::vector<Problem> problems_;
};

}  // namespace

std::vector<Problem> check_boundary(const BoundaryCase& boundary) { return Checker(boundary).run(); }

}  // namespace tunica::bc
