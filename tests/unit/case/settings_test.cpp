// Files of `tunica material`, `mesh`, `fibres` and the section `outlets`: what follows from their values, and what does
// not fit together.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "text.hpp"
#include "tunica/base/error.hpp"
#include "tunica/case/fibres_case.hpp"
#include "tunica/case/material_case.hpp"
#include "tunica/case/mesh_settings.hpp"
#include "tunica/case/tuning_settings.hpp"

namespace tunica::case_file {
namespace {

using test::message_of;

/// The message of what is wrong with a text; empty when nothing is.
template <class T>
std::string refusal(const std::string& yaml) {
  return message_of<InputError>([&] { config::parse_text(T::schema(), yaml, {.check_files = false}); });
}
struct Wrong {
  std::string yaml, says;
};
template <class T>
void expect_refused(const std::string& before, const std::vector<Wrong>& list) {
  for (const auto& [yaml, says] : list) {
    const auto text = refusal<T>(before + yaml);
    EXPECT_NE(text.find(says), std::string::npos) << before + yaml << "\n" << text;
  }
}

template <class T>
void expect_sound() {
  const auto schema = T::schema();
  EXPECT_EQ(config::audit(*schema.description()), std::vector<std::string>{});
}
TEST(Settings, DescriptionsAreSound) {
  expect_sound<MaterialCase>();
  expect_sound<MeshCase>();
  expect_sound<FibresCase>();
  expect_sound<TuningCase>();
}

// --- tunica material ------------------------------------------------------------------------------------------------

const std::string law = "material: {neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.45}}\n";
Loading loading(const std::string& yaml) {
  return config::parse_text(MaterialCase::schema(), law + "tests: {a: " + yaml + "}\n").value.tests[0].second.loading;
}

TEST(MaterialCase, DirectionsAreThoseOfTheFibreFrame) {
  const auto along = [](const std::string& yaml) {
    return vector_of(std::get<Uniaxial>(loading("{uniaxial: {along: " + yaml + ", to: 1.2}}")).along);
  };
  EXPECT_EQ(norm(along("e1") - Vec3<double>{{1, 0, 0}}), 0);
  EXPECT_EQ(norm(along("e3") - Vec3<double>{{0, 0, 1}}), 0);
  EXPECT_NEAR(norm(along("{angle: -30 deg}") - Vec3<double>{{std::sqrt(0.75), -0.5, 0}}), 0, 1e-15);
  EXPECT_EQ(norm(along("{vector: [2, 0, -1]}") - Vec3<double>{{2, 0, -1}}), 0);
  const auto sheet = std::get<Planar>(loading("{planar: {to: 1.3}}"));
  EXPECT_EQ(dot(vector_of(sheet.along), vector_of(sheet.across)), 0);
}

TEST(MaterialCase, PathsBeginAtRestAndEndWhereTheyAreToldTo) {
  const auto stretch = std::get<Uniaxial>(loading("{uniaxial: {to: 1.7, steps: 7}}")).stretch;
  EXPECT_EQ(stretch.at(0), 1);
  // The end is met to the last bit.
  for (double to = 0.3; to < 3; to += 0.173) EXPECT_EQ((LoadPath{.from = 0.1, .to = to, .steps = 3}.at(3)), to);
  for (int k = 0; k < 7; ++k) EXPECT_NEAR(stretch.at(k + 1) - stretch.at(k), 0.1, 1e-15);
  EXPECT_EQ(std::get<SimpleShear>(loading("{simple_shear: {to: 0.4}}")).load.at(0), 0);
}

TEST(MaterialCase, TheSecondStretchFollowsTheFirst) {
  const auto by_ratio = std::get<Biaxial>(loading("{biaxial: {to: 1.4, ratio: 0.5}}"));
  const auto by_end = std::get<Biaxial>(loading("{biaxial: {to: 1.4, to_across: 1.2}}"));
  for (const double s : {1.0, 1.13, 1.4}) {
    EXPECT_NEAR(by_ratio.across_at(s), 1 + 0.5 * (s - 1), 1e-15);
    EXPECT_NEAR(by_end.across_at(s), by_ratio.across_at(s), 1e-15);
  }
}

TEST(MaterialCase, SaysWhatIsNoTest) {
  expect_refused<MaterialCase>(
      law, {{"tests: {a: {uniaxial: {from: 1.2, to: 1.2}}}", "is where the path begins"},
            {"tests: {a: {uniaxial: {along: {vector: [0, 0, 0]}, to: 2}}}", "has length zero"},
            {"tests: {a: {planar: {along: e1, across: {angle: 80 deg}, to: 2}}}", "not perpendicular"},
            {"tests: {a: {biaxial: {to: 1.2}}}", "the second stretch is not given"},
            {"tests: {a: {biaxial: {to: 1.2, ratio: 1, to_across: 1.1}}}", "are both given"},
            {"tests: {a: {biaxial: {from: 0.9, to: 1, to_across: 1.1}}}", "has no path when `to` is 1"},
            {"tests: {a: {biaxial: {to: 2, ratio: -1}}}", "smaller than 0.05"},
            {"tests: {a: {gradients: {list: [[1, 0, 0, 0, 1, 0, 0, 0, -1]]}}}", "has the determinant -1"},
            {"tests: {a: {gradients: {}}}", "no deformation gradient is given"},
            {"tests: {a/b: {uniaxial: {to: 2}}}", "has the character '/'"},
            {"tests: {}", "is empty"},
            {"tests: {a: {uniaxial: {to: 2}}}\noutput: {stress: mm}", "stress"}});
  expect_refused<MaterialCase>("material: {neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.5}}\n",
                               {{"incompressible: false\ntests: {a: {uniaxial: {to: 2}}}", "no finite bulk modulus"}});
}

// --- tunica mesh ----------------------------------------------------------------------------------------------------

TEST(MeshCase, FinerMeshesAreFinerEverywhere) {
  double last = 1;
  for (const char* name : {"{edge: 7 mm}", "{edge: 3.2 mm}", "full", "{edge: 1.1 mm}"}) {
    const auto c =
        config::parse_text(MeshCase::schema(), std::string("geometry: {parametric: {}}\nsize: ") + name).value;
    const double edge = edge_length(c.size);
    EXPECT_LT(edge, last) << name;
    last = edge;
    const auto sizes = size_settings(c.size), finer = size_settings(0.8 * edge);
    EXPECT_EQ(sizes.largest, edge);
    EXPECT_FALSE(sizes.across);
    EXPECT_LT(sizes.smallest, edge);
    EXPECT_LE(finer.smallest, sizes.smallest);
    EXPECT_LE(finer.per_radius, sizes.per_radius);
    EXPECT_LE(finer.per_thickness, sizes.per_thickness);
  }
  EXPECT_NEAR(last, 1.1e-3, 1e-18);
}

TEST(MeshCase, NamesAreElementsAcross) {
  const auto size = [](const std::string& text) {
    return config::parse_text(MeshCase::schema(), "geometry: {parametric: {}}\n" + text).value.size;
  };
  EXPECT_EQ(across(size(""))->count, 4);
  EXPECT_EQ(across(size("size: coarse"))->count, 2.5);
  EXPECT_EQ(across(size("size: medium"))->count, 4);
  EXPECT_EQ(across(size("size: fine"))->count, 6);
  EXPECT_FALSE(across(size("size: full")));
  EXPECT_FALSE(across(size("size: {edge: 2 mm}")));
  EXPECT_EQ(across(size("size: {elements_across: 10}"))->count, 10);
  EXPECT_NE(describe(size("size: coarse")).find("for trying things"), std::string::npos);
  EXPECT_EQ(describe(size("size: {edge: 2 mm}")), "edges of up to 2 mm, however narrow the lumen is");

  const auto bounded =
      size_settings(size("size: {elements_across: {count: 5, longest_edge: 6 mm, shortest_edge: 0.4 mm}}"));
  EXPECT_EQ(bounded.across, 5);
  EXPECT_DOUBLE_EQ(bounded.largest, 6e-3);
  EXPECT_DOUBLE_EQ(bounded.smallest_across, 0.4e-3);
  double last = 1;
  for (const char* name : {"coarse", "medium", "fine", "{elements_across: 10}"}) {
    const auto settings = size_settings(size(std::string("size: ") + name));
    EXPECT_LT(settings.smallest_across, last) << name;
    EXPECT_NEAR(settings.smallest_across * *settings.across, 2e-3, 1e-12) << name;
    last = settings.smallest_across;
  }
  expect_refused<MeshCase>(
      "geometry: {parametric: {}}\n",
      {{"size: {elements_across: {count: 4, longest_edge: 1 mm, shortest_edge: 2 mm}}", "exchange"},
       {"size: {elements_across: 0.5}", "elements_across"},
       {"size: {edge: 2 mm, elements_across: 4}", "size"}});
}

// --- tunica fibres --------------------------------------------------------------------------------------------------

TEST(FibresCase, ItsPartsFitTheMesh) {
  const std::string joined =
      "meshes:\n  tube: {radius: 1 cm, length: 4 cm, wall_thickness: 2 mm}\n"
      "  interface: {lumen: lumen_wall, wall: wall_inner}\n";
  const std::string angle = "inlet: [wall_inlet]\nmean_angle: 40 deg\n";
  const auto c = parse_fibres_case(joined + angle + "regions: {flap: {mean_angle: -90 deg}}\n", "fibres.yaml");
  EXPECT_NE(message_of<InputError>([&] {
              const char* two = "regions: {flap: {mean_angle: -90 deg}, Flap: {mean_angle: 0 deg}}\n";
              parse_fibres_case(joined + angle + two, "fibres.yaml");
            }).find("in the case of letters only"),
            std::string::npos);
  EXPECT_EQ(c.inner_faces(), (std::vector<std::string>{"wall_inner"}));
  EXPECT_NEAR(c.mean_angle, 40 * M_PI / 180, 1e-15);
  EXPECT_NEAR(c.regions.at("flap").mean_angle, -M_PI / 2, 1e-15);
  expect_refused<FibresCase>(joined, {{"mean_angle: 40 deg\n", "names no face"},
                                      {angle + "inner: [wall_inner]\n", "`meshes.interface` says it already"},
                                      {"inlet: [wall_inlet]\nmean_angle: 91 deg\n", "mean_angle"}});
  const std::string apart = "meshes: {tube: {radius: 1 cm, length: 4 cm, wall_thickness: 2 mm}}\n" + angle;
  expect_refused<FibresCase>(apart, {{"", "is missing, and `meshes.interface` too"},
                                     {"inner: [wall_inner]\n", "there is no lumen joined to the wall"},
                                     {"inner: [wall_inner]\ndomain: wall\ntears: {true_lumen: [a], false_lumen: [b]}\n",
                                      "is given, but there is no lumen joined"}});
  EXPECT_EQ(refusal<FibresCase>(apart + "inner: [wall_inner]\ndomain: wall\n"), "");
}

// --- outlets --------------------------------------------------------------------------------------------------------

const std::string pressures = "systolic: 120 mmHg\ndiastolic: 75 mmHg\n";

TEST(TuningCase, ResistancesShareTheFlowAsAskedFor) {
  const auto c = config::parse_text(TuningCase::schema(), pressures + "fractions: {a: 0.2, b: 0.5, c: 0.3}\n").value;
  EXPECT_NEAR(c.mean() / 133.322387415, 90, 1e-6);  // a third of the way from diastolic to systolic
  // Flows at one pressure, of outlets side by side.
  std::vector<double> flows;
  for (const auto& [face, condition] : provisional_outlets(c))
    flows.push_back(1 / std::get<bc::Resistance>(condition).resistance);
  const double all = std::accumulate(flows.begin(), flows.end(), 0.0);
  const auto split = c.flow_split();
  ASSERT_EQ(flows.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(flows[k] / all, c.fractions[k].second, 1e-14);
    EXPECT_EQ(split.fractions[k], c.fractions[k].second);
  }
  EXPECT_EQ(c.file(), c.output / "outlets.yaml");
}

TEST(TuningCase, SaysWhatCannotBe) {
  const std::string fractions = "fractions: {a: 0.4, b: 0.6}\n";
  EXPECT_EQ(refusal<TuningCase>(pressures + "fractions: {a: 0.402, b: 0.6}\n"), "");  // rounded
  expect_refused<TuningCase>("", {{pressures + "fractions: {a: 0.4, b: 0.5}\n", "add up to 0.9"},
                                  {pressures + "fractions: {}\n", "names no outlet"},
                                  {pressures + "fractions: {a: 0, b: 1}\n", "a"},
                                  {"systolic: 70 mmHg\ndiastolic: 75 mmHg\n" + fractions, "is not above the diastolic"},
                                  {pressures + "distal_pressure: 80 mmHg\n" + fractions, "is not below the diastolic"},
                                  {pressures + "distal_share: 1\n" + fractions, "distal_share"}});
}

}  // namespace
}  // namespace tunica::case_file
