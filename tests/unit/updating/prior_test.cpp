// The update that is held to its ranges. Oracles: the law of r = s e, whose most likely s is the root mean square; the maximum
// a posteriori estimate of joint_map.hpp, which is another search of the same problem; the definition of what is offered when.
#include "updating/prior.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "chain.hpp"
#include "updating/joint_map.hpp"
#include "updating/leave_one_out.hpp"

namespace twindeck::updating {
namespace {

// Five masses between walls; two groups of springs and a factor on a part of the masses.
SmallSystem held_chain() {
  SmallSystem small(5);
  const int k1 = small.parameter("k1", 1.0, 0.5, 1.6), k2 = small.parameter("k2", 1.0, 0.5, 1.6),
            m = small.parameter("m", 1.0, 0.5, 1.6);
  for (int i = 0; i < 6; ++i) small.stiffness(400.0 * spring(5, i < 5 ? i : -1, i - 1), i < 2 ? k1 : k2);
  Eigen::VectorXd own(5), variable(5);
  own << 1.0, 1.2, 0.8, 1.1, 1.3;
  variable << 0.0, 0.5, 0.0, 0.0, 0.9;
  return small.mass(own.asDiagonal().toDenseMatrix()).mass(variable.asDiagonal().toDenseMatrix(), m);
}

// No set of parameters meets these: every other frequency is raised, the others lowered.
std::vector<FrequencyTarget> unmet(double by) {
  const Eigen::VectorXd own = dense_frequencies(held_chain().system(), Eigen::Vector3d::Ones());
  std::vector<FrequencyTarget> out;
  for (int i = 0; i < own.size(); ++i) out.push_back({std::to_string(i + 1), i, own(i) * (i % 2 == 0 ? 1.0 + by : 1.0 - by)});
  return out;
}

UpdatingOptions left_out(Eigen::Index surrogate_from = 1000) {
  UpdatingOptions options;
  options.starts = 2;
  options.leave_one_out = true;
  options.surrogate_from_size = surrogate_from;
  return options;
}

TEST(ModelError, OfAModelWithoutParametersIsTheRootMeanSquare) {
  const Eigen::Vector4d residual(0.03, -0.04, 0.0, 0.05);
  const double rms = std::sqrt(residual.squaredNorm() / 4.0);
  // A step of the estimate is 1.7 %.
  EXPECT_NEAR(estimated_model_error(residual, Eigen::MatrixXd::Zero(4, 2), Eigen::Vector2d::Ones()) / rms, 1.0, 0.009);
}

TEST(ModelError, IsLessWhereParametersExplainAPart) {
  const Eigen::Vector4d residual(0.04, 0.042, 0.038, 0.04);
  const Eigen::MatrixXd alike = Eigen::MatrixXd::Ones(4, 1);
  EXPECT_LT(estimated_model_error(residual, alike, Eigen::VectorXd::Constant(1, 0.04)), 0.004);
}

// Both minimise the same sum of squares; they stop at gradients of 1e-6 and at falls of 1e-12.
TEST(Prior, GivesTheMaximumAPosterioriEstimate) {
  const SmallSystem chain = held_chain();
  const std::vector<FrequencyTarget> measured = unmet(0.05);
  for (const Eigen::Index surrogate : {1000, 1}) {
    UpdatingOptions options = left_out(surrogate);
    options.prior = true;
    const UpdatingResult held = update(chain.system(), {}, {0, 1, 2}, measured, options, {});
    ASSERT_TRUE(held.status.converged) << held.status.message;
    ASSERT_GT(held.model_error, 0.0);
    const double deviation = 1.1 / std::sqrt(12.0);
    const auto predict = [&](const Eigen::VectorXd& x, Eigen::VectorXd& g, Eigen::MatrixXd* slope, Eigen::MatrixXd* scales) {
      const auto at = [&](const Eigen::VectorXd& where) {
        Eigen::VectorXd out = dense_frequencies(chain.system(), Eigen::VectorXd::Ones(3) + deviation * where);
        for (std::size_t i = 0; i < measured.size(); ++i) out(static_cast<Eigen::Index>(i)) /= measured[i].measured_Hz;
        return out;
      };
      g = at(x);
      if (slope != nullptr) {
        slope->resize(5, 3);
        for (int j = 0; j < 3; ++j) {
          const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(3, j);
          slope->col(j) = (at(x + step) - at(x - step)) / 2e-5;
        }
      }
      if (scales != nullptr) scales->resize(5, 0);
      return true;
    };
    const Box box{Eigen::VectorXd::Constant(3, -0.5 / deviation), Eigen::VectorXd::Constant(3, 0.6 / deviation)};
    const JointMap map = joint_map(predict, Eigen::VectorXd::Ones(5), held.model_error * Eigen::MatrixXd::Identity(5, 5),
                                   Eigen::VectorXd::Zero(3), box, {200, 1e-12});
    ASSERT_TRUE(map.status.converged) << map.status.message;
    EXPECT_LT((held.theta - (Eigen::VectorXd::Ones(3) + deviation * map.x)).cwiseAbs().maxCoeff(), 1e-4) << surrogate;
  }
}

TEST(Prior, IsOfferedWhereTheUpdatePredictsWorseThanNone) {
  const SmallSystem chain = held_chain();
  const std::vector<FrequencyTarget> measured = unmet(0.05);
  const UpdatingResult fit = update(chain.system(), {}, {0, 1, 2}, measured, left_out(), {});
  const auto errors = prediction_errors(fit, measured);
  ASSERT_TRUE(errors);
  EXPECT_NEAR(errors->before, 0.05, 0.003);  // 1/0.95 - 1 and 1 - 1/1.05
  ASSERT_GT(errors->left_out, errors->before);
  const auto held = regularised_where_worse(fit, chain.system(), {}, {0, 1, 2}, measured, left_out(), {});
  ASSERT_TRUE(held);
  EXPECT_LT(prediction_errors(*held, measured)->left_out, errors->left_out);
  // What is least with a term added has no more of that term. All ranges are alike.
  EXPECT_LT((held->theta.array() - 1.0).matrix().norm(), (fit.theta.array() - 1.0).matrix().norm());
}

TEST(Prior, IsNotOfferedWhereTheUpdatePredicts) {
  const SmallSystem chain = held_chain();
  const Eigen::VectorXd exact = dense_frequencies(chain.system(), Eigen::Vector3d(1.2, 0.9, 1.3));
  std::vector<FrequencyTarget> measured;
  for (int i = 0; i < exact.size(); ++i) measured.push_back({std::to_string(i + 1), i, exact(i)});
  const UpdatingResult fit = update(chain.system(), {}, {0, 1, 2}, measured, left_out(), {});
  EXPECT_FALSE(regularised_where_worse(fit, chain.system(), {}, {0, 1, 2}, measured, left_out(), {}));
  UpdatingOptions none = left_out();
  none.leave_one_out = false;
  const UpdatingResult unasked = update(chain.system(), {}, {0, 1, 2}, unmet(0.05), none, {});
  EXPECT_FALSE(prediction_errors(unasked, measured));
}

}  // namespace
}  // namespace twindeck::updating
