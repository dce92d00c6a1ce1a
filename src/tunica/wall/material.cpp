#include "tunica/wall/material.hpp"

namespace tunica::wall {

namespace {

template <class... P>
config::Schema<std::variant<P...>> schema_of(const std::variant<P...>*) {
  config::Schema<std::variant<P...>> s("material", "Wall law.");
  s.one_of();
  (s.alternative(P::schema()), ...);
  return s;
}

}  // namespace

Law make_law(const LawParameters& parameters) {
  return std::visit([](const auto& p) -> Law { return p.law(); }, parameters);
}

double bulk_modulus(const LawParameters& parameters) {
  return std::visit([](const auto& p) { return p.bulk_modulus(); }, parameters);
}

double matrix_shear_modulus(const LawParameters& parameters) {
  return std::visit([](const auto& p) { return p.shear_modulus(); }, parameters);
}

double shear_modulus_at_rest(const Law& law) {
  return std::visit([](const auto& l) { return l.shear_modulus_at_rest(); }, law);
}

bool has_unsplit_part(const Law& law) {
  return std::visit([](const auto& l) { return has_unsplit_part(l); }, law);
}

std::vector<std::string> notes(const Law& law) {
  const auto* discrete = std::get_if<DiscreteFibreLaw>(&law);
  return discrete ? discrete->notes : std::vector<std::string>{};
}

bool is_anisotropic(const LawParameters& parameters) {
  return !std::holds_alternative<NeoHookeParameters>(parameters) &&
         !std::holds_alternative<MooneyRivlinParameters>(parameters);
}

config::Schema<LawParameters> law_schema() { return schema_of(static_cast<const LawParameters*>(nullptr)); }

}  // namespace tunica::wall
