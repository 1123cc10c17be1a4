/// Oracle: the form that the documentation states, "<measured mode>-<number>N".
#include "matching/mode_name.hpp"

#include <gtest/gtest.h>

namespace twindeck::matching {
namespace {

std::string refusal(const std::vector<std::string>& entries, Eigen::Index n_numerical = 12) {
  try {
    (void)read_pairs(entries, n_numerical, {"s6.toml", 0, "pairs"}, "raise n_modes");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ModeName, ReadsMeasuredAndComputedModes) {
  const auto pairs = read_pairs({"1X-1N", "7X-12N", "heave-3N"}, 12, {}, "");
  ASSERT_EQ(pairs.size(), 3U);
  EXPECT_EQ(pairs[1].experimental, "7X");
  EXPECT_EQ(pairs[1].numerical, 11);
  EXPECT_EQ(pairs[2].experimental, "heave");
}

TEST(ModeName, RefusesEveryOtherForm) {
  for (const char* entry : {"1X-N", "1X-0N", "1X-01N", "1X--1N", "1X-1", "-1N", "1X", "N", "", "1X-1.5N", "1X-1e3N", "1 X-1N",
                            "1X-1NN", "1X- 1N", "1X-9999999N", "1X-99999999999999999999999N"}) {
    EXPECT_NE(refusal({entry}).find("is no pair"), std::string::npos) << "'" << entry << "': " << refusal({entry});
  }
  // Of a name that long a message holds the beginning.
  EXPECT_LT(refusal({std::string(100000, 'X')}).size(), 2000U);
  EXPECT_NE(refusal({std::string(100000, 'X')}).find("s6.toml: pairs"), std::string::npos);
}

TEST(ModeName, RefusesModesThatAreNotThereAndModesNamedTwice) {
  EXPECT_EQ(refusal({"1X-99N"}), "s6.toml: pairs: pair '1X-99N' asks for numerical mode 99 of 12; raise n_modes");
  EXPECT_NE(refusal({"1X-1N", "1X-2N"}).find("another pair names too"), std::string::npos);
  EXPECT_NE(refusal({"1X-1N", "2X-1N"}).find("another pair names too"), std::string::npos);
}

TEST(ModeName, WhatReadsAsANumberHasToBeAWholeOneFromOne) {
  for (const char* name : {"1", "12", "7X", "heave", "1st bending", "B-2", "X", "", "nanX1", "1.5 Hz"})
    EXPECT_TRUE(is_mode_name(name)) << name;
  for (const char* name : {"1.5", "-1", "0", "0X", "+1", "1e3", "01", "1.5X", "-1X", "nan", "inf", "1e999"})
    EXPECT_FALSE(is_mode_name(name)) << name;
}

TEST(ModeName, LabelsOfModes) {
  EXPECT_EQ(experimental_label("7"), "7X");
  EXPECT_EQ(experimental_label("7X"), "7X");
  EXPECT_EQ(numerical_label(7), "8N");
  EXPECT_EQ(numerical_position("8N"), 7);
  for (const char* other : {"", "N", "8", "08N", "0N", "-8N", "8X", "8N ", "1234567N"})
    EXPECT_FALSE(numerical_position(other)) << other;
}

}  // namespace
}  // namespace twindeck::matching
