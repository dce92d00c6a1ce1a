// boundary: faces of the wall, and tractions of both.
#include <fmt/format.h>

#include "tunica/peer_cases/conditions.hpp"
#include "tunica/peer_cases/values.hpp"

namespace tunica::peer_cases {

namespace {

constexpr const char* text_in_time = "give Temporal_and_spatial_values_file_path";

}  // namespace

void Conditions::wall_motion(const ConditionPart& part) {
  const auto held = axes(part.entry);
  const std::string directions = held.empty() ? "all" : names_of(with_held(part)),
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
  const bool whole = profile_is(part, "Flat") && !context_.flag(part.entry, "Impose_flux") && !held.empty() &&
                     !context_.flag(part.entry, "Zero_out_perimeter", true);
  if (part.time == Dependence::general || !whole) return moved_by_nodes(part);
  // One number, that of all axes that are given.
  const bool unsteady = part.time == Dependence::unsteady;
  const std::string size = with_unit(unsteady ? 1.0 : part.scalar(), context_.units.length);
  auto& moved = face(part).section("displacement", context_.source(part.entry, "Type"));
  moved.add("value", along_axes(held, size, with_unit(0.0, context_.units.length)),
            context_.source(part.entry, unsteady ? "Temporal_values_file_path" : "Value"));
  moved.add("directions", directions, source);
  if (unsteady) table(part, "", moved.section("waveform", part.entry.where()));
}

/// The axes of a motion, and those along which another condition holds the face.
std::vector<int> Conditions::with_held(const ConditionPart& part) const {
  std::vector<int> all = axes(part.entry);
  if (part.held != nullptr)
    for (const int axis : axes(*part.held)) all.push_back(axis);
  std::sort(all.begin(), all.end());
  return all;
}

/// Along the normals of the nodes where no axes are given, and zero at the rim unless that is switched off.
void Conditions::moved_by_nodes(const ConditionPart& part) {
  const auto held = axes(part.entry);
  auto& moved = face(part).section("displacement", context_.source(part.entry, "Type"));
  NodalValues values{.kind = NodalValues::Kind::in_time, .where = part.entry.where()};
  if (part.time == Dependence::general) {
    const Entry* file = file_in_time(part);
    if (file == nullptr) return;
    if (file->key == "Bct_file_path") return context_.refuse(*file, "is for velocities of the blood", text_in_time);
    values.file = context_.located(*file);
    values.where = file->where();
  } else {
    values = shape_of(part, true);
    if (held.empty())
      context_.changed(part.entry, fmt::format("the nodes move along their normals in the undeformed shape, as in {}",
                                               context_.peer()));
  }
  values.quantity = NodalValues::Quantity::displacement;
  values.axes = held;
  nodal_table(part, "displacements", "m", std::move(values), moved.section("over_face", part.entry.where()));
  if (!held.empty())
    moved.add("directions", names_of(with_held(part)), context_.source(part.entry, "Effective_direction"));
  if (part.time != Dependence::general) course(part, "", moved.section("waveform", part.entry.where()));
}

void Conditions::lay_on_wall(const ConditionPart& part, CaseKey& pressure) {
  // On the equation FSI loads act on the mesh as the last step has left it, whatever the key says.
  const bool follows = problem_.coupled() || context_.flag(part.entry, "Follower_pressure_load");
  pressure.add("follower", follows ? "true" : "false",
               problem_.coupled() ? "FSI: the load acts on the moved face"
                                  : context_.source(part.entry, "Follower_pressure_load", "false by default"));
  add_held(part, pressure);
  if (problem_.coupled())
    context_.changed(part.entry, fmt::format("the load acts on the face of the present step, in {} on that of the step "
                                             "before",
                                             context_.peer()));
}

/// Axes along which the face does not move under its load.
void Conditions::add_held(const ConditionPart& part, CaseKey& load) {
  if (part.held != nullptr) load.add("fixed", names_of(axes(*part.held)), part.held->where() + ": Dir 0 beside it");
}

void Conditions::wall_pressure(const ConditionPart& part) {
  const Entry* undeforming = part.entry.find("Undeforming_neu_face");
  if (undeforming != nullptr && !context_.flag(part.entry, undeforming->key)) undeforming = nullptr;
  if (part.vanishes() && part.held == nullptr && undeforming == nullptr) {
    boundary_.add(part.entry.label, "free", part.entry.where() + ": Neu 0");
    return;
  }
  auto& pressure = face(part).section("pressure", part.entry.find("Type")->where());
  course(part, context_.units.pressure, pressure);
  lay_on_wall(part, pressure);
  if (undeforming != nullptr) pressure.add("undeforming", "true", undeforming->where());
  if (!has_shape(part)) return;
  if (undeforming != nullptr)
    return context_.changed(
        part.entry, fmt::format("the profile is left out with Undeforming_neu_face, as in {}", context_.peer()));
  auto shape = shape_of(part, false);
  shape.quantity = NodalValues::Quantity::factor;
  nodal_table(part, "factors", "", std::move(shape), pressure.section("over_face", part.entry.where()));
}

/// Pressures that differ from node to node, of blood or wall.
void Conditions::pressure_by_nodes(const ConditionPart& part) {
  const bool general = part.time == Dependence::general;
  const Entry& time = *part.entry.find("Time_dependence");
  if (part.type != ConditionType::neumann) return context_.refuse(time, "is for Neu conditions", "write Steady");
  const Entry* file = general ? file_in_time(part) : part.entry.find("Spatial_values_file_path");
  if (file == nullptr) {
    if (!general) context_.refuse(part.entry, "is Spatial without a file", "give Spatial_values_file_path");
    return;
  }
  if (file->key == "Bct_file_path") return context_.refuse(*file, "is for velocities of the blood", text_in_time);
  if (!general) context_.path(*file);  // warns when it is not there
  auto& pressure = face(part).section("pressure", part.entry.find("Type")->where());
  pressure.add("value", with_unit(1.0, context_.units.pressure), "the factors have the numbers of the file");
  if (!part.face.lumen) lay_on_wall(part, pressure);
  NodalValues values{.kind = general ? NodalValues::Kind::in_time : NodalValues::Kind::pressure,
                     .quantity = NodalValues::Quantity::factor,
                     .file = context_.located(*file),
                     .where = file->where()};
  if (general) {
    values.scale = -1.0;
    context_.changed(*file,
                     fmt::format("the numbers are tractions along the outward normal, as {} takes those of General "
                                 "(but not those of Steady and Unsteady): pressures of the other sign",
                                 context_.peer()));
  }
  nodal_table(part, "pressures", "", std::move(values), pressure.section("over_face", file->where()));
}

void Conditions::traction(const ConditionPart& part) {
  // The file counts alone, whatever else the condition says.
  if (const Entry* file = part.entry.find("Traction_values_file_path")) return traction_by_nodes(part, *file);
  if (part.time == Dependence::unsteady) return traction_in_time(part);
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

void Conditions::traction_by_nodes(const ConditionPart& part, const Entry& file) {
  NodalValues values{.kind = NodalValues::Kind::traction,
                     .quantity = NodalValues::Quantity::traction,
                     .file = context_.located(file),
                     .where = file.where()};
  if (file.key != "Traction_values_file_path")
    values.kind = NodalValues::Kind::in_time;
  else {
    context_.path(file);  // warns when it is not there
    values.scale = context_.number(part.entry, "Traction_multiplier").value_or(1.0);
  }
  auto& traction = face(part).section("traction", part.entry.find("Type")->where());
  nodal_table(part, "tractions", "Pa", std::move(values), traction.section("over_face", file.where()));
  add_held(part, traction);
}

/// Three components of which each has a course of its own.
void Conditions::traction_in_time(const ConditionPart& part) {
  const Entry* in_points = part.entry.find("Temporal_values_file_path");
  const Entry* file = in_points != nullptr ? in_points : part.entry.find("Fourier_coefficients_file_path");
  if (file == nullptr)
    return context_.refuse(part.entry, "is Unsteady without a file",
                           "give Temporal_values_file_path or Fourier_coefficients_file_path");
  file_of(*file);  // warns when it is not there
  const Entry* general = context_.file.root.find("GeneralSimulationParameters");
  const Entry& times = general != nullptr ? *general : context_.file.root;
  auto& traction = face(part).section("traction", part.entry.find("Type")->where());
  NodalValues values{.kind = NodalValues::Kind::course,
                     .quantity = NodalValues::Quantity::traction,
                     .file = context_.located(*file),
                     .where = file->where(),
                     .coefficients = in_points == nullptr,
                     .ramp = in_points != nullptr && context_.flag(part.entry, "Ramp_function"),
                     .step = context_.number(times, "Time_step_size").value_or(0),
                     .steps = static_cast<std::size_t>(context_.number(times, "Number_of_time_steps").value_or(0))};
  if (!values.ramp)
    context_.changed(*file,
                     "the Fourier series of the components is written for the ends of the steps of this case; "
                     "a longer run goes on with the last of them");
  nodal_table(part, "tractions", "Pa", std::move(values), traction.section("over_face", file->where()));
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
    if (file != nullptr) {
      auto& array = support.section(names[i][1], file->where()).section("array", "");
      array.add("name", names[i][0], fmt::format("the name that {} reads", context_.peer()));
      array.add("unit", unit[i], fmt::format("--units {}", units.name));
      array.add("file", context_.path(*file), file->where());
    } else if (const Entry* entry = part.entry.find(names[i][0])) {
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
