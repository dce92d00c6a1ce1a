// boundary: all faces.
#include <fmt/format.h>

#include <algorithm>

#include "tunica/base/text.hpp"
#include "tunica/peer_cases/conditions.hpp"
#include "tunica/peer_cases/svsolver_files.hpp"
#include "tunica/peer_cases/values.hpp"

namespace tunica::peer_cases {

namespace {

std::optional<ConditionType> type_of(Context& context, const Entry& condition) {
  const Entry* type = condition.find("Type");
  if (type == nullptr) {
    context.refuse(condition, "has no Type", "write Dir, Neu, Trac or Robin");
    return std::nullopt;
  }
  const std::string& name = type->value;
  if (name == "Dirichlet" || name == "Dir") return ConditionType::dirichlet;
  if (name == "Neumann" || name == "Neu") return ConditionType::neumann;
  if (name == "Traction" || name == "Trac") return ConditionType::traction;
  if (name == "Robin" || name == "Rbn") return ConditionType::robin;
  if (name == "CMM" || name == "Coupled Momentum")
    context.missing(*type, "the coupled momentum method", "give the wall a mesh and the equation FSI");
  else if (name == "RIS0D")
    context.missing(*type, "valves as resistive surfaces", "remove the condition");
  else
    context.refuse(*type, fmt::format("is `{}`, which {} does not have", text::printable(name), context.peer()),
                   "write Dir, Neu, Trac or Robin");
  return std::nullopt;
}

std::optional<Dependence> time_of(Context& context, const Entry& condition) {
  const std::string name = context.text(condition, "Time_dependence", "Steady");
  if (name == "Steady") return Dependence::steady;
  if (name == "Unsteady") return Dependence::unsteady;
  if (name == "Spatial") return Dependence::spatial;
  if (name == "Resistance") return Dependence::resistance;
  if (name == "RCR" || name == "Windkessel") return Dependence::rcr;
  if (name == "Coupled") return Dependence::coupled;
  if (name == "General") return Dependence::general;
  context.refuse(*condition.find("Time_dependence"),
                 fmt::format("is `{}`, which {} does not have", text::printable(name), context.peer()),
                 "write Steady, Unsteady, Spatial, General, Resistance, RCR or Coupled");
  return std::nullopt;
}

}  // namespace

std::string names_of(const std::vector<int>& axes) {
  std::string names;
  for (const int axis : axes) names += fmt::format("{}{}", names.empty() ? "" : ", ", "xyz"[axis]);
  return "[" + names + "]";
}

std::string along_axes(const std::vector<int>& axes, const std::string& size, const std::string& zero) {
  std::string value;
  for (int axis = 0; axis < 3; ++axis)
    value += (axis == 0 ? "" : ", ") + (std::find(axes.begin(), axes.end(), axis) != axes.end() ? size : zero);
  return "[" + value + "]";
}

// --- time courses -------------------------------------------------------------------------------------------------

std::string Conditions::file_of(const Entry& file) {
  if (context_.file.dialect == Dialect::xml && holds_fortran_exponents(context_.located(file)))
    context_.refuse(file, "holds numbers such as 1.5D-4, of which svMultiPhysics reads 1.5", "write 1.5e-4");
  return context_.path(file);
}

bool Conditions::table(const ConditionPart& part, const char* unit, CaseKey& to) {
  const Entry* values = part.entry.find("Temporal_values_file_path");
  const Entry* file = values != nullptr ? values : part.entry.find("Fourier_coefficients_file_path");
  if (file == nullptr) {
    context_.refuse(part.entry, "is Unsteady without a file",
                    "give Temporal_values_file_path or Fourier_coefficients_file_path");
    return false;
  }
  const bool ramp = values != nullptr && context_.flag(part.entry, "Ramp_function");
  const std::string where = file->where();
  auto& table = to.section("table", where);
  table.add("file", file_of(*file), where);
  table.add("format", values != nullptr ? "simvascular" : "fourier", where);
  table.add("time_unit", "s", "");
  if (*unit != '\0') table.add("unit", unit, fmt::format("--units {}", context_.units.name));
  if (ramp) {
    table.add("interpolation", "ramp", context_.source(part.entry, "Ramp_function"));
  } else if (values != nullptr) {
    table.add("interpolation", "fourier",
              fmt::format("as {} reads tables, with the modes of the file", context_.peer()));
    if (const Entry* period = part.entry.find(bct_period))
      table.add("period", context_.quantity(*period, "s"), period->where());
    if (const Entry* modes = part.entry.find(bct_modes))
      table.add("modes", context_.quantity(*modes, ""), modes->where());
    else
      table.add("trend", "true", "the table need not close");
  }
  return true;
}

void Conditions::course(const ConditionPart& part, const char* unit, CaseKey& to) {
  if (part.time == Dependence::unsteady) {
    table(part, unit, to);
    return;
  }
  const Entry* value = part.entry.find("Value");
  if (value == nullptr) context_.defaulted(part.entry, "Value", fmt::format("0, the default of {}", context_.peer()));
  to.add("value", with_unit(part.scalar(), unit),
         value != nullptr ? value->where() : fmt::format("the default of {}", context_.peer()));
}

std::vector<int> Conditions::axes(const Entry& condition) const {
  const auto direction = context_.vector(condition, "Effective_direction");
  std::vector<int> axes;
  for (std::size_t i = 0; i < direction.size() && i < 3; ++i)
    if (direction[i] != 0) axes.push_back(static_cast<int>(i));
  return axes.size() == 3 ? std::vector<int>() : axes;
}

// --- all faces ----------------------------------------------------------------------------------------------------

const Entry* Conditions::held_beside(const Entry& load) const {
  const std::string type = context_.text(load, "Type");
  const FacePart* found = problem_.face(load.label);
  const bool motion = type.starts_with("Dir");
  if (found == nullptr || found->lumen || !(type.starts_with("Neu") || type.starts_with("Trac") || motion))
    return nullptr;
  std::vector<const Entry*> others;
  for (const Entry* other : problem_.main->all("Add_BC"))
    if (other->label == load.label && other != &load) others.push_back(other);
  if (others.size() != 1) return nullptr;
  const Entry& other = *others[0];
  const auto at_rest = [&](const Entry& c) {
    return context_.text(c, "Type").starts_with("Dir") && !axes(c).empty() &&
           context_.text(c, "Time_dependence", "Steady") == "Steady" && context_.number(c, "Value").value_or(0) == 0;
  };
  if (!at_rest(other)) return nullptr;
  if (!motion) return &other;
  // Of two that hold the face the first one brings the other along.
  if (axes(load).empty() || (at_rest(load) && &load > &other)) return nullptr;
  const auto along = axes(load), across = axes(other);
  const bool apart = std::none_of(across.begin(), across.end(),
                                  [&](int axis) { return std::find(along.begin(), along.end(), axis) != along.end(); });
  return apart ? &other : nullptr;
}

void Conditions::refuse_second(const Entry& condition) {
  for (const Entry* other : done_)
    if (other->label == condition.label)
      return context_.missing(
          condition,
          fmt::format("a second condition on the face {} beside that of line {}", condition.label, other->line),
          "keep one of them, or split the face; a load or a motion goes with Dir 0 along other axes");
}

std::optional<ConditionPart> Conditions::part_of(const Entry& condition) {
  const FacePart* found = problem_.face(condition.label);
  if (found == nullptr) {
    context_.refuse(condition, fmt::format("names the face `{}`, which no mesh has", text::printable(condition.label)),
                    "name a face of Add_face");
    return std::nullopt;
  }
  const auto all = problem_.main->all("Add_BC");
  if (std::any_of(all.begin(), all.end(), [&](const Entry* load) { return held_beside(*load) == &condition; }))
    return std::nullopt;  // the load brings it along
  refuse_second(condition);
  done_.push_back(&condition);
  const auto type = type_of(context_, condition);
  const auto time = time_of(context_, condition);
  if (!type || !time) return std::nullopt;
  if (found->interface != nullptr) {
    context_.missing(condition, "a condition on the interface of blood and wall", "remove it");
    return std::nullopt;
  }
  ConditionPart part{condition, *found, *type, *time, {}, held_beside(condition)};
  const bool by_nodes = *type == ConditionType::traction && condition.peek("Traction_values_file_path") != nullptr;
  if (*time == Dependence::steady && !by_nodes) part.value = context_.vector(condition, "Value");
  return part;
}

void Conditions::translate(const Entry& condition) {
  const auto part = part_of(condition);
  if (!part) return;
  const Entry* named = condition.peek("Profile");
  const std::string profile = named == nullptr ? "Flat" : named->value;
  if (profile != "Flat" && profile != "Parabolic") {
    const Entry& entry = *named;
    if (profile != "User_defined")
      return context_.refuse(entry,
                             fmt::format("is `{}`, which {} does not have", text::printable(profile), context_.peer()),
                             "write Flat, Parabolic or User_defined");
    if (part->type == ConditionType::traction || part->type == ConditionType::robin)
      return context_.missing(entry, "a support or a traction with a profile given node by node", "write Flat");
    if (condition.find("Spatial_profile_file_path") == nullptr)
      return context_.refuse(entry, "is User_defined without a file", "give Spatial_profile_file_path");
  }
  if (part->value.size() > 1 && part->type != ConditionType::traction)
    return context_.refuse(*condition.find("Value"), fmt::format("has {} components", part->value.size()),
                           "write one number; Effective_direction says along which axes");
  warn_of_idle_course(*part);
  translate(*part);
}

/// A condition that looks as if it changed in time, and does not: most of all an inlet that becomes a wall by it.
void Conditions::warn_of_idle_course(const ConditionPart& part) {
  if (part.time != Dependence::steady) return;
  const bool inlet = part.face.lumen && part.type == ConditionType::dirichlet;
  const std::string result = inlet && part.vanishes() ? ", so that the face is a wall that blood does not pass" : "";
  for (const char* key : {"Temporal_values_file_path", "Fourier_coefficients_file_path",
                          "Temporal_and_spatial_values_file_path", "Bct_file_path"})
    if (const Entry* file = part.entry.peek(key)) {
      context_.warnings.push_back(fmt::format(
          "{}: has no effect on {}, whose Time_dependence is Steady{}; write {} for a condition in time", file->where(),
          part.entry.label, result,
          std::string_view(key).starts_with("Temporal_v") || std::string_view(key).starts_with("F") ? "Unsteady"
                                                                                                    : "General"));
      return;
    }
  if (inlet && part.entry.peek("Value") == nullptr)
    context_.warnings.push_back(fmt::format("{}: {} has no Value, which {} takes for 0{}", part.entry.where(),
                                            part.entry.label, context_.peer(), result));
}

void Conditions::translate(const ConditionPart& part) {
  const bool blood = part.face.lumen;
  const bool outlets = part.time == Dependence::resistance || part.time == Dependence::rcr;
  if (part.time == Dependence::coupled)
    return blood
               ? zerod_outlet(part)
               : context_.missing(part.entry, "a wall that is loaded by a zero-dimensional model", "give the pressure");
  if (part.time == Dependence::spatial) return pressure_by_nodes(part);
  if (part.time == Dependence::general) {
    if (part.type == ConditionType::dirichlet) return blood ? lumen_velocity_in_time(part) : wall_motion(part);
    if (part.type == ConditionType::neumann) return pressure_by_nodes(part);
    if (part.type == ConditionType::robin)
      return context_.missing(*part.entry.find("Time_dependence"),
                              "elastic support with a load given node by node and instant by instant",
                              "give a steady load");
    if (part.entry.find("Traction_values_file_path") != nullptr) return traction(part);
    if (const Entry* file = file_in_time(part)) return traction_by_nodes(part, *file);
    return;
  }
  if (outlets && (!blood || part.type != ConditionType::neumann))
    return context_.refuse(*part.entry.find("Time_dependence"), "is for Neu conditions of the blood", "write Steady");
  if (outlets) return outlet(part);
  switch (part.type) {
    case ConditionType::dirichlet:
      return blood ? lumen_velocity(part) : wall_motion(part);
    case ConditionType::neumann:
      return blood ? lumen_pressure(part) : wall_pressure(part);
    case ConditionType::traction:
      return traction(part);
    case ConditionType::robin:
      if (blood) return context_.refuse(*part.entry.find("Type"), "is for walls", "choose another type");
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
    if (lumen ? context_.findings.lumen_rest : context_.findings.wall_rest) {
      const std::string source = "boundary that no Add_face names: natural";
      if (lumen)
        boundary_.section(rest_face(lumen), source).add("pressure", with_unit(0.0, context_.units.pressure), "");
      else
        boundary_.add(rest_face(lumen), "free", source);
    }
}

void translate_conditions(Context& context, const PosedProblem& problem, CaseKey& top) {
  Conditions(context, problem, top.section("boundary", "")).translate();
}

}  // namespace tunica::peer_cases
