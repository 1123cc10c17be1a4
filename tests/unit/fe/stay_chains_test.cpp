#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "assembly_models.hpp"
#include "core/error.hpp"
#include "fe/cable.hpp"

namespace twindeck::fe {
namespace {

/// A stay of 80 m, 20 kg/m, between fixed ends `rise` metres apart in height, with a little mass hanging on a spring so that
/// there is a model without it.
struct OneStay {
  Model model;
  PrestressState state;
  double length = 80.0, mass = 20.0, stiffness_N = 4e8, pull = 3e5;

  explicit OneStay(double rise) {
    model.source = "one_stay";
    model.gravity_m_s2 = 9.81;
    model.materials.push_back({"rope", 165e9, 60e9, 0.3, 8000.0});
    Section section;
    section.name = "rope";
    section.area_m2 = mass / 8000.0;
    model.sections.push_back(section);
    stiffness_N = 165e9 * section.area_m2;
    const double horizontal = std::sqrt(length * length - rise * rise);
    test::add_node(model, 0, 0, 0);
    test::add_node(model, horizontal, 0, rise);
    test::add_element(model, ElementType::stay, "stay", 0, 0, {0, 1}).name = "NE8";
    test::fix(model, 0);
    test::fix(model, 1);
    state.stay_pull_N = Eigen::VectorXd::Constant(1, pull);
    state.axial_force_N = Eigen::VectorXd::Zero(1);
  }
};

/// Frequencies in the vertical plane (y fixed by choice of modes) and out of it, ascending.
void frequencies(const StayChains& chains, std::vector<double>& in_plane, std::vector<double>& out_of_plane) {
  const ParametricSystem system = assemble(chains.model, chains.state);
  const Eigen::VectorXd theta(0);
  const Eigen::MatrixXd k = test::full(system.stiffness(theta));
  const Eigen::MatrixXd m = test::full(system.mass(theta));
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eig(k, m);
  for (Eigen::Index j = 0; j < eig.eigenvalues().size(); ++j) {
    double across = 0.0;
    for (std::size_t i = 0; i < system.dofs.size(); ++i) {
      if (system.dofs[i].direction == 1) across += std::pow(eig.eigenvectors()(static_cast<Eigen::Index>(i), j), 2);
    }
    const double f = std::sqrt(eig.eigenvalues()[j]) / (2.0 * std::numbers::pi);
    (across > 0.5 * eig.eigenvectors().col(j).squaredNorm() ? out_of_plane : in_plane).push_back(f);
  }
}

/// First root of Irvine's tan(w/2) = w/2 - (4/lambda²)(w/2)³ below the second antisymmetric mode.
double irvine(double lambda_squared) {
  const auto f = [&](double w) {
    return std::sin(w / 2) - (w / 2 - 4 / lambda_squared * std::pow(w / 2, 3)) * std::cos(w / 2);
  };
  double low = std::numbers::pi, high = 2 * std::numbers::pi;
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (f(low) * f(middle) <= 0 ? high : low) = middle;
  }
  return low;
}

// Oracles: out of plane a string of lumped masses, omega_n = 2 N/L sqrt(T/m) sin(n pi / (2 N)); in plane, for a level stay,
// Irvine's first symmetric frequency at its lambda² (1 % for what 24 pieces and the flat parabola leave), antisymmetric ones as
// the string's.
TEST(StayChains, LevelStayHasIrvinesFrequencies) {
  const OneStay stay(0.0);
  const int pieces = 24;
  std::vector<double> in, out;
  frequencies(with_stay_chains(stay.model, stay.state, pieces, {"NE8"}), in, out);
  const double c = std::sqrt(stay.pull / stay.mass) / (2 * stay.length);
  for (int n = 1; n <= 5; ++n) {
    const double lumped = 2 * pieces * std::sin(n * std::numbers::pi / (2 * pieces)) / std::numbers::pi * c;
    EXPECT_NEAR(out[static_cast<std::size_t>(n - 1)], lumped, 2e-3 * lumped);
  }
  const double slope = stay.mass * 9.81 * stay.length / stay.pull;
  const double lambda_squared = slope * slope * stay.stiffness_N / (stay.pull * (1 + slope * slope / 8));
  ASSERT_GT(lambda_squared, 1.0);
  EXPECT_NEAR(in[0], irvine(lambda_squared) / std::numbers::pi * c, 0.01 * in[0]);
  EXPECT_NEAR(in[1], 2 * c, 0.01 * in[1]);
}

// Oracle: Dischinger's modulus, a closed form of its own: an inclined chain pulled at its end gives with E_eq A / L (2 % for
// the chord's change of direction).
TEST(StayChains, GivesStaticallyAsDischingerSays) {
  OneStay stay(40.0);
  stay.model.supports.pop_back();
  const Eigen::Vector3d along = (stay.model.nodes[1].x_m - stay.model.nodes[0].x_m).normalized();
  Spring hold;
  hold.name = hold.group = "hold";
  hold.node = 1;
  for (const Eigen::Vector3d& d :
       {Eigen::Vector3d::UnitX().eval(), Eigen::Vector3d::UnitY().eval(), Eigen::Vector3d::UnitZ().eval()}) {
    hold.direction = d;
    hold.stiffness = 1e3;
    stay.model.springs.push_back(hold);
  }
  const StayChains chains = with_stay_chains(stay.model, stay.state, 24, {"NE8"});
  const ParametricSystem system = assemble(chains.model, chains.state);
  const Eigen::VectorXd theta(0);
  const Eigen::MatrixXd k = test::full(system.stiffness(theta));
  Eigen::VectorXd load = Eigen::VectorXd::Zero(system.expansion.rows());
  load.segment<3>(6) = along;
  // What is asked is the stiffness along the chord with the end held from moving across it: the inverse of the flexibility's
  // block.
  const Eigen::MatrixXd end = Eigen::MatrixXd(system.expansion).middleRows(6, 3);
  const Eigen::Matrix3d held = (end * k.ldlt().solve(end.transpose())).inverse();
  const double found = along.dot(held * along) - 1e3;
  const Dischinger sag{8000.0 * 9.81, std::sqrt(80.0 * 80.0 - 40.0 * 40.0), stay.pull / (20.0 / 8000.0)};
  const double expected = sag.modulus(165e9) * (20.0 / 8000.0) / stay.length;
  EXPECT_LT(expected, 0.9 * stay.stiffness_N / stay.length);
  EXPECT_NEAR(found, expected, 0.02 * expected);
}

// Oracle: the contract: old nodes and elements keep their places, mass is kept, what is not named stays, what is no stay is
// refused.
TEST(StayChains, KeepsWhatWasThere) {
  const OneStay stay(40.0);
  const StayChains chains = with_stay_chains(stay.model, stay.state, 8, {"NE8"});
  ASSERT_EQ(chains.model.nodes.size(), 2U + 7U);
  ASSERT_EQ(chains.model.elements.size(), 8U);
  EXPECT_EQ(chains.nodes.at("NE8").front(), 0);
  EXPECT_EQ(chains.nodes.at("NE8").back(), 1);
  double chain_length = 0.0;
  for (const Element& e : chains.model.elements) {
    chain_length += (chains.model.nodes[static_cast<std::size_t>(e.nodes[1])].x_m -
                     chains.model.nodes[static_cast<std::size_t>(e.nodes[0])].x_m)
                        .norm();
  }
  const double slope = stay.mass * 9.81 * std::sqrt(80.0 * 80.0 - 40.0 * 40.0) / stay.pull;
  EXPECT_NEAR(chain_length, 80.0 * (1 + slope * slope / 24), 0.01);  // length of a flat parabola
  EXPECT_EQ(with_stay_chains(stay.model, stay.state, 8, {}).model.elements.size(), 1U);
  EXPECT_THROW((void)with_stay_chains(stay.model, stay.state, 8, {"NE9"}), InputError);
}

}  // namespace
}  // namespace twindeck::fe
