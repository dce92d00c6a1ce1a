#include "tunica/bc/outlets.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <utility>

#include "tunica/base/error.hpp"

namespace tunica::bc {

namespace {

/// phi1(z) = (1 - e^-z)/z and phi2(z) = (1 - phi1(z))/z for z >= 0, without cancellation near zero.
std::pair<double, double> decay_functions(double z) {
  if (z > 0.5) {
    const double phi1 = -std::expm1(-z) / z;
    return {phi1, (1.0 - phi1) / z};
  }
  // phi2 = sum_{k>=0} (-z)^k / (k+2)!; 16 terms leave less than 1e-20 at z = 0.5.
  double term = 0.5, phi2 = 0.5;
  for (int k = 1; k < 16; ++k) {
    term *= -z / (k + 2);
    phi2 += term;
  }
  return {1.0 - z * phi2, phi2};
}

void require(std::vector<Problem>& problems, bool good, const std::string& face, const char* what, double value,
             const char* range) {
  if (good) return;
  problems.push_back({"boundary." + face, fmt::format("{} = {} is not {}", what, value, range),
                      fmt::format("give a finite {} that is {}", what, range)});
}

}  // namespace

Outlet::Outlet(std::string face, const std::variant<Resistance, Rcr>& model) : face_(std::move(face)) {
  std::vector<Problem> problems;
  if (const auto* r = std::get_if<Resistance>(&model)) {
    require(problems, std::isfinite(r->resistance) && r->resistance >= 0, face_, "resistance", r->resistance, ">= 0");
    require(problems, std::isfinite(r->distal_pressure), face_, "distal_pressure", r->distal_pressure, "finite");
    proximal_ = r->resistance;
    distal_pressure_ = capacitor_ = r->distal_pressure;
  } else {
    const auto& m = std::get<Rcr>(model);
    const double initial = m.initial_pressure.value_or(m.distal_pressure);
    require(problems, std::isfinite(m.proximal) && m.proximal >= 0, face_, "proximal", m.proximal, ">= 0");
    require(problems, std::isfinite(m.capacitance) && m.capacitance > 0, face_, "capacitance", m.capacitance,
            "> 0 (without capacitance use a resistance)");
    require(problems, std::isfinite(m.distal) && m.distal > 0, face_, "distal", m.distal, "> 0");
    require(problems, std::isfinite(m.distal_pressure), face_, "distal_pressure", m.distal_pressure, "finite");
    require(problems, std::isfinite(initial), face_, "initial_pressure", initial, "finite");
    proximal_ = m.proximal;
    distal_ = m.distal;
    capacitance_ = m.capacitance;
    distal_pressure_ = m.distal_pressure;
    capacitor_ = initial;
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

Outlet::Stored Outlet::stored_after(double s, double end_flow) const {
  if (capacitance_ == 0) return {distal_pressure_, 0.0};
  // Variation of constants for x = P_c - P_d with Q = Q_n + (Q(s) - Q_n) t/s on 0 <= t <= s, z = s / (R_d C):
  // x(s) = e^-z x_n + s/C [(phi1 - phi2) Q_n + phi2 Q(s)]
  const double z = s / (distal_ * capacitance_), gain = s / capacitance_;
  const auto [phi1, phi2] = decay_functions(z);
  return {distal_pressure_ + std::exp(-z) * (capacitor_ - distal_pressure_) +
              gain * ((phi1 - phi2) * flow_ + phi2 * end_flow),
          gain * phi2};
}

OutletPressure Outlet::evaluate_at_alpha(double dt, double alpha_f, double alpha_flow) const {
  assert(dt > 0 && alpha_f > 0 && alpha_f <= 1);
  const Stored stored = stored_after(alpha_f * dt, alpha_flow);
  const double slope = stored.per_flow + proximal_;
  return {stored.pressure + proximal_ * alpha_flow, alpha_f * slope, slope};
}

OutletPressure Outlet::evaluate(double dt, double alpha_f, double end_flow) const {
  return evaluate_at_alpha(dt, alpha_f, (1.0 - alpha_f) * flow_ + alpha_f * end_flow);
}

void Outlet::commit(double dt, double end_flow) {
  assert(dt > 0);
  capacitor_ = stored_after(dt, end_flow).pressure;
  flow_ = end_flow;
}

double Outlet::pressure() const { return capacitor_ + proximal_ * flow_; }

void Outlet::restore(std::span<const double> values) {
  if (values.size() != 2 || !std::isfinite(values[0]) || !std::isfinite(values[1]))
    throw InputError(
        "boundary." + face_,
        fmt::format("the checkpoint holds {} values for this outlet, not two finite ones (Q, P_c)", values.size()),
        "restart with the boundary conditions of the run that wrote the checkpoint");
  flow_ = values[0];
  capacitor_ = values[1];
}

}  // namespace tunica::bc
