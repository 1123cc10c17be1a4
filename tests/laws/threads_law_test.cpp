#include <gtest/gtest.h>

#include <vector>

#include "core/parallel.hpp"
#include "dynamics/eigenmodes.hpp"
#include "fe/assembly.hpp"
#include "prototype_bridge.hpp"
#include "sensitivity/channel_sensitivity.hpp"
#include "sensitivity/frequency_jacobian.hpp"

namespace {

struct Result {
  Eigen::VectorXd pulls;
  twindeck::dynamics::EigenModes modes;
  Eigen::MatrixXd jacobian;
  std::vector<Eigen::MatrixXd> at_channels;
};

Result with_threads(int threads) {
  twindeck::set_thread_count(threads);
  const auto model = twindeck::tests::prototype_bridge("preliminary");
  const Eigen::VectorXd theta = twindeck::fe::initial_parameters(model);
  const auto state = twindeck::fe::find_prestress(model, theta);
  const auto system = twindeck::fe::assemble(model, state);
  twindeck::dynamics::ModalSolver solver(system);
  Result result{state.stay_pull_N, solver.solve(theta, 10), {}, {}};
  result.jacobian = twindeck::sensitivity::frequency_jacobian(system, theta, result.modes);
  Eigen::MatrixXd channels = Eigen::MatrixXd::Zero(system.size(), 3);
  for (Eigen::Index c = 0; c < 3; ++c) channels((c + 1) * system.size() / 4, c) = 1.0;
  result.at_channels = twindeck::sensitivity::channel_shape_derivatives(system, theta, result.modes, channels);
  return result;
}

// Law: the number of threads changes the time, not one bit of the result; prestress, assembly, modes and derivatives of the
// bridge.
TEST(ThreadsLaw, ResultsHaveTheSameBits) {
  const int before = twindeck::thread_count();
  const Result one = with_threads(1), three = with_threads(3);
  twindeck::set_thread_count(before);
  ASSERT_TRUE(one.modes.status.converged);
  EXPECT_TRUE(one.pulls == three.pulls);
  EXPECT_TRUE(one.modes.eigenvalue == three.modes.eigenvalue);
  EXPECT_TRUE(one.modes.shapes == three.modes.shapes);
  EXPECT_TRUE(one.jacobian == three.jacobian);
  EXPECT_TRUE(one.at_channels == three.at_channels);
}

}  // namespace
