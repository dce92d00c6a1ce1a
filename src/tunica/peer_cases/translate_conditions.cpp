// boundary: what happens at the faces.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tunica/base/text.hpp"
#include "tunica/peer_cases/problem.hpp"
#include "tunica/peer_cases/values.hpp"
#include "tunica/peer_cases/zerod_file.hpp"

namespace tunica::peer_cases {

namespace {

enum class Type { dirichlet, neumann, traction, robin };

std::optional<Type> type_of(Context& context, const Entry& condition) {
  const Entry* type = condition.find("Type");
  if (type == nullptr) {
    context.refuse(condition, "has no Type", "write Dir, Neu, Trac or Robin");
    return std::nullopt;
  }
  const std::string& name = type->value;
  if (name == "Dirichlet" || name == "Dir") return Type::dirichlet;
  if (name == "Neumann" || name == "Neu") return Type::neumann;
  if (name == "Traction" || name == "Trac") return Type::traction;
  if (name == "Robin" || name == "Rbn") return Type::robin;
  if (name == "CMM" || name == "Coupled Momentum")
    context.missing(*type, "the coupled momentum method", "give the wall a mesh and the equation FSI");
  else if (name == "RIS0D")
    context.missing(*type, "valves as resistive surfaces", "remove the condition");
  else
    context.refuse(*type, fmt::format("is `{}`, which {} does not have", text::printable(name), context.peer()),
                   "write Dir, Neu, Trac or Robin");
  return std::nullopt;
}

enum class Time { steady, unsteady, resistance, rcr, coupled };

std::optional<Time> time_of(Context& context, const Entry& condition) {
  const std::string name = context.text(condition, "Time_dependence", "Steady");
  if (name == "Steady") return Time::steady;
  if (name == "Unsteady") return Time::unsteady;
  if (name == "Resistance") return Time::resistance;
  if (name == "RCR" || name == "Windkessel") return Time::rcr;
  if (name == "Coupled") return Time::coupled;
  const Entry& entry = *condition.find("Time_dependence");
  if (name == "General")
    context.missing(entry, "values given node by node and instant by instant",
                    "use a Profile and Temporal_values_file_path");
  else if (name == "Spatial")
    context.missing(entry, "a load given node by node", "use one Value for the face");
  else
    context.refuse(entry, fmt::format("is `{}`, which {} does not have", text::printable(name), context.peer()),
                   "write Steady, Unsteady, Resistance, RCR or Coupled");
  return std::nullopt;
}

/// One condition of the main equation, and where it acts.
struct Part {
  const Entry& entry;  ///< Add_BC
  const FacePart& face;
  Type type;
  Time time;
  std::vector<double> value;  ///< of the key Value; 0 where there is none

  double scalar() const { return value.empty() ? 0.0 : value[0]; }
  bool vanishes() const {
    return time == Time::steady && std::all_of(value.begin(), value.end(), [](double v) { return v == 0; });
  }
};

class Conditions {
 public:
  Conditions(Context& context, const PosedProblem& problem, CaseKey& boundary)
      : context_(context), problem_(problem), boundary_(boundary) {}

  void translate();

 private:
  void translate(const Entry& condition);
  void refuse_second(const Entry& condition);
  void check_mesh_equation();
  void natural(const FacePart& part);

  void lumen_velocity(const Part& part);
  void lumen_flow(const Part& part);
  void lumen_pressure(const Part& part);
  void outlet(const Part& part);
  void zerod_outlet(const Part& part);
  void wall_motion(const Part& part);
  void wall_pressure(const Part& part);
  void traction(const Part& part);
  void support(const Part& part);

  CaseKey& face(const Part& part) { return boundary_.section(part.entry.label, part.entry.where()); }
  /// Value or table of a time course, in that unit; none: a factor.
  void course(const Part& part, const char* unit, CaseKey& to);
  bool table(const Part& part, const char* unit, CaseKey& to);
  /// Axes of Effective_direction; none where it is not there, or names all.
  std::vector<int> axes(const Part& part) const;
  bool profile_is(const Part& part, const char* wanted) const {
    return context_.text(part.entry, "Profile", "Flat") == wanted;
  }
  /// Normal loads are the same on the whole face.
  void check_load(const Part& part);

  Context& context_;
  const PosedProblem& problem_;
  CaseKey& boundary_;
  std::vector<const Entry*> done_;
};

// --- time courses -------------------------------------------------------------------------------------------------

bool Conditions::table(const Part& part, const char* unit, CaseKey& to) {
  const Entry* values = part.entry.find("Temporal_values_file_path");
  const Entry* series = part.entry.find("Fourier_coefficients_file_path");
  const Entry* file = values != nullptr ? values : series;
  if (file == nullptr) {
    context_.refuse(part.entry, "is Unsteady without a file",
                    "give Temporal_values_file_path or Fourier_coefficients_file_path");
    return false;
  }
  const bool ramp = values != nullptr && context_.flag(part.entry, "Ramp_function");
  const std::string where = file->where();
  auto& table = to.section("table", where);
  table.add("file", context_.path(*file), where);
  table.add("format", values != nullptr ? "simvascular" : "fourier", where);
  table.add("time_unit", "s", "");
  if (*unit != '\0') table.add("unit", unit, fmt::format("--units {}", context_.units.name));
  if (ramp) {
    table.add("interpolation", "ramp", context_.source(part.entry, "Ramp_function"));
  } else if (values != nullptr) {
    table.add("interpolation", "fourier",
              fmt::format("as {} reads tables, with the modes of the file", context_.peer()));
    table.add("trend", "true", "the table need not close");
  }
  return true;
}

void Conditions::course(const Part& part, const char* unit, CaseKey& to) {
  if (part.time == Time::unsteady) {
    table(part, unit, to);
    return;
  }
  const Entry* value = part.entry.find("Value");
  if (value == nullptr) context_.defaulted(part.entry, "Value", fmt::format("0, the default of {}", context_.peer()));
  to.add("value", with_unit(part.scalar(), unit),
         value != nullptr ? value->where() : fmt::format("the default of {}", context_.peer()));
}

std::vector<int> Conditions::axes(const Part& part) const {
  const auto direction = context_.vector(part.entry, "Effective_direction");
  std::vector<int> axes;
  for (std::size_t i = 0; i < direction.size() && i < 3; ++i)
    if (direction[i] != 0) axes.push_back(static_cast<int>(i));
  return axes.size() == 3 ? std::vector<int>() : axes;
}

// --- blood --------------------------------------------------------------------------------------------------------

void Conditions::lumen_velocity(const Part& part) {
  const auto held = axes(part);
  const Entry* direction = part.entry.find("Effective_direction");
  if (part.vanishes() && held.empty()) {
    face(part).add("no_slip", "{}", context_.source(part.entry, "Value", part.entry.where()));
    return;
  }
  if (part.vanishes() && held.size() == 1) {
    face(part).add("symmetry", "{}", direction->where());
    context_.changed(*direction,
                     "no velocity across the plane of the face, which has to be flat and at right angles "
                     "to that axis");
    return;
  }
  if (!held.empty())
    return context_.missing(*direction, "a velocity that is given along some axes and free along others",
                            "give all directions");
  if (const Entry* integral = part.entry.find("Impose_on_state_variable_integral");
      integral != nullptr && context_.flag(part.entry, integral->key))
    return context_.missing(*integral, "blood whose displacement is given", "give its velocity");
  if (context_.flag(part.entry, "Impose_flux")) return lumen_flow(part);
  if (!profile_is(part, "Flat"))
    return context_.missing(*part.entry.find("Profile"), "a parabolic profile that is given by its largest velocity",
                            "give the flow instead: Impose_flux true");
  auto& profile = face(part).section("profile", context_.source(part.entry, "Profile", "Flat by default"));
  const bool unsteady = part.time == Time::unsteady;
  const double into = unsteady ? -1.0 : -part.scalar();
  profile.add("speed", yaml_text(number_text(into)),
              unsteady ? "into the vessel, where the table has outward velocities"
                       : context_.source(part.entry, "Value") + ", into the vessel in the place of outward");
  profile.add("unit", context_.units.velocity, fmt::format("--units {}", context_.units.name));
  profile.add("length_unit", context_.units.length, "");
  if (unsteady) table(part, "", profile.section("waveform", part.entry.where()));
  context_.changed(part.entry, "the velocity is along the mean normal of the face, not along that of every node");
}

void Conditions::lumen_flow(const Part& part) {
  auto& flow = face(part).section("flow", context_.source(part.entry, "Impose_flux"));
  course(part, context_.units.flow, flow);
  flow.add("positive", "outflow", fmt::format("{} counts flow out of the vessel", context_.peer()));
  const bool parabolic = profile_is(part, "Parabolic");
  flow.add("profile", parabolic ? "parabolic" : "flat", context_.source(part.entry, "Profile", "Flat by default"));
  if (parabolic)
    context_.changed(*part.entry.find("Profile"),
                     "the profile solves Poisson's equation on the face; on a circle it is the paraboloid");
  const Entry* rim = part.entry.find("Zero_out_perimeter");
  if (rim != nullptr && !context_.flag(part.entry, rim->key, true))
    context_.changed(*rim, "the velocity is zero on the rim of the face");
}

void Conditions::check_load(const Part& part) {
  if (!profile_is(part, "Flat"))
    context_.missing(*part.entry.find("Profile"), "a load with a profile over the face", "remove Profile");
  if (context_.flag(part.entry, "Impose_flux"))
    context_.missing(*part.entry.find("Impose_flux"), "a load given by its force", "give the pressure");
  if (const Entry* rim = part.entry.find("Zero_out_perimeter");
      rim != nullptr && context_.flag(part.entry, rim->key) && !part.vanishes())
    context_.missing(*rim, "a load that vanishes on the rim of its face", "remove the key");
}

void Conditions::lumen_pressure(const Part& part) {
  check_load(part);
  course(part, context_.units.pressure, face(part).section("pressure", part.entry.find("Type")->where()));
}

void Conditions::outlet(const Part& part) {
  const UnitSystem& units = context_.units;
  const auto add = [&](const Entry& section, const char* key, const char* unit, CaseKey& to, const char* name,
                       bool required) {
    if (const Entry* entry = section.find(key))
      to.add(name, context_.quantity(*entry, unit), entry->where());
    else if (required)
      context_.refuse(section, fmt::format("has no {}", key), "write it");
  };
  if (part.time == Time::resistance) {
    auto& resistance = face(part).section("resistance", context_.source(part.entry, "Time_dependence"));
    add(part.entry, "Value", units.resistance, resistance, "resistance", true);
    if (context_.number(part.entry, "Distal_pressure").value_or(0) != 0)
      context_.remarks.dropped.push_back(part.entry.find("Distal_pressure")->where() +
                                         ": has no effect with Resistance");
    return;
  }
  const Entry* values = part.entry.find("RCR_values");
  if (values == nullptr) return context_.refuse(part.entry, "has no RCR_values", "write them");
  auto& rcr = face(part).section("rcr", context_.source(part.entry, "Time_dependence"));
  add(*values, "Proximal_resistance", units.resistance, rcr, "proximal", true);
  add(*values, "Capacitance", units.compliance, rcr, "capacitance", true);
  add(*values, "Distal_resistance", units.resistance, rcr, "distal", true);
  add(*values, "Distal_pressure", units.pressure, rcr, "distal_pressure", false);
  if (values->find("Distal_pressure") == nullptr)
    context_.defaulted(*values, "Distal_pressure", "0, the default of both");
  add(*values, "Initial_pressure", units.pressure, rcr, "initial_pressure", false);
  if (values->find("Initial_pressure") == nullptr) {
    rcr.add("initial_pressure", with_unit(0.0, units.pressure), fmt::format("the default of {}", context_.peer()));
    context_.defaulted(*values, "Initial_pressure", fmt::format("0, the default of {}", context_.peer()));
  }
}

void Conditions::zerod_outlet(const Part& part) {
  const Entry* interface = problem_.main->find("svZeroDSolver_interface");
  const Entry* coupling = part.entry.find("Coupling_interface");
  const Entry* block = coupling == nullptr ? nullptr : coupling->find("svZeroDSolver_block");
  const Entry* configuration = interface == nullptr ? nullptr : interface->find("Configuration_file");
  if (configuration == nullptr || block == nullptr)
    return context_.missing(part.entry, "a zero-dimensional model of another program (Time_dependence Coupled)",
                            "use RCR or Resistance");
  if (part.type != Type::neumann)
    return context_.missing(part.entry, "a flow that a zero-dimensional model gives", "couple the outlet as Neu");
  try {
    const ZeroDOutlet outlet = read_zerod_outlet(context_.located(*configuration), block->value);
    const UnitSystem& units = context_.units;
    const std::string where = configuration->where() + ": " + outlet.name;
    if (outlet.rcr) {
      auto& rcr = face(part).section("rcr", block->where());
      rcr.add("proximal", with_unit(outlet.proximal, units.resistance), where + " Rp");
      rcr.add("capacitance", with_unit(outlet.capacitance, units.compliance), where + " C");
      rcr.add("distal", with_unit(outlet.distal, units.resistance), where + " Rd");
      rcr.add("distal_pressure", with_unit(outlet.distal_pressure, units.pressure), where + " Pd");
      const Entry* initial = interface->find("Initial_pressures");
      rcr.add("initial_pressure",
              with_unit(context_.number(*interface, "Initial_pressures").value_or(0), units.pressure),
              initial != nullptr ? initial->where() : fmt::format("the default of {}", context_.peer()));
    } else {
      auto& resistance = face(part).section("resistance", block->where());
      resistance.add("resistance", with_unit(outlet.proximal, units.resistance), where + " R");
      resistance.add("distal_pressure", with_unit(outlet.distal_pressure, units.pressure), where + " Pd");
    }
  } catch (const InputError& error) {
    for (const Problem& p : error.problems())
      context_.problems.push_back({part.entry.where() + ": " + p.where, p.what, p.remedy});
  }
}

// --- wall ---------------------------------------------------------------------------------------------------------

void Conditions::wall_motion(const Part& part) {
  if (!part.vanishes()) {
    const char* key = part.time == Time::unsteady ? "Time_dependence" : "Value";
    const Entry* entry = part.entry.find(key);
    return context_.missing(entry != nullptr ? *entry : part.entry,
                            "a face of the wall whose displacement is given and is not zero",
                            "load the face by a pressure or a traction, or hold it still");
  }
  auto& fixed = face(part).section("fixed", context_.source(part.entry, "Type"));
  const auto held = axes(part);
  std::string names;
  for (const int axis : held) names += fmt::format("{}{}", names.empty() ? "" : ", ", "xyz"[axis]);
  fixed.add("directions", held.empty() ? "all" : "[" + names + "]",
            context_.source(part.entry, "Effective_direction", context_.source(part.entry, "Value")));
}

void Conditions::wall_pressure(const Part& part) {
  check_load(part);
  if (part.vanishes()) {
    boundary_.add(part.entry.label, "free", part.entry.where() + ": Neu 0");
    return;
  }
  auto& pressure = face(part).section("pressure", part.entry.find("Type")->where());
  course(part, context_.units.pressure, pressure);
  // On the equation FSI loads act on the mesh as the last step has left it, whatever the key says.
  const bool follows = problem_.coupled() || context_.flag(part.entry, "Follower_pressure_load");
  pressure.add("follower", follows ? "true" : "false",
               problem_.coupled() ? "FSI: the load acts on the moved face"
                                  : context_.source(part.entry, "Follower_pressure_load", "false by default"));
  if (problem_.coupled())
    context_.changed(part.entry, fmt::format("the load acts on the face of the present step, in {} on that of the step "
                                             "before",
                                             context_.peer()));
}

void Conditions::traction(const Part& part) {
  if (part.time != Time::steady)
    return context_.missing(part.entry, "a traction whose components have time courses of their own",
                            "give a steady traction");
  check_load(part);
  std::vector<double> value = part.value;
  if (value.size() == 1) {
    value.assign(3, value[0]);
    if (value[0] != 0)
      context_.changed(part.entry,
                       fmt::format("the one Value is that of all three components, as {} takes it", context_.peer()));
  }
  if (value.size() != 3)
    return context_.refuse(part.entry, fmt::format("has a Value of {} components", value.size()), "give three");
  face(part)
      .section("traction", part.entry.find("Type")->where())
      .add("value",
           fmt::format("[{}, {}, {}]", with_unit(value[0], context_.units.pressure),
                       with_unit(value[1], context_.units.pressure), with_unit(value[2], context_.units.pressure)),
           context_.source(part.entry, "Value"));
}

void Conditions::support(const Part& part) {
  if (part.time != Time::steady)
    return context_.missing(part.entry, "elastic support with a load that changes in time", "give a steady load");
  check_load(part);
  auto& support = face(part).section("support", part.entry.find("Type")->where());
  const UnitSystem& units = context_.units;
  constexpr const char* names[2][2] = {{"Stiffness", "stiffness"}, {"Damping", "damping"}};
  const char* unit[] = {units.stiffness_per_area, units.damping_per_area};
  const Entry* file = part.entry.find("Spatial_values_file_path");
  for (int i = 0; i < 2; ++i) {
    const Entry* entry = part.entry.find(names[i][0]);
    if (file != nullptr) {
      auto& array = support.section(names[i][1], file->where()).section("array", "");
      array.add("name", names[i][0], fmt::format("the name that {} reads", context_.peer()));
      array.add("unit", unit[i], fmt::format("--units {}", units.name));
      array.add("file", context_.path(*file), file->where());
    } else if (entry != nullptr) {
      support.add(names[i][1], context_.quantity(*entry, unit[i]), entry->where());
    } else {
      support.add(names[i][1], with_unit(0.0, unit[i]), fmt::format("not written; {} would take 1", context_.peer()));
      context_.defaulted(part.entry, names[i][0], fmt::format("0; {} would take 1", context_.peer()));
    }
  }
  if (const Entry* value = part.entry.find("Value"); value != nullptr && part.scalar() != 0)
    support.add("pressure", with_unit(part.scalar(), units.pressure), value->where());
  const bool normal = context_.flag(part.entry, "Apply_along_normal_direction");
  support.add("direction", normal ? "normal" : "full",
              context_.source(part.entry, "Apply_along_normal_direction", "full by default"));
}

// --- all faces ----------------------------------------------------------------------------------------------------

void Conditions::refuse_second(const Entry& condition) {
  for (const Entry* other : done_)
    if (other->label == condition.label)
      return context_.missing(
          condition,
          fmt::format("a second condition on the face {} beside that of line {}", condition.label, other->line),
          "keep one of them, or split the face");
}

void Conditions::translate(const Entry& condition) {
  const FacePart* found = problem_.face(condition.label);
  if (found == nullptr)
    return context_.refuse(condition,
                           fmt::format("names the face `{}`, which no mesh has", text::printable(condition.label)),
                           "name a face of Add_face");
  refuse_second(condition);
  done_.push_back(&condition);
  const auto type = type_of(context_, condition);
  const auto time = time_of(context_, condition);
  if (!type || !time) return;
  if (found->interface != nullptr)
    return context_.missing(condition, "a condition on the interface of blood and wall", "remove it");
  const std::string profile = context_.text(condition, "Profile", "Flat");
  if (profile != "Flat" && profile != "Parabolic") {
    if (profile != "User_defined")
      context_.refuse(*condition.find("Profile"),
                      fmt::format("is `{}`, which {} does not have", text::printable(profile), context_.peer()),
                      "write Flat or Parabolic");
    else if (condition.find("Spatial_profile_file_path") == nullptr)
      context_.missing(*condition.find("Profile"), "a profile given node by node", "write Flat or Parabolic");
    return;
  }
  const Part part{condition, *found, *type, *time, context_.vector(condition, "Value")};
  if (part.value.size() > 1 && part.type != Type::traction)
    return context_.refuse(*condition.find("Value"), fmt::format("has {} components", part.value.size()),
                           "write one number; Effective_direction says along which axes");
  const bool blood = found->lumen, outlets = part.time != Time::steady && part.time != Time::unsteady;
  if (part.time == Time::coupled)
    return blood
               ? zerod_outlet(part)
               : context_.missing(condition, "a wall that is loaded by a zero-dimensional model", "give the pressure");
  if (outlets && (!blood || part.type != Type::neumann))
    return context_.refuse(*condition.find("Time_dependence"), "is for Neu conditions of the blood", "write Steady");
  if (outlets) return outlet(part);
  switch (part.type) {
    case Type::dirichlet:
      return blood ? lumen_velocity(part) : wall_motion(part);
    case Type::neumann:
      return blood ? lumen_pressure(part) : wall_pressure(part);
    case Type::traction:
      return traction(part);
    case Type::robin:
      if (blood) return context_.refuse(*condition.find("Type"), "is for walls", "choose another type");
      return support(part);
  }
}

void Conditions::natural(const FacePart& part) {
  const std::string source = part.face->where() + " " + part.face->label + ": no Add_BC, so natural";
  if (part.lumen)
    boundary_.section(part.face->label, source).add("pressure", with_unit(0.0, context_.units.pressure), "");
  else
    boundary_.add(part.face->label, "free", source);
  context_.remarks.defaults.push_back(
      fmt::format("{} {} has no Add_BC: {}", part.face->where(), part.face->label, part.lumen ? "pressure 0" : "free"));
}

/// The mesh of the blood follows the wall and slides in openings.
void Conditions::check_mesh_equation() {
  if (problem_.mesh_motion == nullptr) return;
  for (const Entry* condition : problem_.mesh_motion->all("Add_BC")) {
    const bool zero = context_.text(*condition, "Time_dependence", "Steady") == "Steady" &&
                      context_.number(*condition, "Value").value_or(0) == 0;
    const std::string type = context_.text(*condition, "Type");
    if (!zero || (type != "Dir" && type != "Dirichlet"))
      context_.missing(*condition, "a mesh whose motion is given at a face", "write Dir 0, or remove the condition");
    else
      context_.changed(*condition, fmt::format("the nodes of {} slide in its plane where the wall moves, in the place "
                                               "of being held",
                                               condition->label));
  }
}

void Conditions::translate() {
  for (const Entry* condition : problem_.main->all("Add_BC")) translate(*condition);
  check_mesh_equation();
  for (const FacePart& part : problem_.faces)
    if (part.interface == nullptr && std::none_of(done_.begin(), done_.end(), [&](const Entry* condition) {
          return condition->label == part.face->label;
        }))
      natural(part);
  for (const bool lumen : {true, false})
    if (lumen ? context_.leftover.lumen : context_.leftover.wall) {
      const std::string source = "boundary that no Add_face names: natural";
      if (lumen)
        boundary_.section(rest_face(lumen), source).add("pressure", with_unit(0.0, context_.units.pressure), "");
      else
        boundary_.add(rest_face(lumen), "free", source);
    }
}

}  // namespace

void translate_conditions(Context& context, const PosedProblem& problem, CaseKey& top) {
  Conditions(context, problem, top.section("boundary", "")).translate();
}

}  // namespace tunica::peer_cases
