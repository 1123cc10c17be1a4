// Oracles: hand counts of 4 samples for each block row and block, 4 (outputs + inputs) + 2 with inputs; nothing becomes larger.
#include "identification/limits.hpp"

#include <gtest/gtest.h>

namespace twindeck::identification {
namespace {

/// Records of two channels, both references, of these lengths.
Conditioned of_lengths(const std::vector<Eigen::Index>& lengths) {
  Conditioned conditioned;
  conditioned.setup = "S1";
  conditioned.channels.resize(2);
  conditioned.references = {0, 1};
  for (const Eigen::Index n : lengths) {
    conditioned.records.emplace_back(n, 2);
    conditioned.files.push_back("r.csv");
  }
  return conditioned;
}

// 30 rows and 20 blocks need 2400 samples, the Welch segment 2048.
TEST(CarriedBy, ALongRecordCarriesAll) {
  const CarriedLimits carried = carried_by(of_lengths({2400}), {});
  EXPECT_EQ(carried.note, "");
  EXPECT_EQ(carried.config.blocks, 20);
  EXPECT_EQ(carried.config.block_rows, 30);
  EXPECT_EQ(carried.config.maximum_order, 60);
  EXPECT_EQ(carried.config.welch_segment, 2048);
}

// 1200 samples: 1200/(4 · 30) = 10 blocks of 30 rows. The shortest record counts.
TEST(CarriedBy, BlocksAreLoweredFirst) {
  const CarriedLimits carried = carried_by(of_lengths({5000, 1200}), {});
  EXPECT_EQ(carried.config.blocks, 10);
  EXPECT_EQ(carried.config.block_rows, 30);
  EXPECT_EQ(carried.config.maximum_order, 60);
  EXPECT_EQ(carried.config.welch_segment, 1200);
  EXPECT_NE(carried.note.find("blocks 20 -> 10"), std::string::npos) << carried.note;
  EXPECT_NE(carried.note.find("S1"), std::string::npos);
  EXPECT_EQ(carried.note.find("block_rows"), std::string::npos);
}

// 640 samples: eight blocks are the fewest; 640/(4 · 8) = 20 rows, which carry 19 · 2 = 38 orders.
TEST(CarriedBy, ThenBlockRowsAndTheOrdersThatTheyCarry) {
  const CarriedLimits carried = carried_by(of_lengths({640}), {});
  EXPECT_EQ(carried.config.blocks, 8);
  EXPECT_EQ(carried.config.block_rows, 20);
  EXPECT_EQ(carried.config.maximum_order, 38);
  EXPECT_EQ(carried.config.minimum_order, 2);
}

// One reference of two outputs: 20 rows have 20 columns.
TEST(CarriedBy, FewReferencesCarryFewerOrders) {
  Conditioned conditioned = of_lengths({640});
  conditioned.references = {0};
  EXPECT_EQ(carried_by(conditioned, {}).config.maximum_order, 20);
  IdentificationSettings config;
  config.minimum_order = 30;
  EXPECT_EQ(carried_by(conditioned, config).config.minimum_order, 20);  // not above the largest
}

// With inputs no blocks are counted: 4 (2 + 1) + 2 = 14 samples a row; 280 samples are 20 rows and 19 · 2 orders.
TEST(CarriedBy, InputsNeedSamplesOfTheirOwn) {
  Conditioned conditioned = of_lengths({280});
  conditioned.inputs.resize(1);
  conditioned.excitation.emplace_back(280, 1);
  conditioned.references = {0};  // they do not count here
  const CarriedLimits carried = carried_by(conditioned, {});
  EXPECT_EQ(carried.config.block_rows, 20);
  EXPECT_EQ(carried.config.maximum_order, 38);
  EXPECT_EQ(carried.config.blocks, 20);
}

// 10 rows of 8 blocks need 320 samples.
TEST(CarriedBy, ARecordBelowTheSmallestLimitsIsRefused) {
  EXPECT_EQ(carried_by(of_lengths({320}), {}).config.block_rows, 10);
  EXPECT_THROW(static_cast<void>(carried_by(of_lengths({5000, 319}), {})), UnusableRecord);
}

// Who asks for less gets it: 4 rows of 2 blocks need 32 samples, a segment of 32 no more.
TEST(CarriedBy, SmallerWishesAreKept) {
  IdentificationSettings config;
  config.block_rows = 4;
  config.blocks = 2;
  config.welch_segment = 32;
  config.maximum_order = 6;
  const CarriedLimits carried = carried_by(of_lengths({32}), config);
  EXPECT_EQ(carried.note, "");
  EXPECT_EQ(carried.config.block_rows, 4);
  EXPECT_THROW(static_cast<void>(carried_by(of_lengths({31}), config)), UnusableRecord);
  config.welch_segment = 2048;  // a spectrum that shows anything has 64
  EXPECT_THROW(static_cast<void>(carried_by(of_lengths({63}), config)), UnusableRecord);
  EXPECT_EQ(carried_by(of_lengths({64}), config).config.welch_segment, 64);
}

// For every length what is carried fits into it, and no limit is above its wish.
TEST(CarriedBy, WhatIsCarriedFitsTheRecord) {
  const IdentificationSettings wish;
  for (Eigen::Index n = 320; n < 3000; n += 7) {
    const IdentificationSettings got = carried_by(of_lengths({n}), wish).config;
    EXPECT_LE(4 * got.blocks * got.block_rows, n);
    EXPECT_LE(got.welch_segment, n);
    EXPECT_LE(got.maximum_order, 2 * got.block_rows);
    EXPECT_TRUE(got.blocks >= 8 && got.blocks <= wish.blocks && got.block_rows >= 10 && got.block_rows <= wish.block_rows);
  }
}

}  // namespace
}  // namespace twindeck::identification
