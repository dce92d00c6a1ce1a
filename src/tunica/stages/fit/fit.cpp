#include "tunica/stages/fit/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tunica/base/error.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/lock.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/stages/fit/measured.hpp"
#include "tunica/stages/fit/remarks.hpp"

namespace tunica::stages {

namespace {

using fitting::Identification;

nlohmann::ordered_json to_json(const std::vector<InVivo>& in_vivo) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const InVivo& v : in_vivo) {
    if (!v.point) continue;
    nlohmann::ordered_json intervals = nlohmann::ordered_json::array();
    for (const fitting::Interval& i : v.moduli) intervals.push_back({i.low, i.high});
    list.push_back({{"specimen", v.specimen},
                    {"stretch", v.point->stretch},
                    {"moduli_Pa", v.point->moduli},
                    {"moduli_95_Pa", intervals},
                    {"convex", !v.not_convex_at}});
  }
  return list;
}

nlohmann::ordered_json to_json(const FittedModel& f) {
  nlohmann::ordered_json parameters = nlohmann::ordered_json::array(), protocols = nlohmann::ordered_json::array();
  const auto values = f.model.values(f.fit.x);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const fitting::Parameter& p = f.model.parameter(i);
    const fitting::Determination& d = f.uncertainty.unknowns[i];
    const auto interval = [&](const fitting::Interval& x) {
      return nlohmann::ordered_json{p.value(x.low) / p.per_unit(), p.value(x.high) / p.per_unit()};
    };
    parameters.push_back({{"name", f.model.unknowns()[i].name},
                          {"unit", p.unit()},
                          {"value", values[i] / p.per_unit()},
                          {"interval_95", interval(d.interval)},
                          {"bootstrap_95", interval(d.bootstrap)},
                          {"profile_95", interval(d.profile)},
                          {"identified", d.identification == Identification::identified}});
  }
  for (std::size_t k = 0; k < f.fit.by_protocol.size(); ++k) {
    const fitting::Protocol& p = f.model.protocols()[k];
    protocols.push_back({{"specimen", p.specimen},
                         {"name", p.name},
                         {"rmse_Pa", f.fit.by_protocol[k].rms},
                         {"r_squared", f.fit.by_protocol[k].r_squared.value_or(0.0)}});
  }
  return {{"law", f.name},
          {"r_squared", f.fit.overall.r_squared.value_or(0.0)},
          {"rmse_Pa", f.fit.overall.rms},
          {"aic", f.criteria.aic},
          {"bic", f.criteria.bic},
          {"correlation_length", f.fit.correlation.length},
          {"block", f.uncertainty.block},
          {"replicates", f.uncertainty.replicates.size()},
          {"parameters", parameters},
          {"correlation", f.uncertainty.correlation},
          {"protocols", protocols},
          {"in_vivo", to_json(f.in_vivo)},
          {"remarks", f.remarks}};
}

void write_materials(const FittedModel& f, const std::filesystem::path& folder) {
  const auto& unknowns = f.model.unknowns();
  const bool own = std::any_of(unknowns.begin(), unknowns.end(), [](const auto& u) { return u.specimen; });
  const auto write = [&](const std::string& specimen, const std::string& name) {
    const std::string text = fmt::format(
        "# Fitted by `tunica fit`: R^2 {:.5f}, root of the mean square deviation {:.4g} kPa.\n"
        "# For a case: paste the section, or name this file by `material: {{fitted: {}.yaml}}`.\n{}",
        f.fit.overall.r_squared.value_or(0.0), 1e-3 * f.fit.overall.rms, name,
        f.model.law().yaml(f.model.values_of(specimen, f.fit.x)));
    files::write_atomically(folder / (name + ".yaml"), text);
  };
  if (!own) return write(f.model.specimens().front(), f.name);
  for (const auto& specimen : f.model.specimens()) write(specimen, f.name + "_" + specimen);
}

void print(const FittedModel& f, std::FILE* screen) {
  std::fprintf(screen, "%s: R^2 %.5f, rmse %.4g kPa, %zu of %zu starts came so low\n", f.name.c_str(),
               f.fit.overall.r_squared.value_or(0.0), 1e-3 * f.fit.overall.rms, f.fit.agreeing_starts(),
               f.fit.start_squares.size());
  const auto values = f.model.values(f.fit.x);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const fitting::Parameter& p = f.model.parameter(i);
    const fitting::Determination& d = f.uncertainty.unknowns[i];
    std::fprintf(screen, "  %-20s %14s   95 %% %s to %s%s\n", f.model.unknowns()[i].name.c_str(),
                 p.text(values[i]).c_str(), p.text(p.value(d.interval.low), 3).c_str(),
                 p.text(p.value(d.interval.high), 3).c_str(),
                 d.identification == Identification::not_identified ? "   NOT IDENTIFIED" : "");
  }
  for (const auto& remark : f.remarks) std::fprintf(screen, "  %s\n", remark.c_str());
}

InVivo in_vivo(const FittedModel& f, const std::string& specimen, const case_file::InVivoStress& stress) {
  const fitting::SheetLoad load{stress.circumferential, stress.longitudinal};
  const auto law_at = [&](std::span<const double> x) { return f.model.make_law(f.model.parameters_of(specimen, x)); };
  const wall::Law law = law_at(f.fit.x);
  InVivo v{specimen, fitting::vessel_point(law, load), {}};
  auto largest = fitting::tested_stretch(f.model.protocols());
  std::array<double, 2> range;
  for (std::size_t i = 0; i < 2; ++i)
    range[i] = std::max(largest[i].value_or(1.0), v.point ? v.point->stretch[i] : 1.0);
  v.not_convex_at = fitting::not_convex_at(law, range);
  if (!v.point) return v;
  std::array<std::vector<double>, 3> moduli;
  for (const auto& x : f.uncertainty.replicates)
    if (const auto point = fitting::vessel_point(law_at(x), load))
      for (std::size_t k = 0; k < 3; ++k) moduli[k].push_back(point->moduli[k]);
  for (auto& values : moduli)
    if (!values.empty()) v.moduli.push_back(fitting::percentiles(std::move(values)));
  return v;
}

FittedModel fitted(const std::string& name, const fitting::LawTemplate& law,
                   const std::vector<fitting::Protocol>& protocols, const case_file::FitCase& c) {
  fitting::Model model(law, protocols, c.incompressible, c.volumetric_energy);
  if (model.count() <= model.unknowns().size())
    throw InputError(
        "laws." + name,
        fmt::format("has {} values to be found, and {} are measured", model.unknowns().size(), model.count()),
        "measure more, or fix parameters by a number in their place");
  fitting::Fit fit = fitting::fit(model, {.starts = c.fit.starts});
  auto uncertainty = fitting::uncertainty(
      model, fit, {.replicates = c.fit.replicates, .seed = static_cast<std::uint64_t>(c.fit.seed)});
  auto held_out = fitting::held_out(model, fit);
  FittedModel f{name, std::move(model), std::move(fit), std::move(uncertainty), std::move(held_out), {}};
  const auto& unknowns = f.model.unknowns();
  const bool own = std::any_of(unknowns.begin(), unknowns.end(), [](const auto& u) { return u.specimen; });
  for (const std::string& specimen : f.model.specimens()) {
    f.in_vivo.push_back(in_vivo(f, specimen, c.in_vivo));
    if (!own) break;
  }
  f.remarks = remarks_on(f, c.in_vivo);
  return f;
}

/// The best by BIC first.
std::vector<FittedModel> ranked(std::vector<FittedModel> fits) {
  std::vector<const fitting::Fit*> all;
  for (const FittedModel& f : fits) all.push_back(&f.fit);
  const auto criteria = fitting::criteria(all);
  std::vector<std::size_t> order(fits.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    order[k] = k;
    fits[k].criteria = criteria[k];
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return criteria[a].bic < criteria[b].bic; });
  std::vector<FittedModel> sorted;
  for (const std::size_t k : order) sorted.push_back(fits[k]);
  return sorted;
}

}  // namespace

void run_fit(const std::filesystem::path& file, const std::optional<std::filesystem::path>& directory,
             std::FILE* screen) {
  const case_file::ReadFitCase read = case_file::read_fit_case(file);
  const case_file::FitCase& c = read.value;
  for (const Problem& warning : read.warnings) std::fprintf(screen, "warning: %s\n", format(warning).c_str());
  const std::vector<fitting::Protocol> protocols = read_protocols(c);
  const std::filesystem::path folder = directory.value_or(c.output.directory);
  const files::FolderLock lock(folder);
  if (!lock.taken_over().empty()) std::fprintf(screen, "warning: %s\n", lock.taken_over().c_str());
  files::try_outputs(folder, {"fit.html", "fit.json"});
  const std::vector<std::string> repaired = remarks_on_data(protocols);
  for (const std::string& remark : repaired) std::fprintf(screen, "warning: %s\n", remark.c_str());
  std::vector<FittedModel> fits;
  for (std::size_t k = 0; k < read.laws.size(); ++k) {
    print(fits.emplace_back(fitted(c.laws[k].first, read.laws[k], protocols, c)), screen);
    std::fflush(screen);
  }
  fits = ranked(std::move(fits));
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const FittedModel& f : fits) {
    json.push_back(to_json(f));
    write_materials(f, folder);
  }
  files::write_atomically(folder / "fit.json", json.dump(2) + "\n");
  files::write_atomically(folder / "fit.html", fit_page(c, protocols, fits, repaired));
  std::string names;
  for (const FittedModel& f : fits) names += (names.empty() ? "" : ", ") + f.name;
  std::fprintf(screen, "%s%s\n%s\n", fits.size() > 1 ? "best first: " : "", names.c_str(),
               (folder / "fit.html").string().c_str());
}

}  // namespace tunica::stages
