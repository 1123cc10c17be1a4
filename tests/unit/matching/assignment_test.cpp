#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "matching/pairing.hpp"

namespace {

using twindeck::matching::best_assignment;

double gain_of(const Eigen::MatrixXd& gain, const std::vector<int>& columns) {
  double sum = 0.0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] >= 0) sum += gain(static_cast<Eigen::Index>(i), columns[i]);
  }
  return sum;
}

/// All injective assignments of the shorter side, tried one by one.
double best_by_enumeration(Eigen::MatrixXd gain) {
  if (gain.rows() > gain.cols()) gain.transposeInPlace();
  std::vector<int> columns(static_cast<std::size_t>(gain.cols()));
  std::iota(columns.begin(), columns.end(), 0);
  double best = -std::numeric_limits<double>::infinity();
  do {
    best = std::max(best, gain_of(gain, {columns.begin(), columns.begin() + gain.rows()}));
  } while (std::next_permutation(columns.begin(), columns.end()));
  return best;
}

// Oracle: enumeration of every assignment.
TEST(BestAssignment, EqualsEnumeration) {
  std::srand(3);
  for (const auto& [rows, columns] : {std::pair{1, 1}, {3, 3}, {4, 7}, {7, 4}, {6, 6}, {2, 7}}) {
    for (int trial = 0; trial < 20; ++trial) {
      const Eigen::MatrixXd gain = Eigen::MatrixXd::Random(rows, columns);
      const std::vector<int> found = best_assignment(gain);
      std::vector<int> used = found;
      std::erase(used, -1);
      std::sort(used.begin(), used.end());
      EXPECT_EQ(static_cast<int>(used.size()), std::min(rows, columns));
      EXPECT_EQ(std::adjacent_find(used.begin(), used.end()), used.end()) << "a column was given twice";
      EXPECT_NEAR(gain_of(gain, found), best_by_enumeration(gain), 1e-12);
    }
  }
}

// Oracle: hand calculation. Greedy would take 0.9 first and be left with 0.1 (sum 1.0); the best sum is 0.8 + 0.7.
TEST(BestAssignment, IsNotGreedy) {
  Eigen::Matrix2d gain;
  gain << 0.9, 0.8, 0.7, 0.1;
  EXPECT_EQ(best_assignment(gain), (std::vector<int>{1, 0}));
}

TEST(BestAssignment, OfNothingIsNothing) {
  // Oracle: the contract (one entry a row, -1 where there is no column).
  EXPECT_EQ(best_assignment(Eigen::MatrixXd(2, 0)), (std::vector<int>{-1, -1}));
  EXPECT_TRUE(best_assignment(Eigen::MatrixXd(0, 3)).empty());
}

}  // namespace
