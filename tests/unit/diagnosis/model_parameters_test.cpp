// Oracles: a prior that the rows tell nothing about; a stiffness that they tell exactly; products and quadratures by hand.
#include "diagnosis/model_parameters.hpp"

#include <gtest/gtest.h>

#include "unit/diagnosis/prediction/hand_made.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::ModelParameter;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Three masses between walls, the second spring a parameter of 0.8 to 1.2; its truth is 1.1.
class OneParameter {
 public:
  /// @param updated  value that an update left in the model, 1 = none was made
  explicit OneParameter(double relative_std, double updated = 1.0)
      : model_(nodes_in_a_row(3), springs(updated) - updated * second(), mass(),
               {{{"k2", fe::Target::matrix_stiffness, {}, "-", updated, 0.8, 1.2, 1.0}, updated * second()}}) {
    const VectorXd hertz = OneParameter::hertz(1.1);
    for (Eigen::Index i = 0; i < hertz.size(); ++i)
      model_.add_row(diagnosis::RowType::frequency, std::to_string(i + 1), -1, hertz[i], relative_std * hertz[i]);
    group_.set = "groups";
    candidate_.hypothesis = &group_;
    candidate_.location = "group:k2";
  }
  /// @param factor  value, low and high of a cause that scales the parameter; empty: no cause
  [[nodiscard]] ModelParameter estimated(const std::vector<double>& factor = {}) const {
    diagnosis::ScatterOptions exact;
    exact.node_mass = exact.element_stiffness = exact.frequency_floor = 0.0;
    const diagnosis::FeatureMap map = model_.map(exact);
    deviation = map.nuisances()[0].deviation;
    const std::vector<std::unique_ptr<diagnosis::Candidate>> none;
    const diagnosis::Inference inference(map, none);
    diagnosis::Diagnosis result;
    result.before = result.after = inference.fit({}, {});
    if (!factor.empty()) {
      diagnosis::Effect effect;
      effect.cause.candidate = &candidate_;
      effect.parameters = {{"factor", "-", factor[0], factor[1], factor[2]}};
      result.effects.push_back(effect);
    }
    const auto all = model_parameters(inference, result);
    EXPECT_EQ(all.size(), 1u);
    return all.at(0);
  }
  static VectorXd hertz(double k2) { return dense_hertz(springs(k2), mass()); }
  mutable double deviation = 0.0;  ///< of the prior

 private:
  static MatrixXd springs(double second_factor) {
    return springs_in_a_row((VectorXd(4) << 2e6, second_factor * 1.5e6, 1.8e6, 2.2e6).finished());
  }
  static MatrixXd second() { return springs_in_a_row((VectorXd(4) << 0.0, 1.5e6, 0.0, 0.0).finished()); }
  static MatrixXd mass() { return 1000.0 * MatrixXd::Identity(3, 3); }
  Predicted model_;
  diagnosis::Hypothesis group_;
  diagnosis::Candidate candidate_;
};

constexpr double kNinety = 1.6449;  // deviations to either side of the middle 90 %

TEST(ModelParameters, ThatNothingTellsHaveTheirPrior) {
  const OneParameter vague(1e3);
  const ModelParameter found = vague.estimated();
  EXPECT_EQ(found.name, "k2");
  EXPECT_EQ(found.unit, "-");
  EXPECT_NEAR(found.before.value, 1.0, 1e-3);
  EXPECT_NEAR(found.before.low, std::max(0.8, 1.0 - kNinety * vague.deviation), 1e-3);
  EXPECT_NEAR(found.before.high, std::min(1.2, 1.0 + kNinety * vague.deviation), 1e-3);
}

// Oracle: of a Gaussian prior and rows that are linear in the parameter, 1/variance = 1/prior² + sum (d ln f / d k)² / std².
TEST(ModelParameters, ThatTheRowsTellHaveTheirValueAndItsDeviation) {
  const double std = 3e-3;
  const OneParameter told(std);
  const ModelParameter found = told.estimated();
  const double step = 1e-5;
  const VectorXd slope =
      (OneParameter::hertz(1.1 + step).array().log() - OneParameter::hertz(1.1 - step).array().log()) / (2.0 * step);
  const double precision = 1.0 / (told.deviation * told.deviation) + slope.squaredNorm() / (std * std);
  const double pulled = (1.1 * slope.squaredNorm() / (std * std) + 1.0 / (told.deviation * told.deviation)) / precision;
  EXPECT_NEAR(found.before.value, pulled, 1e-3);
  EXPECT_NEAR(found.before.high - found.before.low, 2.0 * kNinety / std::sqrt(precision),
              1e-3 * (found.before.high - found.before.low));
  EXPECT_NEAR(found.before.high - found.before.value, found.before.value - found.before.low, 1e-9);
  EXPECT_EQ(found.after.value, found.before.value);
}

// Oracle: the same rows and the same prior give the same posterior, wherever the model stands: to a fiftieth of the interval,
// because the scatter is a share of the springs as they stand.
TEST(ModelParameters, AnUpdateToTheSameRowsIsNoPrior) {
  for (const double std : {1e3, 3e-3, 3e-2}) {
    const ModelParameter plan = OneParameter(std).estimated(), updated = OneParameter(std, 1.09).estimated();
    const double close = (plan.before.high - plan.before.low) / 50.0;
    EXPECT_NEAR(updated.before.value, plan.before.value, close);
    EXPECT_NEAR(updated.before.low, plan.before.low, close);
    EXPECT_NEAR(updated.before.high, plan.before.high, close);
  }
}

TEST(ModelParameters, ACauseScalesItsParameterAndBothDeviationsCount) {
  const OneParameter known(3e-3);
  const ModelParameter alone = known.estimated(), scaled = known.estimated({0.5, 0.4, 0.7});
  EXPECT_EQ(scaled.before.value, alone.before.value);
  EXPECT_EQ(scaled.before.low, alone.before.low);
  const double value = alone.after.value * 0.5;
  EXPECT_NEAR(scaled.after.value, value, 1e-12);
  const double down = std::hypot(std::log(alone.after.value / alone.after.low), std::log(0.5 / 0.4));
  const double up = std::hypot(std::log(alone.after.high / alone.after.value), std::log(0.7 / 0.5));
  EXPECT_NEAR(scaled.after.low, value * std::exp(-down), 1e-12);
  EXPECT_NEAR(scaled.after.high, value * std::exp(up), 1e-12);
}

TEST(ModelParameters, AFactorThatMayBeNothingIsAdded) {
  const OneParameter known(3e-3);
  const ModelParameter alone = known.estimated(), changed = known.estimated({0.5, -0.1, 1.2});
  EXPECT_NEAR(changed.after.value, alone.after.value - 0.5, 1e-12);
  EXPECT_NEAR(changed.after.low, alone.after.low - 1.1, 1e-12);
  EXPECT_NEAR(changed.after.high, alone.after.high + 0.2, 1e-12);
}

}  // namespace
}  // namespace twindeck::tests
