// Search on the corrected reduced system. Oracles: the search on the full system from the same starts; for the projection,
// matrices multiplied out densely.
#include "updating/surrogate.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"
#include "updating/updating.hpp"

namespace twindeck::updating {
namespace {

constexpr int kMasses = 60;

/// A chain with three groups of springs and a factor on every third mass; `frozen` stands for a prestress.
fe::ParametricSystem chain(double frozen) {
  SmallSystem small(kMasses);
  const int a = small.parameter("a", 1.0, 0.85, 1.15), b = small.parameter("b", 1.0, 0.85, 1.15),
            c = small.parameter("c", 1.0, 0.85, 1.15), m = small.parameter("m", 1.0, 0.85, 1.15);
  Eigen::MatrixXd parts[3] = {Eigen::MatrixXd::Zero(kMasses, kMasses), Eigen::MatrixXd::Zero(kMasses, kMasses),
                              Eigen::MatrixXd::Zero(kMasses, kMasses)};
  for (int i = 0; i <= kMasses; ++i)
    parts[3 * i / (kMasses + 1)] += 4e3 * (1.0 + 0.03 * i) * spring(kMasses, i < kMasses ? i : -1, i - 1);
  // Nothing in it is symmetric: a mirror image would be a second optimum.
  Eigen::VectorXd own = Eigen::VectorXd::LinSpaced(kMasses, 1.0, 2.0), variable = Eigen::VectorXd::Zero(kMasses);
  for (int i = 0; i < kMasses; i += 3) variable[i] = 0.5 + 0.01 * i;
  Eigen::MatrixXd string = Eigen::MatrixXd::Zero(kMasses, kMasses);
  for (int i = 0; i < kMasses; ++i) string += frozen * spring(kMasses, i, -1);
  return small.stiffness(parts[0], a)
      .stiffness(parts[1], b)
      .stiffness(parts[2], c)
      .stiffness(string)
      .mass(own.asDiagonal().toDenseMatrix())
      .mass(variable.asDiagonal().toDenseMatrix(), m)
      .system();
}

fe::ParametricSystem in_balance(const Eigen::VectorXd& theta) { return chain(0.05 * theta[3]); }

UpdatingResult run(Eigen::Index surrogate_from_size, const Eigen::VectorXd& truth) {
  const fe::ParametricSystem start = in_balance(chain(0.0).initial());
  const Eigen::VectorXd measured = dense_frequencies(in_balance(truth), truth);
  std::vector<FrequencyTarget> targets;
  for (int i = 0; i < 10; ++i) targets.push_back({std::to_string(i + 1), i, measured(i)});
  UpdatingOptions options;
  options.starts = 4;
  options.n_modes = 13;
  options.surrogate_from_size = surrogate_from_size;
  return update(start, in_balance, {0, 1, 2, 3}, targets, options, {});
}

TEST(Surrogate, EndsWhereTheFullSearchEnds) {
  // Inside the bounds, and with some parameters driven onto them.
  for (const Eigen::Vector4d& truth : {Eigen::Vector4d(1.08, 0.95, 1.10, 0.92), Eigen::Vector4d(1.3, 0.95, 0.8, 1.02)}) {
    const UpdatingResult full = run(1000, truth), reduced = run(0, truth);
    ASSERT_TRUE(full.status.converged) << full.status.message;
    ASSERT_TRUE(reduced.status.converged) << reduced.status.message;
    EXPECT_LT((full.theta - reduced.theta).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_LT((full.frequency_after_Hz - reduced.frequency_after_Hz).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_EQ(full.on_bound, reduced.on_bound);
    EXPECT_EQ(reduced.optima.size(), 1U);
    int solves_full = 0, solves_reduced = 0;
    for (std::size_t k = 0; k < full.starts.size(); ++k) {
      EXPECT_TRUE(reduced.starts[k].converged) << reduced.starts[k].message;
      EXPECT_LE(reduced.starts[k].relative_projected_gradient, UpdatingOptions{}.optimality_tolerance);
      solves_full += full.starts[k].solves;
      solves_reduced += reduced.starts[k].solves;
    }
    EXPECT_LT(2 * solves_reduced, solves_full);
  }
}

TEST(Surrogate, FrequenciesAreThoseOfTheFullSystem) {
  const UpdatingResult result = run(0, Eigen::Vector4d(1.08, 0.95, 1.10, 0.92));
  const Eigen::VectorXd dense = dense_frequencies(in_balance(result.theta), result.theta);
  for (Eigen::Index i = 0; i < 10; ++i) EXPECT_NEAR(result.frequency_after_Hz(i) / dense(i), 1.0, 1e-9);
}

TEST(ReducedSystem, IsTheProjectionOfTheWhole) {
  const auto system = std::make_shared<const fe::ParametricSystem>(chain(0.3));
  Eigen::MatrixXd vectors(kMasses, 5);
  for (int i = 0; i < kMasses; ++i)
    for (int j = 0; j < 5; ++j) vectors(i, j) = std::sin(0.3 * (i + 1) * (j + 1)) + 0.1 * j;
  const Eigen::VectorXd theta = Eigen::Vector4d(1.1, 0.8, 0.9, 1.2);
  const auto basis = std::make_shared<const Eigen::MatrixXd>(orthonormal_basis(vectors, system->mass(theta), 1e-12));
  ASSERT_EQ(basis->cols(), 5);
  const Eigen::MatrixXd k = Eigen::MatrixXd(system->stiffness(theta)).selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd m = Eigen::MatrixXd(system->mass(theta)).selfadjointView<Eigen::Lower>();
  EXPECT_LT((basis->transpose() * m * *basis - Eigen::MatrixXd::Identity(5, 5)).norm(), 1e-12);
  const ReducedSystem reduced(system, basis, nullptr);
  EXPECT_LT((reduced.stiffness(theta) - basis->transpose() * k * *basis).norm(), 1e-9);
  EXPECT_LT((reduced.mass(theta) - basis->transpose() * m * *basis).norm(), 1e-12);
  // Under another prestress only the frozen term differs; taken over terms must not hide that.
  const auto other = std::make_shared<const fe::ParametricSystem>(chain(0.9));
  const ReducedSystem second(other, basis, &reduced);
  const Eigen::MatrixXd k2 = Eigen::MatrixXd(other->stiffness(theta)).selfadjointView<Eigen::Lower>();
  EXPECT_LT((second.stiffness(theta) - basis->transpose() * k2 * *basis).norm(), 1e-9);
}

}  // namespace
}  // namespace twindeck::updating
