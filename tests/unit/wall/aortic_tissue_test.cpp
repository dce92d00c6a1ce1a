// Parameters of the dissected aorta: as the case file names them, and how stiff they are.
#include "tunica/wall/materials/aortic_tissue.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tunica/wall/material_paths.hpp"

namespace tunica::wall {
namespace {

/// Choosing a rule takes seconds without optimisation.
Law with_few_directions(DfdParameters p) {
  p.rule = dfd::Product{4, 16};
  return p.law();
}

/// Young's modulus at rest [Pa] along e1 and e2.
std::array<double, 2> moduli_at_rest(AorticTissue tissue) {
  const Law law = with_few_directions(aortic_tissue(tissue));
  const Volumetric incompressible;
  const double strain = 1e-4;
  const PathPoint start = deformed(law, incompressible, identity<double>());
  std::array<double, 2> moduli{};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    Vec3<double> along{};
    along[static_cast<int>(axis)] = 1.0;
    moduli[axis] =
        stretched(law, incompressible, specimen_axes(along), {1.0 + strain, {}}, start).state.cauchy[axis] / strain;
  }
  return moduli;
}

TEST(AorticTissue, ModuliAtRestAreThoseOfTheAorta) {
  const auto wall = moduli_at_rest(AorticTissue::true_lumen_wall),
             outer = moduli_at_rest(AorticTissue::false_lumen_wall), flap = moduli_at_rest(AorticTissue::flap);
  for (const auto& moduli : {wall, outer, flap}) {
    EXPECT_GT(moduli[0], moduli[1]) << "fibres lie nearer to the circumference";
    EXPECT_GT(moduli[1], 200e3);
    EXPECT_LT(moduli[0], 800e3);
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    EXPECT_GT(outer[axis], wall[axis]);
    EXPECT_LT(flap[axis], wall[axis]);
  }
}

// Of chronic dissection, and what the parameters with the moduli of the healthy aorta have in its place.
TEST(AorticTissue, ChronicAdventitiaIsAsMeasured) {
  struct State {
    std::array<double, 2> strain, stress;  ///< E11, E22; S11, S22 [kPa]
  };
  constexpr std::array<State, 3> measured{
      {{{0.172, 0.203}, {81, 80}}, {{0.214, 0.066}, {77, 45}}, {{0.065, 0.248}, {43, 77}}}};
  const Law chronic = aortic_tissue(AorticTissue::chronic_adventitia).law(),
            healthy = aortic_tissue(AorticTissue::false_lumen_wall).law();
  for (const auto& [strain, stress] : measured)
    for (std::size_t i = 0; i < 2; ++i) {
      const auto at = [&](const Law& law) {
        const auto S = sheet_stress(law, ConstantFrame{}.frame(), 1.0 + 2.0 * strain[0], 1.0 + 2.0 * strain[1], 0.0);
        return 1e-3 * S.value()[static_cast<int>(i)];
      };
      EXPECT_NEAR(at(chronic), stress[i], 0.1 * stress[i]);
      EXPECT_GT(at(healthy), 2.3 * stress[i]);
      EXPECT_LT(at(healthy), 3.3 * stress[i]);
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
    const Law law = with_few_directions(p);
    return stretched(law, incompressible, specimen_axes({{1.0, 0.2, 0.0}}), {1.2, 1.1},
                     deformed(law, incompressible, identity<double>()))
        .state.cauchy;
  };
  const auto one = stress(named), other = stress(written);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(one[i], other[i], 1e-6);
  EXPECT_NEAR(named.bulk_modulus(), written.bulk_modulus(), 1e-6);
  EXPECT_THROW(read("aortic_tissue: intima"), InputError);
}

}  // namespace
}  // namespace tunica::wall
