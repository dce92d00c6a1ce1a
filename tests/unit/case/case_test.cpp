#include "tunica/case/case.hpp"
#include "tunica/case/case_text.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "tunica/wall/parameters.hpp"

namespace tunica::case_file {
namespace {

namespace fs = std::filesystem;

// Coupled tube; tests replace or append parts.
const std::string fluid_part = "fluid: {viscosity: {newtonian: {viscosity: 0.04 dyn s/cm^2}}}\n";
const std::string wall_part =
    "wall:\n"
    "  density: 1.2 g/cm^3\n"
    "  material: {neo_hooke: {young_modulus: 3e6 dyn/cm^2, poisson_ratio: 0.3}}\n";
const std::string mesh_part =
    "meshes:\n"
    "  tube: {radius: 0.5 cm, length: 5 cm, wall_thickness: 1 mm}\n"
    "  interface: {lumen: lumen_wall, wall: wall_inner}\n";
const std::string boundary_part =
    "boundary:\n"
    "  lumen_inlet: {pressure: {step: {value: 1.3332e4 dyn/cm^2, end: 3 ms}}}\n"
    "  lumen_outlet: {pressure: 0 Pa}\n"
    "  wall_inlet: fixed\n"
    "  wall_outlet: {fixed: {directions: [z]}}\n"
    "  wall_outer: free\n";
const std::string time_part = "time: {step: 0.1 ms, steps: 100}\n";

std::string coupled() { return "analysis: fsi\n" + mesh_part + fluid_part + wall_part + boundary_part + time_part; }

std::vector<Problem> problems_of(const std::string& yaml) {
  try {
    parse_case(yaml, "case.yaml");
  } catch (const InputError& error) {
    return error.problems();
  }
  return {};
}
bool mentions(const std::vector<Problem>& problems, const std::string& where, const std::string& what) {
  for (const Problem& p : problems)
    if (p.where.find(where) != std::string::npos && p.what.find(what) != std::string::npos) return true;
  return false;
}

class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("tunica_case_test_" + std::to_string(getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

TEST(Case, DescriptionIsSound) { EXPECT_EQ(config::audit(*Case::schema().description()), std::vector<std::string>{}); }

TEST(Case, ReadsACoupledCase) {
  const Case c = parse_case(coupled(), "folder/case.yaml");
  EXPECT_TRUE(c.solves_fluid() && c.solves_wall());
  EXPECT_DOUBLE_EQ(c.meshes.tube->radius, 0.005);
  EXPECT_EQ(c.meshes.interface->wall_faces, std::vector<std::string>{"wall_inner"});
  EXPECT_DOUBLE_EQ(std::get<fluid::Newtonian>(c.fluid->viscosity).mu, 0.004);
  EXPECT_DOUBLE_EQ(*std::get<wall::NeoHookeParameters>(c.wall->material).elastic.young_modulus, 3e5);
  EXPECT_EQ(c.mesh_motion->poisson_ratio, 0.3);
  ASSERT_EQ(c.boundary.size(), 5u);
  EXPECT_EQ(c.boundary[4].first, "wall_outer");
  const auto& pulse = std::get<bc::Step>(std::get<bc::Pressure>(c.boundary[0].second).pressure.source);
  EXPECT_DOUBLE_EQ(pulse.value, 1333.2);
  EXPECT_EQ(c.time->steps, 100);
  EXPECT_EQ(c.output.directory, "folder/results");
  EXPECT_EQ(c.output.units.pressure, "mmHg");
}

TEST(Case, EveryAnalysisNeedsItsPartsAndNoOthers) {
  const auto missing = problems_of("analysis: fsi\nmeshes: {tube: {radius: 1 mm, length: 1 mm}}\nboundary: {}\n");
  for (const char* part : {"fluid", "wall", "time", "meshes.wall", "meshes.interface"})
    EXPECT_TRUE(mentions(missing, part, "is missing, but `analysis: fsi` needs it")) << part;
  EXPECT_TRUE(mentions(missing, "boundary", "names no face"));

  const std::string tube = "meshes: {tube: {radius: 1 mm, length: 1 mm}}\nboundary: {a: no_slip}\n";
  EXPECT_TRUE(problems_of("analysis: flow\n" + tube + fluid_part + time_part).empty());
  const auto unused = problems_of("analysis: flow\n" + tube + fluid_part + wall_part + time_part + "mesh_motion: {}\n");
  EXPECT_TRUE(mentions(unused, "wall (case.yaml:5)", "is given, but `analysis: flow` does not use it"));
  EXPECT_TRUE(mentions(unused, "mesh_motion", "does not use it"));

  const Case wall = parse_case(
      "analysis: {static_wall: {load_steps: 3}}\nmeshes: {length_unit: cm, wall: {simvascular: w}}\n"
      "boundary: {a: fixed}\n" +
          wall_part,
      "case.yaml");
  EXPECT_EQ(std::get<StaticWall>(wall.analysis).load_steps, 3);
  EXPECT_FALSE(wall.mesh_motion);
}

TEST(Case, ElementsAreLinearOrQuadraticWithPrestressToo) {
  EXPECT_TRUE(problems_of(coupled() + "elements: quadratic\n").empty());
  EXPECT_TRUE(problems_of(coupled() + "elements: quadratic\nprestress: {flow: {pressure: 80 mmHg, inflow: 80 ml/s}}\n")
                  .empty());
  EXPECT_TRUE(mentions(problems_of(coupled() + "elements: cubic\n"), "elements", "quadratic"));
}

TEST(Case, MeshesComeFromExactlyOneSource) {
  const std::string rest = fluid_part + time_part + "analysis: flow\nboundary: {a: no_slip}\n";
  EXPECT_TRUE(mentions(problems_of(rest + "meshes: {}"), "meshes", "no mesh is given"));
  EXPECT_TRUE(mentions(
      problems_of(rest + "meshes: {length_unit: cm, lumen: {simvascular: a}, tube: {radius: 1 mm, length: 1 mm}}"),
      "meshes", "more than one source"));
  EXPECT_TRUE(mentions(problems_of(rest + "meshes: {lumen: {simvascular: a}}"), "meshes", "`length_unit` is missing"));
  EXPECT_TRUE(mentions(problems_of(rest + "meshes: {length_unit: cm, lumen: {simvascular: a, volume: b.vtu}}"),
                       "meshes.lumen", "both given"));
  EXPECT_TRUE(mentions(problems_of(rest + "meshes: {length_unit: cm, lumen: {volume: b.vtu}}"), "meshes.lumen.faces",
                       "is missing"));
  EXPECT_TRUE(mentions(problems_of(rest + "meshes: {length_unit: cm, lumen: {}}"), "meshes.lumen", "no mesh is given"));
  EXPECT_TRUE(mentions(problems_of(rest + "meshes: {length_unit: kg, lumen: {simvascular: a}}"), "meshes.length_unit",
                       "unit of a mass"));
  EXPECT_TRUE(mentions(problems_of(rest + "meshes: {length_unit: m, tube: {radius: 1 mm, length: 1 mm}}"),
                       "meshes.length_unit", "no mesh is read"));
  EXPECT_TRUE(mentions(problems_of(rest + "meshes: {tube: {radius: 1 mm, length: 1 mm, cells_around: 6}}"),
                       "meshes.tube.cells_around", "no multiple of 4"));
}

TEST(Case, GmshRegionsHaveKinds) {
  const std::string rest = fluid_part + wall_part + time_part + boundary_part + "analysis: fsi\n";
  const Case c = parse_case(
      rest +
          "meshes:\n  length_unit: mm\n  gmsh: {file: a.msh, regions: {blood: lumen, wall: wall, flap: wall}}\n"
          "  interface: {lumen: blood_interface, wall: [wall_interface, flap_interface]}\n",
      "case.yaml");
  EXPECT_EQ(c.meshes.gmsh->regions.at("flap"), mesh::RegionKind::wall);
  EXPECT_EQ(c.meshes.interface->wall_faces.size(), 2u);
  EXPECT_TRUE(c.meshes.has_lumen() && c.meshes.has_wall());
  EXPECT_TRUE(
      mentions(problems_of(rest + "meshes: {length_unit: mm, gmsh: {file: a.msh, regions: {a: lumen, b: lumen}}}"),
               "meshes.gmsh.regions", "names 2 lumens"));
  EXPECT_TRUE(mentions(problems_of(rest + "meshes: {length_unit: mm, gmsh: {file: a.msh, regions: {a: wal}}}"),
                       "meshes.gmsh.regions.a", "`wal` is not one of"));
}

TEST(Case, OutputUnitsAreChecked) {
  EXPECT_EQ(parse_case(coupled() + "output: {units: {stress: dyn/cm^2}}", "c").output.units.stress, "dyn/cm^2");
  EXPECT_TRUE(
      mentions(problems_of(coupled() + "output: {units: {stress: mm}}"), "output.units.stress", "unit of a length"));
}

TEST(Case, FieldsAreChosenByName) {
  const auto chosen = [](const std::string& output) {
    const auto c = parse_case(coupled() + "output: {" + output + "}", "c");
    std::string keys;
    for (std::size_t i = 0; i < c.output.fields.size(); ++i)
      if (c.output.fields[i]) keys += quantities::keys()[i] + " ";
    return keys;
  };
  EXPECT_EQ(chosen("fields: [vorticity, velocity]"), "velocity vorticity ");
  EXPECT_EQ(chosen("every: 1"),
            "velocity displacement pressure wall_shear_stress wall_pressure von_mises_stress first_principal_stress "
            "fibre_stress ");
  EXPECT_TRUE(mentions(problems_of(coupled() + "output: {fields: [vorticty]}"), "output.fields", "is not one of"));
  EXPECT_TRUE(mentions(problems_of(coupled() + "post: {}\noutput: {fields: [velocity, displacement, vorticity]}"),
                       "output.fields", "`post` reads: pressure, wall_shear_stress"));
}

TEST(Case, FieldsThatNoResultsWillHaveAreWarnings) {
  const auto warnings = [](const std::string& fields) {
    return read_case(coupled() + "post: {}\noutput: {fields: [velocity, displacement, pressure, wall_shear_stress" +
                         fields + "]}",
                     "case.yaml")
        .warnings;
  };
  EXPECT_TRUE(mentions(warnings(""), "output.fields", "names no stress of elements"));
  EXPECT_TRUE(mentions(warnings(", fibre_stretch"), "output.fields", "`fibre_stretch` is not written: no law"));
  EXPECT_FALSE(mentions(warnings(", von_mises_stress"), "output.fields", ""));
}

TEST(Case, SlipsOfTheUnitAreWarnings) {
  const Folder folder;
  std::string yaml = coupled();
  const std::string good = "fluid: {", bad = "fluid: {density: 1.06 kg/m^3, ";
  yaml.replace(yaml.find(good), good.size(), bad);
  const auto warnings = read_case(folder.write("case.yaml", yaml)).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].where.find("fluid.density"), std::string::npos);
  EXPECT_EQ(warnings[0].remedy, "a slip of the unit? `1.06 g/cm^3` would be usual");
}

TEST(Case, TablesAreReadAndTheirErrorsNameTheFace) {
  const Folder folder;
  folder.write("q.csv", "t,q\n0,1\n0,2\n");
  std::string yaml = coupled();
  const std::string good = "lumen_outlet: {pressure: 0 Pa}";
  yaml.replace(yaml.find(good), good.size(), "lumen_outlet: {flow: {table: {file: q.csv, time_unit: s, unit: ml/s}}}");
  try {
    read_case(folder.write("case.yaml", yaml));
    ADD_FAILURE() << "a table whose time stands still was accepted";
  } catch (const InputError& error) {
    EXPECT_TRUE(mentions(error.problems(), "boundary.lumen_outlet", ""));
  }
}

TEST(Case, OutletsByFractions) {
  const std::string head = "analysis: flow\nmeshes: {tube: {radius: 1 mm, length: 1 mm}}\n" + fluid_part + time_part,
                    faces = "boundary: {lumen_inlet: {flow: 1 ml/s}, lumen_wall: no_slip}\n";
  const auto outlets = [](const std::string& fractions, const std::string& more = "") {
    return "outlets: {systolic: 125 mmHg, diastolic: 75 mmHg, fractions: {" + fractions + "}" + more + "}\n";
  };
  const Case c = parse_case(head + faces + outlets("a: 0.2, lumen_outlet: 0.795"), "folder/case.yaml");
  ASSERT_EQ(c.boundary.size(), 4u);
  EXPECT_EQ(c.boundary[3].first, "lumen_outlet");
  EXPECT_NEAR(c.outlets->fractions[0].second + c.outlets->fractions[1].second, 1.0, 1e-15);
  EXPECT_NEAR(std::get<bc::Resistance>(c.boundary[2].second).resistance /
                  std::get<bc::Resistance>(c.boundary[3].second).resistance,
              0.795 / 0.2, 1e-12);
  EXPECT_EQ(c.outlets->file(), "folder/outlets/outlets.yaml");
  EXPECT_TRUE(mentions(problems_of(head + faces + outlets("a: 0.2, b: 0.7")), "outlets.fractions", "add up to 0.9"));
  EXPECT_TRUE(mentions(problems_of(head + faces + outlets("lumen_wall: 1")), "boundary.lumen_wall",
                       "is an outlet of `outlets.fractions` as well"));
  EXPECT_TRUE(mentions(problems_of(head + faces + outlets("a: 1", ", distal_pressure: 80 mmHg")),
                       "outlets.distal_pressure", "not below"));
}

}  // namespace
}  // namespace tunica::case_file
