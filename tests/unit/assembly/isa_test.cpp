#include "tunica/assembly/isa.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tunica/base/error.hpp"

namespace tunica::assembly {
namespace {

struct IsaOfEnvironment : testing::Test {
  void SetUp() override {
    if (const char* value = std::getenv("TUNICA_ISA")) saved = value;
  }
  void TearDown() override {
    if (saved.empty())
      unsetenv("TUNICA_ISA");
    else
      setenv("TUNICA_ISA", saved.c_str(), 1);
  }
  std::string saved;
};

TEST_F(IsaOfEnvironment, ChoosesANarrowerSet) {
  setenv("TUNICA_ISA", "sse2", 1);
  EXPECT_EQ(choose_isa(), Isa::sse2);
  unsetenv("TUNICA_ISA");
  EXPECT_GE(choose_isa(), Isa::sse2);
}

TEST_F(IsaOfEnvironment, RefusesWhatIsNotThere) {
  setenv("TUNICA_ISA", "mmx", 1);
  try {
    choose_isa();
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("mmx"), std::string::npos);
  }
}

}  // namespace
}  // namespace tunica::assembly
