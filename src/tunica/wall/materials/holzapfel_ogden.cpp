#include "tunica/wall/materials/holzapfel_ogden.hpp"

namespace tunica::wall {

config::Schema<HolzapfelOgdenParameters> HolzapfelOgdenParameters::schema() {
  using P = HolzapfelOgdenParameters;
  const auto pressure = config::dimension::pressure;
  config::Schema<P> schema("holzapfel_ogden",
                           "Orthotropic law of heart muscle, fibres along e1 and sheets along e2 (Holzapfel & Ogden "
                           "2009).");
  schema.quantity("a", &P::a, pressure, config::above(0), "Of the matrix; the shear modulus at rest")
      .plausible("1 Pa", "10 MPa")
      .number("b", &P::b, config::above(0), "Stiffening of the matrix");
  struct Term {
    const char *a, *b, *of;
    double P::*stress, P::*stiffening;
  };
  constexpr Term terms[] = {{"a_f", "b_f", "fibres", &P::a_f, &P::b_f},
                            {"a_s", "b_s", "sheets", &P::a_s, &P::b_s},
                            {"a_fs", "b_fs", "the angle between fibres and sheets", &P::a_fs, &P::b_fs}};
  for (const Term& term : terms)
    schema.quantity(term.a, term.stress, pressure, config::at_least(0), std::string("Of ") + term.of)
        .number(term.b, term.stiffening, config::at_least(0), std::string("Stiffening of ") + term.of);
  return schema.include(&P::options, FibreOptions::schema()).include(&P::compressibility, Compressibility::schema());
}

}  // namespace tunica::wall
