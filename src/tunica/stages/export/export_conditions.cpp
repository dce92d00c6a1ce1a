// Conditions of the faces.
#include <algorithm>
#include <cmath>

#include "tunica/stages/export/exported.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::stages {

namespace dimension = config::dimension;
using peer_cases::add_key;
using peer_cases::add_section;
using peer_cases::Entry;

namespace {

constexpr int sampled_points = 513, sampled_modes = 192;

std::string vector_text(const std::array<double, 3>& v) {
  return fmt::format("({}, {}, {})", number(v[0]), number(v[1]), number(v[2]));
}

/// "(1, 1, 0)".
std::string directions(const bc::Axes& axes) {
  return vector_text({axes[0] ? 1.0 : 0.0, axes[1] ? 1.0 : 0.0, axes[2] ? 1.0 : 0.0});
}

/// The axis along which the face has its mean normal; -1: none.
int axis_of(const mesh::MeshData& data, const std::string& name) {
  Vec3<double> sum{};
  for (const auto& face : data.faces)
    for (const auto& t : face.triangles)
      if (face.name == name)
        sum = sum + cross(data.points[t[1]] - data.points[t[0]], data.points[t[2]] - data.points[t[0]]);
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(sum[axis]) > (1 - 1e-9) * norm(sum)) return axis;
  return -1;
}

constexpr const char* in_points = "a table of points, which this export does not write";

/// Writes the conditions of one face.
class FaceExport {
 public:
  FaceExport(Exported& exported, Entry& equation, const std::string& face)
      : e_(exported), equation_(equation), face_(face), where_("boundary." + face) {}

  void operator()(const bc::NoSlip&) { condition("Dir", "0"); }
  void operator()(const bc::Velocity&) {
    e_.missing(where_, "a velocity that is not along the normal of the face", "prescribe the flow");
  }
  void operator()(const bc::VelocityProfile&) {
    e_.missing(where_, "a velocity by formulas or points", "prescribe the flow");
  }
  void operator()(const bc::Flow& c) {
    Entry& entry = condition("Dir");
    course(entry, c.course, bc::inflow(c), -1 / factor(e_.units.flow, dimension::volume_flow));
    add_key(entry, "Profile", c.profile == bc::Profile::parabolic ? "Parabolic" : "Flat");
    add_key(entry, "Impose_flux", "true");
    add_key(entry, "Zero_out_perimeter", "true");
    if (c.profile == bc::Profile::parabolic)
      e_.change(where_, "on an opening that is not round the profile differs; the flow is the same");
  }
  void operator()(const bc::Pressure& c) {
    if (c.over_face) return e_.missing(where_ + ".pressure.over_face", in_points, "give one value");
    Entry& entry = condition("Neu");
    course(entry, c.pressure, bc::make_waveform(c.pressure), 1 / factor(e_.units.pressure, dimension::pressure));
    if (!on_wall()) return;
    add_key(entry, "Follower_pressure_load", c.follower ? "true" : "false");
    if (c.undeforming) {
      if (e_.c.solves_fluid() || e_.c.wall->element != wall::Element::mixed)
        return e_.missing(where_ + ".pressure.undeforming", "a face that moves as a whole, but in ustruct",
                          "set `element: mixed`, or leave it out");
      add_key(entry, "Undeforming_neu_face", "true");
    }
    hold(c.fixed);
  }
  void operator()(const bc::Traction& c) {
    if (c.over_face) return e_.missing(where_ + ".traction.over_face", in_points, "give one value");
    if (!fixed(c.course))
      return e_.missing(where_ + ".traction.waveform", "a traction in time", "give a constant traction");
    if (c.undeforming)
      return e_.missing(where_ + ".traction.undeforming", "a face that moves as a whole under a traction",
                        "load it by a pressure");
    const double f = bc::make_waveform(c.course).value(0.0) / factor(e_.units.pressure, dimension::pressure);
    condition("Trac", vector_text({f * c.vector[0], f * c.vector[1], f * c.vector[2]}));
    hold(c.fixed);
  }
  void operator()(const bc::Resistance& c) {
    if (c.distal_pressure != 0)
      return e_.missing(where_ + ".resistance.distal_pressure", "a pressure behind a resistance",
                        "use an rcr with a small capacitance");
    Entry& entry = condition("Neu", e_.in(e_.units.resistance, dimension::resistance, c.resistance));
    add_key(entry, "Time_dependence", "Resistance");
  }
  void operator()(const bc::Rcr& c) {
    Entry& entry = condition("Neu");
    add_key(entry, "Time_dependence", "RCR");
    Entry& rcr = add_section(entry, "RCR_values");
    add_key(rcr, "Proximal_resistance", e_.in(e_.units.resistance, dimension::resistance, c.proximal));
    add_key(rcr, "Capacitance", e_.in(e_.units.compliance, dimension::compliance, c.capacitance));
    add_key(rcr, "Distal_resistance", e_.in(e_.units.resistance, dimension::resistance, c.distal));
    add_key(rcr, "Distal_pressure", e_.pressure(c.distal_pressure));
    add_key(rcr, "Initial_pressure", e_.pressure(c.initial_pressure.value_or(c.distal_pressure)));
  }
  void operator()(const bc::Fixed& c) {
    bc::Axes axes = c.axes();
    if (c.along_normal()) {
      const int axis = axis_of(e_.data, face_);
      if (axis < 0) return e_.missing(where_, "a direction that is no axis", "turn the mesh, or fix axes");
      axes[static_cast<std::size_t>(axis)] = true;
    }
    hold(axes);
  }
  void operator()(const bc::Symmetry&) {
    const int axis = axis_of(e_.data, face_);
    if (axis < 0) return e_.missing(where_, "a plane of symmetry that is at right angles to no axis", "turn the mesh");
    bc::Axes axes{};
    axes[static_cast<std::size_t>(axis)] = true;
    hold(axes);
  }
  void operator()(const bc::Free&) {}
  void operator()(const bc::Displacement& c) {
    if (c.over_face) return e_.missing(where_ + ".displacement.over_face", in_points, "give one value");
    double size = 0;
    for (int i = 0; i < 3; ++i) {
      if (!c.directions[static_cast<std::size_t>(i)]) continue;
      if (size != 0 && c.value[i] != size)
        return e_.missing(where_, "a displacement of several sizes along the axes", "move the face along one axis");
      size = c.value[i];
    }
    Entry& entry = condition("Dir");
    course(entry, c.course, bc::make_waveform(c.course), size / factor(e_.units.length, dimension::length));
    add_key(entry, "Effective_direction", directions(c.directions));
    add_key(entry, "Impose_on_state_variable_integral", "true");
    add_key(entry, "Zero_out_perimeter", "false");  // else the rim of the face would stay
  }
  void operator()(const bc::Support& c) {
    for (const auto* value : {&c.stiffness, &c.damping, &c.pressure})
      if (value->index() != 0)
        return e_.missing(where_, "an array of the face, which this export does not write", "give one value");
    Entry& entry = condition("Robin", e_.pressure(std::get<double>(c.pressure)));
    add_key(entry, "Stiffness",
            e_.in(e_.units.stiffness_per_area, dimension::stiffness_per_area, std::get<double>(c.stiffness)));
    add_key(entry, "Damping",
            e_.in(e_.units.damping_per_area, dimension::damping_per_area, std::get<double>(c.damping)));
    add_key(entry, "Apply_along_normal_direction", c.direction == bc::Support::Direction::normal ? "true" : "false");
  }

 private:
  static double factor(const char* unit, const config::Dimension& due) { return config::unit_factor(unit, due); }
  static bool fixed(const bc::WaveformInput& input) {
    return std::holds_alternative<double>(input.source) && input.ramp_time == 0;
  }
  bool on_wall() const {
    return std::any_of(e_.data.faces.begin(), e_.data.faces.end(), [&](const auto& face) {
      return face.name == face_ &&
             e_.data.regions[static_cast<std::size_t>(face.region)].kind == mesh::RegionKind::wall;
    });
  }
  Entry& condition(const char* type, const std::string& value = "") {
    Entry& entry = add_section(equation_, "Add_BC", face_);
    add_key(entry, "Type", type);
    if (!value.empty()) add_key(entry, "Value", value);
    return entry;
  }
  void hold(const bc::Axes& axes) {
    if (axes == bc::Axes{}) return;
    Entry& entry = condition("Dir", "0");
    if (axes != bc::Axes{true, true, true}) add_key(entry, "Effective_direction", directions(axes));
  }

  /// A constant as Value, a series as its coefficients, a ramp as its ends, all else a table of points that are read as
  /// a Fourier series.
  void course(Entry& entry, const bc::WaveformInput& input, const bc::Waveform& waveform, double factor);
  void sampled_course(Entry& entry, const bc::WaveformInput& input, const bc::Waveform& waveform, double factor);
  void in_file(Entry& entry, const char* key, const char* extension, const std::string& text);

  Exported& e_;
  Entry& equation_;
  const std::string& face_;
  std::string where_;
};

void FaceExport::in_file(Entry& entry, const char* key, const char* extension, const std::string& text) {
  add_key(entry, "Time_dependence", "Unsteady");
  add_key(entry, key, face_ + extension);
  e_.tables.emplace_back(face_ + extension, text);
}

void FaceExport::course(Entry& entry, const bc::WaveformInput& input, const bc::Waveform& waveform, double factor) {
  if (fixed(input)) return add_key(entry, "Value", number(factor * waveform.value(0.0)));
  if (const auto series = waveform.series()) {
    std::string text = fmt::format("{}\n{}\n{} {}\n{}\n", series->start, series->period, factor * series->value,
                                   factor * series->slope, series->cosine.size());
    for (std::size_t k = 0; k < series->cosine.size(); ++k)
      text += fmt::format("{} {}\n", factor * series->cosine[k], -factor * series->sine[k]);
    return in_file(entry, "Fourier_coefficients_file_path", ".fcs", text);
  }
  const auto* source = std::get_if<bc::TableSource>(&input.source);
  if (source != nullptr && source->options.interpolation == bc::Interpolation::ramp && input.ramp_time == 0) {
    const auto times = bc::read_table(source->file).times;
    std::string text = "2 1\n";
    for (const double t : {times.front(), times.back()}) text += fmt::format("{} {}\n", t, factor * waveform.value(t));
    in_file(entry, "Temporal_values_file_path", ".flow", text);
    return add_key(entry, "Ramp_function", "true");
  }
  sampled_course(entry, input, waveform, factor);
}

void FaceExport::sampled_course(Entry& entry, const bc::WaveformInput& input, const bc::Waveform& waveform,
                                double factor) {
  // What starts, steps or is ramped repeats nowhere, so that the series spans the run, and a step beyond: its end is
  // its start again.
  const double span =
      waveform.period() && input.ramp_time == 0 ? *waveform.period() : e_.end() + (e_.c.time ? e_.c.time->step : 0.0);
  bc::Table table{.times = {}, .values = {}, .modes = sampled_modes};
  std::string text = fmt::format("{} {}\n", sampled_points, sampled_modes);
  double lowest = HUGE_VAL, highest = -HUGE_VAL;
  for (int k = 0; k < sampled_points; ++k) {
    table.times.push_back(span * k / (sampled_points - 1));
    // What steps up at the start has its value from then on; no code asks for that of the start itself.
    table.values.push_back(waveform.value(k > 0 ? table.times.back() : 1e-6 * span));
    text += fmt::format("{:.12g} {:.12g}\n", table.times.back(), factor * table.values.back());
    lowest = std::min(lowest, table.values.back());
    highest = std::max(highest, table.values.back());
  }
  if (highest == lowest) return add_key(entry, "Value", number(factor * highest));
  const auto series = bc::Waveform::table(
      table, {.interpolation = bc::Interpolation::fourier, .periodic = true, .modes = sampled_modes, .trend = true});
  double off = 0;
  for (int k = 0; k < 4 * (sampled_points - 1); ++k) {
    const double t = span * (k + 0.5) / (4 * (sampled_points - 1));
    off = std::max(off, std::abs(series.value(t) - waveform.value(t)));
  }
  e_.change(where_, fmt::format("{} points and {} Fourier modes follow the course within {:.1e} of its range",
                                sampled_points, sampled_modes, off / (highest - lowest)));
  in_file(entry, "Temporal_values_file_path", ".flow", text);
}

}  // namespace

void export_conditions(Exported& exported, Entry& equation) {
  for (const auto& [face, condition] : exported.c.boundary)
    std::visit([&, &name = face](const auto& c) { FaceExport(exported, equation, name)(c); }, condition);
}

}  // namespace tunica::stages
