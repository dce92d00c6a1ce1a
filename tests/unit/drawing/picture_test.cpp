#include "tunica/drawing/picture.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tunica/base/error.hpp"
#include "tunica/drawing/picture_colours.hpp"
#include "tunica/drawing/picture_data.hpp"

namespace tunica::drawing {
namespace {

using Colour = std::array<int, 3>;

/// A folder of files that lives as long as a test.
class Picture : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  /// The cube [0, 2]^3 as eight hexahedra with pressure = x + `shift` and displacement = (0, 0, 2).
  std::string write_cube(const std::string& name, double shift = 0.0, bool ascii = false) const {
    vtkNew<vtkPoints> points;
    vtkNew<vtkDoubleArray> pressure, displacement;
    pressure->SetName("pressure");
    displacement->SetName("displacement [mm]");
    displacement->SetNumberOfComponents(3);
    for (int i = 0; i < 27; ++i) {
      points->InsertNextPoint(i % 3, i / 3 % 3, i / 9);
      pressure->InsertNextValue(i % 3 + shift);
      displacement->InsertNextTuple3(0.0, 0.0, 2.0);
    }
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(points);
    for (int c = 0; c < 8; ++c) {
      const vtkIdType n = c % 2 + 3 * (c / 2 % 2) + 9 * (c / 4);
      const vtkIdType nodes[8] = {n, n + 1, n + 4, n + 3, n + 9, n + 10, n + 13, n + 12};
      grid->InsertNextCell(VTK_HEXAHEDRON, 8, nodes);
    }
    vtkNew<vtkDoubleArray> along;
    along->SetName("along");
    along->SetNumberOfComponents(3);
    for (int c = 0; c < 8; ++c) along->InsertNextTuple3(3.0, 0.0, 0.0);
    vtkNew<vtkIntArray> part;  // 3 on the left, 8 on the right
    part->SetName("part");
    for (int c = 0; c < 8; ++c) part->InsertNextValue(c % 2 == 0 ? 3 : 8);
    grid->GetCellData()->AddArray(along);
    grid->GetCellData()->AddArray(part);
    grid->GetPointData()->AddArray(pressure);
    grid->GetPointData()->AddArray(displacement);
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    writer->SetFileName(file(name).c_str());
    writer->SetInputData(grid);
    if (ascii) writer->SetDataModeToAscii();
    writer->Write();
    return file(name);
  }
  /// What refuses a picture; empty when nothing does.
  static std::string message(const PictureOptions& options) {
    try {
      render(options);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  /// Looks at the cube from the front: x to the right, z up.
  PictureOptions front(const std::string& input) const {
    PictureOptions options;
    options.inputs = {input};
    options.output = file("picture.png");
    options.array = "pressure";
    options.view = {{0.0, -1.0, 0.0}};
    options.width = 400;
    options.height = 300;
    return options;
  }

  /// A movie of two cubes in a series that lists the later one first: pressures from 0 to 2, then from 5 to 7.
  PictureOptions movie_of_two_steps() const {
    write_cube("a.vtu");
    write_cube("b.vtu", 5.0);
    std::ofstream(file("series.pvd")) << "<?xml version=\"1.0\"?><VTKFile type=\"Collection\"><Collection>"
                                         "<DataSet timestep=\"0.2\" file=\"b.vtu\"/>"
                                         "<DataSet timestep=\"0.1\" file=\"a.vtu\"/></Collection></VTKFile>";
    auto options = front(file("series.pvd"));
    options.movie = true;
    return options;
  }

  /// Colours across the picture at a height given as a fraction from below.
  std::vector<Colour> row(double height) const {
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(file("picture.png").c_str());
    reader->Update();
    auto* image = reader->GetOutput();
    const int* size = image->GetDimensions();
    std::vector<Colour> colours;
    for (int x = 0; x < size[0]; ++x) {
      Colour colour;
      for (int c = 0; c < 3; ++c)
        colour[static_cast<std::size_t>(c)] =
            static_cast<int>(image->GetScalarComponentAsDouble(x, static_cast<int>(height * size[1]), 0, c));
      colours.push_back(colour);
    }
    return colours;
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("tunica_picture_" + std::to_string(getpid()));
};

bool is_white(const Colour& c) { return c[0] > 250 && c[1] > 250 && c[2] > 250; }

TEST_F(Picture, ColoursTheSurfaceByTheArray) {
  const auto summary = render(front(write_cube("cube.vtu")));
  EXPECT_EQ(summary.limits, (std::array<double, 2>{0.0, 2.0}));
  EXPECT_FALSE(summary.time);
  const auto colours = row(0.46);
  ASSERT_EQ(colours.size(), 400U);
  // 276 pixels high at 8 % border: the cube is 256 wide, centred in the left 332 pixels.
  EXPECT_TRUE(is_white(colours[30]) && is_white(colours[320]));
  const auto left = colours[44], middle = colours[166], right = colours[289];
  EXPECT_GT(left[2], left[1] + 20) << "dark violet at the lowest value";
  EXPECT_GT(middle[1], middle[0] + 30) << "green between";
  EXPECT_GT(right[0], right[2] + 60) << "yellow at the highest value";
}

TEST_F(Picture, LeavesOutTheLargestValuesWhenAsked) {
  auto options = front(write_cube("cube.vtu"));  // more than a third of the values is 0, less than a third 1
  options.percentile = 50;
  EXPECT_EQ(render(options).limits, (std::array<double, 2>{0.0, 1.0}));
  options.percentile = 30;
  EXPECT_EQ(render(options).limits, (std::array<double, 2>{0.0, 0.0}));
}

TEST_F(Picture, ScalesAndTakesComponentsOrMagnitude) {
  auto options = front(write_cube("cube.vtu", 1.0));
  options.scale = 10.0;
  EXPECT_EQ(render(options).limits, (std::array<double, 2>{10.0, 30.0}));
  options.array = "displacement";
  EXPECT_EQ(render(options).limits, (std::array<double, 2>{20.0, 20.0}));
  options.component = 0;
  EXPECT_EQ(render(options).limits, (std::array<double, 2>{0.0, 0.0}));
  options.component = 3;
  EXPECT_THROW(render(options), InputError);
}

TEST_F(Picture, CutsAwayTheSideThatTheNormalPointsTo) {
  auto options = front(write_cube("cube.vtu"));
  options.clip = ClipPlane{{{1.0, 0.0, 0.0}}, {{1.0, 0.0, 0.0}}};
  EXPECT_EQ(render(options).limits, (std::array<double, 2>{0.0, 1.0}));
  options.clip->origin = {{-1.0, 0.0, 0.0}};
  EXPECT_THROW(render(options), InputError) << "nothing is left";
}

TEST_F(Picture, MovesOnlyWhatHasTheWarpVector) {
  // Beside an unmoved copy the cube reaches twice as high, so both together are drawn half as wide.
  auto options = front(write_cube("moving.vtu"));
  options.warp = "displacement";
  options.clip = ClipPlane{{{0.0, 0.0, 2.5}}, {{0.0, 0.0, -1.0}}};
  render(options);
  options.warp.clear();
  EXPECT_THROW(render(options), InputError) << "unmoved, the cube lies below the plane";
}

TEST_F(Picture, DrawsTheWantedStepOfASeries) {
  write_cube("a.vtu");
  write_cube("b.vtu", 5.0);
  std::ofstream(file("series.pvd")) << "<?xml version=\"1.0\"?><VTKFile type=\"Collection\"><Collection>"
                                       "<DataSet timestep=\"0.2\" file=\"b.vtu\"/>"
                                       "<DataSet timestep=\"0.1\" part=\"0\" file=\"a.vtu\"/>"
                                       "<DataSet timestep=\"0.1\" part=\"1\" file=\"b.vtu\"/>"
                                       "</Collection></VTKFile>";
  const auto steps = read_series(file("series.pvd"));
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].files, (std::vector{file("a.vtu"), file("b.vtu")}));
  auto options = front(file("series.pvd"));
  auto summary = render(options);
  EXPECT_EQ(summary.time, 0.2);
  EXPECT_EQ(summary.limits, (std::array<double, 2>{5.0, 7.0}));
  options.time = 0.12;
  summary = render(options);
  EXPECT_EQ(summary.time, 0.1);
  EXPECT_EQ(summary.limits, (std::array<double, 2>{0.0, 7.0}));
}

TEST_F(Picture, DrawsLinesAlongVectorsAndShowsAFocus) {
  auto options = front(write_cube("cube.vtu"));
  options.array.clear();
  options.width = 332;  // as wide as the cube's part of the other pictures
  const auto dark = [&](double height) {
    const auto colours = row(height);
    return std::count_if(colours.begin(), colours.end(), [](const Colour& c) { return c[0] + c[1] + c[2] < 300; });
  };
  render(options);
  EXPECT_EQ(dark(0.247), 0);
  options.lines = "along";
  options.line_length = 0.8;
  render(options);
  // The lines lie along x through the middles of the cells, half a unit (64 pixels) below the middle at 0.46.
  EXPECT_GT(dark(0.244) + dark(0.247) + dark(0.25), 100);
  EXPECT_EQ(dark(0.46), 0);
  options.lines = "displacement";
  EXPECT_THROW(render(options), InputError) << "it is of the points";
  options.lines.clear();
  options.focus = Focus{{{1.0, 0.0, 1.0}}, 0.5};
  render(options);
  EXPECT_FALSE(is_white(row(0.46)[40])) << "half the cube fills the picture";
  options.focus->radius = 0;
  EXPECT_THROW(render(options), InputError);
}

TEST_F(Picture, SignedValuesHaveAMapAboutZero) {
  EXPECT_EQ(render(front(write_cube("cube.vtu", -1.0))).limits, (std::array<double, 2>{-1.0, 1.0}));
  const auto colours = row(0.46);
  const auto left = colours[44], middle = colours[166], right = colours[289];
  EXPECT_GT(left[2], left[0] + 60) << "blue below zero";
  EXPECT_NEAR(middle[0], middle[2], 12) << "grey at zero";
  EXPECT_GT(right[0], right[2] + 60) << "red above it";
  auto options = front(write_cube("cube.vtu", -0.5));  // -0.5, 0.5, 1.5: two thirds are smaller than 1
  options.percentile = 60;
  EXPECT_EQ(render(options).limits, (std::array<double, 2>{-0.5, 0.5}));
}

TEST_F(Picture, WholeNumbersAreCategories) {
  auto options = front(write_cube("cube.vtu"));
  options.array = "part";
  EXPECT_EQ(render(options).limits, (std::array<double, 2>{3.0, 8.0}));
  const auto colours = row(0.46);
  const auto left = colours[80], right = colours[260];
  EXPECT_GT(left[2], left[0] + 80) << "blue";
  EXPECT_GT(right[0], right[2] + 80) << "orange";
  EXPECT_EQ(colours[60], colours[150]) << "nothing between two categories";
}

TEST(PictureKey, WritesUnitsAsReadersDo) {
  EXPECT_EQ(with_readable_unit("velocity [cm s^-1]"), "velocity [cm/s]");
  EXPECT_EQ(with_readable_unit("RRT [Pa^-1]"), "RRT [1/Pa]");
  EXPECT_EQ(with_readable_unit("force [kg m s^-2]"), "force [kg m/s²]");
  EXPECT_EQ(with_readable_unit("pressure [mmHg]"), "pressure [mmHg]");
  EXPECT_EQ(with_readable_unit("OSI"), "OSI");
}

TEST_F(Picture, FitsTheSceneWithoutASize) {
  auto options = front(write_cube("cube.vtu"));
  options.width = options.height = 0;
  render(options);
  // The cube, 1/1.08 of the scene's width, fills what the key leaves.
  const auto colours = row(0.46);
  const auto seen = [&](double at) {
    return !is_white(colours[static_cast<std::size_t>(at * static_cast<double>(colours.size()))]);
  };
  EXPECT_TRUE(seen(0.05) && seen(0.77)) << colours.size();
}

TEST_F(Picture, StreamlinesFollowVectors) {
  auto options = front(write_cube("cube.vtu"));
  options.streamlines = "displacement";
  options.array = "pressure";
  options.seeds = 27;
  options.width = 1200, options.height = 900;
  EXPECT_EQ(render(options).limits, (std::array<double, 2>{0.0, 2.0}));
  // They stand upright, at x = 0, 1 and 2: dark violet, green, yellow, with the shell between them.
  const auto colours = row(0.46);
  const auto strong = std::count_if(colours.begin(), colours.begin() + 1020, [](const Colour& c) {
    return *std::max_element(c.begin(), c.end()) - *std::min_element(c.begin(), c.end()) > 60;
  });
  EXPECT_GT(strong, 3);
  EXPECT_LT(strong, 120);
  options.array.clear();
  EXPECT_EQ(render(options).limits, (std::array<double, 2>{2.0, 2.0})) << "coloured by their own size";
  options.streamlines = "pressure";
  EXPECT_NE(message(options).find("no input has a point array 'pressure' of vectors to follow"), std::string::npos)
      << message(options);
}

TEST_F(Picture, MoviesHaveAllStepsInTheSameColours) {
  auto options = movie_of_two_steps();
  options.width = 401;
  options.output = file("movie.png");
  const auto summary = render(options);
  EXPECT_EQ(summary.frames, 2U);
  EXPECT_EQ(summary.limits, (std::array<double, 2>{0.0, 7.0}));
  EXPECT_TRUE(std::filesystem::exists(file("movie_0001.png")) && std::filesystem::exists(file("movie_0002.png")));
  options.output = file("movie.mp4");
  EXPECT_NE(message(options).find("is no name of a movie"), std::string::npos);
  options.inputs = {file("a.vtu")};
  options.output = file("movie.png");
  EXPECT_NE(message(options).find("no input is a series"), std::string::npos);
}

TEST_F(Picture, MoviesAreEncoded) {
  if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not installed";
  auto options = movie_of_two_steps();
  for (const auto& [name, begin] :
       {std::pair<std::string, std::string>{"movie.gif", "GIF89a"}, {"movie.webm", "\x1a\x45\xdf\xa3"}}) {
    options.output = file(name);
    render(options);
    std::ifstream stream(file(name), std::ios::binary);
    std::string head(begin.size(), ' ');
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    EXPECT_EQ(head, begin) << name;
    EXPECT_FALSE(std::filesystem::exists(file(name + ".part")));
  }
  const std::string path = std::getenv("PATH");
  setenv("PATH", file("").c_str(), 1);
  EXPECT_THROW(render(options), SolverError) << "without ffmpeg";
  setenv("PATH", path.c_str(), 1);
}

TEST_F(Picture, DamagedFilesAreRefused) {
  const auto spoiled = [&](const std::string& name, const std::string& was, const std::string& is) {
    std::ifstream stream(write_cube(name, 0, true));
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    const auto at = text.find(was);
    EXPECT_NE(at, std::string::npos) << was << " in " << text;
    if (at != std::string::npos) text.replace(at, was.size(), is);
    std::ofstream(file(name)) << text;
    return message(front(file(name)));
  };
  const auto expect = [](const std::string& text, const std::string& what) {
    EXPECT_NE(text.find(what), std::string::npos) << text;
  };
  EXPECT_EQ(spoiled("a.vtu", "VTKFile", "VTKFile"), "");
  expect(spoiled("a.vtu", "0 1 4 3 9 10", "0 1 4 3 9 999999"), "a.vtu: a cell names point 999999");
  expect(spoiled("a.vtu", "0 1 4 3 9 10", "0 1 4 3 9 -2"), "a.vtu: a cell names point -2");
  expect(spoiled("a.vtu", "8 16 24", "8 160 24"), "the \"offsets\" array is not monotonically increasing");
  expect(spoiled("a.vtu", "12 12 12", "12 25 12"), "a.vtu: a cell of type 25 has 8 points");
  expect(spoiled("a.vtu", "12 12 12", "12 71 12"), "a.vtu: cells of type 71 are not drawn");
  expect(spoiled("a.vtu", "NumberOfComponents=\"3\"", "NumberOfComponents=\"99999999999\""), "a.vtu");
  write_cube("piece.vtu");
  const auto pieces = [&](const std::string& components) {
    std::ofstream(file("a.pvtu")) << "<VTKFile type=\"PUnstructuredGrid\">\n<PUnstructuredGrid>\n<PPointData>\n"
                                     "<PDataArray type=\"Float64\" Name=\"pressure\" NumberOfComponents=\""
                                  << components << "\"/>\n</PPointData>\n<Piece Source=\"piece.vtu\"/>\n"
                                  << "</PUnstructuredGrid>\n</VTKFile>\n";
    return message(front(file("a.pvtu")));
  };
  EXPECT_EQ(pieces("1"), "");
  expect(pieces("99999999999"), "a.pvtu:4");
  std::ofstream(file("piece.vtu")) << "<VTKFile";
  expect(pieces("1"), "piece.vtu");
  std::ofstream(file("a.vti")) << "";
  expect(message(front(file("a.vti"))), "give .hdf.series, .hdf, .vtu, .pvtu, .vtp, .pvtp or .pvd files");
}

TEST_F(Picture, NamesTheArraysThatExist) {
  auto options = front(write_cube("cube.vtu"));
  options.array = "velocity";
  try {
    render(options);
    FAIL() << "an unknown array was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("displacement [mm], part, pressure"), std::string::npos) << error.what();
  }
  options.array = "pressure";
  options.warp = "velocity";
  EXPECT_THROW(render(options), InputError);
}

TEST_F(Picture, RefusesImpossibleOptions) {
  const auto input = write_cube("cube.vtu");
  auto options = front(input);
  options.inputs = {file("missing.vtu")};
  EXPECT_THROW(render(options), InputError);
  options = front(input);
  options.output = file("picture.jpg");
  options.up = options.view;
  options.width = 3;
  try {
    render(options);
    FAIL() << "impossible options were accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 3U) << error.what();
  }
  options = front(input);
  options.output = file("no/such/folder/picture.png");
  EXPECT_THROW(render(options), InputError);
}

TEST_F(Picture, SaysThatADisplayIsMissing) {
  const std::string display = std::getenv("DISPLAY") ? std::getenv("DISPLAY") : "";
  unsetenv("DISPLAY");
  EXPECT_THROW(render(front(write_cube("cube.vtu"))), SolverError);
  setenv("DISPLAY", display.c_str(), 1);
}

}  // namespace
}  // namespace tunica::drawing
