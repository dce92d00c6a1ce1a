// Tables, series, fingerprints and writing that never leaves half a file.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/files/hash.hpp"
#include "tunica/files/time_stamp.hpp"

namespace tunica::files {
namespace {

namespace fs = std::filesystem;
using test::message_of;

class Files : public ::testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << text;
    return folder_.path() / name;
  }
  test::TemporaryFolder folder_;
};

TEST_F(Files, TablesMayHaveCommentsBlanksAndLinesOfWindows) {
  const auto table =
      read_csv(write("a.csv", "# measured\r\n\r\n time [s] ,flow [ml/s]\r\n0, 1e3\r\n#no\r\n 0.5 ,-2.25\r\n"), "");
  EXPECT_EQ(table.headers, (std::vector<std::string>{"time [s]", "flow [ml/s]"}));
  EXPECT_EQ(table.column("time [s]"), (std::vector<double>{0, 0.5}));
  EXPECT_EQ(table.column("flow [ml/s]"), (std::vector<double>{1000, -2.25}));
}

TEST_F(Files, NumbersOfTablesAreThoseThatWerePrinted) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-300, 300), sign(-1, 1);
  std::vector<double> values;
  std::string text = "x\n";
  for (int k = 0; k < 500; ++k) {
    values.push_back(sign(random) * std::pow(10, exponent(random)));
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.17g\n", values.back());
    text += digits;
  }
  EXPECT_EQ(read_csv(write("a.csv", text), "").column("x"), values);
}

TEST_F(Files, TablesThatAreNoneAreRefusedWithTheirLine) {
  const auto refusal = [&](const std::string& text) {
    const auto file = write("a.csv", text);
    return message_of<InputError>([&] { read_csv(file, "give a table of flows").column("flow"); });
  };
  const auto says = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(says(refusal("# a\nt,flow\n1,2\n\n3\n"), "a.csv:5: has 1 columns, the header 2"));
  EXPECT_TRUE(says(refusal("t,flow\n1,2\n3,4,5\n"), "a.csv:3"));
  EXPECT_TRUE(says(refusal("t,flow\n1,2 ml\n"), "a.csv:2: '2 ml' under 'flow' is not a number"));
  EXPECT_TRUE(says(refusal("t,flow\n1,\n"), "'' under 'flow' is not a number"));
  EXPECT_TRUE(says(refusal("t,Fluss\n1,2\n"), "no column is called 'flow'"));
  EXPECT_TRUE(says(refusal("t,Fluss\n1,2\n"), "choose from: t, Fluss"));
  EXPECT_TRUE(says(refusal("# nothing\n"), "give a table of flows"));
  EXPECT_TRUE(
      says(message_of<InputError>([&] { read_csv(folder_.path() / "none.csv", "give one"); }), "cannot be read"));
}

TEST_F(Files, AFailedWriteLeavesTheOldFileAndNoOther) {
  const auto old = write("a.txt", "old");
  // What would be renamed cannot be written: its name is that of a folder with something in it.
  fs::create_directories(folder_.path() / "a.txt.part" / "full");
  EXPECT_NE(message_of<SolverError>([&] { write_atomically(old, "new"); }).find("cannot write"), std::string::npos);
  EXPECT_EQ(test::slurp(old), "old");
  fs::remove_all(folder_.path() / "a.txt.part");
  write_atomically(old, "new");
  EXPECT_EQ(test::slurp(old), "new");
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder_.path())) files += entry.exists();
  EXPECT_EQ(files, 1U);
  // Onto a folder it cannot be renamed, and then nothing is left beside it.
  fs::create_directories(folder_.path() / "b" / "full");
  EXPECT_THROW(write_atomically(folder_.path() / "b", "new"), SolverError);
  EXPECT_FALSE(fs::exists(folder_.path() / "b.part"));
}

TEST(Hash, NoticesEveryBitAndTheOrder) {
  const auto of = [](const std::string& bytes) {
    Hash hash;
    hash.add(bytes.data(), bytes.size());
    return hash.value();
  };
  const std::string text = "a mesh of 20 bytes ..";
  std::set<std::uint64_t> seen = {of(text)};
  for (std::size_t byte = 0; byte < text.size(); ++byte)
    for (int bit = 0; bit < 8; ++bit) {
      auto changed = text;
      changed[byte] = static_cast<char>(changed[byte] ^ (1 << bit));
      EXPECT_TRUE(seen.insert(of(changed)).second) << byte << " " << bit;
    }
  Hash ab, ba;
  const double a = 1.5, b = -2.5;
  ab.add(&a, sizeof a);
  ab.add(&b, sizeof b);
  ba.add(&b, sizeof b);
  ba.add(&a, sizeof a);
  EXPECT_NE(ab.value(), ba.value());
  EXPECT_EQ(hex(0xabcULL), "0000000000000abc");
  EXPECT_EQ(Hash().value(), 14695981039346656037ULL);  // FNV-1a of nothing
  // One word, filled up with zeros: files of other days hold such numbers.
  const std::uint64_t word = (14695981039346656037ULL ^ 0x636261ULL) * 1099511628211ULL;
  EXPECT_EQ(of("abc"), word ^ (word >> 32));
}

TEST(TimeStamp, IsTheTimeOfNowInUtc) {
  std::tm parsed{};
  const auto before = std::time(nullptr);
  const auto stamp = time_stamp();
  ASSERT_NE(strptime(stamp.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parsed), nullptr) << stamp;
  const auto then = timegm(&parsed);
  EXPECT_GE(then, before);
  EXPECT_LE(then, before + 5);
}

}  // namespace
}  // namespace tunica::files
