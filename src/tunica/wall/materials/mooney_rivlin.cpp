#include "tunica/wall/materials/mooney_rivlin.hpp"

namespace tunica::wall {

config::Schema<MooneyRivlinParameters> MooneyRivlinParameters::schema() {
  using P = MooneyRivlinParameters;
  return config::Schema<P>("mooney_rivlin", "Isotropic Mooney-Rivlin law, c1 (I1 - 3) + c2 (I2 - 3).")
      .quantity("c1", &P::c1, config::dimension::pressure, config::above(0), "Factor of the first invariant")
      .plausible("0.1 kPa", "1 GPa")
      .quantity("c2", &P::c2, config::dimension::pressure, config::at_least(0), "Factor of the second invariant")
      .include(&P::compressibility, Compressibility::schema());
}

}  // namespace tunica::wall
