#include "tunica/flow_imaging/read_series.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "tube_flow.hpp"
#include "tunica/base/error.hpp"
#include "tunica/imaging/value_image.hpp"

namespace tunica::flow_imaging {
namespace {

class ReadSeries : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("tunica_series_" + std::to_string(::getpid()) +
                                                        testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
    PhaseContrast scan;
    scan.frames = 5;
    scan.voxel = 4e-3;
    scan.tilt = 0.3;
    series_ = TubeFlow().imaged(scan);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  SeriesFiles files() const {
    return {.x = folder_ / "velocity_x.nii.gz",
            .y = folder_ / "velocity_y.nii.gz",
            .z = folder_ / "velocity_z.nii.gz",
            .field = {},
            .magnitude = folder_ / "magnitude.nii.gz",
            .unit = 1,
            .encoding = 1.5,
            .period = 0.8,
            .times = {},
            .axes = SeriesFiles::Axes::image};
  }
  std::string message(const SeriesFiles& f) const {
    try {
      read_series(f, "velocity");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  void expect_same(const VelocitySeries& read) const {
    ASSERT_EQ(read.frame.size, series_.frame.size);
    EXPECT_LT(norm(read.frame.origin - series_.frame.origin), 1e-7);
    ASSERT_EQ(read.frames(), series_.frames());
    for (std::size_t k = 0; k < read.frames(); ++k) {
      EXPECT_NEAR(read.times[k], series_.times[k], 1e-6);
      for (std::size_t d = 0; d < 3; ++d)
        for (std::size_t n = 0; n < series_.velocity[k][d].size(); n += 7)
          ASSERT_NEAR(read.velocity[k][d][n], series_.velocity[k][d][n], 1e-5);
    }
  }
  /// One NRRD of raw floats.
  void write_nrrd(const std::string& name, const std::string& sizes, const std::string& first_direction,
                  const std::string& last_direction, const std::vector<float>& values) const {
    std::ofstream file(folder_ / name, std::ios::binary);
    const auto& f = series_.frame;
    const auto vector = [](const Vec3<double>& v) {
      return "(" + std::to_string(1e3 * v[0]) + "," + std::to_string(1e3 * v[1]) + "," + std::to_string(1e3 * v[2]) +
             ")";
    };
    file << "NRRD0005\ntype: float\ndimension: " << (first_direction.empty() && last_direction.empty() ? 3 : 4)
         << "\nspace: left-posterior-superior\nsizes: " << sizes << "\nspace directions: " << first_direction
         << vector(f.steps[0]) << " " << vector(f.steps[1]) << " " << vector(f.steps[2]) << last_direction
         << "\nspace origin: " << vector(f.origin) << "\nendian: little\nencoding: raw\n\n";
    file.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(4 * values.size()));
  }
  std::string size_text() const {
    const auto& s = series_.frame.size;
    return std::to_string(s[0]) + " " + std::to_string(s[1]) + " " + std::to_string(s[2]);
  }

  std::filesystem::path folder_;
  VelocitySeries series_;
};

TEST_F(ReadSeries, NiftiThereAndBack) {
  write_series(series_, folder_);
  const auto read = read_series(files(), "velocity");
  expect_same(read);
  for (std::size_t n = 0; n < read.magnitude.size(); ++n) EXPECT_FLOAT_EQ(read.magnitude[n], series_.magnitude[n]);
}

TEST_F(ReadSeries, NrrdFramesOfVectors) {
  for (std::size_t k = 0; k < series_.frames(); ++k) {
    std::vector<float> values;
    for (std::size_t n = 0; n < series_.velocity[k][0].size(); ++n)
      for (std::size_t d = 0; d < 3; ++d) values.push_back(100 * series_.velocity[k][d][n]);  // cm/s
    write_nrrd("v_" + std::to_string(k + 8) + ".nrrd", "3 " + size_text(), "none ", "", values);
  }
  SeriesFiles f;
  f.field = folder_ / "v_*.nrrd";
  f.unit = 0.01;
  f.period = 0.8;
  expect_same(read_series(f, "velocity"));
  std::filesystem::remove(folder_ / "v_10.nrrd");
  EXPECT_NE(message(f).find("after frame 9"), std::string::npos) << message(f);
}

TEST_F(ReadSeries, NrrdComponentsOverTime) {
  const char* names[] = {"x.nrrd", "y.nrrd", "z.nrrd"};
  for (std::size_t d = 0; d < 3; ++d) {
    std::vector<float> values;
    for (const auto& v : series_.velocity) values.insert(values.end(), v[d].begin(), v[d].end());
    write_nrrd(names[d], size_text() + " 5", "", " none", values);
  }
  SeriesFiles f;
  f.x = folder_ / "x.nrrd", f.y = folder_ / "y.nrrd", f.z = folder_ / "z.nrrd";
  f.period = 0.8;
  expect_same(read_series(f, "velocity"));
}

TEST_F(ReadSeries, MetaImageOverTime) {
  const auto& s = series_.frame.size;
  const char* names[] = {"x.mha", "y.mha", "z.mha"};
  for (std::size_t d = 0; d < 3; ++d) {
    std::ofstream file(folder_ / names[d], std::ios::binary);
    file << "ObjectType = Image\nNDims = 4\nBinaryData = True\nBinaryDataByteOrderMSB = False\nTransformMatrix =";
    for (std::size_t a = 0; a < 3; ++a) {
      for (int c = 0; c < 3; ++c)
        file << " " << std::to_string(series_.frame.steps[a][c] / norm(series_.frame.steps[a]));
      file << " 0";
    }
    file << " 0 0 0 1\nOffset = " << 1e3 * series_.frame.origin[0] << " " << 1e3 * series_.frame.origin[1] << " "
         << 1e3 * series_.frame.origin[2] << " 0\nElementSpacing = 4 4 4 1\nDimSize = " << s[0] << " " << s[1] << " "
         << s[2] << " 5\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n";
    for (const auto& v : series_.velocity)
      file.write(reinterpret_cast<const char*>(v[d].data()), static_cast<std::streamsize>(4 * v[d].size()));
  }
  SeriesFiles f;
  f.x = folder_ / "x.mha", f.y = folder_ / "y.mha", f.z = folder_ / "z.mha";
  f.period = 0.8;
  const auto read = read_series(f, "velocity");
  ASSERT_EQ(read.frames(), 5U);
  EXPECT_FLOAT_EQ(read.velocity[3][2][11], series_.velocity[3][2][11]);
}

TEST_F(ReadSeries, WrongUnitOtherVoxelsAndMissingFramesAreTold) {
  write_series(series_, folder_);
  auto f = files();
  f.unit = 0.001;
  EXPECT_NE(message(f).find("velocity.unit"), std::string::npos) << message(f);
  f = files();
  f.encoding = 0.3;
  EXPECT_NE(message(f).find("beyond the encoding velocity"), std::string::npos) << message(f);
  f = files();
  f.times = {0, 0.1, 0.1, 0.3, 0.4};
  EXPECT_NE(message(f).find("both have the time"), std::string::npos) << message(f);
  auto moved = series_.frame;
  moved.origin[0] += 0.1;
  imaging::write_value_series(moved, {series_.magnitude}, 0, folder_ / "magnitude.nii.gz");
  EXPECT_NE(message(files()).find("other voxels"), std::string::npos) << message(files());
  f = files();
  f.y = folder_ / "y_*.nii";
  EXPECT_NE(message(f).find("no file is named like"), std::string::npos) << message(f);
}

}  // namespace
}  // namespace tunica::flow_imaging
