#include "sensitivity/selection.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

namespace twindeck::sensitivity {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

bool says_why(const SelectedParameter& parameter, const std::string& part) {
  return parameter.reason.find(part) != std::string::npos;
}

// Oracle: hand calculation in the plane. b = (3, 0.5) is longest. Of c = (0, 2) the part sqrt(4 - 1/9.25) = 1.97 is left, of
// a = (3, 0) the part sqrt(9 - 81/9.25) = 0.49, and nothing once c is kept as well. d = (0.3, 0) is too short by itself.
TEST(SelectParameters, TakesWhatOthersCannotDo) {
  const MatrixXd scaled = (MatrixXd(2, 4) << 3.0, 3.0, 0.0, 0.3, 0.0, 0.5, 2.0, 0.0).finished();
  const std::vector<SelectedParameter> fate = select_parameters(scaled, {"a", "b", "c", "d"}, 1.0);
  ASSERT_EQ(fate.size(), 4U);
  EXPECT_EQ(fate[1].rank, 1);
  EXPECT_EQ(fate[2].rank, 2);
  EXPECT_NEAR(fate[1].remaining, std::sqrt(9.25), 1e-14);
  EXPECT_NEAR(fate[2].score, 2.0, 1e-14);
  EXPECT_NEAR(fate[2].remaining, std::sqrt(4.0 - 1.0 / 9.25), 1e-14);
  EXPECT_NEAR(fate[0].score, 3.0, 1e-14);
  EXPECT_NEAR(fate[0].remaining, 0.0, 1e-14);
  EXPECT_TRUE(fate[1].selected && fate[2].selected);
  EXPECT_FALSE(fate[0].selected || fate[3].selected);
  EXPECT_TRUE(says_why(fate[1], "by 3.04 std of its own")) << fate[1].reason;
  EXPECT_TRUE(says_why(fate[0], "others do the same: 0.00 of 3.00 std left, most like b")) << fate[0].reason;
  EXPECT_TRUE(says_why(fate[3], "too little: its range moves the frequencies by 0.30 std")) << fate[3].reason;
}

// Oracle: hand calculation. What is left of (3, 0) beside b alone is 0.493: kept with a threshold below that, not above. A
// parameter that is not kept takes nothing from those after it.
TEST(SelectParameters, HoldsAtItsThreshold) {
  const MatrixXd scaled = (MatrixXd(2, 2) << 3.0, 3.0, 0.0, 0.5).finished();
  const double left = std::sqrt(9.0 - 81.0 / 9.25);
  EXPECT_TRUE(select_parameters(scaled, {"a", "b"}, 0.999 * left)[0].selected);
  EXPECT_FALSE(select_parameters(scaled, {"a", "b"}, 1.001 * left)[0].selected);
  const std::vector<SelectedParameter> none = select_parameters(scaled, {"a", "b"}, 5.0);
  EXPECT_FALSE(none[0].selected || none[1].selected);
  EXPECT_NEAR(none[0].remaining, 3.0, 1e-14);
}

// Oracle: hand calculation. Beside (10, 0) and (0, 1.5) nothing is left of (1.1, 1) and (-1, -1.1). The angle says which of the
// kept ones does the same, whatever its length and sign: the first for the one, the second for the other.
TEST(SelectParameters, NamesTheNearestByAngle) {
  const MatrixXd scaled = (MatrixXd(2, 4) << 10.0, 0.0, 1.1, -1.0, 0.0, 1.5, 1.0, -1.1).finished();
  const std::vector<SelectedParameter> fate = select_parameters(scaled, {"a", "b", "c", "d"}, 1.3);
  EXPECT_TRUE(says_why(fate[2], "most like a")) << fate[2].reason;
  EXPECT_TRUE(says_why(fate[3], "most like b")) << fate[3].reason;
}

MatrixXd rough_matrix(Index rows, Index columns) {
  MatrixXd a(rows, columns);
  for (Index i = 0; i < a.size(); ++i) a(i) = std::sin(1.0 + static_cast<double>(i * i)) * static_cast<double>(1 + i % 3);
  return a;
}

// Oracle: the volume. If all are kept, the product of what is left of each is |det A|, and the parts fall with the rank.
TEST(SelectParameters, SpanTheVolumeOfTheColumns) {
  const MatrixXd scaled = rough_matrix(4, 4);
  const std::vector<SelectedParameter> fate = select_parameters(scaled, {"a", "b", "c", "d"}, 1e-6);
  double volume = 1.0;
  for (const SelectedParameter& parameter : fate) {
    EXPECT_TRUE(parameter.selected);
    volume *= parameter.remaining;
    for (const SelectedParameter& other : fate)
      EXPECT_TRUE(other.rank <= parameter.rank || other.remaining <= parameter.remaining + 1e-14);
  }
  EXPECT_NEAR(volume / std::abs(scaled.determinant()), 1.0, 1e-12);
}

// Oracle: invariance. Signs of columns and a rotation of the rows change no length and no angle; another order of the columns
// goes along with the result.
TEST(SelectParameters, DependOnLengthsAndAnglesAlone) {
  const MatrixXd scaled = rough_matrix(3, 4);
  const MatrixXd rotation = Eigen::HouseholderQR<MatrixXd>(rough_matrix(3, 3)).householderQ();
  const MatrixXd turned = rotation * scaled * Eigen::Vector4d(1.0, -1.0, 1.0, -1.0).asDiagonal();
  const MatrixXd exchanged = scaled.rowwise().reverse();
  const std::vector<SelectedParameter> fate = select_parameters(scaled, {"a", "b", "c", "d"}, 1.0);
  const std::vector<SelectedParameter> of_turned = select_parameters(turned, {"a", "b", "c", "d"}, 1.0);
  const std::vector<SelectedParameter> of_exchanged = select_parameters(exchanged, {"d", "c", "b", "a"}, 1.0);
  for (std::size_t p = 0; p < 4; ++p) {
    for (const SelectedParameter& other : {of_turned[p], of_exchanged[3 - p]}) {
      EXPECT_EQ(other.rank, fate[p].rank);
      EXPECT_EQ(other.selected, fate[p].selected);
      EXPECT_NEAR(other.score, fate[p].score, 1e-13);
      EXPECT_NEAR(other.remaining, fate[p].remaining, 1e-13);
    }
  }
}

// Oracle: hand calculation. Two parameters of 3 and 0.5 deviations that act apart: with a cutoff of 1 the first is seen alone.
TEST(IdentifiabilityOf, ParametersThatActApart) {
  const MatrixXd scaled = (MatrixXd(3, 2) << 0.0, 0.5, 3.0, 0.0, 0.0, 0.0).finished();
  const Identifiability found = identifiability(scaled, 1.0);
  EXPECT_NEAR((found.singular_values - Eigen::Vector2d(3.0, 0.5)).norm(), 0.0, 1e-14);
  EXPECT_EQ(found.retained, 1);
  EXPECT_NEAR((found.resolution - Eigen::Vector2d(1.0, 0.0)).norm(), 0.0, 1e-14);
  EXPECT_EQ(identifiability(scaled, 0.49).retained, 2);
  EXPECT_EQ(identifiability(scaled, 3.01).retained, 0);
  EXPECT_EQ(identifiability(scaled, 3.01).resolution.norm(), 0.0);
}

// Oracle: hand calculation. A row (2, 1, 0) has one singular value, sqrt(5), along (2, 1, 0)/sqrt(5): resolution 4/5, 1/5 and
// nothing. More parameters than frequencies leave zeros.
TEST(IdentifiabilityOf, MoreParametersThanFrequencies) {
  const Identifiability found = identifiability((MatrixXd(1, 3) << 2.0, 1.0, 0.0).finished(), 1.0);
  EXPECT_NEAR((found.singular_values - Eigen::Vector3d(std::sqrt(5.0), 0.0, 0.0)).norm(), 0.0, 1e-14);
  EXPECT_EQ(found.retained, 1);
  EXPECT_NEAR((found.resolution - Eigen::Vector3d(0.8, 0.2, 0.0)).norm(), 0.0, 1e-14);
}

// Oracle: V_r has orthonormal columns, so that the resolutions add up to the number retained; A'A has the squares.
TEST(IdentifiabilityOf, ResolutionsAddUpToTheDirections) {
  const MatrixXd scaled = rough_matrix(5, 4);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> gram(scaled.transpose() * scaled);
  for (int retained = 0; retained < 4; ++retained) {
    const Eigen::VectorXd squares = gram.eigenvalues().reverse();
    const double cutoff = retained == 0 ? 1e9 : std::sqrt(0.5 * (squares[retained - 1] + squares[retained]));
    const Identifiability found = identifiability(scaled, cutoff);
    EXPECT_EQ(found.retained, retained);
    EXPECT_NEAR(found.resolution.sum(), retained, 1e-12);
    EXPECT_NEAR((found.singular_values.cwiseAbs2() - squares).norm(), 0.0, 1e-11);
  }
}

}  // namespace
}  // namespace twindeck::sensitivity
