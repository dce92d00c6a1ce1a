// Where the voxels of an image lie, and that every format keeps them there.
#include "tunica/imaging/label_image.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "small_images.hpp"
#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/imaging/image_formats.hpp"

namespace tunica::imaging {
namespace {

using namespace testing;

TEST(ImageFrame, NeighboursAreThoseThatTouch) {
  const ImageFrame frame{{4, 5, 6}, {{0.1, 0.2, 0.3}}, oblique()};
  for (std::int64_t index = 0; index < frame.count(); ++index) {
    const auto v = frame.voxel(index);
    ASSERT_EQ(frame.index(v[0], v[1], v[2]), index);
    std::set<std::int64_t> by_faces, all, expected_faces, expected_all;
    for_each_face_neighbour(frame, index, [&](std::int64_t other) { by_faces.insert(other); });
    for_each_neighbour(frame, index, [&](std::int64_t other, const Size3& step) {
      all.insert(other);
      const auto way = frame.place(frame.voxel(other)) - frame.place(v);
      Vec3<double> steps{{0, 0, 0}};
      for (int d = 0; d < 3; ++d) steps = steps + static_cast<double>(step[d]) * frame.steps[d];
      EXPECT_NEAR(norm(way - steps), 0, 1e-15);
    });
    for (std::int64_t other = 0; other < frame.count(); ++other) {
      const auto w = frame.voxel(other);
      std::int64_t most = 0, sum = 0;
      for (int d = 0; d < 3; ++d) {
        most = std::max(most, std::abs(w[d] - v[d]));
        sum += std::abs(w[d] - v[d]);
      }
      if (sum == 1) expected_faces.insert(other);
      if (most == 1) expected_all.insert(other);
    }
    EXPECT_EQ(by_faces, expected_faces) << index;
    EXPECT_EQ(all, expected_all) << index;
  }
}

TEST(ImageFrame, BoxAboutABallHoldsAllOfIt) {
  // Axes far from right angles.
  const ImageFrame frame{{12, 14, 10},
                         {{-4 * mm, -5 * mm, -3 * mm}},
                         {{{{0.8 * mm, 0, 0}}, {{0.5 * mm, 0.6 * mm, 0}}, {{-0.2 * mm, 0.3 * mm, 0.9 * mm}}}}};
  EXPECT_NEAR(frame.voxel_volume(), 0.8 * 0.6 * 0.9 * std::pow(mm, 3), 1e-24);
  for (const Point& centre : {frame.place(Size3{6, 7, 5}), frame.place(Size3{1, 12, 2}), Point{{0, 0, 40 * mm}}}) {
    const double radius = 2.1 * mm;
    std::set<std::int64_t> visited;
    for_each_voxel_near(frame, centre, radius, [&](std::int64_t i) { EXPECT_TRUE(visited.insert(i).second); });
    for (std::int64_t i = 0; i < frame.count(); ++i)
      if (norm(frame.place(frame.voxel(i)) - centre) < radius) {
        EXPECT_TRUE(visited.contains(i)) << i;
      }
    EXPECT_LT(static_cast<double>(visited.size()) * frame.voxel_volume(), 10 * std::pow(2 * radius, 3));
  }
}

TEST(LabelImage, StaysInPlaceInEveryFormatForEveryOrderOfItsAxes) {
  const test::TemporaryFolder folder;
  const Size3 size{3, 4, 2};
  int order[3] = {0, 1, 2};
  do
    for (int signs = 0; signs < 8; ++signs) {
      LabelImage image{{size, {{3 * mm, -5 * mm, 7 * mm}}, {}}, {}};
      for (int a = 0; a < 3; ++a) image.frame.steps[a][order[a]] = (signs >> a & 1 ? -0.5 : 0.5) * (a + 1) * mm;
      for (std::int64_t i = 0; i < image.frame.count(); ++i)
        image.labels.push_back(static_cast<std::int16_t>(100 * i - 1000));
      // Places in tenths of a millimetre, since NIfTI keeps single precision.
      const auto places = [](const LabelImage& of) {
        std::map<std::array<long, 3>, int> labels;
        for (std::int64_t i = 0; i < of.frame.count(); ++i) {
          const auto p = of.frame.place(of.frame.voxel(i));
          labels[{std::lround(p[0] / (0.1 * mm)), std::lround(p[1] / (0.1 * mm)), std::lround(p[2] / (0.1 * mm))}] =
              of.labels[static_cast<std::size_t>(i)];
        }
        return labels;
      };
      ASSERT_EQ(places(image).size(), 24U);
      for (const char* name : {"a.nrrd", "a.mha", "a.nii"}) {
        write_label_image(image, folder.path() / name);
        EXPECT_EQ(places(read_label_image(folder.path() / name)), places(image))
            << name << ", axes " << order[0] << order[1] << order[2] << ", signs " << signs;
      }
    }
  while (std::next_permutation(order, order + 3));
}

/// The values 0, 1, 2 ... and, where there are any, their negatives.
template <class T>
std::string bytes_of(const std::vector<std::int16_t>& labels, bool big_endian) {
  std::string bytes;
  for (const auto label : labels) {
    const auto value = static_cast<T>(label);
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), &value, sizeof(T));
    if (big_endian != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
  }
  return bytes;
}

struct NamedType {
  const char *nrrd, *metaimage;
  std::string (*bytes)(const std::vector<std::int16_t>&, bool);
  bool has_signs, is_wide;
};
constexpr NamedType types[] = {{"signed char", "MET_CHAR", bytes_of<std::int8_t>, true, false},
                               {"uint8", "MET_UCHAR", bytes_of<std::uint8_t>, false, false},
                               {"short", "MET_SHORT", bytes_of<std::int16_t>, true, true},
                               {"uint16_t", "MET_USHORT", bytes_of<std::uint16_t>, false, true},
                               {"int", "MET_INT", bytes_of<std::int32_t>, true, true},
                               {"unsigned int", "MET_UINT", bytes_of<std::uint32_t>, false, true},
                               {"longlong", "MET_LONG_LONG", bytes_of<std::int64_t>, true, true},
                               {"uint64", "MET_ULONG_LONG", bytes_of<std::uint64_t>, false, true},
                               {"float", "MET_FLOAT", bytes_of<float>, true, true},
                               {"double", "MET_DOUBLE", bytes_of<double>, true, true}};

TEST(LabelImage, MayHoldItsLabelsInAnyTypeAndByteOrder) {
  const test::TemporaryFolder folder;
  for (const auto& type : types)
    for (const bool big_endian : {false, true}) {
      SCOPED_TRACE(std::string(type.nrrd) + (big_endian ? ", big-endian" : ", little-endian"));
      std::vector<std::int16_t> labels = {0, 1, 2, 5, 127, 64, 3, 4};
      if (type.has_signs) labels[6] = -128;
      if (type.is_wide) labels[7] = 12345;
      const auto bytes = type.bytes(labels, big_endian);
      std::ofstream(folder.path() / "a.nrrd", std::ios::binary)
          << "NRRD0004\ntype: " << type.nrrd
          << "\ndimension: 3\nsizes: 2 2 2\nspacings: 1 1 1\nendian: " << (big_endian ? "big" : "little")
          << "\nencoding: raw\n\n"
          << bytes;
      EXPECT_EQ(read_label_image(folder.path() / "a.nrrd").labels, labels);
      std::ofstream(folder.path() / "a.mha", std::ios::binary)
          << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = "
          << (big_endian ? "True" : "False")
          << "\nElementSpacing = 1 1 1\nDimSize = 2 2 2\nElementType = " << type.metaimage
          << "\nElementDataFile = LOCAL\n"
          << bytes;
      EXPECT_EQ(read_label_image(folder.path() / "a.mha").labels, labels);
    }
}

TEST(LabelImage, LargeUnsignedValuesDoNotBecomeNegativeLabels) {
  const test::TemporaryFolder folder;
  for (const char* type : {"MET_USHORT", "MET_UINT", "MET_ULONG_LONG"}) {
    // The first value is 40000, which as a signed number of 16 bits would be -25536.
    std::string bytes(64, '\0');
    bytes[0] = '\x40';
    bytes[1] = '\x9c';
    std::ofstream(folder.path() / "a.mha", std::ios::binary)
        << "NDims = 3\nElementSpacing = 1 1 1\nDimSize = 2 2 2\nElementType = " << type << "\nElementDataFile = LOCAL\n"
        << bytes.substr(0, type == std::string("MET_USHORT") ? 16
                           : type == std::string("MET_UINT") ? 32
                                                             : 64);
    const auto text = test::message_of<InputError>([&] { read_label_image(folder.path() / "a.mha"); });
    EXPECT_NE(text.find("the value of voxel 0 is 40000"), std::string::npos) << type << ": " << text;
  }
}

}  // namespace
}  // namespace tunica::imaging
