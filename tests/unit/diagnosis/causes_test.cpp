// Primitives of the catalogue as they change the structure. Oracle: the same change written into dense matrices by hand; and
// derivatives against central differences.
#include <gtest/gtest.h>

#include "chain.hpp"
#include "test_places.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::Cause;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd hertz(const MatrixXd& k, const MatrixXd& m) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(k, m);
  return eigen.eigenvalues().cwiseSqrt() / (2.0 * std::numbers::pi);
}

class Causes : public ::testing::Test {
 protected:
  Causes()
      : chain({.masses = 8, .modes = 6}),
        features(chain.measure(chain.as_modelled())),
        e(examine(chain, features, catalogue())) {}

  [[nodiscard]] VectorXd frequencies(const std::string& id, const VectorXd& a) {
    const auto base = e.map->base(VectorXd::Zero(static_cast<Index>(e.map->nuisances().size())));
    const auto p = e.map->predict(base, {{&e.entry(id), a}}, false);
    EXPECT_TRUE(p.valid);
    return Eigen::Map<const VectorXd>(p.frequency_Hz.data(), static_cast<Index>(p.frequency_Hz.size()));
  }
  void expect(const std::string& id, const VectorXd& a, const MatrixXd& stiffness, const MatrixXd& mass) {
    const VectorXd expected = hertz(stiffness, mass), found = frequencies(id, a);
    for (Index i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i] / expected[i], 1.0, 1e-9) << id << " mode " << i + 1;
  }

  Chain chain;
  diagnosis::FeatureSet features;
  Examined e;
  MatrixXd k = chain.stiffness(chain.as_modelled()), m = Chain::kMass * MatrixXd::Identity(8, 8);
};

TEST_F(Causes, FactorOnAGroup) {
  ChainTruth truth = chain.as_modelled();
  truth.spring[5] = 0.6;
  expect("stiffness@group:g5", VectorXd::Constant(1, std::log(0.6)), chain.stiffness(truth), m);
}

TEST_F(Causes, MassOnANode) {
  m(2, 2) += 250.0;
  VectorXd a = VectorXd::Constant(1, e.entry("mass@node:3").log[0] ? std::log(250.0) : 250.0);
  expect("mass@node:3", a, k, m);
}

TEST_F(Causes, TieBetweenTwoNodes) {
  ChainTruth truth = chain.as_modelled();
  truth.tie_from = 2;
  truth.tie_to = 5;
  truth.tie_N_m = 7e5;
  expect("tie@nodes:3,6", VectorXd::Constant(1, std::log(7e5)), chain.stiffness(truth), m);
}

TEST(SofteningCause, ScalesStiffnessByTheHyperbolaOfTheAmplitude) {
  // Half of the stiffness is left at 4 mm: 1/(1 + A/4 mm) of spring 5 at 1, 4 and 12 mm, and all of it where no amplitude is
  // known.
  const Chain chain({.masses = 8, .modes = 3});
  auto features = chain.measure(chain.as_modelled());
  const std::vector<double> amplitudes = {0.001, 0.004, 0.012};
  const std::size_t rows = features.rows.size();
  for (const double amplitude : amplitudes) {
    diagnosis::Condition condition;
    condition.name = "shaken" + std::to_string(features.conditions.size());
    condition.amplitude_m = amplitude;
    features.conditions.push_back(condition);
    for (std::size_t r = 0; r < rows; ++r) {
      features.rows.push_back(features.rows[r]);
      features.rows.back().condition = static_cast<int>(features.conditions.size()) - 1;
    }
  }
  const Examined e = examine(
      chain, features, diagnosis::read_catalogue(std::string(TWINDECK_SOURCE_DIR) + "/workflows/meloland_overpass/hypotheses"));
  const auto base = e.map->base(VectorXd::Zero(static_cast<Index>(e.map->nuisances().size())));
  const auto p = e.map->predict(base, {{&e.entry("soften@group:g5"), VectorXd::Constant(1, std::log(0.004))}}, false);
  ASSERT_TRUE(p.valid);
  const MatrixXd m = Chain::kMass * MatrixXd::Identity(8, 8);
  for (std::size_t i = 0; i < p.frequency_Hz.size(); ++i) {
    const diagnosis::MeasuredMode& mode = e.map->measured_modes()[i];
    ChainTruth truth = chain.as_modelled();
    if (mode.condition > 0) truth.spring[5] = 1.0 / (1.0 + amplitudes[static_cast<std::size_t>(mode.condition) - 1] / 0.004);
    const double expected = hertz(chain.stiffness(truth), m)[std::atoi(mode.label.c_str()) - 1];
    EXPECT_NEAR(p.frequency_Hz[i] / expected, 1.0, 1e-9) << mode.label << " of condition " << mode.condition;
  }
}

TEST_F(Causes, EveryStructuralCauseAtNothingIsTheModel) {
  // Factors of one, masses and ties of almost nothing; entries whose smallest size still matters are left to the law on the
  // bridge.
  const auto zero = e.map->base(VectorXd::Zero(static_cast<Index>(e.map->nuisances().size())));
  const VectorXd plain = e.map->predict(zero, {}, false).g;
  int neutral = 0;
  for (const auto& candidate : e.entries.candidates) {
    const auto& h = *candidate->hypothesis;
    if (h.unknowns.empty() || h.unknowns.size() > 1) continue;
    VectorXd a(1);
    if (h.unknowns[0].name == "factor" && candidate->log[0])
      a[0] = 0.0;
    else if (h.unknowns[0].name == "mass_kg" || h.unknowns[0].name == "stiffness_N_m")
      a[0] = candidate->log[0] ? -40.0 : 0.0;
    else if (!candidate->log[0])
      a[0] = 0.0;
    else
      continue;
    const auto p = e.map->predict(zero, {{candidate.get(), a}}, false);
    ASSERT_TRUE(p.valid) << candidate->id();
    EXPECT_LT((p.g - plain).cwiseAbs().maxCoeff(), 1e-10) << candidate->id();
    ++neutral;
  }
  EXPECT_GT(neutral, 30);
}

TEST_F(Causes, SlopesOfTheJacobianAreThoseOfDifferences) {
  // At a point away from the start, with a cause in the model: every nuisance, every row. Central differences of step 1e-4
  // deviations leave about 1e-8 of rounding; the rows' own scale is free, so its direction is taken out of both.
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  const auto n = static_cast<Index>(e.map->nuisances().size());
  VectorXd x(n);
  for (double& v : x) v = 0.4 * normal(random);
  const std::vector<Cause> causes = {{&e.entry("tie@nodes:3,6"), VectorXd::Constant(1, std::log(4e5))},
                                     {&e.entry("gain@channel:c4"), VectorXd::Constant(1, std::log(1.3))}};
  const auto at = e.map->predict(e.map->base(x), causes, true);
  ASSERT_TRUE(at.valid);
  const auto without_scales = [&](VectorXd v) {
    for (Index s = 0; s < at.scales.cols(); ++s) {
      const VectorXd d = at.scales.col(s);
      v -= d * (d.dot(v) / d.squaredNorm());
    }
    return v;
  };
  for (Index j = 0; j < n; ++j) {
    const double h = 1e-4;
    VectorXd up = x, down = x;
    up[j] += h;
    down[j] -= h;
    const VectorXd difference =
        (e.map->predict(e.map->base(up), causes, false).g - e.map->predict(e.map->base(down), causes, false).g) / (2.0 * h);
    EXPECT_LT((without_scales(difference) - without_scales(at.jacobian.col(j))).cwiseAbs().maxCoeff(), 2e-6)
        << e.map->nuisances()[static_cast<std::size_t>(j)].name;
  }
}

TEST(DampedCauses, SlopesWithADamperAreThoseOfDifferences) {
  // The same for a state with a dashpot, whose modes are complex.
  const Chain chain({.masses = 9, .modes = 4, .shapes = false, .dampers = true});
  auto features = chain.measure(chain.as_modelled());
  diagnosis::Condition on;
  on.name = "on";
  on.dampers_on = true;
  features.conditions.push_back(on);
  for (int m = 1; m <= 3; ++m) {
    features.rows.push_back({diagnosis::RowType::frequency, std::to_string(m), -1, "", 1,
                             features.rows[static_cast<std::size_t>(m - 1)].value, 0.01, false});
    features.rows.push_back({diagnosis::RowType::damping, std::to_string(m), -1, "", 1, 3.0, 0.3, false});
    for (int c = 0; c < 9; ++c) {
      features.rows.push_back({diagnosis::RowType::shape, std::to_string(m), c, "", 1,
                               std::sin(m * std::numbers::pi * (c + 1) / 10.0), 0.02, false});
      features.rows.push_back({diagnosis::RowType::shape_imag, std::to_string(m), c, "", 1, 0.0, 0.02, false});
    }
  }
  const Examined e = examine(chain, features, catalogue({"stiffness"}));
  const auto n = static_cast<Index>(e.map->nuisances().size());
  VectorXd x = VectorXd::Constant(n, 0.2);
  const auto at = e.map->predict(e.map->base(x), {}, true);
  ASSERT_TRUE(at.valid);
  const MatrixXd basis =
      Eigen::HouseholderQR<MatrixXd>(at.scales).householderQ() * MatrixXd::Identity(at.scales.rows(), at.scales.cols());
  const auto without_scales = [&](const VectorXd& v) { return VectorXd(v - basis * (basis.transpose() * v)); };
  for (Index j = 0; j < n; ++j) {
    VectorXd up = x, down = x;
    up[j] += 1e-4;
    down[j] -= 1e-4;
    const VectorXd difference =
        (e.map->predict(e.map->base(up), {}, false).g - e.map->predict(e.map->base(down), {}, false).g) / 2e-4;
    EXPECT_LT((without_scales(difference) - without_scales(at.jacobian.col(j))).cwiseAbs().maxCoeff(), 1e-5)
        << e.map->nuisances()[static_cast<std::size_t>(j)].name;
  }
}

}  // namespace
}  // namespace twindeck::tests
