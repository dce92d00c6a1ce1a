// Files of labelled images: written and read back, and written by hand after the definition of each format.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "unit/imaging/image_file.hpp"

namespace tunica::imaging {
namespace {

/// Axes turned about an oblique direction; unequal spacings; mirrored on request.
ImageFrame oblique_frame(bool mirrored) {
  const double a = 0.4, b = -0.7, c = std::cos(a), s = std::sin(a), d = std::cos(b), e = std::sin(b);
  const Vec3<double> x{{c, s * d, s * e}}, y{{-s, c * d, c * e}}, z{{0, -e, d}};
  return {{5, 4, 3}, {{-0.0123, 0.0456, 0.789}}, {0.7e-3 * x, 0.8e-3 * y, (mirrored ? -1.25e-3 : 1.25e-3) * z}};
}

void expect_equal(const ImageFrame& a, const ImageFrame& b, double tolerance) {
  EXPECT_EQ(a.size, b.size);
  EXPECT_NEAR(norm(a.origin - b.origin), 0, tolerance);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(norm(a.steps[d] - b.steps[d]), 0, tolerance) << d;
}

TEST_F(ImageFile, ComesBackFromEveryFormatWithObliqueAxes) {
  for (const bool mirrored : {false, true}) {
    LabelImage image{oblique_frame(mirrored), {}};
    for (std::int64_t i = 0; i < image.frame.count(); ++i)
      image.labels.push_back(static_cast<std::int16_t>(i * 7 - 90));
    for (const char* name : {"a.nrrd", "a.nhdr", "a.mha", "a.mhd", "a.nii", "a.nii.gz"}) {
      SCOPED_TRACE(name);
      write_label_image(image, folder_ / name);
      const auto read = read_label_image(folder_ / name);
      EXPECT_EQ(read.frame.size, image.frame.size);
      // VTK turns slices around where NIfTI's axes are left-handed: what counts is the label of a place. NIfTI keeps
      // single precision.
      const auto to_voxels = inverse(image.frame.matrix());
      for (std::int64_t i = 0; i < read.frame.count(); ++i) {
        const auto v = to_voxels * (read.frame.place(read.frame.voxel(i)) - image.frame.origin);
        for (int d = 0; d < 3; ++d) EXPECT_NEAR(v[d], std::round(v[d]), 1e-3);
        EXPECT_EQ(read.labels[i],
                  image.labels[image.frame.index(std::lround(v[0]), std::lround(v[1]), std::lround(v[2]))]);
      }
    }
  }
}

TEST_F(ImageFile, NrrdOfAnotherSpaceAsText) {
  const auto read = read_label_image(write("a.nrrd",
                                           "NRRD0005\n# made by hand\ntype: unsigned char\ndimension: 3\n"
                                           "space: right-anterior-superior\nsizes: 2 2 3\n"
                                           "space directions: (0,2,0) (0.5,0,0) (0,0,3)\nspace origin: (10, 20, 30)\n"
                                           "key:=value\nencoding: ascii\n\n0 1 2 3\n4 5 6 7\n8 9 10 11\n"));
  expect_equal(read.frame,
               {{2, 2, 3}, {{-0.010, -0.020, 0.030}}, {{{{0, -2e-3, 0}}, {{-0.5e-3, 0, 0}}, {{0, 0, 3e-3}}}}}, 1e-15);
  EXPECT_EQ(read.labels[read.frame.index(1, 0, 2)], 9);
}

TEST_F(ImageFile, NrrdOfBigEndianShortsInCentimetres) {
  const std::string header =
      "NRRD0004\ntype: unsigned short\ndimension: 3\nspace dimension: 3\nsizes: 2 2 2\n"
      "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace units: \"cm\" \"cm\" \"cm\"\nendian: big\nencoding: raw\n\n";
  const auto read = read_label_image(write("a.nrrd", header + std::string("\0\1\0\2\0\3\0\4\1\0\0\6\0\7\0\10", 16)));
  EXPECT_EQ(read.labels, (std::vector<std::int16_t>{1, 2, 3, 4, 256, 6, 7, 8}));
  EXPECT_DOUBLE_EQ(read.frame.steps[0][0], 1e-2);
}

TEST_F(ImageFile, MetaImageListsTheDirectionsOfItsAxes) {
  const auto read = read_label_image(write("a.mha",
                                           "ObjectType = Image\nNDims = 3\nBinaryData = True\nCompressedData = False\n"
                                           "TransformMatrix = 0 1 0 0 0 1 1 0 0\nOffset = 1 2 3\n"
                                           "ElementSpacing = 0.5 1 2\nDimSize = 2 2 2\nElementType = MET_UCHAR\n"
                                           "ElementDataFile = LOCAL\n" +
                                               std::string("\0\1\2\3\4\5\6\7", 8)));
  expect_equal(read.frame, {{2, 2, 2}, {{1e-3, 2e-3, 3e-3}}, {{{{0, 0.5e-3, 0}}, {{0, 0, 1e-3}}, {{2e-3, 0, 0}}}}},
               1e-15);
  EXPECT_EQ(read.labels[3], 3);
}

TEST_F(ImageFile, NiftiWithAQuaternion) {
  const auto read = read_label_image(write("a.nii", nifti_header(1) + std::string("\0\1\2\3\4\5\6\7", 8)));
  // Its x points to the right and its y to the front.
  expect_equal(read.frame, {{2, 2, 2}, {{-0.010, -0.020, 0.030}}, {{{{0, -2e-3, 0}}, {{3e-3, 0, 0}}, {{0, 0, 4e-3}}}}},
               1e-8);
  EXPECT_EQ(read.labels[5], 5);
}

TEST_F(ImageFile, RefusesWhatIsNoLabelledVolume) {
  EXPECT_NE(refusal("a.dcm", "").find("no known kind of image"), std::string::npos);
  EXPECT_NE(refusal("a.nrrd", "PNG").find("no NRRD file"), std::string::npos);
  const std::string start = "NRRD0004\ntype: uchar\n", end = "encoding: ascii\n\n0 1 2 3 4 5 6 7";
  EXPECT_NE(refusal("a.nrrd", start + "dimension: 2\nsizes: 4 2\n" + end).find("2 dimensions"), std::string::npos);
  EXPECT_NE(refusal("a.nrrd", start + "dimension: 3\nsizes: 2 2 2\n" + end).find("no voxel spacing"),
            std::string::npos);
  EXPECT_NE(refusal("a.nrrd", start + "dimension: 3\nspacings: 1 1 1\nsizes: 4 2 1\n" + end).find("4 x 2 x 1"),
            std::string::npos);
  EXPECT_NE(refusal("a.nrrd", start + "dimension: 3\nspacings: 1 0 1\nsizes: 2 2 2\n" + end).find("voxel spacing"),
            std::string::npos);
  EXPECT_NE(refusal("a.nrrd", start + "dimension: 3\nspacings: 1 nan 1\nsizes: 2 2 2\n" + end).find("voxel spacing"),
            std::string::npos);
  EXPECT_NE(refusal("a.nrrd", start + "dimension: 3\nspacings: 1 1 1\nsizes: 2 2 3\n" + end).find("values as text"),
            std::string::npos);
  EXPECT_NE(
      refusal("a.nrrd", start + "dimension: 3\nspacings: 1 1 1\nsizes: 2 2 2\nencoding: ascii\n\n0 1 2 3 4 .5 6 7")
          .find("the value of voxel 5 is 0.5"),
      std::string::npos);
  EXPECT_NE(refusal("a.nrrd", start + "dimension: 3\nspacings: 1 1 1\nsizes: 2 2 2\nencoding: gzip\n\nnot zipped")
                .find("damaged"),
            std::string::npos);
  EXPECT_NE(refusal("a.mha", "NDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n")
                .find("no voxel spacing"),
            std::string::npos);
  EXPECT_NE(refusal("a.mha",
                    "NDims = 3\nDimSize = 2 2 2\nElementSpacing = 1 1 1\nElementType = MET_UCHAR\n"
                    "ElementDataFile = LOCAL\n1234567")
                .find("holds 7 bytes of data, its size of 2 x 2 x 2 voxels asks for 8"),
            std::string::npos);
  EXPECT_NE(refusal("a.nii", nifti_header(0) + std::string(8, '\1')).find("no orientation"), std::string::npos);
  auto flat = nifti_header(1);
  std::memset(flat.data() + 84, 0, 4);
  EXPECT_NE(refusal("a.nii", flat + std::string(8, '\1')).find("spacing"), std::string::npos);
}

}  // namespace
}  // namespace tunica::imaging
