#include "tunica/files/named_files.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "temporary_folder.hpp"

namespace tunica::files {
namespace {

using Names = std::vector<std::string>;

Names names_in(const std::string& name, const std::string& text) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / name, std::ios::binary) << text;
  return named_files(folder.path() / name);
}

TEST(NamedFiles, VoxelsOfADetachedNrrdHeader) {
  EXPECT_EQ(names_in("a.nhdr", "NRRD0004\ntype: uchar\ndata file: seg.raw\n"), Names{"seg.raw"});
  EXPECT_EQ(names_in("a.nhdr", "NRRD0004\r\n# a comment: x\r\nDataFile:../raw data/seg.raw\r\n"),
            Names{"../raw data/seg.raw"});
  EXPECT_EQ(names_in("a.NHDR", "NRRD0004\nkey:=data file: no\ndata file: LIST\na.raw\nb.raw\n"),
            (Names{"a.raw", "b.raw"}));
  EXPECT_EQ(names_in("a.nhdr", "NRRD0004\ndata file: s%02d.raw 9 11 1\n"), (Names{"s09.raw", "s10.raw", "s11.raw"}));
  EXPECT_EQ(names_in("a.nrrd", "NRRD0004\ntype: uchar\n\ndata file: these are voxels\n"), Names{});
}

TEST(NamedFiles, VoxelsOfADetachedMetaImageHeader) {
  EXPECT_EQ(names_in("a.mhd", "ObjectType = Image\nElementDataFile = seg.zraw\n"), Names{"seg.zraw"});
  EXPECT_EQ(names_in("a.mha", "ObjectType = Image\nElementDataFile = LOCAL\nElementDataFile = no\n"), Names{});
  EXPECT_EQ(names_in("a.mhd", "ElementDataFile = LIST\na.raw\nb.raw\n"), (Names{"a.raw", "b.raw"}));
  EXPECT_EQ(names_in("a.mhd", "ElementDataFile = s%d.raw 5 1 -2\n"), (Names{"s5.raw", "s3.raw", "s1.raw"}));
}

TEST(NamedFiles, PiecesOfVtkFiles) {
  EXPECT_EQ(names_in("a.pvd", "<DataSet timestep=\"0\" file=\"a_0.pvtu\"/>\n<DataSet file='b &amp; c.vtu'/>"),
            (Names{"a_0.pvtu", "b & c.vtu"}));
  EXPECT_EQ(names_in("a.series", "{\"files\": [{\"name\": \"a_0.hdf\", \"time\": 0}, {\"name\":\"a_1.hdf\"}]}"),
            (Names{"a_0.hdf", "a_1.hdf"}));
  EXPECT_EQ(names_in("a.pvtu", "<Piece Source=\"p0.vtu\"/><Piece Source=\"p1.vtu\"/>"), (Names{"p0.vtu", "p1.vtu"}));
  EXPECT_EQ(names_in("a.vtu", "<Piece Source=\"p0.vtu\"/>"), Names{}) << "a whole file";
}

TEST(NamedFiles, NoneOfOtherFilesAndOfNone) {
  EXPECT_EQ(names_in("a.csv", "data file: b\n"), Names{});
  EXPECT_EQ(named_files("no/such.nhdr"), Names{});
}

}  // namespace
}  // namespace tunica::files
