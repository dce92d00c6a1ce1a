#include "tunica/files/csv_file.hpp"

#include <cmath>

#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"

namespace tunica::files {
namespace {

/// UTF-16, low byte first or last, of ASCII.
std::string wide(const std::string& text, bool low_first, bool with_mark) {
  std::string bytes = !with_mark ? "" : low_first ? "\xFF\xFE" : "\xFE\xFF";
  for (const char c : text) bytes += low_first ? std::string{c, '\0'} : std::string{'\0', c};
  return bytes;
}

class Tables : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& bytes) const {
    std::ofstream(folder_.path() / "t.csv", std::ios::binary) << bytes;
    return folder_.path() / "t.csv";
  }
  CsvColumns columns(const std::string& bytes) const { return read_csv(file(bytes), "write a table"); }
  TextTable table(const std::string& bytes) const { return read_table(file(bytes), "write a table"); }
  std::string why(const std::string& bytes) const {
    try {
      columns(bytes);
    } catch (const InputError& error) {
      EXPECT_FALSE(error.problems().at(0).remedy.empty());
      return error.what();
    }
    return "no error";
  }
  void expect_why(const std::string& bytes, const std::string& part) const {
    EXPECT_NE(why(bytes).find(part), std::string::npos) << why(bytes);
  }
  test::TemporaryFolder folder_;
};

TEST_F(Tables, WhateverSpreadsheetsMakeOfATableIsReadAlike) {
  const char* same[] = {
      "stretch,stress\n1,0\n1.1,-5.5\n",
      "\xEF\xBB\xBFstretch,stress\n1,0\n1.1,-5.5\n",
      "stretch,stress\r\n1,0\r\n1.1,-5.5\r\n\r\n",
      "stretch,stress\r1,0\r1.1,-5.5\r",
      "\"stretch\",\"stress\"\n\"1\",\"0\"\n\"1.1\",\"-5.5\"\n",
      "\"stretch\" , \"stress\"\n +1 ,\t+0\n+1.1,-5.50\n",
      "# by hand\n\nstretch, stress\n  # more\n1, 0\n\n1.1, -5.5",
      "\"# time, place\"\nstretch,stress\n1,0\n1.1,-5.5\n",
      "stretch;stress\n1;0\n1.1;-5.5\n",
      "stretch\tstress\n1\t0\n1.1\t-5.5\n",
      "sep=;\r\nstretch;stress\r\n1;0\r\n1.1;-5.5\r\n",
      "stretch,stress,,\n1,0,,\n1.1,-5.5,,\n,,,\n",
      "stretch,stress\n1,0e0\n11e-1,-.55e1\n",
      "stretch\xC2\xA0,stress\n1,0\n\xC2\xA0"
      "1.1,-5.5\n",
  };
  for (const char* bytes : same) {
    SCOPED_TRACE(bytes);
    const auto t = columns(bytes);
    EXPECT_EQ(t.headers, (std::vector<std::string>{"stretch", "stress"}));
    EXPECT_EQ(t.column("stretch"), (std::vector<double>{1, 1.1}));
    EXPECT_EQ(t.column("stress"), (std::vector<double>{0, -5.5}));
  }
}

TEST_F(Tables, QuotedCellsHoldSeparatorsAndQuotes) {
  const auto t = table("name,\"p \"\"mean\"\", kPa\"\n\"a, b\",1\n\"\",\"2\"\n");
  EXPECT_EQ(t.headers[1], "p \"mean\", kPa");
  ASSERT_EQ(t.rows.size(), 2u);
  EXPECT_EQ(t.rows[0].cells[0], "a, b");
  EXPECT_EQ(t.rows[1].cells[0], "");
  EXPECT_EQ(t.rows[1].line, 3);
  EXPECT_EQ(t.number(t.rows[1], 1), 2);
}

TEST_F(Tables, TheRowBelowTellsTheSeparatorOfAHeaderWithTwo) {
  EXPECT_EQ(columns("t [s],p [Pa; mean]\n1,2\n").headers.size(), 2u);
  EXPECT_EQ(columns("t [s];p [Pa, mean]\n1;2\n").headers.size(), 2u);
}

TEST_F(Tables, HeadersAreFoundInAnyCaseWhenThatIsClear) {
  const auto t = columns("Stretch,p,P,q,q\n1,2,3,4,5\n");
  EXPECT_EQ(t.column("stretch")[0], 1);
  EXPECT_EQ(t.column("P")[0], 3);
  EXPECT_NE(test::message_of<InputError>([&] { (void)t.find("sigma"); }).find("choose from: Stretch, p, P, q, q"),
            std::string::npos);
  EXPECT_NE(test::message_of<InputError>([&] { (void)t.find("q"); }).find("2 columns are called 'q'"),
            std::string::npos);
}

TEST_F(Tables, OtherEncodingsAreRefusedByName) {
  const std::string text = "stretch,stress\n1,0\n";
  for (const bool low_first : {true, false})
    for (const bool with_mark : {true, false})
      expect_why(wide(text, low_first, with_mark), "t.csv: is UTF-16, not UTF-8");
  expect_why(std::string("\xFF\xFE\0\0s\0\0\0", 8), "is UTF-32");
  expect_why("stretch,stress\n# M\xFCller\n1,0\n", "t.csv, line 2, column 4: holds the byte 0xfc");
  expect_why("stretch,stress\n# M\xFCller\n1,0\n", "in Latin-1 and Windows-1252 it is 'ü'");
  expect_why("a\r\nb\r\n\x80\r\n", "line 3, column 1: holds the byte 0x80");
  expect_why("ü\xC3", "line 1, column 2");
  expect_why("a\n\xED\xA0\x80", "line 2");
  expect_why(std::string("stretch,stress\n1,0\0\n", 20), "line 2, column 4: holds the control character 0x00");
  expect_why("PK\x03\x04 and more", "a ZIP archive");
}

TEST_F(Tables, LinesThatDoNotFitAreNamed) {
  expect_why("a,b\n1\n", "t.csv:2: has 1 columns, the header 2");
  expect_why("a,b\n1,2,3\n", "t.csv:2: has 3 columns, the header 2");
  expect_why("t,Q\n0,5,1,5\n", "decimals are written with a point");
  expect_why("t;Q\n0,5;1\n", "t.csv:2: '0,5' under 't' is not a number");
  expect_why("t;Q\n0,5;1\n", "with a decimal point");
  expect_why("t,Q\n0,x\n", "t.csv:2: 'x' under 'Q' is not a number");
  expect_why("t,Q\n\n# c\n0,\n", "t.csv:4: '' under 'Q' is not a number");
  expect_why("t,Q\n0,1 ml\n", "'1 ml'");
  expect_why("t,Q\n0,+-1\n", "'+-1'");
  expect_why("t,Q\n0,0x10\n", "'0x10'");
  expect_why(
      "t,Q\n0,\xE2\x88\x92"
      "5\n",
      "plain minus sign");
  expect_why("t,Q\n0,1e999\n", "larger or smaller");
  for (const char* word : {"nan", "inf", "-INF", "NaN(1)"})
    expect_why(std::string("t,Q\n0,") + word + "\n", "finite number");
  expect_why("t,\"Q\n0,1\n", "t.csv:1: the quote before 'Q' is not closed");
  expect_why("t,\"Q\"x\n0,1\n", "t.csv:1: 'x' follows a closed quote");
  expect_why("sep=x\nt,Q\n", "names no separator");
}

TEST_F(Tables, EmptyFilesAndHeadersAlone) {
  for (const char* bytes : {"", "\n\n", "# nothing\n", "\xEF\xBB\xBF", ",,\n,,\n", "sep=,\n"})
    EXPECT_NE(why(bytes).find("is empty"), std::string::npos) << bytes << why(bytes);
  EXPECT_TRUE(columns("t,Q\n").column("Q").empty());
  EXPECT_NE(test::message_of<InputError>([&] { read_csv(folder_.path() / "none.csv", ""); }).find("cannot be read"),
            std::string::npos);
  EXPECT_NE(test::message_of<InputError>([&] { read_csv(folder_.path(), ""); }).find("is a folder"), std::string::npos);
}

TEST_F(Tables, GapsOnlyWhereTheyAreAllowed) {
  EXPECT_TRUE(std::isnan(read_csv(file("t,Q\n0,nan\n"), "", Gaps::allowed).column("Q")[0]));
  EXPECT_THROW(read_csv(file("t,Q\n0,inf\n"), "", Gaps::allowed), InputError);
}

TEST_F(Tables, LongLinesAreNoTrouble) {
  const std::string cell(3000000, '7');
  expect_why("t,Q\n0," + cell + "\n", "larger or smaller");
  expect_why(cell + "x," + cell + "\n1\n", "has 1 columns");
  EXPECT_LT(why("t,Q\n0," + cell + "\n").size(), 400u);
}

}  // namespace
}  // namespace tunica::files
