#include "tunica/base/text.hpp"

#include <gtest/gtest.h>

namespace tunica {
namespace {

TEST(Text, Utf8AsItsStandardHasIt) {
  for (const char* good : {"", "a", "ü", "–", "😀", "\xF4\x8F\xBF\xBF", "\xEF\xBF\xBD"})
    EXPECT_EQ(text::valid_utf8(good), std::string_view(good).size()) << good;
  const char* bad[] = {"\x80",
                       "\xC0\x80",
                       "\xC3",
                       "\xE0\x80\x80",
                       "\xED\xA0\x80",
                       "\xF0\x80\x80\x80",
                       "\xF4\x90\x80\x80",
                       "\xF8\x88\x80\x80\x80",
                       "\xFF"};
  for (const char* bytes : bad) EXPECT_EQ(text::valid_utf8(std::string("ü") + bytes), 2u);
}

TEST(Text, PrintableInMessages) {
  EXPECT_EQ(text::printable("M\xFCller\n\x01ü"), "M\\xfcller\\x0a\\x01ü");
  EXPECT_EQ(text::printable("a\xC2\x9B"
                            "2Jb"),
            "a\\xc2\\x9b2Jb");
  EXPECT_EQ(text::printable("abcdef", 3), "abc...");
}

TEST(Text, TrimmedOfWhatCannotBeSeen) {
  EXPECT_EQ(text::trimmed("\xEF\xBB\xBF \t\xC2\xA0 a b \r\t\xC2\xA0"), "a b");
  EXPECT_EQ(text::trimmed(" \t"), "");
}

}  // namespace
}  // namespace tunica
