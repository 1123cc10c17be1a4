// V' S V computed part by part. Oracle: the dense product of the whole.
#include "diagnosis/reduction/reduced_matrix.hpp"

#include <gtest/gtest.h>

namespace twindeck::tests {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kDofs = 30, kCommonVectors = 6;

diagnosis::ReducedBasis::Block block(int count) {
  const MatrixXd vectors = MatrixXd::Random(kDofs, count);
  return {std::make_shared<const MatrixXd>(vectors), [vectors] { return vectors; }};
}

/// A basis of six common vectors and three groups of two, three and one.
std::shared_ptr<diagnosis::ReducedBasis> projection_basis() {
  auto out = std::make_shared<diagnosis::ReducedBasis>(MatrixXd::Random(kDofs, kCommonVectors));
  out->append({block(2), block(0), block(3), block(1)});
  return out;
}

MatrixXd vectors(const diagnosis::ReducedBasis& basis, const std::vector<int>& columns) {
  MatrixXd out(kDofs, std::ssize(columns));
  out << basis.common_vectors(), basis.own(columns);
  return out;
}

/// Springs in a row between some degrees of freedom.
diagnosis::Symmetric row_of_springs(int first, int last) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = first; i < last; ++i)
    for (const auto& [row, column, value] : {std::tuple{i, i, 1.0}, {i + 1, i + 1, 1.0}, {i, i + 1, -1.0}, {i + 1, i, -1.0}})
      entries.emplace_back(row, column, (1.0 + i) * value);
  diagnosis::Symmetric s(kDofs, kDofs);
  s.setFromTriplets(entries.begin(), entries.end());
  return s;
}

const std::vector<int> kSomeColumns = {0, 1, 2, 3, 4, 5, 8, 9, 10, 6, 7};  // the common ones, the second group, the first

MatrixXd whole_product(const diagnosis::ReducedBasis& basis, const diagnosis::Symmetric& s, const std::vector<int>& columns) {
  const MatrixXd v = vectors(basis, columns);
  return v.transpose() * (s * v);
}

TEST(ReducedMatrix, PartIsThatOfTheWholeWhetherKeptOrMultipliedOut) {
  const auto v = projection_basis();
  for (const int last : {14, kDofs - 1})  // three degrees of freedom; all but a few
    for (const bool for_all : {false, true}) {
      const diagnosis::Symmetric s = row_of_springs(12, last);
      const diagnosis::ReducedMatrix matrix(s, v, for_all);
      EXPECT_EQ(matrix.is_local(), last == 14);
      const MatrixXd expected = whole_product(*v, s, kSomeColumns);
      for (int again = 0; again < 2; ++again) EXPECT_LT((matrix.part(kSomeColumns) - expected).norm(), 1e-12 * expected.norm());
      EXPECT_LT((matrix.common() - expected.topLeftCorner(kCommonVectors, kCommonVectors)).norm(), 1e-12 * expected.norm());
    }
}

TEST(ReducedMatrix, ImagesOfMotionAreTheWholesProducts) {
  const auto v = projection_basis();
  const diagnosis::Symmetric s = row_of_springs(12, 14);
  const diagnosis::ReducedMatrix matrix(s, v, true);
  const VectorXd x = VectorXd::Random(std::ssize(kSomeColumns));
  const MatrixXd own = v->own(kSomeColumns);
  const MatrixXd motion = v->motion(own, x);
  EXPECT_LT((motion - vectors(*v, kSomeColumns) * x).norm(), 1e-12 * motion.norm());
  const VectorXd expected = 2.5 * (whole_product(*v, s, kSomeColumns) * x);
  MatrixXd force = MatrixXd::Zero(kDofs, 1);
  matrix.add_image(2.5, motion, force);
  EXPECT_LT((v->projected(own, force) - expected).norm(), 1e-12 * expected.norm());
  VectorXd sum = VectorXd::Zero(x.size());
  matrix.add_product(2.5, own, motion.col(0), sum);
  EXPECT_LT((sum - expected).norm(), 1e-12 * expected.norm());
}

TEST(ReducedBasis, KeepsFewGroupsAndComputesOthersAgain) {
  const auto v = projection_basis();
  const MatrixXd first = *v->vectors(0);
  const auto groups = v->groups().size();
  v->append(std::vector<diagnosis::ReducedBasis::Block>(diagnosis::ReducedBasis::kKept, block(1)));
  EXPECT_EQ(v->groups().size(), groups + diagnosis::ReducedBasis::kKept);
  EXPECT_EQ(*v->vectors(0), first);
  EXPECT_EQ(v->own(kSomeColumns).rightCols(2), first);
}

TEST(ReducedMatrix, FollowsABasisThatHasGrown) {
  const auto v = projection_basis();
  const diagnosis::Symmetric s = row_of_springs(0, kDofs - 1);
  diagnosis::ReducedMatrix matrix(s, v, true);
  const std::vector<std::vector<int>> further = v->append({block(2)});
  matrix.follow_basis();
  std::vector<int> columns = kSomeColumns;
  columns.insert(columns.end(), further[0].begin(), further[0].end());
  EXPECT_EQ(matrix.size(), kCommonVectors + 8);
  const MatrixXd expected = whole_product(*v, s, columns);
  EXPECT_LT((matrix.part(columns) - expected).norm(), 1e-12 * expected.norm());
}

}  // namespace
}  // namespace twindeck::tests
