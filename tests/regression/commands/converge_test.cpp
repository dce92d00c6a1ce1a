// `tunica converge` on a short tube: levels, bands, what is reused, and cases that cannot be refined.
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace tunica::test {
namespace {

class ConvergeCommand : public Program {
 protected:
  void write_case(const std::string& post) const {
    write("case.yaml",
          "title: Tube\nanalysis: flow\nelements: quadratic\n"
          "meshes: {tube: {radius: 5 mm, length: 20 mm, cells_around: 8, cells_radial: 1, cells_along: 4}}\n"
          "fluid: {}\n"
          "boundary: {lumen_inlet: {flow: 20 ml/s}, lumen_outlet: {resistance: 5e7 Pa s/m^3}, lumen_wall: no_slip}\n"
          "time: {step: 4 ms, steps: 3, rho_infinity: 0.2}\n"
          "output: {directory: out}\n" +
              post);
  }
  nlohmann::json results() const { return nlohmann::json::parse(read("out/converge/converge.json")); }
};

TEST_F(ConvergeCommand, GivesEveryFigureABandAndTakesItAgain) {
  write_case("post: {}\nreport: {pictures: false, view: false}\n");
  ASSERT_EQ(tunica("converge case.yaml --ratio 1.5"), 0) << printed();
  const auto first = results();
  ASSERT_EQ(first["levels"].size(), 4U);
  EXPECT_GT(first["levels"][2]["elements"], 2 * first["levels"][0]["elements"].get<int>());
  EXPECT_EQ(first["levels"][3]["elements"], first["levels"][0]["elements"]);
  EXPECT_DOUBLE_EQ(first["levels"][3]["step_s"], 2e-3);
  const auto& pressure = first["figures"]["openings/lumen_inlet/pressure/mean_mmHg"];
  const double value = pressure["value"];
  EXPECT_GT(value, 0);
  EXPECT_GT(pressure["band"], 0);
  EXPECT_EQ(pressure["values_by_mesh"].size(), 3U);
  EXPECT_NEAR(pressure["band"], pressure["mesh"]["band"].get<double>() + pressure["step"]["band"].get<double>(),
              1e-9 * value);
  EXPECT_TRUE(fs::exists(folder_ / "out/converge/converge.html"));
  EXPECT_NE(read("out/converge/converge.csv").find("openings/lumen_inlet/pressure/mean_mmHg"), std::string::npos);
  EXPECT_NE(read("out/report/report.html").find(" ± "), std::string::npos);
  EXPECT_EQ(read("out/report/report.html").find("view3d"), std::string::npos) << "the view is not wanted";
  // The computations are taken as they are.
  const auto made = fs::last_write_time(folder_ / "out/converge/mesh_2/run/manifest.json");
  ASSERT_EQ(tunica("converge case.yaml --ratio 1.5 --quantity 'openings/*/pressure/mean_mmHg'"), 0) << printed();
  EXPECT_EQ(fs::last_write_time(folder_ / "out/converge/mesh_2/run/manifest.json"), made);
  EXPECT_EQ(results()["figures"].size(), 2U);
}

TEST_F(ConvergeCommand, SaysWhatItNeeds) {
  write_case("");
  EXPECT_EQ(tunica("converge case.yaml"), 2);
  EXPECT_NE(printed().find("add `post: {}`"), std::string::npos) << printed();
  write_case("post: {}\n");
  EXPECT_EQ(tunica("converge case.yaml --meshes 0 --steps 0"), 2);
  EXPECT_EQ(tunica("converge case.yaml --meshes 0 --steps 1 --quantity 'no/such*'"), 2);
  EXPECT_NE(printed().find("matches no figure"), std::string::npos) << printed();
}

}  // namespace
}  // namespace tunica::test
