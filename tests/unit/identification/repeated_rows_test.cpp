// Oracle: records of noise put together from known pieces.
#include "identification/repeated_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twindeck::identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd noisy_rows(Index n, unsigned seed) {
  std::srand(seed);
  return MatrixXd::Random(n, 3);
}

void expect_repeat(const std::optional<RepeatedRows>& found, const std::string& file, Index from, Index again, Index length) {
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->file, file);
  EXPECT_EQ(found->first, from);
  EXPECT_EQ(found->again, again);
  EXPECT_EQ(found->length, length);
}

TEST(RowsSeen, ARecordAppendedToItself) {
  const MatrixXd once = noisy_rows(1003, 1);
  MatrixXd twice(2 * once.rows(), 3), with_rest(once.rows() + 700, 3);
  twice << once, once;
  with_rest << once, once.middleRows(217, 700);
  expect_repeat(RowsSeen().add(Samples(twice), "a"), "a", 0, 1003, 1003);
  expect_repeat(RowsSeen().add(Samples(with_rest), "a"), "a", 217, 1003, 700);
}

TEST(RowsSeen, ARecordThatHoldsAnother) {
  RowsSeen seen;
  const MatrixXd earlier = noisy_rows(900, 2);
  MatrixXd overlap(800, 3);
  overlap << earlier.bottomRows(100), noisy_rows(700, 3);
  EXPECT_FALSE(seen.add(Samples(earlier), "a"));
  expect_repeat(seen.add(Samples(overlap), "b"), "a", 800, 0, 100);
  expect_repeat(seen.add(Samples(earlier), "c"), "a", 0, 0, 900);
}

TEST(RowsSeen, NoiseRestAndPeriodsAreNoRepeat) {
  MatrixXd rest = noisy_rows(4000, 4), coarse = noisy_rows(4000, 5);
  rest.topRows(1000).setZero();
  rest.bottomRows(1500).setZero();
  coarse = coarse.array().round();
  MatrixXd sine(4000, 1);
  for (Index t = 0; t < sine.rows(); ++t) sine(t, 0) = std::round(1e4 * std::sin(0.08 * static_cast<double>(t % 25) * M_PI));
  for (const MatrixXd& record : {rest, coarse, sine}) EXPECT_FALSE(RowsSeen().add(Samples(record), "a"));
}

}  // namespace
}  // namespace twindeck::identification
