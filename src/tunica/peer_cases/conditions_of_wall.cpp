// boundary: faces of the wall, and tractions of both.
#include <fmt/format.h>

#include "tunica/peer_cases/conditions.hpp"
#include "tunica/peer_cases/values.hpp"

namespace tunica::peer_cases {

void Conditions::wall_motion(const ConditionPart& part) {
  const auto held = axes(part.entry);
  const std::string directions = held.empty() ? "all" : names_of(held),
                    source = context_.source(part.entry, "Effective_direction", part.entry.where());
  if (part.vanishes()) {
    face(part).section("fixed", context_.source(part.entry, "Type")).add("directions", directions, source);
    return;
  }
  const bool displacement =
      context_.flag(part.entry, "Impose_on_state_variable_integral", problem_.equation == Equation::structure);
  if (!displacement)
    return context_.missing(part.entry, "a face of the wall whose velocity is given",
                            "give its displacement: Impose_on_state_variable_integral true");
  if (!profile_is(part, "Flat"))
    return context_.missing(*part.entry.find("Profile"), "a displacement with a profile over the face",
                            "remove Profile");
  if (context_.flag(part.entry, "Zero_out_perimeter", true))
    return context_.missing(
        part.entry,
        fmt::format("a face that is moved while its rim stays, which {} takes without Zero_out_perimeter",
                    context_.peer()),
        "write Zero_out_perimeter false to move the whole face");
  if (context_.flag(part.entry, "Impose_flux"))
    return context_.missing(*part.entry.find("Impose_flux"), "a displacement given by its integral",
                            "give the displacement");
  // One number, that of all axes that are given.
  const bool unsteady = part.time == Dependence::unsteady;
  const std::string size = with_unit(unsteady ? 1.0 : part.scalar(), context_.units.length);
  std::string value;
  for (int axis = 0; axis < 3; ++axis) {
    const bool given = held.empty() || std::find(held.begin(), held.end(), axis) != held.end();
    value += fmt::format("{}{}", axis == 0 ? "" : ", ", given ? size : with_unit(0.0, context_.units.length));
  }
  auto& moved = face(part).section("displacement", context_.source(part.entry, "Type"));
  moved.add("value", "[" + value + "]", context_.source(part.entry, unsteady ? "Temporal_values_file_path" : "Value"));
  if (!held.empty()) moved.add("directions", directions, source);
  if (unsteady) table(part, "", moved.section("waveform", part.entry.where()));
}

/// Axes along which the face does not move under its load.
void Conditions::add_held(const ConditionPart& part, CaseKey& load) {
  if (part.held != nullptr) load.add("fixed", names_of(axes(*part.held)), part.held->where() + ": Dir 0 beside it");
}

void Conditions::wall_pressure(const ConditionPart& part) {
  check_load(part);
  const Entry* undeforming = part.entry.find("Undeforming_neu_face");
  if (undeforming != nullptr && !context_.flag(part.entry, undeforming->key)) undeforming = nullptr;
  if (part.vanishes() && part.held == nullptr && undeforming == nullptr) {
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
  add_held(part, pressure);
  if (undeforming != nullptr) pressure.add("undeforming", "true", undeforming->where());
  if (problem_.coupled())
    context_.changed(part.entry, fmt::format("the load acts on the face of the present step, in {} on that of the step "
                                             "before",
                                             context_.peer()));
}

/// A pressure that differs from node to node is that of surroundings without stiffness.
void Conditions::pressure_by_nodes(const ConditionPart& part) {
  const Entry* file = part.entry.find("Spatial_values_file_path");
  const Entry& time = *part.entry.find("Time_dependence");
  if (part.type != ConditionType::neumann) return context_.refuse(time, "is for Neu conditions", "write Steady");
  if (file == nullptr) return context_.refuse(part.entry, "is Spatial without a file", "give Spatial_values_file_path");
  if (part.face.lumen)
    return context_.missing(time, "blood whose pressure is given node by node", "use one Value for the face");
  if (part.held != nullptr)
    return context_.missing(*part.held, "a face that is held along some axes beside a load given node by node",
                            "use one Value for the face");
  check_load(part);
  auto& support = face(part).section("support", part.entry.find("Type")->where());
  support.add("stiffness", with_unit(0.0, context_.units.stiffness_per_area), "a load alone");
  auto& array = support.section("pressure", time.where()).section("array", "");
  array.add("name", "Pressure", fmt::format("the name that {} reads", context_.peer()));
  array.add("unit", context_.units.pressure, fmt::format("--units {}", context_.units.name));
  array.add("file", context_.path(*file), file->where());
  if (!problem_.coupled() && !context_.flag(part.entry, "Follower_pressure_load"))
    context_.changed(part.entry, "the load follows the moved face, as with Follower_pressure_load true");
}

void Conditions::traction(const ConditionPart& part) {
  if (part.time != Dependence::steady)
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
  auto& traction = face(part).section("traction", part.entry.find("Type")->where());
  traction.add("value",
               fmt::format("[{}, {}, {}]", with_unit(value[0], context_.units.pressure),
                           with_unit(value[1], context_.units.pressure), with_unit(value[2], context_.units.pressure)),
               context_.source(part.entry, "Value"));
  add_held(part, traction);
}

void Conditions::support(const ConditionPart& part) {
  if (part.time != Dependence::steady)
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

}  // namespace tunica::peer_cases
