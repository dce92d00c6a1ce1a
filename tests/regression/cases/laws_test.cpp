// Every wall law in every analysis with both elements: the case file reaches the solver, the solver converges, and what
// it finds is the same on any number of ranks.
#include <cmath>
#include <limits>

#include "small_cases.hpp"
#include "tunica/mesh/generate.hpp"

namespace tunica::test {
namespace {

struct LawCase {
  std::string name, text;
  double displacement;  ///< largest in statics, mixed element [mm]; from this program
};

const std::string families =
    "families: [{k1: 20 kPa, k2: 5, mean_angle: 35 deg%}, {k1: 20 kPa, k2: 5, mean_angle: -35 deg%}]";

std::string with(const std::string& more) {
  std::string text = families;
  for (std::size_t at; (at = text.find('%')) != std::string::npos;) text.replace(at, 1, more);
  return text;
}

const std::string matrix = "shear_modulus: 40 kPa, poisson_ratio: 0.45, ";
const std::string dispersed =
    "families: [{k1: 20 kPa, k2: 5, bivariate_von_mises: {a: 2.5, b: 15, mean_angle: 35 deg}},"
    " {k1: 20 kPa, k2: 5, bivariate_von_mises: {a: 2.5, b: 15, mean_angle: -35 deg}}]";

const LawCase laws[] = {
    {"neo-Hooke", "{neo_hooke: {shear_modulus: 40 kPa, poisson_ratio: 0.45}}", 1.8397854},
    {"Mooney-Rivlin", "{mooney_rivlin: {c1: 15 kPa, c2: 5 kPa, poisson_ratio: 0.45}}", 1.8538425},
    {"HGO", "{hgo: {" + matrix + with("") + "}}", 1.0341389},
    {"GOH", "{goh: {" + matrix + with(", kappa: 0.2") + "}}", 1.5273222},
    {"GOH, bivariate", "{goh: {" + matrix + with(", kappa_ip: 0.2, kappa_op: 0.45") + "}}", 1.3125911},
    {"Fung",
     "{fung: {c: 30 kPa, b_cc: 1, b_ll: 0.8, b_rr: 0.7, b_cl: 0.3, b_lr: 0.2, b_rc: 0.1, g_cl: 4, g_lr: 5, g_rc: 6, "
     "poisson_ratio: 0.45}}",
     4.5058260},
    {"DFD", "{dfd: {" + matrix + dispersed + "}}", 1.0222154},
    {"DFD, unsplit", "{dfd: {" + matrix + "fibre_energy: unsplit, " + dispersed + "}}", 0.9471725},
    {"DFD, no exclusion, octahedral",
     "{dfd: {" + matrix + "exclusion: none, directions: {octahedral: {count: 64}}, " + dispersed + "}}", 1.0365821},
    {"DFD, degraded elastic fibres",
     "{dfd: {" + matrix +
         "families: [{k1: 40 kPa, k2: 0, von_mises: {b: 0, mean_angle: 0 deg}, degradation: [{from: 0 deg, to: 30 deg, "
         "factor: 0.1}]}]}}",
     1.4432555},
};

std::string wall_section(const LawCase& law, const std::string& element) {
  return "wall: {density: 1.2 g/cm^3, element: " + element +
         ", fibre_frame: {cylindrical: {origin: [0 mm, 0 mm, 0 mm], axis: [0, 0, 1]}}, material: " + law.text + "}\n";
}

/// A quarter of a thick tube under 3 kPa.
fs::path solve_wall(const SharedFolder& folder, const std::string& analysis, const std::string& wall,
                    const std::string& more) {
  const std::string text = "analysis: " + analysis +
                           "\nelements: linear\n"
                           "meshes: {length_unit: m, wall: {simvascular: not_used}}\n" +
                           wall +
                           "boundary:\n"
                           "  wall_inner: {pressure: 3 kPa}\n"
                           "  wall_outer: free\n"
                           "  wall_inlet: {fixed: {directions: [z]}}\n  wall_outlet: {fixed: {directions: [z]}}\n"
                           "  symmetry_x: {fixed: {directions: [x]}}\n  symmetry_y: {fixed: {directions: [y]}}\n" +
                           more;
  stages::ReadCase c{case_file::parse_case(text, folder.path() / "case.yaml"), text, {}, {}, {}};
  c.mesh.data = mesh::thick_cylinder(
      {.inner = 0.01, .outer = 0.012, .length = 0.001, .cells_radial = 2, .cells_around = 16, .cells_along = 1},
      mesh::Sector::quarter);
  stages::run_case(c, {}, MPI_COMM_WORLD, nullptr);
  return folder.path() / "results";
}

TEST(Laws, StaticWall) {
  for (const LawCase& law : laws)
    for (const std::string element : {"mixed", "displacement"}) {
      const SharedFolder folder;
      const auto results = solve_wall(folder, "{static_wall: {load_steps: 4}}", wall_section(law, element),
                                      "newton: {relative_tolerance: 1e-8}\nlinear: {tolerance: 1e-6}\n");
      const Table balance(results / "balance.csv"), steps(results / "steps.csv");
      EXPECT_EQ(steps["load factor"], (std::vector{0.25, 0.5, 0.75, 1.0})) << law.name << " " << element;
      const double u = balance.last("max displacement [mm]");
      if (parallel::rank(MPI_COMM_WORLD) == 0)
        std::printf("static, %-30s %-12s largest displacement %.7f mm\n", law.name.c_str(), element.c_str(), u);
      if (element == "mixed") {
        EXPECT_NEAR(u, law.displacement, 1e-5 * law.displacement) << law.name;
      }
    }
}

TEST(Laws, DynamicWall) {
  for (const LawCase& law : laws)
    for (const std::string element : {"mixed", "displacement"}) {
      const SharedFolder folder;
      const auto results = solve_wall(folder, "wall", wall_section(law, element), "time: {step: 0.2 ms, steps: 4}\n");
      EXPECT_EQ(Table(results / "steps.csv")["step"].size(), 4u) << law.name << " " << element;
    }
}

TEST(Laws, FluidStructureInteraction) {
  for (const LawCase& law : laws)
    for (const std::string element : {"mixed", "displacement"}) {
      const SharedFolder folder;
      std::string text = coupled_case(3);
      const auto begin = text.find("wall: {density");
      text.replace(begin, text.find('\n', begin) + 1 - begin, wall_section(law, element));
      run(folder.write("case.yaml", text));
      const Table balance(folder.path() / "results/balance.csv");
      ASSERT_EQ(balance["relative mass residual"].size(), 3u) << law.name << " " << element;
      for (const double r : balance["relative mass residual"]) EXPECT_LT(r, 1e-6) << law.name << " " << element;
      EXPECT_GT(balance.last("wall strain energy [J]"), 0.0) << law.name << " " << element;
    }
}

}  // namespace
}  // namespace tunica::test
