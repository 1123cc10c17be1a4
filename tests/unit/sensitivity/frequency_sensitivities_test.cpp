#include "sensitivity/frequency_sensitivities.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/dynamics/spring_chain.hpp"

namespace twindeck::sensitivity {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using tests::SpringChain;

Sensitivities of_system(const fe::ParametricSystem& system, const VectorXd& theta, int n_modes) {
  SensitivityOptions options;
  options.n_modes = n_modes;
  return frequency_sensitivities(system, theta, options, {});
}

// Oracle: closed form. f ~ sqrt(k/m): df/dk = f/(2 k), df/dm = -f/(2 m). A forward step of 1 % gives f (sqrt(1.01) - 1) and
// f (1/sqrt(1.01) - 1). Differences lose some digits of the solver's 1e-12 to steps of 1e-3.
TEST(FrequencySensitivities, MeetTheClosedForms) {
  const SpringChain chain{.n = 12};
  const fe::ParametricSystem system = chain.system();
  const Sensitivities found = of_system(system, system.initial(), 4);
  ASSERT_TRUE(found.status.converged);
  ASSERT_EQ(found.frequency_Hz.size(), 4);
  EXPECT_EQ(found.theta, system.initial());
  EXPECT_EQ(found.scale, system.initial());
  for (int j = 1; j <= 4; ++j) {
    const double f = chain.frequency_Hz(j);
    EXPECT_NEAR(found.frequency_Hz[j - 1] / f, 1.0, 1e-10);
    for (const MatrixXd* exact : {&found.exact, &found.richardson}) {
      EXPECT_NEAR((*exact)(j - 1, 0) * 2.0 * chain.k / f, 1.0, 1e-7) << j;
      EXPECT_NEAR((*exact)(j - 1, 1) * 2.0 * chain.m / f, -1.0, 1e-7) << j;
    }
    EXPECT_NEAR(found.forward(j - 1, 0) * 0.01 * chain.k / f, std::sqrt(1.01) - 1.0, 1e-8) << j;
    EXPECT_NEAR(found.forward(j - 1, 1) * 0.01 * chain.m / f, 1.0 / std::sqrt(1.01) - 1.0, 1e-8) << j;
    EXPECT_NEAR(found.relative()(j - 1, 0), 0.5, 1e-9);
    EXPECT_NEAR(found.relative()(j - 1, 1), -0.5, 1e-9);
  }
}

// Oracle: the three ways agree. One ground spring makes a derivative without a closed form; extrapolated differences are good
// to h⁴, forward ones to the step of 1 %.
TEST(FrequencySensitivities, AgreeThreeWays) {
  fe::ParametricSystem system = SpringChain{.n = 12}.system();
  SpringChain::add_ground_spring(system, 4, 30.0);
  const Sensitivities found = of_system(system, system.initial(), 5);
  const VectorXd exact = found.exact.col(3);
  ASSERT_GT(exact.minCoeff(), 0.0);  // a spring more can only raise frequencies
  EXPECT_LT((found.richardson.col(3) - exact).norm(), 1e-7 * exact.norm());
  EXPECT_LT((found.forward.col(3) - exact).norm(), 0.02 * exact.norm());
  EXPECT_GT((found.forward.col(3) - exact).norm(), 1e-5 * exact.norm());  // else it were no forward difference
}

// Oracle: the header. At zero the range of a parameter, here -1e3 to 1e3 N/m, takes the place of its value.
TEST(FrequencySensitivities, ScaleByTheRangeAtZero) {
  fe::ParametricSystem system = SpringChain{.n = 6}.system();
  SpringChain::add_ground_spring(system, 2, 0.0);
  const Sensitivities found = of_system(system, system.initial(), 2);
  EXPECT_EQ(found.scale[3], 2000.0);
  EXPECT_NEAR((found.richardson.col(3) - found.exact.col(3)).norm() / found.exact.col(3).norm(), 0.0, 1e-4);
  VectorXd negative = system.initial();
  negative[3] = -5.0;
  EXPECT_EQ(of_system(system, negative, 2).scale[3], 5.0);
}

// Oracle: closed form. The second chain is 0.5 % stiffer, so that a forward step of 1 % lets the modes of the first pass those
// of the second. Followed by shape, one of each pair moves by f (sqrt(1.01) - 1) and the other not at all.
TEST(FrequencySensitivities, FollowModesThatPassEachOther) {
  const SpringChain chain{.n = 6, .copies = 2};
  const fe::ParametricSystem system = chain.system();
  VectorXd theta = system.initial();
  theta[3] = 1.005;
  const Sensitivities found = of_system(system, theta, 4);
  for (int i = 0; i < 4; ++i) {
    const double moved = i % 2 == 0 ? chain.frequency_Hz(i / 2 + 1) : 0.0;
    EXPECT_NEAR(found.forward(i, 2), moved * (std::sqrt(1.01) - 1.0) / 0.01, 1e-6) << i;
    EXPECT_NEAR(found.exact(i, 2), 0.5 * moved, 1e-8) << i;
    EXPECT_NEAR(found.richardson(i, 2), 0.5 * moved, 1e-6) << i;
  }
}

// Oracle: a chain of three masses has three modes.
TEST(FrequencySensitivities, GiveAsManyModesAsThereAre) {
  const fe::ParametricSystem system = SpringChain{.n = 3}.system();
  const Sensitivities found = of_system(system, system.initial(), 9);
  EXPECT_TRUE(found.status.converged);
  EXPECT_EQ(found.frequency_Hz.size(), 3);
  EXPECT_EQ(found.exact.rows(), 3);
  EXPECT_EQ(found.forward.cols(), 3);
}

// Oracle: the definition. A stiffness that is not positive definite is a status, and no exception: at the values themselves,
// and where a difference alone reaches it.
TEST(FrequencySensitivities, ReturnAStatusWhereThereAreNoModes) {
  const fe::ParametricSystem system = SpringChain{.n = 4}.system();
  VectorXd theta = system.initial();
  theta[0] = -theta[0];
  EXPECT_FALSE(of_system(system, theta, 2).status.converged);
  SensitivityOptions options;
  options.n_modes = 2;
  options.forward_step = -1.5;  // k falls below zero
  const Sensitivities reached = frequency_sensitivities(system, system.initial(), options, {});
  EXPECT_FALSE(reached.status.converged);
  EXPECT_FALSE(reached.forward.col(0).array().isFinite().any());
  EXPECT_TRUE(reached.exact.array().isFinite().all());
}

// Oracle: the header. Progress counts from 1 to the number of parameters.
TEST(FrequencySensitivities, ReportTheirProgress) {
  const fe::ParametricSystem system = SpringChain{.n = 4, .copies = 2}.system();
  std::vector<int> counted;
  (void)frequency_sensitivities(system, system.initial(), {}, [&](int done, int of) {
    EXPECT_EQ(of, 4);
    counted.push_back(done);
  });
  EXPECT_EQ(counted, (std::vector<int>{1, 2, 3, 4}));
}

// Oracle: counted by hand.
TEST(RefuseRigidBodies, CountsModesAtZero) {
  Sensitivities found;
  found.frequency_Hz = Eigen::Vector3d(1e-9, 1.0, 2.0);
  EXPECT_NO_THROW(refuse_rigid_bodies(found, "model"));
  found.frequency_Hz = Eigen::Vector4d(0.0, 0.0, 1.0, 2.0);
  try {
    refuse_rigid_bodies(found, "model");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.place().file, "model");
    EXPECT_NE(std::string(error.what()).find("2 of 4 modes"), std::string::npos) << error.what();
  }
}

// Oracle: hand calculation. df/dp = 0.5 Hz at f = 2 Hz over half a range of 0.4 shifts f by 10 %, which is 20 deviations of
// 0.5 %.
TEST(ScaledSensitivity, CountsDeviationsOverHalfTheRange) {
  Sensitivities found;
  found.frequency_Hz = Eigen::Vector3d(2.0, 4.0, 5.0);
  found.exact.resize(3, 2);
  found.exact << 0.5, 0.0, 1.0, -2.0, 0.0, 1.0;
  std::vector<fe::Parameter> parameters(2);
  parameters[0].lower = 0.8, parameters[0].upper = 1.6;
  parameters[1].lower = -0.01, parameters[1].upper = 0.03;
  const MatrixXd all = scaled_sensitivity({}, 0.5, parameters, found);
  const MatrixXd expected = (MatrixXd(3, 2) << 20.0, 0.0, 20.0, -2.0, 0.0, 0.8).finished();
  EXPECT_LT((all - expected).norm(), 1e-12);
  const MatrixXd some = scaled_sensitivity({3.0, 1.0, 7.0}, 0.5, parameters, found);  // a seventh mode was not computed
  ASSERT_EQ(some.rows(), 2);
  EXPECT_EQ(some.row(0), all.row(2));
  EXPECT_EQ(some.row(1), all.row(0));
  EXPECT_LT((scaled_sensitivity({}, 1.0, parameters, found) - 0.5 * expected).norm(), 1e-12);
}

}  // namespace
}  // namespace twindeck::sensitivity
