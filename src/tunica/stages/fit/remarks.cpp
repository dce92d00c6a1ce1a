#include "tunica/stages/fit/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tunica::stages {

namespace {

using fitting::Identification;

bool in_plane_only(const std::vector<fitting::Protocol>& protocols) {
  return std::all_of(protocols.begin(), protocols.end(), [](const fitting::Protocol& p) {
    const bool planar_axes = std::abs(p.axes.e1[2]) < 1e-6 && std::abs(p.axes.e2[2]) < 1e-6;
    return p.loading == fitting::Loading::uniaxial ? std::abs(p.axes.e1[2]) < 1e-6 : planar_axes;
  });
}

/// Is it a dispersion across the wall?
bool is_out_of_plane(const std::string& key) {
  return key.ends_with("bivariate_von_mises.b") || key.ends_with("kappa_op") || key.ends_with("b_rr");
}

/// Where the vessel works: does the law come there, was it tested so far, is it convex up to there?
void add_in_vivo(const FittedModel& f, const InVivo& v, const case_file::InVivoStress& stress,
                 std::vector<std::string>& remarks) {
  const std::string whose = f.in_vivo.size() > 1 ? " of " + v.specimen : "";
  const std::string load = fmt::format("{:.4g}/{:.4g} kPa", 1e-3 * stress.circumferential, 1e-3 * stress.longitudinal);
  if (v.not_convex_at)
    remarks.push_back(fmt::format(
        "The law{} is not convex at stretches of {:.3f}/{:.3f}, in the range of the vessel: more strain may come with "
        "less stress there. Narrow the bounds, fix what is not identified, or take another law.",
        whose, (*v.not_convex_at)[0], (*v.not_convex_at)[1]));
  if (!v.point) {
    remarks.push_back(fmt::format("The law{} does not come to the stress in vivo, {}.", whose, load));
    return;
  }
  const auto tested = fitting::tested_stretch(f.model.protocols());
  for (std::size_t i = 0; i < 2; ++i) {
    const double stretch = v.point->stretch[i];
    const char* axis = i == 0 ? "e1" : "e2";
    if (!tested[i])
      remarks.push_back(fmt::format("Extrapolated: no test stretches along {}; in vivo ({}) the law{} does, by {:.3f}.",
                                    axis, load, whose, stretch));
    else if (stretch > *tested[i])
      remarks.push_back(
          fmt::format("Extrapolated: in vivo ({}) the law{} is stretched by {:.3f} along {}, and tests end at {:.3f}.",
                      load, whose, stretch, axis, *tested[i]));
  }
}

}  // namespace

std::vector<std::string> remarks_on_data(const std::vector<fitting::Protocol>& protocols) {
  std::vector<std::string> remarks;
  for (const fitting::Protocol& p : protocols) {
    double worst = 0.0;
    int line = 0;
    for (const fitting::Row& row : p.rows)
      if (row.F && std::abs(determinant(*row.F) - 1.0) > worst) {
        worst = std::abs(determinant(*row.F) - 1.0);
        line = row.line;
      }
    constexpr double rounding = 1e-4;
    if (worst > rounding)
      remarks.push_back(fmt::format(
          "{}, {}: det F is up to {:.2g} % from 1 ({}:{}). The stretch across the sheet was replaced by the "
          "one that keeps the volume.",
          p.specimen, p.name, 100.0 * worst, p.file, line));
  }
  return remarks;
}

std::string remark_on(const FittedModel& f, std::size_t i) {
  const fitting::Determination& d = f.uncertainty.unknowns[i];
  const fitting::Parameter& p = f.model.parameter(i);
  const std::string& name = f.model.unknowns()[i].name;
  const std::string from = p.text(p.value(d.profile.low), 3), to = p.text(p.value(d.profile.high), 3);
  if (d.identification == Identification::not_identified) {
    std::string text =
        fmt::format("{} is not identified by these tests: values from {} to {} fit as well{}.", name, from, to,
                    d.open_below && d.open_above ? ", which are both bounds"
                    : d.open_above               ? ", the upper bound"
                                                 : ", the lower of which is a bound");
    const bool out_of_plane = is_out_of_plane(f.model.law().key(f.model.unknowns()[i].parameter));
    if (out_of_plane && in_plane_only(f.model.protocols()))
      text +=
          " It acts across the wall, and tests in the plane of the wall do not see that: take it from histology and "
          "write the number in its place, or add a test out of the plane.";
    else
      text += " Write a number from another source in its place, or add a test that it acts in.";
    return text;
  }
  constexpr double at_bound = 1e-4;
  if (f.fit.x[i] < at_bound || f.fit.x[i] > 1.0 - at_bound)
    return fmt::format("{} sits on its bound, {}: widen the bound, or ask whether the law suits.", name,
                       p.text(f.model.values(f.fit.x)[i]));
  if (d.identification == Identification::weak)
    return fmt::format("{} is weakly identified: values from {} to {} fit as well.", name, from, to);
  return "";
}

std::vector<std::string> remarks_on(const FittedModel& f, const case_file::InVivoStress& stress) {
  std::vector<std::string> remarks;
  for (std::size_t i = 0; i < f.fit.x.size(); ++i)
    if (std::string text = remark_on(f, i); !text.empty()) remarks.push_back(std::move(text));
  if (!f.fit.converged) remarks.push_back("The search has not converged: give more starts, or narrow the bounds.");
  const std::size_t n = f.fit.start_squares.size(), agreeing = f.fit.agreeing_starts();
  if (n > 1 && agreeing < 2)
    remarks.push_back(fmt::format(
        "Only {} of {} starts came so low: there may be a lower minimum. Give more starts, or narrow the bounds.",
        agreeing, n));
  for (const InVivo& v : f.in_vivo) add_in_vivo(f, v, stress, remarks);
  return remarks;
}

}  // namespace tunica::stages
