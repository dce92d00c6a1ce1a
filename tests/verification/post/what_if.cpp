// What if: a tear of the idealised dissection closed, between rigid walls. With one tear alone nothing flows through
// the false lumen, and its pressure is that at the tear which is left: an occluded exit raises it, an occluded entry
// lowers it, as has been measured (docs/what_if.md).
#include "tunica/pipeline/what_if.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "shared_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/parallel/agree.hpp"
#include "verification/fluid/flow_case.hpp"

namespace tunica::verification {
namespace {

namespace fs = std::filesystem;

constexpr const char* rigid_case =
    "analysis: flow\nelements: linear\n"
    "mesh: {geometry: {parametric: {}}, size: {edge: 7 mm}}\n"
    "fluid: {density: 1060 kg/m^3, viscosity: {newtonian: {viscosity: 4 mPa s}}}\n"
    "boundary:\n  lumen_inlet: {flow: {value: 200 ml/s, ramp_time: 60 ms}}\n  lumen_wall: no_slip\n"
    "  \"lumen_*\": {resistance: 4e8 Pa s/m^3}\n"
    "time: {step: 5 ms, steps: 40, rho_infinity: 0.2}\noutput: {directory: results, every: 1}\n"
    "post: {spacing: 10 mm, from: 150 ms, until: 200 ms}\n";

/// what_if.csv: values of the case and its variants, by what they are.
std::map<std::string, std::map<std::string, double>> table_of(const fs::path& file) {
  const auto table = files::read_table(file, "");
  std::map<std::string, std::map<std::string, double>> values;
  for (const auto& row : table.rows)
    for (std::size_t c = 2; c < table.headers.size(); ++c)
      values[row.cells[0]][table.headers[c]] = row.cells[c] == "nan" ? NAN : table.number(row, c);
  return values;
}

TEST(WhatIf, ATearThatIsClosedMovesThePressureOfTheFalseLumen) {
  const test::SharedFolder folder;
  folder.write("case.yaml", rigid_case);
  pipeline::WhatIfRequest request;
  request.file = folder.write("what_if.yaml",
                              "case: case.yaml\nvariants:\n  exit_closed: {close_tears: tear_2}\n"
                              "  entry_closed: {close_tears: tear_1}\n  more: {stroke_volume: 1.2}\n");
  ASSERT_EQ(pipeline::what_if(request, MPI_COMM_WORLD, stdout), 0);
  parallel::on_root(MPI_COMM_WORLD, [&] {
    const auto values = table_of(folder.path() / "what_if/what_if.csv");
    const auto& in_false = values.at("pressure in the false lumen");
    const auto& difference = values.at("true less false lumen pressure");
    const auto& flow = values.at("largest mean flow along the false lumen");
    for (const char* name : {"as it is", "exit_closed", "entry_closed", "more"})
      say("  %s: false lumen %.3f mmHg, true less false %.3f mmHg, flow along the false lumen %.3f ml/s\n", name,
          in_false.at(name), difference.at(name), flow.at(name));
    EXPECT_GT(std::abs(flow.at("as it is")), 10);
    // The tear that is left keeps its name.
    const auto &first = values.at("tears/tear_1/volume_into_false_lumen_ml"),
               &second = values.at("tears/tear_2/volume_into_false_lumen_ml");
    EXPECT_TRUE(std::isnan(first.at("entry_closed")) && std::isfinite(first.at("exit_closed")));
    EXPECT_TRUE(std::isnan(second.at("exit_closed")) && std::isfinite(second.at("entry_closed")));
    // Nothing passes the tear that is left. Cuts along such a sac still have a tenth of the flow of before: they
    // conserve mass to the accuracy of the mesh only.
    int tears = 0;
    for (const auto& [what, by_name] : values) {
      if (!what.starts_with("tears/") || !what.ends_with("_ml")) continue;
      ++tears;
      for (const char* name : {"exit_closed", "entry_closed"}) {
        const double ml = by_name.at(name);  // not a number where there is no such tear any more
        EXPECT_FALSE(std::abs(ml) > 1e-3) << what << " of " << name << ": " << ml;
      }
    }
    EXPECT_GE(tears, 2);
    EXPECT_GT(in_false.at("exit_closed"), in_false.at("as it is"));
    EXPECT_LT(in_false.at("entry_closed"), in_false.at("as it is"));
    EXPECT_GT(values.at("openings/lumen_inlet/pressure/mean_mmHg").at("more"),
              1.1 * values.at("openings/lumen_inlet/pressure/mean_mmHg").at("as it is"));
    // One distance is one place, on both vessels.
    const auto lines_of = [](const fs::path& file) {
      std::map<double, std::array<double, 3>> centres;
      const auto table = files::read_table(file, "");
      const auto column = [&](const char* name) {
        for (std::size_t c = 0; c < table.headers.size(); ++c)
          if (table.headers[c] == name) return c;
        throw std::runtime_error(std::string("no column ") + name);
      };
      for (const auto& row : table.rows)
        centres[table.number(row, column("distance [mm]"))] = {table.number(row, column("x [mm]")),
                                                               table.number(row, column("y [mm]")),
                                                               table.number(row, column("z [mm]"))};
      return centres;
    };
    const auto centres = lines_of(folder.path() / "results/post/stations.csv");
    for (const char* name : {"exit_closed", "entry_closed"}) {
      const auto closed = lines_of(folder.path() / "what_if" / name / "post/stations.csv");
      EXPECT_EQ(closed.size(), centres.size());
      for (const auto& [distance, centre] : closed) {
        ASSERT_TRUE(centres.contains(distance)) << distance;
        const auto& c = centres.at(distance);
        EXPECT_LT(std::hypot(centre[0] - c[0], centre[1] - c[1], centre[2] - c[2]), 1.5) << name << " " << distance;
      }
    }
    // Only variants with another vessel have a mesh of their own.
    EXPECT_TRUE(fs::exists(folder.path() / "what_if/exit_closed/mesh/meshes.yaml"));
    EXPECT_FALSE(fs::exists(folder.path() / "what_if/more/mesh"));
  });

  // Both closed: the false lumen would have no pressure.
  request.file =
      folder.write("both.yaml", "case: case.yaml\nvariants:\n  both: {close_tears: [tear_1, tear_2]}\noutput: both\n");
  try {
    pipeline::what_if(request, MPI_COMM_WORLD, stdout);
    FAIL() << "a false lumen without an opening is taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("without any opening"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace tunica::verification
