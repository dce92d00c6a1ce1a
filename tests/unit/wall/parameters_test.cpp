#include "tunica/wall/parameters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace tunica::wall {
namespace {

config::Parsed<Parameters> read(const std::string& material, const std::string& more = "") {
  return config::parse_text(Parameters::schema(), "density: 1200 kg/m^3\nmaterial: {" + material + "}\n" + more);
}

TEST(WallParameters, YoungAndPoissonGiveShearAndBulk) {
  const Parameters p = read("neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.3}").value;
  EXPECT_EQ(p.element, Element::mixed);
  EXPECT_NEAR(std::get<NeoHooke>(p.law()).shear_modulus, 1e6 / 2.6, 1e-9);
  EXPECT_NEAR(p.body().volumetric.bulk_modulus, 1e6 / (3 * 0.4), 1e-9);
  EXPECT_EQ(p.body().density, 1200.0);
  EXPECT_EQ(p.body().stabilisation, default_stabilisation);
}

TEST(WallParameters, ShearAndBulkAreTakenAsTheyAre) {
  const Parameters p = read("neo_hooke: {shear_modulus: 50 kPa, bulk_modulus: 1 MPa}",
                            "element: displacement\nvolumetric_energy: miehe\n")
                           .value;
  EXPECT_EQ(std::get<NeoHooke>(p.law()).shear_modulus, 50e3);
  EXPECT_EQ(p.body().volumetric.bulk_modulus, 1e6);
  EXPECT_EQ(p.body().volumetric.energy, VolumetricEnergy::miehe);
  EXPECT_EQ(p.element, Element::displacement);
}

TEST(WallParameters, YoungAndBulkAgreeWithYoungAndPoisson) {
  const ElasticConstants a{.young_modulus = 2.0, .poisson_ratio = 0.4};
  const ElasticConstants b{.young_modulus = 2.0, .bulk_modulus = a.bulk()};
  EXPECT_NEAR(a.shear(), b.shear(), 1e-15);
}

TEST(WallParameters, IncompressibleNeedsTheMixedElement) {
  const Parameters p = read("neo_hooke: {shear_modulus: 50 kPa, poisson_ratio: 0.5}").value;
  EXPECT_TRUE(std::isinf(p.body().volumetric.bulk_modulus));
  EXPECT_EQ(p.body().volumetric.compressibility(), 0.0);
  try {
    read("neo_hooke: {shear_modulus: 50 kPa, poisson_ratio: 0.5}", "element: displacement\n");
    FAIL();
  } catch (const InputError& e) {
    ASSERT_EQ(e.problems().size(), 1u);
    EXPECT_NE(std::string(e.what()).find("incompressible"), std::string::npos);
  }
}

TEST(WallParameters, LockingDisplacementElementIsWarnedAbout) {
  EXPECT_EQ(read("neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.49}", "element: displacement\n").warnings.size(),
            1u);
  EXPECT_EQ(read("neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.49}").warnings.size(), 0u);
}

TEST(WallParameters, BadParametersAreRefused) {
  for (const char* bad : {"neo_hooke: {young_modulus: 1 MPa}", "neo_hooke: {poisson_ratio: 0.3}",
                          "neo_hooke: {young_modulus: 1 MPa, shear_modulus: 1 MPa, poisson_ratio: 0.3}",
                          "neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.3, bulk_modulus: 1 MPa}",
                          "neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.51}",
                          "neo_hooke: {young_modulus: -1 MPa, poisson_ratio: 0.3}",
                          "neo_hooke: {young_modulus: 1 MPa, bulk_modulus: 0.1 MPa}",
                          "neo_hooke: {shear_modulus: 0 kPa, bulk_modulus: 0.1 MPa}", "rubber: {}"})
    EXPECT_THROW(read(bad), InputError) << bad;
  EXPECT_THROW(read("neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.3}", "stabilisation: 0\n"), InputError);
  EXPECT_THROW(read("neo_hooke: {young_modulus: 1 MPa}", "element: displacement\n"), InputError);
}

TEST(WallParameters, SchemaIsSound) {
  for (const std::string& slip : config::audit(*Parameters::schema().description())) ADD_FAILURE() << slip;
}

}  // namespace
}  // namespace tunica::wall
