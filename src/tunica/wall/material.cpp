#include "tunica/wall/material.hpp"

#include <cmath>

#include "tunica/wall/materials/aortic_tissue.hpp"

namespace tunica::wall {

namespace {

template <class... P>
config::Schema<std::variant<P...>> laws_of(const std::variant<P...>*) {
  config::Schema<std::variant<P...>> s("material", "Wall law.");
  s.one_of();
  (s.alternative(P::schema()), ...);
  return s.choice(
      "aortic_tissue", config::emplace<DfdParameters>,
      {{"true_lumen_wall", aortic_tissue(AorticTissue::true_lumen_wall)},
       {"false_lumen_wall", aortic_tissue(AorticTissue::false_lumen_wall)},
       {"flap", aortic_tissue(AorticTissue::flap)},
       {"chronic_adventitia", aortic_tissue(AorticTissue::chronic_adventitia)}},
      "Dispersed fibres with parameters for a part of the dissected aorta, where none are measured: moduli of "
      "the healthy aorta, but for `chronic_adventitia`, which was measured in chronic dissection");
}

struct FittedFile {
  LawParameters material;
};

/// The section `material` of a file that `tunica fit` has written. It holds a law itself and names no other file.
LawParameters read_fitted(const std::string& file) {
  const auto schema = config::Schema<FittedFile>("fitted", "A law that was fitted to tests.")
                          .section("material", &FittedFile::material,
                                   laws_of(static_cast<const LawParameters*>(nullptr)), "Law and its parameters");
  return config::parse_file(schema, file).value.material;
}

Vec3<double> in_plane(double angle) { return {{std::cos(angle), std::sin(angle), 0.0}}; }

Vec3<double> mean_direction(const HgoParameters::Family& family) { return in_plane(family.mean_angle); }
Vec3<double> mean_direction(const GohParameters::Family& family) { return in_plane(family.mean_angle); }
Vec3<double> mean_direction(const dfd::Family& family) {
  const auto density = family.density();
  if (const auto* d = std::get_if<VonMises>(&density)) return d->mean_direction;
  return in_plane(std::get<BivariateVonMises>(density).mean_angle);
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
         !std::holds_alternative<MooneyRivlinParameters>(parameters) &&
         !std::holds_alternative<StVenantKirchhoffParameters>(parameters);
}

std::vector<Vec3<double>> mean_fibre_directions(const LawParameters& parameters) {
  std::vector<Vec3<double>> directions;
  std::visit(
      [&](const auto& p) {
        if constexpr (requires { p.families; })
          for (const auto& family : p.families) directions.push_back(mean_direction(family));
      },
      parameters);
  return directions;
}

config::Schema<LawParameters> law_schema() {
  auto schema = laws_of(static_cast<const LawParameters*>(nullptr));
  // The one key whose value stands in another file.
  config::Field& fitted = schema.description()->fields.emplace_back();
  fitted.key = "fitted";
  fitted.kind = config::Kind::file;
  fitted.help = "File that `tunica fit` has written: a law with its parameters";
  fitted.store = [](void* object, const config::Value& value) {
    *static_cast<LawParameters*>(object) = read_fitted(std::get<std::string>(value));
  };
  return schema;
}

}  // namespace tunica::wall
