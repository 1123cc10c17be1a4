// States whose causes bring more motion than the structure has. Oracles: the same changes written into dense matrices; finite
// differences of their eigenvalues.
#include <gtest/gtest.h>

#include "hand_made.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::Cause;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kRowMasses = 6;
constexpr double kSameModes = 1e-9;  // of ln f: two eigensolvers

/// Unequal masses in a row between two walls, the third spring a parameter. The basis has two modes; each place adds its own
/// vectors. Masses are added at all nodes but the last: more vectors than there are degrees of freedom.
class ReducedRow {
 public:
  /// @param turn  another row: which rounding a singular matrix has is a matter of luck
  explicit ReducedRow(int turn) : k(springs_in_a_row(springs(turn))) {
    model = std::make_unique<Predicted>(nodes_in_a_row(kRowMasses), k - third(), m,
                                        std::vector<MatrixModel::Part>{{parameter(), third()}}, nullptr, diagnosis::LoadTests{},
                                        few_modes());
    for (int i = 0; i + 1 < kRowMasses; ++i) {
      const double kg = 40.0 * (i + 1);
      const diagnosis::ReducedPlace* node = model->place("nodes", "node:" + std::to_string(i + 1));
      masses.push_back(std::make_unique<HandMade>("mass.add", std::map<std::string, double>{{"mass", kg}},
                                                  std::vector<const diagnosis::ReducedPlace*>{node}));
      causes.push_back(masses.back()->cause());
      vectors += std::ssize(node->columns);
      m(i, i) += kg;
    }
    model->add_frequencies(dense_hertz(k, m));
  }
  static VectorXd springs(int turn) {
    VectorXd out = (VectorXd(kRowMasses + 1) << 2.0e6, 1.6e6, 2.4e6, 1.8e6, 2.2e6, 1.9e6, 2.5e6).finished();
    for (Index i = 0; i < out.size(); ++i)
      if (i != 2) out[i] *= 1.0 + 0.3 * std::sin(static_cast<double>(turn * (i + 1)));
    return out;
  }
  static MatrixXd third() {
    VectorXd springs = VectorXd::Zero(kRowMasses + 1);
    springs[2] = 2.4e6;
    return springs_in_a_row(springs);
  }
  static fe::Parameter parameter() { return {"k2", fe::Target::matrix_stiffness, {}, "-", 1.0, 0.8, 1.2}; }
  static diagnosis::ReductionOptions few_modes() {
    diagnosis::ReductionOptions options;
    options.modes = 2;
    options.parameter_vectors = 0;
    options.full_below = 0;
    return options;
  }
  [[nodiscard]] VectorXd log_hertz(double factor) const { return dense_hertz(k + (factor - 1.0) * third(), m).array().log(); }

  MatrixXd k;
  MatrixXd m =
      (VectorXd(kRowMasses) << 900.0, 1200.0, 1000.0, 800.0, 950.0, 1100.0).finished().asDiagonal();  // with the causes
  std::unique_ptr<Predicted> model;
  std::vector<std::unique_ptr<HandMade>> masses;
  std::vector<Cause> causes;
  Index vectors = 0;
};

constexpr int kTurns = 20;

TEST(ManyCauses, HaveTheModesOfTheDenseMatrices) {
  for (int turn = 0; turn < kTurns; ++turn) {
    const ReducedRow row(turn);
    ASSERT_GT(row.model->reduced().common + row.vectors, kRowMasses) << "no vector too many: the test asks nothing";
    const auto p = row.model->predict(row.causes);
    ASSERT_TRUE(p.valid) << "row " << turn;
    EXPECT_LT((p.g - row.log_hertz(1.0)).cwiseAbs().maxCoeff(), kSameModes) << "row " << turn;
  }
}

TEST(ManyCauses, HaveTheDerivativesOfTheDenseMatrices) {
  for (int turn = 0; turn < kTurns; ++turn) {
    const ReducedRow row(turn);
    const diagnosis::FeatureMap map = row.model->map();
    ASSERT_EQ(map.nuisances()[0].name, "k2");
    const auto p = map.predict(map.base(VectorXd::Zero(std::ssize(map.nuisances()))), row.causes, true);
    ASSERT_TRUE(p.valid) << "row " << turn;
    const double step = 1e-4;
    const VectorXd slope =
        map.nuisances()[0].deviation * (row.log_hertz(1.0 + step) - row.log_hertz(1.0 - step)) / (2.0 * step);
    EXPECT_LT((p.jacobian.col(0) - slope).cwiseAbs().maxCoeff(), 1e-6 * slope.cwiseAbs().maxCoeff()) << "row " << turn;
  }
}

}  // namespace
}  // namespace twindeck::tests
