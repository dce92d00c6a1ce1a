// Image files that are damaged, hold something else than one labelled volume, or claim to be larger than they are.
#include <zlib.h>

#include <cmath>
#include <limits>

#include "unit/imaging/image_file.hpp"

namespace tunica::imaging {
namespace {

const std::string eight("\0\1\2\3\4\5\6\7", 8);

class DamagedImage : public ImageFile {
 protected:
  /// Expects an InputError whose message has `part`.
  void refused(const std::string& name, const std::string& bytes, const std::string& part) const {
    EXPECT_NE(refusal(name, bytes).find(part), std::string::npos)
        << "expected: " << part << "\nfound: " << refusal(name, bytes);
  }
  std::vector<std::int16_t> labels(const std::string& name, const std::string& bytes) const {
    return read_label_image(write(name, bytes)).labels;
  }
};

const std::vector<std::int16_t> counted{0, 1, 2, 3, 4, 5, 6, 7};

std::string zipped(const std::string& bytes, bool gzip = true) {
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, 15 + (gzip ? 16 : 0), 8, Z_DEFAULT_STRATEGY);
  std::string result(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

template <class T>
std::string nifti_with(std::size_t at, T value, const std::string& data = eight) {
  auto header = nifti_header(1);
  put_at(header, at, value);
  return header + data;
}

std::string nrrd(const std::string& fields, const std::string& data = eight, const std::string& sizes = "2 2 2") {
  return "NRRD0004\ntype: uchar\ndimension: 3\nsizes: " + sizes + "\n" + fields + "\n\n" + data;
}

std::string metaimage(const std::string& fields, const std::string& data = eight, const std::string& sizes = "2 2 2") {
  return "ObjectType = Image\nNDims = 3\nDimSize = " + sizes + "\nElementType = MET_UCHAR\n" + fields +
         "\nElementDataFile = LOCAL\n" + data;
}

const std::string raw_header = "encoding: raw\nspacings: 1 1 1";
const std::string spacing = "ElementSpacing = 1 1 1";
const std::string huge_sizes[] = {"100000 100000 100000", "4611686018427387904 2 2", "9223372036854775807 3 3",
                                  "4294967296 4294967296 2", "2000 2000 2000"};

// --- sizes --------------------------------------------------------------------------------------------------------

TEST_F(DamagedImage, SizesThatOverflowOrNoFileCanHold) {
  for (const auto& sizes : huge_sizes) {
    SCOPED_TRACE(sizes);
    refused("a.nrrd", nrrd(raw_header, eight, sizes), "at most 2147483648 can be read");
    refused("a.nrrd", nrrd("encoding: gzip\nspacings: 1 1 1", zipped(eight), sizes), "at most 2147483648 can be read");
    refused("a.mha", metaimage(spacing, eight, sizes), "at most 2147483648 can be read");
  }
  refused("a.nrrd", nrrd(raw_header, eight, "99999999999999999999 2 2"), "must be 3 whole numbers");
  auto nifti = nifti_header(1);
  for (int d = 1; d <= 3; ++d) put_at(nifti, 40 + 2 * static_cast<std::size_t>(d), std::int16_t{32767});
  refused("a.nii", nifti + eight, "at most 2147483648 can be read");
}

TEST_F(DamagedImage, SizesBelowTwoOrNoWholeNumbers) {
  for (const char* sizes : {"0 2 2", "-2 2 2", "2 2 1"}) {
    refused("a.nrrd", nrrd(raw_header, eight, sizes), "is an image of ");
    refused("a.mha", metaimage(spacing, eight, sizes), "is an image of ");
  }
  for (const char* sizes : {"2.5 2 2", "nan 2 2", "2 2", "2 2 2 2", "1e1 2 2", "two 2 2"}) {
    refused("a.nrrd", nrrd(raw_header, eight, sizes), "field 'sizes' is");
    refused("a.mha", metaimage(spacing, eight, sizes), "field 'dimsize' is");
  }
}

TEST_F(DamagedImage, SizesLargerThanTheFileTakeNoMemory) {
  // Two gigabytes, as the header says.
  const std::string sizes = "1000 1000 2000";
  refused("a.nrrd", nrrd(raw_header, eight, sizes),
          "holds 8 bytes of data, its size of 1000 x 1000 x 2000 voxels asks for");
  refused("a.nrrd", nrrd("encoding: gzip\nspacings: 1 1 1", zipped(eight), sizes), "holds at most ");
  refused("a.nrrd", nrrd("encoding: ascii\nspacings: 1 1 1", "1 2 3", sizes), "holds at most 3 values as text");
  refused("a.mha", metaimage(spacing, eight, sizes), "holds 8 bytes of data");
  refused("a.mha", metaimage(spacing + "\nCompressedData = True", zipped(eight, false), sizes), "holds at most ");
  auto nifti = nifti_header(1);
  for (int d = 1; d <= 3; ++d) put_at(nifti, 40 + 2 * static_cast<std::size_t>(d), std::int16_t{1200});
  refused("a.nii", nifti + eight, "holds 8 bytes of data");
  refused("a.nii.gz", zipped(nifti + eight), "holds at most ");
}

TEST_F(DamagedImage, MoreDataThanTheSizeSays) {
  const auto nine = eight + "\1";
  refused("a.nrrd", nrrd(raw_header, nine), "holds 9 bytes of data, its size of 2 x 2 x 2 voxels asks for 8");
  refused("a.nrrd", nrrd("encoding: gzip\nspacings: 1 1 1", zipped(nine)), "holds more than 8 bytes");
  refused("a.nrrd", nrrd("encoding: ascii\nspacings: 1 1 1", "1 2 3 4 5 6 7 8 9"), "holds more than 8 values as text");
  refused("a.mha", metaimage(spacing, nine), "holds 9 bytes of data");
  refused("a.nii", nifti_header(1) + nine, "holds 9 bytes of data");
  refused("a.nii.gz", zipped(nifti_header(1) + nine), "holds more than 8 bytes");
  // Of a stream that inflates to 64 MB, no more is read than tells that it is too long.
  refused("a.nii.gz", zipped(nifti_header(1) + std::string(std::size_t{1} << 26, '\0')), "holds more than 8 bytes");
}

// --- compression --------------------------------------------------------------------------------------------------

TEST_F(DamagedImage, GzipOfSeveralMembersIsReadToItsEnd) {
  const auto nifti = nifti_header(1) + eight;
  for (const std::size_t cut : {std::size_t{0}, std::size_t{3}, std::size_t{352}, std::size_t{355}, nifti.size()})
    EXPECT_EQ(labels("a.nii.gz", zipped(nifti.substr(0, cut)) + zipped(nifti.substr(cut))), counted) << cut;
  const std::string gz = "encoding: gzip\nspacings: 1 1 1";
  EXPECT_EQ(labels("a.nrrd", nrrd(gz, zipped(eight.substr(0, 3)) + zipped(eight.substr(3)))), counted);
  EXPECT_EQ(labels("a.mha", metaimage(spacing + "\nCompressedData = True",
                                      zipped(eight.substr(0, 3)) + zipped(eight.substr(3)))),
            counted);
  std::string many;
  for (const char c : eight) many += zipped(std::string(1, c));
  EXPECT_EQ(labels("a.nrrd", nrrd(gz, many)), counted);
  // Zeros that fill up a block do not belong to the data.
  EXPECT_EQ(labels("a.nrrd", nrrd(gz, zipped(eight) + std::string(100, '\0'))), counted);
}

TEST_F(DamagedImage, CompressedDataThatAreCutOffOrDamaged) {
  auto whole = zipped(nifti_header(1) + eight);
  for (std::size_t size = 2; size < whole.size(); ++size) refused("a.nii.gz", whole.substr(0, size), "too early");
  whole[whole.size() - 8] = static_cast<char>(whole[whole.size() - 8] ^ 1);  // the check sum
  refused("a.nii.gz", whole, "damaged (incorrect data check)");
  refused("a.nrrd", nrrd("encoding: gzip\nspacings: 1 1 1", ""), "too early");
  refused("a.nrrd", nrrd("encoding: gzip\nspacings: 1 1 1", eight), "damaged");
  refused("a.nrrd", nrrd("encoding: gzip\nspacings: 1 1 1", zipped("1234567")), "holds 7 bytes of data");
}

TEST_F(DamagedImage, CompressedDataSizeOfAMetaImage) {
  const auto data = zipped(eight, false);
  const auto with = [&](const std::string& size) {
    return metaimage(spacing + "\nCompressedData = True\nCompressedDataSize = " + size, data);
  };
  EXPECT_EQ(labels("a.mha", with(std::to_string(data.size()))), counted);
  EXPECT_EQ(labels("a.mha", with("0")), counted);
  refused("a.mha", with("1000"), "a.mha:7: field 'compresseddatasize' is '1000': ");
  refused("a.mha", with("5"), "too early");
  refused("a.mha", with("-1"), "must be above zero");
  refused("a.mha", with("many"), "must be 1 whole number");
}

// --- NIfTI --------------------------------------------------------------------------------------------------------

TEST_F(DamagedImage, NiftiOfSeveralTimesOrValues) {
  auto h = nifti_header(1);
  put_at(h, 40, std::int16_t{4});
  EXPECT_EQ(labels("a.nii", h + eight), counted);  // a single time is a volume
  put_at(h, 48, std::int16_t{3});
  refused("a.nii", h + eight + eight + eight, "is an image of 4 dimensions: it holds 3 times (frames)");
  put_at(h, 48, std::int16_t{1});
  put_at(h, 40, std::int16_t{5});
  put_at(h, 50, std::int16_t{2});
  refused("a.nii", h + eight + eight, "holds 2 values for each voxel");
}

TEST_F(DamagedImage, NiftiHeadersOutOfRange) {
  refused("a.nii", nifti_with(40, std::int16_t{0}), "its number of dimensions is 0");
  refused("a.nii", nifti_with(40, std::int16_t{8}), "its number of dimensions is 8");
  refused("a.nii", nifti_with(40, std::int16_t{-3}), "its number of dimensions is -3");
  refused("a.nii", nifti_with(40, std::int16_t{2}), "is an image of 2 dimensions");
  refused("a.nii", nifti_with(42, std::int16_t{0}), "its size along dimension 1 is 0");
  refused("a.nii", nifti_with(44, std::int16_t{-2}), "its size along dimension 2 is -2");
  refused("a.nii", nifti_with(70, std::int16_t{128}), "its datatype 128 cannot be read");
  refused("a.nii", nifti_with(70, std::int16_t{999}), "its datatype 999 cannot be read");
  refused("a.nii", nifti_with(72, std::int16_t{16}), "its datatype 2 has 8 bits, its bitpix says 16");
  refused("a.nii", nifti_with(123, char{5}), "its unit of length has the code 5");
  refused("a.nii", nifti_with(344, char{'x'}), "its magic is not 'n+1'");
  refused("a.nii", nifti_with(0, std::int32_t{349}), "its header begins with 349");
  refused("a.nii", nifti_header(1).substr(0, 340), "is shorter than the header");
  refused("a.nii", "", "is shorter than the header");
}

TEST_F(DamagedImage, NiftiDataThatBeginNowhere) {
  for (const float offset : {-352.0F, 0.0F, 351.0F, 352.5F, 1e30F, std::nanf(""), HUGE_VALF})
    refused("a.nii", nifti_with(108, offset), "(vox_offset), must be a whole number");
  refused("a.nii", nifti_with(108, 4000.0F), "its voxels begin after 4000 bytes (vox_offset), it has 360");
  EXPECT_EQ(labels("a.nii", nifti_with(108, 356.0F, "1234" + eight)), counted);
}

TEST_F(DamagedImage, NiftiScaling) {
  const float no_number = std::nanf("");
  EXPECT_EQ(labels("a.nii", nifti_with(112, no_number)), counted);
  auto both = nifti_with(112, no_number);
  put_at(both, 116, no_number);
  EXPECT_EQ(labels("a.nii", both), counted);
  auto scaled = nifti_with(112, 2.0F);
  put_at(scaled, 116, 1.0F);
  EXPECT_EQ(labels("a.nii", scaled), (std::vector<std::int16_t>{1, 3, 5, 7, 9, 11, 13, 15}));
  put_at(scaled, 116, no_number);
  refused("a.nii", scaled, "scl_slope");
  refused("a.nii", nifti_with(112, HUGE_VALF), "scl_slope");
  refused("a.nii", nifti_with(112, 0.5F), "the value of voxel 1 is 0.5");
  refused("a.nii", nifti_with(112, 1e6F), "the value of voxel 1 is 1000000");
}

TEST_F(DamagedImage, NiftiPlaces) {
  const float no_number = std::nanf("");
  refused("a.nii", nifti_with(80, 0.0F), "its voxel spacing along axis 1 is 0");
  refused("a.nii", nifti_with(84, -1.0F), "its voxel spacing along axis 2 is -1");
  refused("a.nii", nifti_with(88, no_number), "its voxel spacing along axis 3 is nan");
  refused("a.nii", nifti_with(256, no_number), "its voxel spacing along axis 1 is nan");
  refused("a.nii", nifti_with(268, HUGE_VALF), "its first voxel lies at (");
  auto h = nifti_header(0);
  put_at(h, 254, std::int16_t{1});  // sform, all of it zero
  refused("a.nii", h + eight, "its voxel spacing along axis 1 is 0");
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      put_at(h, 280 + 16 * static_cast<std::size_t>(row) + 4 * static_cast<std::size_t>(column), 1.0F);
  refused("a.nii", h + eight, "in one plane");
}

TEST_F(DamagedImage, NiftiOfTheOtherByteOrder) {
  auto h = nifti_header(1);
  const auto turn = [&](std::size_t at, std::size_t bytes) {
    std::reverse(h.begin() + static_cast<std::ptrdiff_t>(at), h.begin() + static_cast<std::ptrdiff_t>(at + bytes));
  };
  turn(0, 4);
  for (std::size_t at = 40; at < 56; at += 2) turn(at, 2);
  turn(70, 2), turn(72, 2), turn(252, 2), turn(254, 2);
  for (std::size_t at = 76; at < 120; at += 4) turn(at, 4);
  for (std::size_t at = 256; at < 328; at += 4) turn(at, 4);
  const auto image = read_label_image(write("a.nii", h + eight));
  EXPECT_EQ(image.labels, counted);
  EXPECT_NEAR(image.frame.steps[2][2], 4e-3, 1e-12);
}

TEST_F(DamagedImage, NiftiOfVersionTwo) {
  std::string h(544, '\0');
  put_at(h, 0, std::int32_t{540});
  h.replace(4, 8, std::string("n+2\0\r\n\032\n", 8));
  put_at(h, 12, std::int16_t{4});
  put_at(h, 14, std::int16_t{16});
  const std::int64_t dim[8] = {3, 2, 2, 2, 1, 1, 1, 1};
  for (std::size_t d = 0; d < 8; ++d) put_at(h, 16 + 8 * d, dim[d]);
  put_at(h, 168, std::int64_t{544});
  put_at(h, 348, std::int32_t{1});
  const double rows[3][4] = {{2, 0, 0, 10}, {0, 3, 0, 20}, {0, 0, 4, 30}};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 4; ++c) put_at(h, 400 + 32 * r + 8 * c, rows[r][c]);
  put_at(h, 500, std::int32_t{2});
  std::string data(16, '\0');
  for (std::size_t i = 0; i < 8; ++i) put_at(data, 2 * i, static_cast<std::int16_t>(i));
  const auto image = read_label_image(write("a.nii", h + data));
  EXPECT_EQ(image.labels, counted);
  EXPECT_NEAR(image.frame.origin[0], -10e-3, 1e-12);
  EXPECT_NEAR(image.frame.steps[1][1], -3e-3, 1e-12);
  put_at(h, 24, std::int64_t{1} << 62);
  refused("a.nii", h + data, "at most 2147483648 can be read");
}

// --- NRRD ---------------------------------------------------------------------------------------------------------

TEST_F(DamagedImage, NrrdPlacedByItsAxes) {
  const auto origin = [&](const std::string& fields) {
    return read_label_image(write("a.nrrd", nrrd("encoding: raw\n" + fields))).frame.origin;
  };
  // Cells begin half a spacing before their centres.
  EXPECT_NEAR(norm(origin("spacings: 2 2 4\naxis mins: 10 20 -30") - Point{{11e-3, 21e-3, -28e-3}}), 0, 1e-15);
  EXPECT_NEAR(
      norm(origin("spacings: 2 2 4\naxis mins: 10 20 -30\ncenters: node node node") - Point{{10e-3, 20e-3, -30e-3}}), 0,
      1e-15);
  EXPECT_NEAR(norm(origin("spacings: 2 2 4\nspace origin: (1,2,3)") - Point{{1e-3, 2e-3, 3e-3}}), 0, 1e-15);
  refused("a.nrrd", nrrd("encoding: raw\nspacings: 1 1 1\naxis mins: 1 2"), "field 'axis mins' is '1 2'");
  refused("a.nrrd", nrrd("encoding: raw\nspacings: 1 1 1\naxis mins: nan 0 0"), "its first voxel lies at (nan");
  refused("a.nrrd", nrrd("encoding: raw\nspacings: 1 1 1\naxis mins: 1 2 3\nspace origin: (1,2,3)"),
          "gives a space origin as well");
  for (const char* bad : {"1 0 1", "1 -1 1", "1 nan 1"})
    refused("a.nrrd", nrrd(std::string("encoding: raw\nspacings: ") + bad), "spacings are numbers above zero");
  refused("a.nrrd", nrrd("encoding: raw\nspace directions: (1,0,0) (1,0,0) (0,0,1)"), "in one plane");
  refused("a.nrrd", nrrd("encoding: raw\nspace directions: (1,0,0) (0,nan,0) (0,0,1)"), "along axis 2 is nan");
}

TEST_F(DamagedImage, NrrdInOtherUnits) {
  const auto spacing_in = [&](const std::string& units) {
    return read_label_image(write("a.nrrd", nrrd(raw_header + "\n" + units))).frame.steps[0][0];
  };
  EXPECT_DOUBLE_EQ(spacing_in("units: \"cm\" \"cm\" \"cm\""), 1e-2);
  EXPECT_DOUBLE_EQ(spacing_in("space units: \"um\" \"um\" \"um\""), 1e-6);
  EXPECT_DOUBLE_EQ(spacing_in("units: \"\" \"\" \"\""), 1e-3);
  refused("a.nrrd", nrrd(raw_header + "\nunits: \"mm\" \"mm\" \"cm\""), "the same along each axis");
  refused("a.nrrd", nrrd(raw_header + "\nspace units: \"inch\" \"inch\" \"inch\""), "lengths are in");
}

TEST_F(DamagedImage, NrrdWithForeignHeadersBeforeItsData) {
  const auto detached = [&](const std::string& fields, const std::string& data) {
    write("a.raw", data);
    return labels("a.nhdr", nrrd(raw_header + "\ndata file: a.raw\n" + fields, ""));
  };
  EXPECT_EQ(detached("byte skip: 4", "1234" + eight), counted);
  EXPECT_EQ(detached("line skip: 2", "one\ntwo\n" + eight), counted);
  EXPECT_EQ(detached("line skip: 1\nbyte skip: 3", "one\n123" + eight), counted);
  EXPECT_EQ(detached("byte skip: -1", "anything at all" + eight), counted);
  const std::string gz = "encoding: gzip\nspacings: 1 1 1\n";
  EXPECT_EQ(labels("a.nrrd", nrrd(gz + "byte skip: 3", zipped("abc" + eight))), counted);
  refused("a.nrrd", nrrd(raw_header + "\nbyte skip: 300"), "field 'byte skip' is '300': there are fewer bytes");
  refused("a.nrrd", nrrd(raw_header + "\nbyte skip: -2"), "must be at least -1");
  refused("a.nrrd", nrrd(gz + "byte skip: -1", zipped(eight)), "must be at least 0");
  refused("a.nrrd", nrrd(raw_header + "\nline skip: 7"), "field 'line skip' is '7'");
}

TEST_F(DamagedImage, NrrdWhoseDataFileIsAmiss) {
  const auto header = [](const std::string& file) { return nrrd(raw_header + "\ndata file: " + file, ""); };
  refused("a.nhdr", header("none.raw"), "none.raw: there is no such file");
  refused("a.nhdr", header("."), "there is no such file");
  refused("a.nhdr", header("LIST"), "lie in several files");
  refused("a.nhdr", header("a%03d.raw 1 2 1"), "lie in several files");
  write("short.raw", eight.substr(1));
  refused("a.nhdr", header("short.raw"), "holds 7 bytes of data");
  write("long one.raw", eight + eight);
  refused("a.nhdr", header("long one.raw"), "holds 16 bytes of data");
  write("right one.raw", eight);
  EXPECT_EQ(labels("a.nhdr", header("right one.raw")), counted);
}

TEST_F(DamagedImage, NrrdHeaders) {
  refused("a.nrrd", "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 2 2 2\nspacings: 1 1 1 1\nencoding: raw\n\n" + eight,
          "is an image of 4 dimensions");
  refused("a.nrrd", nrrd(raw_header + "\nspace:"), "a.nrrd:7: field 'space' has no value");
  refused("a.nrrd", nrrd(raw_header + "\nsizes: 2 2 2"), "stands in line 4 already");
  refused("a.nrrd", nrrd(raw_header + "\nsome words"), "a.nrrd:7: 'some words' is no line of a NRRD header");
  refused("a.nrrd", nrrd("spacings: 1 1 1\nencoding: bzip2"), "this encoding cannot be read");
  refused("a.nrrd", nrrd("encoding: raw"), "states no voxel spacing");
  refused("a.nrrd", "NRRD0004\n# " + std::string(std::size_t{1} << 21, 'x'), "its header does not end within");
  refused("a.nrrd", "NRRD0004\n" + std::string(std::size_t{1} << 21, '#'), "its header does not end within");
  std::string many = "NRRD0004\n";
  for (int i = 0; many.size() < (std::size_t{1} << 21); ++i)
    many += std::string("a").append(std::to_string(i)).append(":=b\n");
  refused("a.nrrd", many, "its header does not end within");
}

TEST_F(DamagedImage, LabelsThatAreNone) {
  const auto text = [](const std::string& values) { return nrrd("encoding: ascii\nspacings: 1 1 1", values); };
  EXPECT_EQ(labels("a.nrrd", text("0, 1 +2\t3\r\n4 5.0 6e0 7\n")), counted);
  refused("a.nrrd", text("0 1 2 3 4 5 6 nan"), "the value of voxel 7 is nan");
  refused("a.nrrd", text("0 1 2 3 4 5 6 40000"), "the value of voxel 7 is 40000");
  refused("a.nrrd", text("0 1 2 3 4 5 6 seven"), "the value of voxel 7 is 'seven', no number");
  refused("a.nrrd", text(std::string(500, 'x')), "no number");
  refused("a.nrrd", text(std::string(500, '1')), "labels are whole numbers");
  auto floats = nifti_header(1);
  put_at(floats, 70, std::int16_t{16});
  put_at(floats, 72, std::int16_t{32});
  std::string values(32, '\0');
  put_at(values, 12, 0.25F);
  refused("a.nii", floats + values, "the value of voxel 3 is 0.25");
  put_at(values, 12, std::nanf(""));
  refused("a.nii", floats + values, "the value of voxel 3 is nan");
  put_at(values, 12, -1e9F);
  refused("a.nii", floats + values, "the value of voxel 3 is -1000000000");
}

// --- MetaImage ----------------------------------------------------------------------------------------------------

TEST_F(DamagedImage, MetaImageAsText) {
  EXPECT_EQ(labels("a.mha", metaimage(spacing + "\nBinaryData = False", "0 1 2 3\n4 5 6 7\n")), counted);
  refused("a.mha", metaimage(spacing + "\nBinaryData = False", "0 1 2 3\n4 5 6\n"), "holds at most 7 values as text");
  refused("a.mha", metaimage(spacing + "\nBinaryData = Ascii", eight), "must be True or False");
  refused("a.mha", metaimage(spacing + "\nBinaryData = False", "0 1 2 3     4 5 6\n"), "holds 7 values as text");
  write("a.txt", "0 1 2 3 4 5 6 7");
  auto detached = metaimage(spacing + "\nBinaryData = False", "");
  detached.replace(detached.find("LOCAL"), 5, "a.txt");
  EXPECT_EQ(labels("a.mhd", detached), counted);
}

TEST_F(DamagedImage, MetaImageInForeignFiles) {
  const auto detached = [&](const std::string& file, const std::string& fields = "") {
    auto text = metaimage(spacing + fields, "");
    return text.replace(text.find("LOCAL"), 5, file);
  };
  refused("a.mhd", detached("none.raw"), "none.raw: there is no such file");
  refused("a.mhd", detached("LIST"), "lie in several files");
  refused("a.mhd", detached("a%03d.raw 1 2 1"), "lie in several files");
  write("a.raw", "1234" + eight);
  EXPECT_EQ(labels("a.mhd", detached("a.raw", "\nHeaderSize = 4")), counted);
  EXPECT_EQ(labels("a.mhd", detached("a.raw", "\nHeaderSize = -1")), counted);
  refused("a.mhd", detached("a.raw", "\nHeaderSize = 400"), "its data begin after 400 bytes, the file has 12");
  refused("a.mhd", detached("a.raw", "\nHeaderSize = -2"), "must be -1 or more");
  refused("a.mhd", detached("a.raw"), "holds 12 bytes of data");
}

TEST_F(DamagedImage, MetaImageHeaders) {
  refused("a.mha", metaimage(spacing + "\nsome words"), "a.mha:6: 'some words' is no line of a MetaImage header");
  refused("a.mha", "NDims = 3\nDimSize = 2 2 2\nElementDataFile =\n" + eight, "'elementdatafile' has no value");
  EXPECT_EQ(labels("a.mha", metaimage(spacing + "\nComment =")), counted);
  EXPECT_EQ(labels("a.mha", metaimage("ElementSize = 1 1 1")), counted);
  refused("a.mha", "NDims = 4\nDimSize = 2 2 2 1\nElementDataFile = LOCAL\n" + eight, "is an image of 4 dimensions");
  refused("a.mha", metaimage(spacing + "\nElementNumberOfChannels = 3"), "a voxel has several values");
  for (const char* bad : {"1 0 1", "1 -1 1", "1 nan 1"})
    refused("a.mha", metaimage(std::string("ElementSpacing = ") + bad), "spacings are numbers above zero");
  refused("a.mha", metaimage(spacing + "\nTransformMatrix = 1 0 0 1 0 0 0 0 1"), "in one plane");
  refused("a.mha", metaimage(spacing + "\nTransformMatrix = nan 0 0 0 1 0 0 0 1"), "along axis 1 is nan");
  refused("a.mha", metaimage(spacing + "\nOffset = nan 0 0"), "its first voxel lies at (nan");
  refused("a.mha", "a = b\n" + std::string(std::size_t{1} << 21, 'x'), "its header does not end within");
}

}  // namespace
}  // namespace tunica::imaging
