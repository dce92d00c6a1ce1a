// Follow-ups: three scans of an idealised dissection that grows as is known.
#include "tunica/pipeline/follow_up.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "shared_folder.hpp"
#include "tunica/config/schema.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/geometry/dissection_model.hpp"
#include "tunica/parallel/agree.hpp"
#include "verification/fluid/flow_case.hpp"

namespace tunica::verification {
namespace {

namespace fs = std::filesystem;
using geometry::DissectionModel, geometry::mm;

constexpr const char* names[] = {"baseline", "year_1", "year_3"};
/// The false lumen grows, the flap moves, the entry tear widens.
constexpr const char* shapes[] = {
    "{}", "{aorta: {dissected_radius: 17 mm}, flap: {true_lumen_share: 0.38, entry_tear: {area: 250 mm^2}}}",
    "{aorta: {dissected_radius: 18.5 mm}, flap: {true_lumen_share: 0.33, entry_tear: {area: 280 mm^2}}}"};
constexpr const char* dates[] = {"2020-01-01", "2021-01-01", "2023-01-01"};

constexpr const char* common_case =
    "analysis: flow\nelements: linear\n"
    "mesh: {geometry: {parametric: {}}, size: coarse}\n"
    "fluid: {}\n"
    "boundary:\n  lumen_inlet: {flow: 100 ml/s}\n  \"lumen_*\": {resistance: 4e8 Pa s/m^3}\n  lumen_wall: no_slip\n"
    "time: {step: 5 ms, steps: 4}\npost: {}\noutput: {directory: results}\n";

DissectionModel model(int scan) {
  return DissectionModel(config::parse_text(geometry::ParametricDissection::schema(), shapes[scan]).value);
}

/// Volume of true and false lumen of the body between two places along its centreline, by counting points [ml].
std::array<double, 2> counted(const DissectionModel& body, double from, double to) {
  const double h = 1e-3;
  const geometry::Box box = body.box();
  std::array<double, 2> ml{};
  for (double x = box.low[0] + 0.37 * h; x < box.high[0]; x += h)
    for (double y = box.low[1] + 0.61 * h; y < box.high[1]; y += h)
      for (double z = box.low[2] + 0.13 * h; z < box.high[2]; z += h) {
        const geometry::Point p{{x, y, z}};
        const auto c = body.centreline().closest(p);
        if (c.s < from || c.s > to || c.distance > 1.05 * body.aorta_radius(c.s)) continue;
        const auto v = body.at(p);
        if (v.lumen < 0 && v.flap > 0) ml[v.side > 0 ? 0 : 1] += h * h * h * 1e6;
      }
  return ml;
}

TEST(FollowUp, FindsTheGrowthOfAGrowingDissection) {
  const test::SharedFolder folder;
  folder.write("case.yaml", common_case);
  std::string scans = "title: Growing dissection\ncase: case.yaml\nscans:\n";
  for (int k = 0; k < 3; ++k)
    scans += fmt::format("  {}: {{date: {}, geometry: {{parametric: {}}}}}\n", names[k], dates[k], shapes[k]);
  const auto file = folder.write("scans.yaml", scans);
  pipeline::FollowUpRequest request;
  request.file = file;
  ASSERT_EQ(pipeline::follow_up(request, MPI_COMM_WORLD, stdout), 0);
  parallel::on_root(MPI_COMM_WORLD, [&] {
    const fs::path results = folder.path() / "follow_up";
    const auto found = nlohmann::json::parse(std::ifstream(results / "follow_up.json"));
    const auto stations = files::read_csv(results / "stations.csv", "", files::Gaps::allowed);
    std::vector<DissectionModel> bodies;
    for (int k = 0; k < 3; ++k) bodies.push_back(model(k));
    ASSERT_EQ(found["intervals"].size(), 2u);
    // Branches are where the body has them; the line begins where the first section is, not at the inlet.
    const auto branches = files::read_table(results / "branches.csv", "");
    std::vector<double> origins;
    for (const auto& row : branches.rows)
      if (row.cells[0] == names[0]) origins.push_back(branches.number(row, 2));
    ASSERT_EQ(origins.size(), 3u);
    const double start = 141 - origins[2];
    say("  branches at %.1f, %.1f, %.1f mm; the body has 98, 121, 141 mm\n", origins[0] + start, origins[1] + start,
        origins[2] + start);
    EXPECT_NEAR(origins[0] + start, 98, 6);  // the line runs farther out in the arch than that of the body
    EXPECT_NEAR(origins[1] + start, 121, 6);
    EXPECT_LT(std::abs(start), 10);

    // Diameter at each station.
    double worst = 0;
    const auto &distance = stations.column("distance [mm]"), &x = stations.column("baseline x [mm]"),
               &y = stations.column("baseline y [mm]"), &z = stations.column("baseline z [mm]");
    for (int k = 1; k < 3; ++k) {
      const auto &before = stations.column(fmt::format("{} diameter [mm]", names[k - 1])),
                 &after = stations.column(fmt::format("{} diameter [mm]", names[k]));
      for (std::size_t s = 1; s + 1 < distance.size(); ++s) {
        const double place = bodies[0].centreline().closest({{x[s] * mm, y[s] * mm, z[s] * mm}}).s;
        const double exact = 2e3 * (bodies[k].aorta_radius(place) - bodies[k - 1].aorta_radius(place));
        const double error = after[s] - before[s] - exact;
        worst = std::abs(error) > std::abs(worst) ? error : worst;
        EXPECT_NEAR(error, 0, 0.5) << names[k] << " at " << distance[s] << " mm";
      }
      const auto& folds = found["intervals"][k - 1]["map"];
      say("  %s: %d of %d elements folded, least Jacobian %.3f\n", names[k], folds["folded"].get<int>(),
          folds["elements"].get<int>(), folds["least_jacobian"].get<double>());
      EXPECT_EQ(folds["folded"], 0);
      EXPECT_GT(folds["elements"], 10000);
    }
    say("  growth of the diameter: largest error %.2f mm\n", worst);

    // Volume of each lumen between the last branch and the end.
    const auto& segment = found["segments"].back();
    EXPECT_EQ(segment["from"], "lumen_left_subclavian");
    const double end = (origins[2] + start) + segment["scans"][0]["length_mm"].get<double>();
    std::array<std::array<double, 2>, 3> exact;
    for (int k = 0; k < 3; ++k) exact[k] = counted(bodies[k], (origins[2] + start) * mm, end * mm);
    const char* lumens[] = {"true_lumen_ml", "false_lumen_ml"};
    for (int k = 1; k < 3; ++k)
      for (int lumen = 0; lumen < 2; ++lumen) {
        const auto& both = segment["scans"];
        const double growth = both[k][lumens[lumen]].get<double>() - both[k - 1][lumens[lumen]].get<double>();
        say("  %s %s: %.2f ml, growth %.2f ml, exact %.2f ml\n", names[k], lumens[lumen],
            both[k][lumens[lumen]].get<double>(), growth, exact[k][lumen] - exact[k - 1][lumen]);
        EXPECT_NEAR(growth, exact[k][lumen] - exact[k - 1][lumen], 1.0) << names[k] << lumens[lumen];
      }

    // Tears keep their places, and one of them widens.
    ASSERT_EQ(found["tears"].size(), 2u);
    for (const auto& tear : found["tears"])
      say("  tear at %.0f mm: %.0f, %.0f, %.0f mm^2\n", tear["distance_mm"].get<double>() + start,
          tear["area_mm2"][0].get<double>(), tear["area_mm2"][1].get<double>(), tear["area_mm2"][2].get<double>());
    EXPECT_NEAR(found["tears"][0]["distance_mm"].get<double>() + start, 212, 5);
    EXPECT_NEAR(found["tears"][1]["distance_mm"].get<double>() + start, 318, 5);
    EXPECT_GT(found["tears"][0]["area_mm2"][2].get<double>(), found["tears"][0]["area_mm2"][0].get<double>() + 20);
    EXPECT_TRUE(fs::exists(results / "growth.vtp"));
    EXPECT_TRUE(fs::exists(results / "map_year_1_to_year_3.vtp"));
  });
}

}  // namespace
}  // namespace tunica::verification
