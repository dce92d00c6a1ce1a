#include "tunica/wall/materials/fung.hpp"

namespace tunica::wall {

namespace {

void check_definite(const FungParameters& p, config::Problems& problems) {
  const double minor = p.b_cc * p.b_ll - p.b_cl * p.b_cl;
  const double det = determinant(Symmetric<double>{{p.b_cc, p.b_ll, p.b_rr, p.b_cl, p.b_lr, p.b_rc}});
  if (!(minor > 0.0 && det > 0.0))
    problems.add("", "the exponent Q is not positive definite, so the law loses convexity",
                 "make b_cl, b_lr, b_rc smaller against b_cc, b_ll, b_rr (principal minors must be positive)");
}

}  // namespace

config::Schema<FungParameters> FungParameters::schema() {
  using P = FungParameters;
  using config::above;
  return config::Schema<P>("fung", "Orthotropic law of Fung type, c/2 (exp Q - 1).")
      .quantity("c", &P::c, config::dimension::pressure, above(0), "Stress-like factor")
      .plausible("0.1 kPa", "10 MPa")
      .number("b_cc", &P::b_cc, above(0), "Factor of Ecc^2 in Q; c circumferential")
      .number("b_ll", &P::b_ll, above(0), "Factor of Ell^2; l longitudinal")
      .number("b_rr", &P::b_rr, above(0), "Factor of Err^2; r radial")
      .number("b_cl", &P::b_cl, config::anything(), "Half the factor of Ecc Ell")
      .number("b_lr", &P::b_lr, config::anything(), "Half the factor of Ell Err")
      .number("b_rc", &P::b_rc, config::anything(), "Half the factor of Err Ecc")
      .number("g_cl", &P::g_cl, above(0), "Factor of Ecl^2; the shear modulus at rest is c g_cl / 4")
      .number("g_lr", &P::g_lr, above(0), "Factor of Elr^2")
      .number("g_rc", &P::g_rc, above(0), "Factor of Erc^2")
      .include(&P::compressibility, Compressibility::schema())
      .check(check_definite);
}

}  // namespace tunica::wall
