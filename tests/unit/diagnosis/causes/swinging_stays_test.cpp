// Oracles: the eigenproblem of structure and cable together, without component mode synthesis; measurements drawn from a
// structure of which the stay that swings is known.
#include "diagnosis/causes/swinging_stays.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

namespace twindeck::tests {
namespace {

using diagnosis::BarModes;
using diagnosis::MeasuredShape;
using diagnosis::SwingingCable;
using diagnosis::VisibleModes;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Cable of four masses between its ends, motion in z alone, the bar's stiffness and mass taken out: dofs as in fe::Cable.
struct Chain {
  MatrixXd stiffness = MatrixXd::Zero(18, 18), mass = MatrixXd::Zero(18, 18);
  Chain(double k, double m) {
    MatrixXd inner = MatrixXd::Zero(12, 12), coupling = MatrixXd::Zero(12, 6);
    for (int i = 0; i < 4; ++i)
      for (int d = 0; d < 3; ++d) {
        inner(3 * i + d, 3 * i + d) = 2.0 * k;
        if (i < 3) inner(3 * i + d, 3 * i + 3 + d) = inner(3 * i + 3 + d, 3 * i + d) = -k;
        mass(6 + 3 * i + d, 6 + 3 * i + d) = m;
      }
    for (int d = 0; d < 3; ++d) coupling(d, d) = coupling(9 + d, 3 + d) = -k;
    stiffness.bottomRightCorner(12, 12) = inner;
    stiffness.bottomLeftCorner(12, 6) = coupling;
    stiffness.topRightCorner(6, 12) = coupling.transpose();
    stiffness.topLeftCorner(6, 6) = coupling.transpose() * inner.ldlt().solve(coupling);
    mass.topLeftCorner(6, 6).diagonal().setConstant(-0.2 * m);
  }
};

/// A deck of eight masses in z on springs; two cables from the ground to the masses 2 and 5.
struct Deck {
  MatrixXd k = MatrixXd::Zero(8, 8);
  VectorXd omega2;
  MatrixXd shapes;
  std::vector<Chain> chains;
  std::vector<SwingingCable> cables;
  std::vector<double> own_Hz;
  std::vector<int> held = {2, 5};

  Deck() {
    for (int i = 0; i < 8; ++i) {
      k(i, i) = 2.0 * 4e5 + 2e4 * (i + 1);
      if (i < 7) k(i, i + 1) = k(i + 1, i) = -4e5;
    }
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eig(k / 2000.0);
    omega2 = eig.eigenvalues();
    shapes = eig.eigenvectors() / std::sqrt(2000.0);
    for (int s = 0; s < 2; ++s) {
      // The first frequency of four masses, 2 sqrt(k/m) sin(pi/10), a little above a mode of the deck.
      const double target = std::sqrt(omega2[1 + 2 * s]) * 1.03, m = 40.0;
      chains.emplace_back(m * std::pow(target / (2.0 * std::sin(0.1 * std::numbers::pi)), 2), m);
      MatrixXd ends = MatrixXd::Zero(6, 8);
      ends.row(5) = shapes.row(held[static_cast<std::size_t>(s)]);
      cables.push_back(diagnosis::swinging_cable(chains.back().stiffness, chains.back().mass, ends, 100.0));
      own_Hz.push_back(target / (2.0 * std::numbers::pi));
    }
  }
  [[nodiscard]] BarModes bars() const { return {omega2, shapes}; }
  /// Modes in which the deck takes part, as measured.
  [[nodiscard]] static std::vector<MeasuredShape> measured(const VisibleModes& modes, Index count) {
    std::vector<MeasuredShape> out;
    for (Index j = 0; std::ssize(out) < count; ++j) {
      if (modes.shapes.col(j).cwiseAbs().maxCoeff() < 1e-4) continue;
      MeasuredShape m{std::to_string(j), 0, modes.frequency_Hz[j], {}, modes.shapes.col(j).cast<std::complex<double>>()};
      for (int c = 0; c < 8; ++c) m.channels.push_back(c);
      out.push_back(std::move(m));
    }
    return out;
  }
};

TEST(SwingingStays, SynthesisIsTheWholeProblem) {
  const Deck deck;
  MatrixXd k = MatrixXd::Zero(20, 20),
           m = MatrixXd::Zero(20, 20);  // the deck, then z x y of the inner nodes of the first cable
  k.topLeftCorner(8, 8) = deck.k;
  m.topLeftCorner(8, 8).diagonal().setConstant(2000.0);
  std::vector<Index> place(18, -1);
  place[5] = deck.held[0];
  for (std::size_t i = 6; i < 18; ++i) place[i] = static_cast<Index>(i) + 2;
  for (std::size_t i = 0; i < 18; ++i)
    for (std::size_t j = 0; j < 18; ++j) {
      if (place[i] < 0 || place[j] < 0) continue;
      k(place[i], place[j]) += deck.chains[0].stiffness(static_cast<Index>(i), static_cast<Index>(j));
      m(place[i], place[j]) += deck.chains[0].mass(static_cast<Index>(i), static_cast<Index>(j));
    }
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> whole(k, m);
  const VisibleModes found = modes_with(deck.bars(), {&deck.cables[0]});
  ASSERT_EQ(found.frequency_Hz.size(), 20);
  for (Index j = 0; j < 20; ++j)
    EXPECT_NEAR(found.frequency_Hz[j], std::sqrt(whole.eigenvalues()[j]) / (2.0 * std::numbers::pi),
                1e-8 * found.frequency_Hz[j]);
}

TEST(SwingingStays, TheOneThatSwingsIsFound) {
  const Deck deck;
  const auto truth = modes_with(deck.bars(), {&deck.cables[1]});
  const auto measured = Deck::measured(truth, 7);
  const auto choice = choose_swinging(deck.bars(), deck.cables, deck.own_Hz, {}, measured, {0.6, 0.02}, 0.0);
  EXPECT_EQ(choice.swinging, (std::vector<int>{1}));
  EXPECT_EQ(choice.after.count, 7);
  EXPECT_LT(choice.before.count, 7);
  EXPECT_GT(choice.log_odds, 0.0);
}

TEST(SwingingStays, OneThatIsKnownToSwingCostsNoChoice) {
  const Deck deck;
  const auto measured = Deck::measured(modes_with(deck.bars(), {&deck.cables[1]}), 7);
  const auto choice = choose_swinging(deck.bars(), deck.cables, deck.own_Hz, {1}, measured, {0.6, 0.02}, 0.0);
  const auto chosen = choose_swinging(deck.bars(), deck.cables, deck.own_Hz, {}, measured, {0.6, 0.02}, 0.0);
  EXPECT_EQ(choice.swinging, (std::vector<int>{1}));
  EXPECT_TRUE(choose_swinging(deck.bars(), deck.cables, deck.own_Hz, {}, measured, {0.6, 0.02}, 50.0).swinging.empty());
  EXPECT_NEAR(choice.log_odds, chosen.log_odds + std::log(2.0), 1e-12);  // of two stays
}

TEST(SwingingStays, WhereNoneSwingsNoneIsNamed) {
  const Deck deck;
  const auto measured = Deck::measured(modes_with(deck.bars(), {}), 7);
  const auto choice = choose_swinging(deck.bars(), deck.cables, deck.own_Hz, {}, measured, {0.6, 0.02}, 0.0);
  EXPECT_EQ(choice.before.count, 7);
  EXPECT_TRUE(choice.swinging.empty());
  EXPECT_EQ(choice.log_odds, 0.0);
}

}  // namespace
}  // namespace twindeck::tests
