// Parameters of the dissected aorta: as the case file names them, and how stiff they are.
#include "tunica/wall/materials/aortic_tissue.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tunica/wall/material_paths.hpp"

namespace tunica::wall {
namespace {

constexpr AorticTissue tissues[] = {AorticTissue::true_lumen_wall, AorticTissue::false_lumen_wall, AorticTissue::flap};

/// Young's modulus at rest [Pa] along e1 (0) or e2 (1).
double modulus_at_rest(AorticTissue tissue, int axis) {
  const Law law = aortic_tissue(tissue).law();
  const Volumetric incompressible;
  const double strain = 1e-4;
  Vec3<double> along{};
  along[axis] = 1.0;
  const PathPoint start = deformed(law, incompressible, identity<double>());
  return stretched(law, incompressible, specimen_axes(along), {1.0 + strain, {}}, start).state.cauchy[axis] / strain;
}

TEST(AorticTissue, ModuliAtRestAreThoseOfTheAorta) {
  for (const AorticTissue tissue : tissues) {
    for (const int axis : {0, 1}) {
      EXPECT_GT(modulus_at_rest(tissue, axis), 200e3);
      EXPECT_LT(modulus_at_rest(tissue, axis), 800e3);
    }
    EXPECT_GT(modulus_at_rest(tissue, 0), modulus_at_rest(tissue, 1)) << "fibres lie nearer to the circumference";
  }
  for (const int axis : {0, 1}) {
    const double wall = modulus_at_rest(AorticTissue::true_lumen_wall, axis);
    EXPECT_GT(modulus_at_rest(AorticTissue::false_lumen_wall, axis), wall);
    EXPECT_LT(modulus_at_rest(AorticTissue::flap, axis), wall);
  }
}

/// `aortic_tissue: flap` stands for what the reference says of it, written out.
TEST(AorticTissue, CaseFilesNameThem) {
  const auto read = [](const std::string& yaml) {
    return std::get<DfdParameters>(config::parse_text(law_schema(), yaml).value);
  };
  const DfdParameters named = read("aortic_tissue: flap");
  const DfdParameters written = read(R"(dfd:
  shear_modulus: 80 kPa
  poisson_ratio: 0.49
  families:
    - {k1: 30 kPa, k2: 4, bivariate_von_mises: {a: 2.54, b: 19.44, mean_angle: 25 deg}}
    - {k1: 30 kPa, k2: 4, bivariate_von_mises: {a: 2.54, b: 19.44, mean_angle: -25 deg}}
)");
  const auto stress = [](const DfdParameters& p) {
    const Volumetric incompressible;
    const Law law = p.law();
    return stretched(law, incompressible, specimen_axes({{1.0, 0.2, 0.0}}), {1.2, 1.1},
                     deformed(law, incompressible, identity<double>()))
        .state.cauchy;
  };
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(stress(named)[i], stress(written)[i], 1e-6);
  EXPECT_NEAR(named.bulk_modulus(), written.bulk_modulus(), 1e-6);
  EXPECT_THROW(read("aortic_tissue: intima"), InputError);
}

}  // namespace
}  // namespace tunica::wall
