#include "tunica/fitting/model.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tunica/base/error.hpp"

namespace tunica::fitting {

Model::Model(const LawTemplate& law, const std::vector<Protocol>& protocols, std::optional<bool> incompressible,
             wall::VolumetricEnergy energy)
    : law_(law), protocols_(&protocols), incompressible_(incompressible), energy_(energy) {
  for (const Protocol& p : protocols)
    if (std::find(specimens_.begin(), specimens_.end(), p.specimen) == specimens_.end())
      specimens_.push_back(p.specimen);
  for (std::size_t i = 0; i < law_.parameters().size(); ++i) {
    const Parameter& p = law_.parameters()[i];
    if (!p.own || specimens_.size() == 1) {
      unknowns_.push_back({i, std::nullopt, p.name});
      continue;
    }
    for (const std::string& s : specimens_) unknowns_.push_back({i, s, p.name + " of " + s});
  }
}

std::vector<double> Model::start() const {
  std::vector<double> x;
  for (std::size_t i = 0; i < unknowns_.size(); ++i)
    x.push_back(std::clamp(parameter(i).scaled(parameter(i).start), 0.0, 1.0));
  return x;
}

std::vector<double> Model::values(std::span<const double> scaled) const {
  std::vector<double> v;
  for (std::size_t i = 0; i < unknowns_.size(); ++i) v.push_back(parameter(i).value(scaled[i]));
  return v;
}

std::vector<double> Model::values_of(const std::string& specimen, std::span<const double> scaled) const {
  std::vector<double> v(law_.parameters().size());
  for (std::size_t i = 0; i < unknowns_.size(); ++i)
    if (!unknowns_[i].specimen || *unknowns_[i].specimen == specimen)
      v[unknowns_[i].parameter] = parameter(i).value(scaled[i]);
  return v;
}

wall::LawParameters Model::parameters_of(const std::string& specimen, std::span<const double> scaled) const {
  return law_.at(values_of(specimen, scaled));
}

void Model::choose_directions(std::span<const double> scaled, double tolerance) {
  wall::RuleSize largest;
  for (const std::string& s : specimens_) {
    const wall::LawParameters parameters = parameters_of(s, scaled);
    const auto* dispersed = std::get_if<wall::DfdParameters>(&parameters);
    if (!dispersed) return;
    wall::RuleSize rule;
    if (const auto* given = std::get_if<wall::dfd::Product>(&dispersed->rule))
      rule = {given->across, given->around};
    else if (std::holds_alternative<wall::dfd::Automatic>(dispersed->rule))
      rule = wall::rule_size_for(*dispersed, tolerance);
    else
      return;  // octahedral: the law is made as a case makes it
    largest = {std::max(largest.across, rule.across), std::max(largest.around, rule.around)};
  }
  directions_ = largest;
}

wall::Law Model::make_law(const wall::LawParameters& parameters) const {
  const auto* dispersed = std::get_if<wall::DfdParameters>(&parameters);
  if (dispersed && directions_) return wall::law_with(*dispersed, *directions_);
  return wall::make_law(parameters);
}

wall::Volumetric Model::volumetric(const wall::LawParameters& parameters) const {
  if (incompressible_ == true) return {energy_};
  return {energy_, wall::bulk_modulus(parameters)};
}

std::vector<std::vector<double>> Model::predicted(std::span<const double> scaled) const {
  struct Prepared {
    wall::Law law;
    wall::Volumetric volumetric;
  };
  std::map<std::string, Prepared> laws;
  const bool shared = std::none_of(unknowns_.begin(), unknowns_.end(), [](const Unknown& u) { return u.specimen; });
  std::vector<std::vector<double>> all;
  for (const Protocol& p : *protocols_) {
    const std::string key = shared ? "" : p.specimen;
    auto at = laws.find(key);
    if (at == laws.end()) {
      const wall::LawParameters parameters = parameters_of(p.specimen, scaled);
      at = laws.emplace(key, Prepared{make_law(parameters), volumetric(parameters)}).first;
    }
    all.push_back(fitting::predicted(at->second.law, at->second.volumetric, p));
  }
  return all;
}

bool Model::residuals(std::span<const double> scaled, const std::vector<std::vector<double>>& targets,
                      std::vector<double>& out) const {
  out.clear();
  try {
    const auto stresses = predicted(scaled);
    constexpr double per_pascal = 1e-3;
    for (std::size_t k = 0; k < stresses.size(); ++k) {
      const double factor = std::sqrt((*protocols_)[k].weight) * per_pascal;
      for (std::size_t i = 0; i < stresses[k].size(); ++i) {
        out.push_back(factor * (stresses[k][i] - targets[k][i]));
        if (!std::isfinite(out.back())) return false;
      }
    }
  } catch (const SolverError&) {
    return false;
  } catch (const InputError&) {  // values that the law's schema refuses
    return false;
  }
  return true;
}

Residuals Model::against(std::vector<std::vector<double>> targets) const {
  return [this, targets = std::move(targets)](std::span<const double> x, std::vector<double>& r) {
    return residuals(x, targets, r);
  };
}

std::vector<std::vector<double>> Model::measured() const {
  std::vector<std::vector<double>> all;
  for (const Protocol& p : *protocols_) all.push_back(fitting::measured(p));
  return all;
}

std::size_t Model::count() const {
  std::size_t n = 0;
  for (const Protocol& p : *protocols_) n += p.values();
  return n;
}

}  // namespace tunica::fitting
