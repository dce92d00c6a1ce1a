// boundary: faces of the blood.
#include <fmt/format.h>

#include "tunica/peer_cases/conditions.hpp"
#include "tunica/peer_cases/values.hpp"
#include "tunica/peer_cases/zerod_file.hpp"

namespace tunica::peer_cases {

void Conditions::lumen_velocity(const ConditionPart& part) {
  const auto held = axes(part.entry);
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
  if (const Entry* integral = part.entry.find("Impose_on_state_variable_integral");
      integral != nullptr && context_.flag(part.entry, integral->key))
    return context_.missing(*integral, "blood whose displacement is given", "give its velocity");
  if (!held.empty()) return lumen_velocity_along(part, held);
  const bool flux = context_.flag(part.entry, "Impose_flux");
  if (profile_is(part, "User_defined") || (profile_is(part, "Parabolic") && !flux))
    return lumen_velocity_of_shape(part);
  if (flux) return lumen_flow(part);
  auto& profile = face(part).section("profile", context_.source(part.entry, "Profile", "Flat by default"));
  const bool unsteady = part.time == Dependence::unsteady;
  const double into = unsteady ? -1.0 : -part.scalar();
  profile.add("speed", yaml_text(number_text(into)),
              unsteady ? "into the vessel, where the table has outward velocities"
                       : context_.source(part.entry, "Value") + ", into the vessel in the place of outward");
  profile.add("unit", context_.units.velocity, fmt::format("--units {}", context_.units.name));
  profile.add("length_unit", context_.units.length, "");
  if (unsteady) table(part, "", profile.section("waveform", part.entry.where()));
  context_.changed(part.entry, "the velocity is along the mean normal of the face, not along that of every node");
}

// Values node by node become a table of points in a file beside the case.
void Conditions::nodal_table(const ConditionPart& part, const std::string& name, const char* unit, NodalValues values,
                             CaseKey& table) {
  values.face = part.entry.label;
  values.table = part.entry.label + "_" + name + ".csv";
  values.wall = !part.face.lumen;
  table.add("table", yaml_text(values.table), values.where);
  if (*unit != '\0') table.add("unit", unit, "");
  table.add("length_unit", "m", "");
  table.add("interpolation", "nearest", "the points are the nodes");
  if (const auto period = context_.findings.periods.find(values.table); period != context_.findings.periods.end())
    table.add("period", with_unit(period->second, "s"),
              fmt::format("the last time, as {} repeats it", context_.peer()));
  context_.remarks.changed.push_back(values.where + ": the values at the nodes belong in the file " + values.table +
                                     ", which is written where mesh and values are there");
  context_.nodal.push_back(std::move(values));
}

const Entry* Conditions::file_in_time(const ConditionPart& part) {
  const Entry* bct = part.entry.find("Bct_file_path");
  const Entry* file = bct != nullptr ? bct : part.entry.find("Temporal_and_spatial_values_file_path");
  if (file == nullptr)
    context_.refuse(part.entry, "is General without a file",
                    "give Bct_file_path or Temporal_and_spatial_values_file_path");
  else
    context_.path(*file);  // warns when it is not there
  return file;
}

void Conditions::lumen_velocity_in_time(const ConditionPart& part) {
  const Entry* file = file_in_time(part);
  if (file == nullptr) return;
  const auto kind = file->key == "Bct_file_path" ? NodalValues::Kind::bct : NodalValues::Kind::in_time;
  const auto along = axes(part.entry);
  auto& profile = face(part).section("profile", part.entry.where());
  nodal_table(part, "velocities", "m/s",
              {.kind = kind, .file = context_.located(*file), .where = file->where(), .axes = along}, profile);
  add_directions(part, along, profile);
}

void Conditions::add_directions(const ConditionPart& part, const std::vector<int>& along, CaseKey& to) {
  if (!along.empty()) to.add("directions", names_of(along), context_.source(part.entry, "Effective_direction"));
}

/// The same number along each of the axes; along the others the blood is free.
void Conditions::lumen_velocity_along(const ConditionPart& part, const std::vector<int>& along) {
  const bool whole = profile_is(part, "Flat") && !context_.flag(part.entry, "Impose_flux") &&
                     !context_.flag(part.entry, "Zero_out_perimeter", true);
  if (!whole && !part.vanishes()) {
    auto shape = shape_of(part, true);
    shape.axes = along;
    auto& profile = face(part).section("profile", part.entry.where());
    nodal_table(part, "velocities", "m/s", std::move(shape), profile);
    add_directions(part, along, profile);
    return course(part, "", profile.section("waveform", part.entry.where()));
  }
  const bool unsteady = part.time == Dependence::unsteady;
  auto& velocity = face(part).section("velocity", context_.source(part.entry, "Type"));
  velocity.add("value",
               along_axes(along, with_unit(unsteady ? 1.0 : part.scalar(), context_.units.velocity),
                          with_unit(0.0, context_.units.velocity)),
               context_.source(part.entry, unsteady ? "Temporal_values_file_path" : "Value"));
  add_directions(part, along, velocity);
  if (unsteady) table(part, "", velocity.section("waveform", part.entry.where()));
}

NodalValues Conditions::shape_of(const ConditionPart& part, bool zero_rim) {
  NodalValues shape{.kind = NodalValues::Kind::flat,
                    .where = part.entry.where(),
                    .zero_rim = context_.flag(part.entry, "Zero_out_perimeter", zero_rim),
                    .unit_flow = context_.flag(part.entry, "Impose_flux")};
  if (profile_is(part, "Parabolic")) shape.kind = NodalValues::Kind::parabolic;
  if (profile_is(part, "User_defined")) {
    const Entry& file = *part.entry.find("Spatial_profile_file_path");
    context_.path(file);  // warns when it is not there
    shape.kind = NodalValues::Kind::user;
    shape.file = context_.located(file);
    shape.where = file.where();
    // solver.xml counts nodes from 0 here, .inp files from 1.
    shape.first_node = context_.file.dialect == Dialect::xml ? 0 : 1;
  }
  return shape;
}

bool Conditions::has_shape(const ConditionPart& part) const {
  return !part.vanishes() && (!profile_is(part, "Flat") || context_.flag(part.entry, "Impose_flux") ||
                              context_.flag(part.entry, "Zero_out_perimeter"));
}

void Conditions::lumen_velocity_of_shape(const ConditionPart& part) {
  auto& profile = face(part).section("profile", part.entry.where());
  nodal_table(part, "velocities", "m/s", shape_of(part, true), profile);
  course(part, "", profile.section("waveform", part.entry.where()));
}

void Conditions::lumen_flow(const ConditionPart& part) {
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

void Conditions::check_load(const ConditionPart& part) {
  if (!profile_is(part, "Flat"))
    context_.missing(*part.entry.find("Profile"), "a support or a traction with a profile over the face",
                     "remove Profile");
  if (context_.flag(part.entry, "Impose_flux"))
    context_.missing(*part.entry.find("Impose_flux"), "a support or a traction given by its force",
                     "give the load by its area");
  if (const Entry* rim = part.entry.find("Zero_out_perimeter");
      rim != nullptr && context_.flag(part.entry, rim->key) && !part.vanishes())
    context_.missing(*rim, "a support or a traction that vanishes on the rim of its face", "remove the key");
}

void Conditions::lumen_pressure(const ConditionPart& part) {
  if (const Entry* undeforming = part.entry.find("Undeforming_neu_face");
      undeforming != nullptr && context_.flag(part.entry, undeforming->key))
    return context_.refuse(*undeforming, "is for walls", "remove it");
  auto& pressure = face(part).section("pressure", part.entry.find("Type")->where());
  course(part, context_.units.pressure, pressure);
  if (!has_shape(part)) return;
  auto shape = shape_of(part, false);
  shape.quantity = NodalValues::Quantity::factor;
  nodal_table(part, "factors", "", std::move(shape), pressure.section("over_face", part.entry.where()));
}

void Conditions::outlet(const ConditionPart& part) {
  const UnitSystem& units = context_.units;
  const auto add = [&](const Entry& section, const char* key, const char* unit, CaseKey& to, const char* name,
                       bool required) {
    if (const Entry* entry = section.find(key))
      to.add(name, context_.quantity(*entry, unit), entry->where());
    else if (required)
      context_.refuse(section, fmt::format("has no {}", key), "write it");
  };
  if (part.time == Dependence::resistance) {
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
  if (const Entry* follow = problem_.main->find("Initialize_RCR_from_flow");
      follow != nullptr && context_.flag(*problem_.main, follow->key)) {
    if (const Entry* initial = values->find("Initial_pressure"))
      context_.remarks.dropped.push_back(initial->where() + ": has no effect with Initialize_RCR_from_flow");
    // Left out, it is what is left of the pressure of the start behind R_p Q.
    if (!context_.initial)
      rcr.add("initial_pressure", with_unit(0.0, units.pressure), follow->where() + ", at rest without a pressure");
    return;
  }
  add(*values, "Initial_pressure", units.pressure, rcr, "initial_pressure", false);
  if (values->find("Initial_pressure") == nullptr) {
    rcr.add("initial_pressure", with_unit(0.0, units.pressure), fmt::format("the default of {}", context_.peer()));
    context_.defaulted(*values, "Initial_pressure", fmt::format("0, the default of {}", context_.peer()));
  }
}

void Conditions::zerod_outlet(const ConditionPart& part) {
  const Entry* interface = problem_.main->find("svZeroDSolver_interface");
  const Entry* coupling = part.entry.find("Coupling_interface");
  const Entry* block = coupling == nullptr ? nullptr : coupling->find("svZeroDSolver_block");
  const Entry* configuration = interface == nullptr ? nullptr : interface->find("Configuration_file");
  if (configuration == nullptr || block == nullptr)
    return context_.missing(part.entry, "a zero-dimensional model of another program (Time_dependence Coupled)",
                            "use RCR or Resistance");
  if (part.type != ConditionType::neumann)
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

}  // namespace tunica::peer_cases
