#include "tunica/case/plausible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tunica/base/text.hpp"
#include "tunica/base/units.hpp"
#include "tunica/case/case.hpp"
#include "tunica/case/face_patterns.hpp"
#include "tunica/case/mesh_settings.hpp"
#include "tunica/geometry/elements_across.hpp"
#include "tunica/quantities/quantity.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::case_file {

namespace {

namespace dimension = config::dimension;

/// What tables of one kind usually reach, in SI units, and how that is said.
struct Usual {
  const char* what;
  config::Dimension due;
  double least, most;  ///< of the largest size
  double likely;       ///< what a slip is rather taken for than for less
  double shown_unit;
  const char *shown, *text;
};

constexpr Usual usual_flow{
    "flow", dimension::volume_flow,  0.01 * unit::ml_s, 1000 * unit::ml_s, 1 * unit::ml_s, unit::ml_s,
    "ml/s", "0.01 ml/s to 1000 ml/s"};
constexpr Usual usual_pressure{"pressure",      dimension::pressure, 1 * unit::mmHg, 400 * unit::mmHg,
                               40 * unit::mmHg, unit::mmHg,          "mmHg",         "1 mmHg to 400 mmHg"};
constexpr Usual usual_velocity{"velocity", dimension::velocity, 1e-5, 10, 0.01, 1, "m/s", "1e-5 m/s to 10 m/s"};
constexpr Usual usual_traction{"traction", dimension::pressure, 0,      400 * unit::mmHg,
                               0,          unit::mmHg,          "mmHg", "up to 400 mmHg"};

constexpr double shortest_period = 0.2, longest_period = 3;                  // s: 300 and 20 beats a minute
constexpr double shortest_time_constant = 0.01, longest_time_constant = 30;  // s
constexpr double highest_mean_pressure = 300 * unit::mmHg, arterial_pressure = 40 * unit::mmHg;
constexpr double least_outflow = 0.1 * unit::ml_s;
constexpr double usual_resistance = 1e12;   // Pa s/m^3, as the keys have it
constexpr double usual_capacitance = 1e-7;  // m^3/Pa, likewise
constexpr double longest_step = 0.02;       // s: more is warned of as it is read
constexpr int fewest_steps = 20;            // of a period
constexpr double least_part = 1e-3;         // of a table that does not repeat, which the run should come to

std::string meant(double in_unit, const config::Dimension& due, double low, double high) {
  const std::string likely = config::likely_meant(fmt::format("{:.6g}", in_unit), due, low, high);
  return likely.empty() ? "check the unit and `scale`" : fmt::format("a slip of the unit? {} would be usual", likely);
}

class Checker {
 public:
  explicit Checker(const Case& c) : case_(c) {}
  std::vector<Problem> warnings;

  /// Fields that were chosen and that no results will have.
  void fields() {
    const auto& chosen = case_.output.fields;
    if (chosen == quantities::standard()) return;
    const auto& all = quantities::registry();
    bool stress = false, any = false;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!chosen[i]) continue;
      const std::string why = why_none(all[i]);
      if (!why.empty())
        warnings.push_back({"output.fields", fmt::format("`{}` is not written: {}", all[i].key, why), "leave it out"});
      any = any || why.empty();
      stress = stress || (all[i].place == quantities::Place::wall_elements && all[i].components == 1 &&
                          all[i].unit == quantities::Unit::stress);
    }
    if (!any)
      warnings.push_back({"output.fields", "names nothing that the case has: the series show meshes alone",
                          "name some, or leave out `fields`"});
    if (case_.post && case_.solves_wall() && !stress)
      warnings.push_back({"output.fields", "names no stress of elements, so `post` and the report have none",
                          "add `von_mises_stress` and `first_principal_stress`"});
  }

  void tables() {
    for (const auto& [face, condition] : case_.boundary) {
      const std::string where = "boundary." + face;
      if (const auto* flow = std::get_if<bc::Flow>(&condition)) course(where, flow->course, usual_flow);
      if (const auto* pressure = std::get_if<bc::Pressure>(&condition))
        course(where, pressure->pressure, usual_pressure);
      if (const auto* velocity = std::get_if<bc::Velocity>(&condition))
        course(where, velocity->course, usual_velocity, velocity->value);
      if (const auto* traction = std::get_if<bc::Traction>(&condition))
        course(where, traction->course, usual_traction, traction->vector);
    }
  }

  void sign_of_inflow() {
    double net = 0;
    std::string into;
    for (const auto& [face, condition] : case_.boundary)
      if (const auto* flow = std::get_if<bc::Flow>(&condition)) {
        const double mean = bc::inflow(*flow).mean();
        net += mean;
        into += (into.empty() ? "" : ", ") + face;
        const bool inlet = text::lower(face).find("inlet") != std::string::npos;
        if (mean < 0 && inlet) return warn_of_sign("boundary." + face, mean);
      }
    if (net < 0 && only_outlets_besides()) warn_of_sign("boundary: " + into, net);
  }

  void outlets() {
    if (!case_.solves_fluid()) return;
    for (const auto& [face, condition] : case_.boundary)
      if (const auto* rcr = std::get_if<bc::Rcr>(&condition)) {
        const double constant = rcr->distal * rcr->capacitance;
        if (is_unusual(rcr->distal) || rcr->capacitance > usual_capacitance) continue;
        if (constant < shortest_time_constant || constant > longest_time_constant)
          warnings.push_back({"boundary." + face,
                              fmt::format("the Windkessel empties with a time constant (distal x capacitance) of "
                                          "{:.3g} s; {:.2g} s to {:.2g} s is usual, of a whole circulation 1 s to 2 s",
                                          constant, shortest_time_constant, longest_time_constant),
                              "a slip of the unit of `distal` or `capacitance`?"});
      }
    resistances();
  }

  void fineness() {
    const auto asked = case_.mesh ? across(case_.mesh->size) : std::nullopt;
    const double enough = enough_across(case_);
    if (!asked || asked->count >= enough) return;
    warnings.push_back({"mesh.size",
                        fmt::format("{:g} elements across the lumen are asked for; flow on {} ones needs {:g}",
                                    asked->count, case_.elements == Elements::linear ? "linear" : "quadratic", enough),
                        remedy_across(case_)});
  }

 private:
  std::string why_none(const quantities::Quantity& quantity) const {
    using quantities::Place;
    const bool of_wall = quantity.place == Place::wall_nodes || quantity.place == Place::wall_elements ||
                         quantity.unit == quantities::Unit::length;
    if (quantity.place == Place::lumen_nodes && !case_.solves_fluid()) return "the analysis has no blood";
    if (of_wall && !case_.solves_wall()) return "the analysis has no wall";
    if (quantity.of_motion && std::holds_alternative<StaticWall>(case_.analysis)) return "nothing moves in statics";
    if (quantity.key == "wall_pressure" && !case_.wall_has_pressure()) return "the displacement element has none";
    if (quantity.key.starts_with("fibre_") && !has_fibres()) return "no law of the wall has fibres";
    return "";
  }

  bool has_fibres() const {
    if (!wall::mean_fibre_directions(case_.wall->material).empty()) return true;
    return std::any_of(case_.wall->regions.begin(), case_.wall->regions.end(),
                       [](const auto& region) { return !wall::mean_fibre_directions(region.second.material).empty(); });
  }

  /// Was a resistance warned of as it was read?
  static bool is_unusual(double resistance) { return resistance > usual_resistance; }

  /// `vector`: what the course is a factor of, when it is one.
  void course(const std::string& where, const bc::WaveformInput& input, const Usual& usual,
              const std::optional<Vec3<double>>& vector = {}) {
    const double factor = vector ? norm(*vector) : 1;
    const auto* source = std::get_if<bc::TableSource>(&input.source);
    if (!source) return constant(where, input, usual, vector);
    const auto table = bc::read_table(source->file);
    const std::string file = fmt::format("{} ({})", where, text::printable(source->file.path.string(), 400));
    const double size = largest_size(input) * factor;
    if (size > usual.most || (size > 0 && size < usual.least))
      warnings.push_back({file,
                          fmt::format("the {} of the table reaches {:.4g} {}; {} is usual", usual.what,
                                      size / usual.shown_unit, usual.shown, usual.text),
                          !vector ? meant(size / source->file.value_unit, usual.due, usual.likely, 0.8 * usual.most)
                                  : "check the unit and `scale`"});
    const auto waveform = bc::make_waveform(input);
    if (waveform.period())
      period(file, *waveform.period(), source->file.time_unit);
    else
      duration(file, table.times.back() - table.times.front(), source->file.time_unit);
  }

  /// A constant or a step with its scale. What is beyond the usual as it is typed has been warned of as it was read.
  void constant(const std::string& where, const bc::WaveformInput& input, const Usual& usual,
                const std::optional<Vec3<double>>& vector) {
    const double course = largest_size(input), size = course * (vector ? norm(*vector) : 1);
    double typed = 0;
    if (vector)
      for (int i = 0; i < 3; ++i) typed = std::max(typed, std::abs((*vector)[i]));
    else if (input.scale != 0)
      typed = course / std::abs(input.scale);
    constexpr double rounding = 1 + 1e-12;  // of units
    if (typed > usual.most * rounding || size <= usual.most * rounding) return;
    warnings.push_back({where,
                        fmt::format("the {} reaches {:.4g} {} with its {}; {} is usual", usual.what,
                                    size / usual.shown_unit, usual.shown, vector ? "waveform" : "scale", usual.text),
                        "check the unit and `scale`"});
  }

  void period(const std::string& where, double seconds, double unit) {
    if (seconds < shortest_period || seconds > longest_period)
      warnings.push_back({where,
                          fmt::format("the period of the table is {:.4g} s; {:.2g} s to {:.2g} s is usual", seconds,
                                      shortest_period, longest_period),
                          meant(seconds / unit, dimension::time, shortest_period, longest_period)});
    else if (case_.time && case_.time->step <= longest_step && seconds < fewest_steps * case_.time->step)
      warnings.push_back({where,
                          fmt::format("a period of {:.4g} s has {:.3g} steps of {:.4g} s; more than {} are usual",
                                      seconds, seconds / case_.time->step, case_.time->step, fewest_steps),
                          "take smaller steps: `time.step`"});
  }

  void duration(const std::string& where, double seconds, double unit) {
    if (!case_.time) return;
    const double run = static_cast<double>(case_.time->most_steps()) * case_.time->step;
    if (run < least_part * seconds)
      warnings.push_back(
          {where,
           fmt::format("the table lasts {:.4g} s, the run {:.4g} s: no more than its beginning is used", seconds, run),
           meant(seconds / unit, dimension::time, 0.5 * run, 100 * run)});
  }

  void warn_of_sign(const std::string& where, double mean) {
    warnings.push_back({where,
                        fmt::format("the flow is {:.4g} ml/s out of the vessel on average; blood usually flows in "
                                    "there",
                                    -mean / unit::ml_s),
                        "the wrong sign? `positive: inflow` and `positive: outflow` say what a positive number means "
                        "(in a .flow file: outflow)"});
  }

  /// Is it a lumen face, as far as its name tells before the mesh is read?
  static bool may_be_opening(const std::string& face) { return !text::lower(face).starts_with("wall"); }

  /// Do all openings without a given flow resist what flows out?
  bool only_outlets_besides() const {
    bool any = false;
    for (const auto& [face, condition] : case_.boundary) {
      const bool load =
          std::holds_alternative<bc::Pressure>(condition) || std::holds_alternative<bc::Traction>(condition);
      if (std::holds_alternative<bc::Velocity>(condition) || std::holds_alternative<bc::VelocityProfile>(condition) ||
          (load && may_be_opening(face)))
        return false;
      any = any || std::holds_alternative<bc::Resistance>(condition) || std::holds_alternative<bc::Rcr>(condition);
    }
    return any;
  }

  /// Outlets in parallel: a pressure P drives P * conductance - driven.
  struct Parallel {
    double conductance = 0, driven = 0;
  };

  /// None where a pattern stands for any number of outlets, or an outlet does not resist. A value that is beyond the
  /// usual has been warned of as it was read; their sum may be without any of them.
  std::optional<Parallel> parallel_outlets() const {
    Parallel all;
    for (const auto& [face, condition] : case_.boundary) {
      double resistance = 0, distal_pressure = 0, largest = 0;
      if (const auto* r = std::get_if<bc::Resistance>(&condition))
        resistance = largest = r->resistance, distal_pressure = r->distal_pressure;
      else if (const auto* rcr = std::get_if<bc::Rcr>(&condition))
        resistance = rcr->proximal + rcr->distal, largest = std::max(rcr->proximal, rcr->distal),
        distal_pressure = rcr->distal_pressure;
      else
        continue;
      if (is_pattern(face) || !(resistance > 0) || is_unusual(largest)) return std::nullopt;
      all.conductance += 1 / resistance;
      all.driven += distal_pressure / resistance;
    }
    return all.conductance > 0 ? std::optional(all) : std::nullopt;
  }

  /// Mean pressure that the mean inflow needs, or mean flow that a given pressure drives.
  void resistances() {
    const auto outlets = parallel_outlets();
    if (!outlets) return;
    double inflow = 0, pressure = 0;
    bool flow_is_given = false;
    for (const auto& [face, condition] : case_.boundary) {
      flow_is_given = flow_is_given || std::holds_alternative<bc::Flow>(condition) ||
                      std::holds_alternative<bc::Velocity>(condition) ||
                      std::holds_alternative<bc::VelocityProfile>(condition);
      if (const auto* flow = std::get_if<bc::Flow>(&condition)) inflow += bc::inflow(*flow).mean();
      if (const auto* given = std::get_if<bc::Pressure>(&condition); given && may_be_opening(face))
        pressure = std::max(pressure, bc::make_waveform(given->pressure).mean());
    }
    const double resistance = unit::ml_s / outlets->conductance / unit::mmHg;
    const double needed = (inflow + outlets->driven) / outlets->conductance,
                 driven = pressure * outlets->conductance - outlets->driven;
    const char* remedy = "a slip of the unit of the resistances, or of the flow or pressure?";
    if (only_outlets_besides() && inflow > 0 && inflow < usual_flow.most && needed > highest_mean_pressure)
      warnings.push_back(
          {"boundary",
           fmt::format("a mean inflow of {:.4g} ml/s through the resistances of the outlets, {:.4g} mmHg "
                       "s/ml in parallel, needs a mean pressure of {:.4g} mmHg; up to {:.0f} mmHg is usual",
                       inflow / unit::ml_s, resistance, needed / unit::mmHg, highest_mean_pressure / unit::mmHg),
           remedy});
    if (!flow_is_given && pressure > arterial_pressure && driven > 0 && driven < least_outflow)
      warnings.push_back(
          {"boundary",
           fmt::format("a mean pressure of {:.4g} mmHg drives {:.3g} ml/s through the resistances of the "
                       "outlets, {:.4g} mmHg s/ml in parallel; more than {:.1f} ml/s is usual",
                       pressure / unit::mmHg, driven / unit::ml_s, resistance, least_outflow / unit::ml_s),
           remedy});
  }

  const Case& case_;
};

}  // namespace

double enough_across(const Case& c) {
  return c.elements == Elements::quadratic ? geometry::enough_quadratic : geometry::enough_linear;
}

std::string remedy_across(const Case& c) {
  const bool quadratic = c.elements == Elements::quadratic;
  // A mesh of other programs is made finer there, one of `tunica mesh` in its file.
  const std::string finer =
      c.meshes.tube ? "more `cells_around` and `cells_radial`"
                    : fmt::format("a finer mesh there (`{}size: {{elements_across: {:g}}}` of `tunica mesh`{})",
                                  c.mesh ? "mesh." : "", enough_across(c), quadratic ? "" : " and `boundary_layers`");
  if (quadratic) return finer;
  return fmt::format("`elements: quadratic`, which need {:g}, or {}", geometry::enough_quadratic, finer);
}

double largest_size(const bc::WaveformInput& input) {
  double largest = 0;
  if (const auto* constant = std::get_if<double>(&input.source)) largest = std::abs(*constant);
  if (const auto* step = std::get_if<bc::Step>(&input.source)) largest = std::abs(step->value);
  if (const auto* source = std::get_if<bc::TableSource>(&input.source))
    for (const double v : bc::read_table(source->file).values) largest = std::max(largest, std::abs(v));
  return largest * std::abs(input.scale);
}

std::vector<Problem> implausible_values(const Case& c) {
  Checker checker(c);
  checker.tables();
  if (c.solves_fluid()) checker.sign_of_inflow();
  if (!c.outlets) checker.outlets();
  if (c.solves_fluid()) checker.fineness();
  checker.fields();
  return std::move(checker.warnings);
}

std::vector<Problem> implausible_outlets(const Case& c) {
  Checker checker(c);
  checker.outlets();
  return std::move(checker.warnings);
}

}  // namespace tunica::case_file
