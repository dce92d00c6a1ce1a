#include "tunica/geometry/parametric_dissection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/geometry/dissection_model.hpp"

namespace tunica::geometry {

namespace {

using config::in_si;
using config::Problems;
using config::Schema;
namespace dimension = config::dimension;

const config::Range any_angle = config::range(-2 * std::numbers::pi, 2 * std::numbers::pi);

BranchShape usual_celiac() { return {380 * mm, 180 * degree, 35 * degree, 4.2 * mm, 32 * mm, 1.2 * mm}; }
BranchShape usual_superior_mesenteric() { return {399 * mm, 180 * degree, 45 * degree, 3.6 * mm, 38 * mm, 1.2 * mm}; }
BranchShape usual_left_renal() { return {412 * mm, 90 * degree, 15 * degree, 3 * mm, 32 * mm, 1.1 * mm}; }
BranchShape usual_right_renal() { return {414 * mm, -90 * degree, 15 * degree, 3 * mm, 32 * mm, 1.1 * mm}; }

Schema<AortaShape> aorta_schema() {
  using A = AortaShape;
  return Schema<A>("aorta", "Centreline (straight, arch, descending), radii of the lumen along it, wall.")
      .quantity("ascending_length", &A::ascending_length, dimension::length, config::range(10 * mm, 150 * mm),
                "Straight part from the inlet to the arch")
      .by_default()
      .quantity("arch_bend_radius", &A::arch_bend_radius, dimension::length, config::range(20 * mm, 100 * mm),
                "Radius of the centreline in the arch")
      .by_default()
      .quantity("arch_angle", &A::arch_angle, dimension::angle, config::range(90 * degree, 190 * degree),
                "Angle by which the arch turns")
      .by_default("175 deg")
      .quantity("arch_direction", &A::arch_direction, dimension::angle, any_angle,
                "Direction of the arch seen from above: 0 to the left of the patient, 90 deg to the back")
      .by_default("65 deg")
      .quantity("descending_length", &A::descending_length, dimension::length, config::range(100 * mm, 600 * mm),
                "From the arch to the end")
      .by_default()
      .quantity("descending_bend", &A::descending_bend, dimension::angle, config::range(-40 * degree, 40 * degree),
                "Angle by which that part bends on, > 0 forward")
      .by_default("15 deg")
      .quantity("ascending_radius", &A::ascending_radius, dimension::length, config::range(8 * mm, 30 * mm),
                "Up to the arch")
      .by_default()
      .quantity("arch_radius", &A::arch_radius, dimension::length, config::range(6 * mm, 25 * mm),
                "Where the dissection begins")
      .by_default()
      .quantity("dissected_radius", &A::dissected_radius, dimension::length, config::range(8 * mm, 30 * mm),
                "Of both lumens together")
      .by_default()
      .quantity("abdominal_radius", &A::abdominal_radius, dimension::length, config::range(5 * mm, 20 * mm),
                "At the end")
      .by_default()
      .quantity("wall_thickness", &A::wall_thickness, dimension::length, config::range(0.8 * mm, 5 * mm),
                "Of the aorta")
      .by_default()
      .plausible("2 mm", "3.4 mm")
      .quantity("branch_fillet", &A::branch_fillet, dimension::length, config::range(1 * mm, 8 * mm),
                "Radius of the rounding where branches leave")
      .by_default();
}

Schema<TearShape> tear_schema(const std::string& name, const TearShape& usual) {
  return Schema<TearShape>(name, "Oval hole in the flap with rounded rim.")
      .quantity("position", &TearShape::position, dimension::length, config::above(0),
                "Of its middle, along the centreline from the inlet")
      .by_default(in_si(usual.position, dimension::length))
      .quantity("area", &TearShape::area, dimension::area, config::range(5e-6, 1000e-6), "At its narrowest")
      .by_default(in_si(usual.area, dimension::area))
      .number("aspect", &TearShape::aspect, config::range(0.3, 4), "Length along the vessel by width")
      .by_default(in_si(usual.aspect, dimension::none))
      .quantity("across", &TearShape::across, dimension::length, config::range(-20 * mm, 20 * mm),
                "Of its middle, from the middle of the flap")
      .by_default(in_si(usual.across, dimension::length));
}

Schema<FlapShape> flap_schema() {
  using F = FlapShape;
  return Schema<F>("flap", "Spiral flap that separates true and false lumen.")
      .quantity("start", &F::start, dimension::length, config::above(0),
                "Where it leaves the wall, along the centreline from the inlet")
      .by_default()
      .quantity("length", &F::length, dimension::length, config::range(60 * mm, 500 * mm), "Along the centreline")
      .by_default()
      .quantity("taper", &F::taper, dimension::length, config::range(10 * mm, 80 * mm),
                "Length at either end over which it comes from the wall to its place")
      .by_default()
      .quantity("thickness", &F::thickness, dimension::length, config::range(0.6 * mm, 4 * mm), "Of the flap")
      .by_default()
      .plausible("1.5 mm", "2 mm")
      .quantity("false_lumen_wall_thickness", &F::false_lumen_wall_thickness, dimension::length,
                config::range(0.6 * mm, 4 * mm), "Of the wall over the false lumen")
      .by_default()
      .plausible("1 mm", "1.6 mm")
      .number("turns", &F::turns, config::range(-2, 2), "Of the spiral over the length")
      .by_default()
      .quantity("true_lumen_direction", &F::true_lumen_direction, dimension::angle, any_angle,
                "Side of the true lumen at the start, from the outside of the arch")
      .by_default("180 deg")
      .number("true_lumen_share", &F::true_lumen_share, config::range(0.15, 0.85), "Of the cross-section")
      .by_default()
      .quantity("bow", &F::bow, dimension::length, config::range(-8 * mm, 8 * mm),
                "Height by which the flap is curved, > 0 into the true lumen")
      .by_default()
      .quantity("rim_fillet", &F::rim_fillet, dimension::length, config::range(0.2 * mm, 2 * mm),
                "Radius of the rounded rims of the tears")
      .by_default()
      .quantity("corner_fillet", &F::corner_fillet, dimension::length, config::range(0.5 * mm, 6 * mm),
                "Radius of the rounding where flap and wall meet")
      .by_default()
      .section("entry_tear", &F::entry, tear_schema("entry_tear", F{}.entry), "Below the left subclavian artery")
      .by_default()
      .section("exit_tear", &F::exit, tear_schema("exit_tear", F{}.exit), "Above the celiac trunk")
      .by_default();
}

Schema<BranchShape> branch_schema(const std::string& name, const BranchShape& usual) {
  using B = BranchShape;
  return Schema<B>(name, "A straight branch of the aorta.")
      .quantity("position", &B::position, dimension::length, config::above(0),
                "Of its origin, along the centreline from the inlet")
      .by_default(in_si(usual.position, dimension::length))
      .quantity("angle", &B::angle, dimension::angle, any_angle,
                "Where around the aorta: 0 on the outside of the arch, 90 deg to the right of the flow")
      .by_default(in_si(usual.angle, dimension::angle))
      .quantity("inclination", &B::inclination, dimension::angle, config::range(-60 * degree, 60 * degree),
                "Of its axis, from straight away towards downstream")
      .by_default(in_si(usual.inclination, dimension::angle))
      .quantity("radius", &B::radius, dimension::length, config::range(1.5 * mm, 12 * mm), "Of the lumen")
      .by_default(in_si(usual.radius, dimension::length))
      .quantity("length", &B::length, dimension::length, config::range(10 * mm, 100 * mm), "Outside of the aorta")
      .by_default(in_si(usual.length, dimension::length))
      .quantity("wall_thickness", &B::wall_thickness, dimension::length, config::range(0.5 * mm, 4 * mm), "Of its wall")
      .by_default(in_si(usual.wall_thickness, dimension::length))
      .plausible("1 mm", "1.6 mm");
}

Schema<IliacShape> iliac_schema() {
  using I = IliacShape;
  return Schema<I>("iliacs", "The two arteries that the aorta ends in.")
      .quantity("angle", &I::angle, dimension::angle, config::range(15 * degree, 50 * degree),
                "Of either, from the direction of the aorta")
      .by_default("25 deg")
      .quantity("radius", &I::radius, dimension::length, config::range(2 * mm, 12 * mm), "Of the lumen")
      .by_default()
      .quantity("length", &I::length, dimension::length, config::range(20 * mm, 150 * mm), "Beyond the aorta")
      .by_default()
      .quantity("wall_thickness", &I::wall_thickness, dimension::length, config::range(0.5 * mm, 4 * mm),
                "Of their walls")
      .by_default();
}

Schema<ThrombusShape> thrombus_schema() {
  using T = ThrombusShape;
  return Schema<T>("thrombus", "Clotted blood along the outer wall of the false lumen.")
      .quantity("start", &T::start, dimension::length, config::above(0),
                "Where it begins, along the centreline from the inlet")
      .by_default()
      .quantity("length", &T::length, dimension::length, config::range(10 * mm, 400 * mm), "Along the centreline")
      .by_default()
      .quantity("taper", &T::taper, dimension::length, config::range(3 * mm, 80 * mm),
                "Length at either end over which it becomes thick")
      .by_default()
      .quantity("thickness", &T::thickness, dimension::length, config::range(1.5 * mm, 30 * mm), "From the wall")
      .by_default();
}

std::string in_mm(double x) { return fmt::format("{:.4g} mm", x / mm); }

// --- what is impossible -------------------------------------------------------------------------------------------

void check_aorta(const ParametricDissection& d, Problems& problems) {
  const auto& a = d.aorta;
  const double widest = std::max({a.ascending_radius, a.arch_radius, a.dissected_radius}) + a.wall_thickness;
  if (a.arch_bend_radius < widest + 1 * mm)
    problems.add("aorta.arch_bend_radius",
                 fmt::format("is {}, but the vessel with its wall has a radius of {}: it would overlap itself on the "
                             "inside of the arch",
                             in_mm(a.arch_bend_radius), in_mm(widest)),
                 fmt::format("give at least {}, or smaller radii", in_mm(widest + 1 * mm)));
  const double gap = 2 * a.arch_bend_radius - a.ascending_radius - a.dissected_radius - 2 * a.wall_thickness;
  if (gap < 2 * mm)
    problems.add("aorta.arch_bend_radius",
                 fmt::format("is {}: ascending and descending aorta would touch", in_mm(a.arch_bend_radius)),
                 fmt::format("give at least {}", in_mm(a.arch_bend_radius + 1 * mm - gap / 2)));
}

void check_flap_place(const ParametricDissection& d, Problems& problems) {
  const auto& f = d.flap;
  const double end = f.start + f.length, last = d.length() - 5 * mm;
  if (f.start < d.aorta.ascending_length)
    problems.add("flap.start",
                 fmt::format("is {}, in the ascending aorta: that is no type-B dissection", in_mm(f.start)),
                 fmt::format("start after the ascending part, {}", in_mm(d.aorta.ascending_length)));
  if (end > last)
    problems.add("flap.length",
                 fmt::format("lets the flap end at {}, but the aorta is {} long", in_mm(end), in_mm(d.length())),
                 "shorten the flap, start it earlier, or lengthen the descending aorta");
  if (2 * f.taper > f.length - 20 * mm)
    problems.add("flap.taper", fmt::format("is {} at either end of a flap of {}", in_mm(f.taper), in_mm(f.length)),
                 "leave at least 20 mm between the tapers");
  if (f.rim_fillet > f.thickness / 2)
    problems.add(
        "flap.rim_fillet",
        fmt::format("is {}, more than half the thickness of the flap, {}", in_mm(f.rim_fillet), in_mm(f.thickness)),
        fmt::format("give at most {}", in_mm(f.thickness / 2)));
}

void check_lumens(const ParametricDissection& d, const DissectionModel& model, Problems& problems) {
  const auto depths = model.depths(d.flap.start + d.flap.length / 2);
  const double least = 2 * d.flap.corner_fillet;
  const std::pair<const char*, double> lumens[] = {{"true", depths.true_lumen}, {"false", depths.false_lumen}};
  for (const auto& [name, depth] : lumens)
    if (depth < std::max(3 * mm, least))
      problems.add("flap",
                   fmt::format("leaves a {} lumen of {} in depth: share, bow and thickness do not go together", name,
                               in_mm(depth)),
                   fmt::format("leave at least {}: another true_lumen_share, a thinner or flatter flap, or a smaller "
                               "corner_fillet",
                               in_mm(std::max(3 * mm, least))));
}

void check_tear(const ParametricDissection& d, const DissectionModel& model, const std::string& key,
                const TearShape& tear, Problems& problems) {
  const auto& f = d.flap;
  const double half_width = std::sqrt(tear.area / (std::numbers::pi * tear.aspect)),
               half_length = tear.aspect * half_width;
  // A strip of flap has to remain between the rim and what lies around it.
  const double strip = f.corner_fillet + f.rim_fillet + 1 * mm;
  const double first = f.start + f.taper * 0.8 + half_length + strip,
               last = f.start + f.length - f.taper * 0.8 - half_length - strip;
  if (tear.position < first || tear.position > last)
    problems.add(key + ".position",
                 fmt::format("is {}: the tear would reach where the flap leaves the wall", in_mm(tear.position)),
                 first < last ? fmt::format("place it between {} and {}", in_mm(first), in_mm(last))
                              : "make the tear smaller or the flap longer");
  double width = 1;
  for (double s = tear.position - half_length; s <= tear.position + half_length; s += mm)
    width = std::min(width, model.flap_half_width(s));
  if (std::abs(tear.across) + half_width + strip > width)
    problems.add(key,
                 fmt::format("is {} wide{}, but the flap there has a width of {}", in_mm(2 * half_width),
                             tear.across == 0 ? "" : " and off the middle", in_mm(2 * width)),
                 fmt::format("leave {} of flap on either side: a smaller area, or a larger aspect", in_mm(strip)));
}

void check_tears(const ParametricDissection& d, const DissectionModel& model, Problems& problems) {
  check_tear(d, model, "flap.entry_tear", d.flap.entry, problems);
  check_tear(d, model, "flap.exit_tear", d.flap.exit, problems);
  const auto half_length = [](const TearShape& t) { return std::sqrt(t.area * t.aspect / std::numbers::pi); };
  const double apart = half_length(d.flap.entry) + half_length(d.flap.exit) + 5 * mm;
  if (d.flap.exit.position - d.flap.entry.position < apart)
    problems.add("flap.exit_tear.position",
                 fmt::format("is {}, the entry tear at {}", in_mm(d.flap.exit.position), in_mm(d.flap.entry.position)),
                 fmt::format("place it at least {} after the entry tear", in_mm(apart)));
}

void check_thrombus(const ParametricDissection& d, const DissectionModel& model, Problems& problems) {
  if (!d.thrombus) return;
  const auto& t = *d.thrombus;
  const double first = d.flap.start + d.flap.taper, last = d.flap.start + d.flap.length - d.flap.taper;
  if (t.start < first || t.start + t.length > last)
    problems.add("thrombus",
                 fmt::format("reaches from {} to {}, where the flap is not as far from the wall as in its middle",
                             in_mm(t.start), in_mm(t.start + t.length)),
                 fmt::format("place it between {} and {}", in_mm(first), in_mm(last)));
  if (!problems.errors.empty()) return;  // what follows looks at the lumen beside it
  if (2 * t.taper > t.length)
    problems.add("thrombus.taper", fmt::format("is {} at either end of {}", in_mm(t.taper), in_mm(t.length)),
                 fmt::format("give at most {}", in_mm(t.length / 2)));
  const double depth = model.depths(t.start + t.length / 2).false_lumen;
  const double open = std::max(3 * mm, 2 * d.flap.corner_fillet);
  if (t.thickness > depth - open)
    problems.add("thrombus.thickness",
                 fmt::format("is {}, the false lumen there is {} deep", in_mm(t.thickness), in_mm(depth)),
                 depth - open > 1.5 * mm
                     ? fmt::format("leave {} to the blood: give at most {}", in_mm(open), in_mm(depth - open))
                     : "make the false lumen deeper: a smaller true_lumen_share");
}

/// Smallest distance of the points of two straight lines, sampled.
double distance(const DissectionModel::Tube& a, double a_from, const DissectionModel::Tube& b, double b_from) {
  double least = 1;
  constexpr int samples = 40;
  for (int i = 0; i <= samples; ++i) {
    const Point p = a.origin + std::lerp(a_from, a.length, i / double(samples)) * a.axis;
    const double along = std::clamp(dot(p - b.origin, b.axis), b_from, b.length);
    least = std::min(least, norm(p - b.origin - along * b.axis));
  }
  return least;
}

void check_branch(const ParametricDissection& d, const DissectionModel& model, const std::string& key,
                  const BranchShape& branch, const DissectionModel::Tube& tube, Problems& problems) {
  const double R = model.aorta_radius(std::min(branch.position, d.length()));
  const double room = (branch.radius + branch.wall_thickness) / std::cos(branch.inclination) + d.aorta.branch_fillet;
  if (branch.radius > 0.75 * R)
    problems.add(key + ".radius", fmt::format("is {}, the aorta there has {}", in_mm(branch.radius), in_mm(R)),
                 fmt::format("give at most {}", in_mm(0.75 * R)));
  // Where the axis leaves the lumen of the aorta.
  const double leaves = branch.position + R * std::tan(branch.inclination);
  const double end = d.length() - (d.iliacs ? R : 0);
  if (std::min(leaves, branch.position) - room < 2 * mm || std::max(leaves, branch.position) + room > end - 2 * mm)
    problems.add(key + ".position",
                 fmt::format("is {}: the branch would reach beyond an end of the aorta", in_mm(branch.position)),
                 fmt::format("place it between {} and {}", in_mm(room + 2 * mm), in_mm(end - room - 2 * mm)));
  const double first = d.flap.start, last = d.flap.start + d.flap.length;
  if (std::max(leaves, branch.position) + room > first && std::min(leaves, branch.position) - room < last)
    problems.add(key + ".position",
                 fmt::format("is {}: the branch would leave from the dissected part, {} to {}", in_mm(branch.position),
                             in_mm(first), in_mm(last)),
                 fmt::format("keep {} away from it: move the branch or the flap", in_mm(room)));
  const double clear = branch.radius + branch.wall_thickness + d.aorta.branch_fillet + 1 * mm;
  if (model.outside_aorta(tube.origin + tube.length * tube.axis) < clear)
    problems.add(key + ".length", fmt::format("is {}: its end is too near the aorta", in_mm(branch.length)),
                 "make the branch longer, or incline it less");
}

void check_branches(const ParametricDissection& d, const DissectionModel& model, Problems& problems) {
  const auto branches = d.branches();
  const auto& tubes = model.tubes();
  const auto origin = [&](std::size_t i) {
    return i < branches.size() ? tubes[i].length - branches[i].second.length : tubes[i].length - d.iliacs->length;
  };
  for (std::size_t i = 0; i < branches.size(); ++i)
    check_branch(d, model, branches[i].first, branches[i].second, tubes[i], problems);
  for (std::size_t i = 0; i < tubes.size(); ++i)
    for (std::size_t j = i + 1; j < tubes.size(); ++j) {
      if (i >= branches.size()) continue;  // the iliacs leave together
      const double least = tubes[i].radius + tubes[i].wall_thickness + tubes[j].radius + tubes[j].wall_thickness;
      const double found = distance(tubes[i], origin(i), tubes[j], origin(j));
      if (found < least + 1 * mm)
        problems.add(
            branches[i].first,
            fmt::format("overlaps {}: their axes come as near as {}, radii and walls add up to {}",
                        j < branches.size() ? branches[j].first : "an iliac artery", in_mm(found), in_mm(least)),
            "move them apart, or make them thinner");
    }
}

void check_iliacs(const ParametricDissection& d, Problems& problems) {
  if (!d.iliacs) return;
  const auto& i = *d.iliacs;
  const double outer = i.radius + i.wall_thickness, R = d.aorta.abdominal_radius;
  if (i.radius > 0.75 * R)
    problems.add("iliacs.radius", fmt::format("is {}, the aorta there has {}", in_mm(i.radius), in_mm(R)),
                 fmt::format("give at most {}", in_mm(0.75 * R)));
  const double apart = 2 * (i.length + R) * std::sin(i.angle);
  if (apart < 2 * outer + 2 * d.aorta.branch_fillet)
    problems.add("iliacs", fmt::format("end {} apart, radii and walls add up to {}", in_mm(apart), in_mm(2 * outer)),
                 "give a larger angle or length");
}

}  // namespace

std::vector<std::pair<std::string, BranchShape>> ParametricDissection::branches() const {
  std::vector<std::pair<std::string, BranchShape>> all = {{"brachiocephalic", brachiocephalic},
                                                          {"left_common_carotid", left_common_carotid},
                                                          {"left_subclavian", left_subclavian}};
  if (celiac) all.emplace_back("celiac", *celiac);
  if (superior_mesenteric) all.emplace_back("superior_mesenteric", *superior_mesenteric);
  if (left_renal) all.emplace_back("left_renal", *left_renal);
  if (right_renal) all.emplace_back("right_renal", *right_renal);
  return all;
}

double ParametricDissection::length() const {
  return aorta.ascending_length + aorta.arch_bend_radius * aorta.arch_angle + aorta.descending_length;
}

Problems impossibilities(const ParametricDissection& shape) {
  Problems problems;
  check_aorta(shape, problems);
  check_flap_place(shape, problems);
  check_iliacs(shape, problems);
  if (!problems.errors.empty()) return problems;  // the rest looks at the body, which these make meaningless
  const DissectionModel model(shape);
  check_lumens(shape, model, problems);
  check_tears(shape, model, problems);
  check_branches(shape, model, problems);
  check_thrombus(shape, model, problems);
  return problems;
}

Schema<ParametricDissection> ParametricDissection::schema() {
  using P = ParametricDissection;
  const P usual;
  Schema<P> schema("parametric",
                   "Idealised type-B dissection. Positions are lengths along the centreline of the aorta from the "
                   "inlet, radii those of the lumen.");
  schema.section("aorta", &P::aorta, aorta_schema(), "The aorta").by_default();
  schema.section("flap", &P::flap, flap_schema(), "Flap and tears").by_default();
  const auto arch = [&](const char* name, BranchShape P::*branch) {
    schema.section(name, branch, branch_schema(name, usual.*branch), "Branch of the arch").by_default();
  };
  arch("brachiocephalic", &P::brachiocephalic);
  arch("left_common_carotid", &P::left_common_carotid);
  arch("left_subclavian", &P::left_subclavian);
  const auto visceral = [&](const char* name, std::optional<BranchShape> P::*branch, const BranchShape& sizes) {
    schema.section(name, branch, branch_schema(name, sizes),
                   "Visceral branch; `{}` for the usual one, none when left out");
  };
  visceral("celiac", &P::celiac, usual_celiac());
  visceral("superior_mesenteric", &P::superior_mesenteric, usual_superior_mesenteric());
  visceral("left_renal", &P::left_renal, usual_left_renal());
  visceral("right_renal", &P::right_renal, usual_right_renal());
  schema.section("iliacs", &P::iliacs, iliac_schema(),
                 "`{}` for the usual ones; when left out the aorta ends in a plane");
  schema.section("thrombus", &P::thrombus, thrombus_schema(),
                 "Partial thrombosis of the false lumen: region `thrombus` of the wall; `{}` for the usual one, none "
                 "when left out");
  return schema.check([](const P& shape, Problems& problems) {
    const Problems found = impossibilities(shape);
    problems.errors.insert(problems.errors.end(), found.errors.begin(), found.errors.end());
  });
}

}  // namespace tunica::geometry
