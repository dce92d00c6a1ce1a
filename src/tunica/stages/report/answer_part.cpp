// Page one: what was found, beside what was asked for or is known, and how far it can be trusted.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "tunica/base/units.hpp"
#include "tunica/drawing/page.hpp"
#include "tunica/stages/report/parts.hpp"

namespace tunica::stages::report {

namespace {

namespace page = drawing::page;

/// What a figure is held against.
struct Beside {
  double low, high;
  std::string text;
};

/// Published values, with their source; a case may lie outside for good reasons.
const Beside physiological_shear = {
    0.4, std::numeric_limits<double>::infinity(),
    "endothelium is quiescent above 1.5 and atherogenic below 0.4 (Malek et al. 1999, JAMA 282:2035)"};
const Beside strength = {
    0, 1180,
    "measured around ascending aortas: aneurysms tear at 1180 ± 120 kPa, others at 1800 ± 240 kPa (Vorp "
    "et al. 2003, after table 1 of Sherifova & Holzapfel 2019, Acta Biomater 99:1)"};

const Beside systolic_at_rest = {
    0, 120, "below 120 at rest is normal, above it elevated (Whelton et al. 2018, Hypertension 71:e13)"};
const Beside stable_lumen = {0, 0.22,
                             "backflow over inflow at the entry tear: 0.10 ± 0.12 in stable, 0.49 ± 0.18 in growing "
                             "chronic dissections (Marlevi et al. 2021, J Cardiovasc Magn Reson 23:51)"};
const Beside moving_lumens = {
    0, 1.9,
    "with the heart beat the lumens of chronic dissections move by 0.9 ± 0.4 mm (true) and 1.1 "
    "± 0.4 mm (false; Weber et al. 2009, Eur J Radiol 72:483)"};

/// Rows of a table of figures: what, value, beside what.
class Answers {
 public:
  explicit Answers(const Results& r) : r_(r) {}

  /// `path`: in post.json; `of`: the object that bears the mark of dissipation. Nothing where the figure is not there.
  void add(const std::string& what, const json& value, const std::string& unit, const std::string& path, const json& of,
           const Beside* beside = nullptr) {
    if (!value.is_number()) return;
    const bool outside = beside != nullptr && (value.get<double>() < beside->low || value.get<double>() > beside->high);
    rows_.push_back({what, figure(value, 3) + band(r_, path) + mark(of), unit,
                     beside == nullptr ? "" : "<span class=\"aside\">" + beside->text + "</span>",
                     beside == nullptr ? ""
                     : outside         ? "<span class=\"bad\">outside</span>"
                                       : "<span class=\"good\">within</span>"});
  }
  std::string table(const std::string& caption) const {
    return rows_.empty() ? ""
                         : page::table({"quantity", "value", "unit", "<span class=\"aside\">beside</span>", "mark"},
                                       rows_, caption);
  }

 private:
  const Results& r_;
  std::vector<std::vector<std::string>> rows_;
};

/// Pressure at the inlet beside its targets, which `outlets` has been given.
void add_pressures(const Results& r, Answers& answers) {
  const double tolerance = r.tuning.is_object() ? r.tuning.value("tolerance", 0.02) : 0;
  for (const auto& o : at(r.post, "openings")) {
    if (!o.value("inlet", false)) continue;
    for (const char* when : {"systolic", "diastolic", "mean"}) {
      // The mean follows from the other two and the inflow: nobody has asked for it.
      const bool asked_for = when != std::string_view("mean");
      const json target = asked_for ? at(at(r.tuning, "targets"), fmt::format("{}_Pa", when)) : json();
      Beside beside{0, 0, ""};
      if (target.is_number()) {
        const double asked = target.get<double>() / unit::mmHg;
        beside = {asked * (1 - tolerance), asked * (1 + tolerance),
                  fmt::format("target {:.1f}, {:.2g} % of it allowed", asked, 100 * tolerance)};
      }
      const std::string key = fmt::format("pressure/{}_mmHg", when);
      answers.add(fmt::format("{} pressure at the inlet", when), at(o, key), "mmHg",
                  fmt::format("openings/{}/{}", o.value("name", ""), key), o,
                  target.is_number()                     ? &beside
                  : when == std::string_view("systolic") ? &systolic_at_rest
                                                         : nullptr);
    }
  }
}

void add_shares(const Results& r, Answers& answers) {
  const double tolerance = r.tuning.is_object() ? r.tuning.value("tolerance", 0.02) : 0;
  for (const auto& o : at(r.post, "openings")) {
    const json share = at(o, "share_of_outflow"), target = at(at(r.tuning, "target_fractions"), o.value("name", ""));
    if (!share.is_number()) continue;
    Beside beside{0, 0, ""};
    if (target.is_number()) {
      const double asked = 100 * target.get<double>();
      beside = {asked * (1 - tolerance), asked * (1 + tolerance),
                fmt::format("target {:.3g}, {:.2g} % of it allowed", asked, 100 * tolerance)};
    }
    answers.add("share of the outflow, " + readable(o.value("name", "")), 100 * share.get<double>(), "%",
                fmt::format("openings/{}/share_of_outflow", o.value("name", "")), o,
                target.is_number() ? &beside : nullptr);
  }
}

/// The largest difference in size along the aorta, with its sign and where it is.
void add_difference(const Results& r, Answers& answers) {
  const json* most = nullptr;
  double value = 0;
  const json stations = at(r.post, "stations");
  for (const auto& s : stations)
    for (const char* extreme : {"largest", "smallest"})
      if (const json d = at(s, fmt::format("true_minus_false_pressure/{}_mmHg", extreme));
          d.is_number() && std::abs(d.get<double>()) > std::abs(value)) {
        most = &s;
        value = d.get<double>();
      }
  if (most == nullptr) return;
  answers.add(fmt::format("true less false lumen pressure, largest in the beat, {:.0f} mm from the inlet",
                          most->value("distance_mm", 0.0)),
              value, "mmHg", "", *most);
}

void add_lumens(const Results& r, Answers& answers) {
  const json all = at(r.post, "tears"), lumen = at(r.post, "false_lumen"), flap = at(r.post, "flap");
  const auto tears = largest_tears(all);
  for (const auto& t : tears) {
    const std::string name = readable(t.value("name", "")) + (t.value("entry", false) ? " (entry)" : "");
    answers.add(name + ": into the false lumen in a beat", at(t, "volume_into_false_lumen_ml"), "ml", "", t);
    answers.add(name + ": out of it", at(t, "volume_out_of_false_lumen_ml"), "ml", "", t);
  }
  if (all.size() > tears.size()) {
    double into = 0, out = 0;
    json marked;  // of the smaller ones, if any bears the mark
    for (const auto& t : all) {
      if (std::find(tears.begin(), tears.end(), t) != tears.end()) continue;
      if (!mark(t).empty()) marked = t;
      into += t.value("volume_into_false_lumen_ml", 0.0);
      out += t.value("volume_out_of_false_lumen_ml", 0.0);
    }
    const std::string name = fmt::format("{} smaller tears together", all.size() - tears.size());
    answers.add(name + ": into the false lumen in a beat", into, "ml", "", marked);
    answers.add(name + ": out of it", out, "ml", "", marked);
  }
  answers.add("ejection fraction of the false lumen", at(lumen, "ejection_fraction"), "",
              "false_lumen/ejection_fraction", lumen, &stable_lumen);
  answers.add("largest displacement of the flap since the start", at(flap, "largest_displacement_mm"), "mm",
              "flap/largest_displacement_mm", flap, &moving_lumens);
}

void add_wall(const Results& r, Answers& answers) {
  const json shear = at(r.post, "wall_shear");
  answers.add("TAWSS, mean over the wall", at(shear, "tawss_Pa/mean"), "Pa", "wall_shear/tawss_Pa/mean", shear,
              &physiological_shear);
  answers.add("TAWSS that 99 % of the wall stay below", at(shear, "tawss_Pa/p99"), "Pa", "wall_shear/tawss_Pa/p99",
              shear);
}

std::string stress_table(const Results& r) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> head = {"region", "stress"};
  for (const auto& region : at(r.post, "stress"))
    for (const char* key : {"von_mises_stress_kPa", "first_principal_stress_kPa"}) {
      const json most = at(region, fmt::format("{}/cycle_maximum", key));
      if (!most.is_object()) continue;
      head.resize(2);
      std::vector<std::string> cells = {readable(region.value("name", "")),
                                        key[0] == 'v' ? "von Mises" : "first principal"};
      double last = 0;
      for (const auto& [percent, value] : most.items()) {
        head.push_back(percent.substr(1) + " % [kPa]");
        cells.push_back(figure(value, 3) +
                        band(r, fmt::format("stress/{}/{}/cycle_maximum/{}", region.value("name", ""), key, percent)) +
                        mark(region));
        if (value.is_number()) last = std::max(last, value.get<double>());
      }
      head.push_back("mark");
      cells.push_back(last > strength.high ? "<span class=\"bad\">above</span>" : "<span class=\"good\">below</span>");
      rows.push_back(cells);
    }
  return rows.empty() ? ""
                      : page::table(head, rows,
                                    "Stress in the wall: so many per cent of a region's volume stay below, largest of "
                                    "the beat; beside it: " +
                                        strength.text);
}

/// Does the pressure at the inlet come back to where it began?
std::string periodic_text(const std::vector<viewer::Plot>& plots, const json& post) {
  if (plots.empty() || !plots[0].in_time || plots[0].curves.empty() || !post.is_object() || !post.contains("openings"))
    return "";
  std::size_t inlet = 0;
  while (inlet < post["openings"].size() && !post["openings"][inlet].value("inlet", false)) ++inlet;
  if (inlet >= plots[0].curves.size() || plots[0].curves[inlet].y.size() < 3) return "";
  const auto& y = plots[0].curves[inlet].y;
  const double pulse = *std::max_element(y.begin(), y.end()) - *std::min_element(y.begin(), y.end()),
               gap = y.back() - y.front();
  const double share = 100 * std::abs(gap) / std::max(pulse, 1e-12);
  const bool periodic = share < 3;
  return fmt::format(
      "<li><span class=\"{}\">{}</span>: the pressure at the inlet ends {:.2g} mmHg {} where the window began, {:.2g} "
      "% of the pulse pressure{}.</li>\n",
      periodic ? "good" : "bad", periodic ? "The beat is periodic" : "The beat is not periodic", std::abs(gap),
      gap < 0 ? "below" : "above", share,
      periodic ? ""
               : "; mean values and volumes are those of this window, not of a steady rhythm (more cycles: "
                 "<code>time.cycles</code>)");
}

std::string resolution_text(const Results& r) {
  std::string text;
  const auto item = [&](bool good, const std::string& what, const std::string& why) {
    text += fmt::format("<li><span class=\"{}\">{}</span>: {}.</li>\n", good ? "good" : "bad", what, why);
  };
  std::string dissipated;
  for (const auto& p : at(r.post, "numerical_dissipation/parts"))
    if (p.value("above_limit", false)) dissipated += (dissipated.empty() ? "" : ", ") + readable(p.value("part", ""));
  if (at(r.post, "numerical_dissipation").is_object())
    item(dissipated.empty(), dissipated.empty() ? "The flow is not damped by the scheme" : "The mesh damps the flow",
         dissipated.empty() ? "it takes less than half of what viscosity takes"
                            : "the scheme takes more than half of what viscosity takes in: " + dissipated +
                                  "; figures there bear a † and depend on the mesh");
  const json across = at(r.manifest, "mesh/elements_across");
  double least = 1e30;
  for (const auto& part : across) least = std::min(least, part.value("median", 1e30));
  // Quadratic: on tubes it is then within some per cent (table in docs/verification.md).
  const double enough = at(r.post, "numerical_dissipation/elements") == "quadratic" ? 6 : 10;
  if (least < 1e29)
    item(least >= enough, "Wall shear",
         fmt::format("the coarsest part has {:.2g} elements across; wall shear needs {:g} to be within some per cent",
                     least, enough));
  item(r.bands.is_object(),
       r.bands.is_object() ? "Errors of mesh and step are known" : "Errors of mesh and step are not known",
       r.bands.is_object() ? "± beside the figures, from finer meshes and smaller steps"
                           : "<code>tunica converge</code> finds them from finer meshes and smaller steps");
  for (const auto& left : at(r.post, "left_out"))
    item(false, "Left out: " + page::escaped(left.value("part", "")), page::escaped(left.value("why", "")));
  return text;
}

}  // namespace

std::vector<json> largest_tears(const json& tears) {
  constexpr std::size_t most = 4;
  std::vector<double> areas;
  for (const auto& tear : tears) areas.push_back(tear.value("area_mm2", 0.0));
  std::sort(areas.begin(), areas.end(), std::greater<>());
  const double least = areas.size() > most ? areas[most - 1] : 0;
  std::vector<json> largest;
  std::copy_if(tears.begin(), tears.end(), std::back_inserter(largest),
               [&](const json& tear) { return tear.value("area_mm2", 0.0) >= least; });
  return largest;
}

void add_targets(const Results& r, std::vector<viewer::Plot>& plots) {
  if (plots.empty() || !plots[0].in_time || plots[0].curves.empty() || plots[0].curves[0].x.empty()) return;
  const std::vector<double> ends = {plots[0].curves[0].x.front(), plots[0].curves[0].x.back()};
  for (const char* when : {"systolic", "diastolic"})
    if (const json target = at(at(r.tuning, "targets"), fmt::format("{}_Pa", when)); target.is_number()) {
      const double asked = target.get<double>() / unit::mmHg;
      plots[0].curves.push_back({fmt::format("target at the inlet, {}", when), ends, {asked, asked}, 0, "target"});
    }
}

std::string answer_part(const Results& r, const std::vector<viewer::Plot>& plots) {
  if (!r.post.is_object())
    return "<h2 id=\"answer\">What was found</h2>\n" +
           missing("Figures of the cycle", "the case has no stage `post`, or it is not done");
  Answers pressures(r), lumens(r);
  add_pressures(r, pressures);
  add_shares(r, pressures);
  add_difference(r, lumens);
  add_lumens(r, lumens);
  add_wall(r, lumens);
  return "<h2 id=\"answer\">What was found</h2>\n<div class=\"columns\">" +
         pressures.table("Pressure at the inlet and shares of the outflow, of the computed beat") +
         lumens.table("Lumens, flap and wall shear") + stress_table(r) + "<h3>How far it can be trusted</h3>\n<ul>\n" +
         periodic_text(plots, r.post) + resolution_text(r) + "</ul></div>\n";
}

}  // namespace tunica::stages::report
