#include "tunica/wall/composition.hpp"

#include <gtest/gtest.h>

#include "tunica/base/error.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::wall {
namespace {

Parameters read_parameters(const std::string& rest) {
  return config::parse_text(Parameters::schema(),
                            "density: 1120 kg/m^3\nmaterial: {neo_hooke: {young_modulus: 400 kPa, poisson_ratio: "
                            "0.49}}\n" +
                                rest)
      .value;
}

const std::string stiff = "{neo_hooke: {young_modulus: 800 kPa, poisson_ratio: 0.49}}";

TEST(Composition, IsReadWithTheWallAndItsRegions) {
  const auto p = read_parameters(
      "smoothing_length: 1 mm\nlayers: {depth: depth, outwards: [{beyond: 0.6, material: " + stiff +
      "}]}\nregions: {flap: {material: " + stiff + ", admixture: {share: calcified, material: " + stiff + "}}}\n");
  EXPECT_EQ(p.cell_arrays(), (std::vector<std::string>{"depth", "calcified"}));
  EXPECT_EQ(p.composition.further().size(), 1u);
  EXPECT_NEAR(matrix_shear_modulus(*p.regions.at("flap").composition.further()[0]), 800e3 / 2.98, 1.0);
}

TEST(Composition, JumpsWithoutBlending) {
  const auto p = read_parameters("layers: {depth: depth, outwards: [{beyond: 0.2, material: " + stiff +
                                 "}, {beyond: 0.6, material: " + stiff + "}]}\n");
  EXPECT_EQ(p.composition.layers->weights(-0.1), (std::vector<double>{1, 0, 0}));
  EXPECT_EQ(p.composition.layers->weights(0.4), (std::vector<double>{0, 1, 0}));
  EXPECT_EQ(p.composition.layers->weights(1.2), (std::vector<double>{0, 0, 1}));
}

TEST(Composition, LayersGoOutwardsAndAreThickerThanTheBlending) {
  const auto layers = [](const std::string& first, const std::string& second) {
    return "layers: {depth: depth, blending: 0.1, outwards: [{beyond: " + first + ", material: " + stiff +
           "}, {beyond: " + second + ", material: " + stiff + "}]}\n";
  };
  EXPECT_NO_THROW(read_parameters(layers("0.3", "0.5")));
  EXPECT_THROW(read_parameters(layers("0.6", "0.2")), InputError);
  EXPECT_THROW(read_parameters(layers("0.3", "0.35")), InputError);
  EXPECT_THROW(read_parameters("layers: {depth: depth, outwards: []}\n"), InputError);
}

}  // namespace
}  // namespace tunica::wall
