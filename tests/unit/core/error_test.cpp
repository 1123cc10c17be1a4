#include "core/error.hpp"

#include <gtest/gtest.h>

namespace twindeck {
namespace {

// Oracle: the format promised in core/error.hpp, "file:line: key: problem; mend", leaving out what is unknown.
TEST(InputError, ReadsAsOneLineWithWhatIsKnown) {
  EXPECT_STREQ(InputError({"a.toml", 3, "E_s"}, "is -3", "give a modulus").what(), "a.toml:3: E_s: is -3; give a modulus");
  EXPECT_STREQ(InputError({"a.toml", 0, ""}, "is empty").what(), "a.toml: is empty");
  EXPECT_STREQ(InputError({"", 0, "E_s"}, "is -3").what(), "E_s: is -3");
  EXPECT_EQ(InputError({"a.toml", 3, "E_s"}, "x").place().line, 3);
}

// Oracle: edit distances counted by hand; near means at most a third of the letters of the longer name.
TEST(NearestName, FindsSlipsAndLeavesStrangersAlone) {
  const std::vector<std::string> known{"frequency_Hz", "damping_ratio_pct", "mode", "E_s"};
  EXPECT_EQ(nearest_name("frequencyHz", known), "frequency_Hz");
  EXPECT_EQ(nearest_name("mdoe", known), "mode");  // a swap of neighbours is one slip
  EXPECT_EQ(nearest_name("Es", known), "E_s");
  EXPECT_EQ(nearest_name("temperature", known), "");
  EXPECT_EQ(nearest_name("mode", {}), "");
  EXPECT_EQ(did_you_mean("mdoe", known), " (did you mean 'mode'?)");
  EXPECT_EQ(did_you_mean("temperature", known), "");
}

// Oracle: of two candidates the one with the smaller distance, worked by hand (1 against 2).
TEST(NearestName, PrefersTheNearer) {
  const std::vector<std::string> known{"stay_group_2", "stay_group"};
  EXPECT_EQ(nearest_name("stay_grup", known), "stay_group");
  // A letter of the wrong case is nearer than another letter.
  EXPECT_EQ(nearest_name("Z_m", std::vector<std::string>{"node", "x_m", "y_m", "z_m"}), "z_m");
  EXPECT_EQ(nearest_name("Y", std::vector<std::string>{"x", "y"}), "y");
  EXPECT_EQ(nearest_name("w", std::vector<std::string>{"x", "y"}), "");
  // All letters of the other case, as solvers write names: a distance of five where a third of the letters is one.
  EXPECT_EQ(nearest_name("steel", std::vector<std::string>{"STEEL", "CONCRETE"}), "STEEL");
  EXPECT_EQ(nearest_name("steed", std::vector<std::string>{"STEEL", "CONCRETE"}), "");
}

// Oracle: TWINDECK_ASSERT is for our own mistakes, so it raises InternalError (exit code 3), never InputError.
TEST(Assertion, NamesConditionAndSource) {
  try {
    TWINDECK_ASSERT(1 + 1 == 3);
    FAIL() << "no exception";
  } catch (const InternalError& error) {
    EXPECT_NE(std::string(error.what()).find("1 + 1 == 3"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("error_test.cpp"), std::string::npos);
  }
}

}  // namespace
}  // namespace twindeck
