// The reduced basis against all degrees of freedom. Oracles: a chain's own dense matrices for the full frequencies, the bounds
// of Rayleigh and Ritz (reduced frequencies never lie below the full ones), and 0.1 % as what a diagnosis may lose.
#include "diagnosis/full_check.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"
#include "prediction/hand_made.hpp"

namespace twindeck::tests {
namespace {

using Eigen::VectorXd;

/// Check of a chain of 120 masses, of which a prediction uses some vectors, with one cause at given magnitudes.
diagnosis::FullCheck check_with(const Chain& chain, const std::string& id, const VectorXd& physical) {
  const auto features = chain.measure(chain.as_modelled());
  const Examined e = examine(chain, features, catalogue({"mass", "tie", "osc", "stiffness"}));
  const auto& candidate = e.entry(id);
  diagnosis::Cause cause{&candidate, physical};
  for (Eigen::Index i = 0; i < physical.size(); ++i)
    if (candidate.log[static_cast<std::size_t>(i)]) cause.a[i] = std::log(physical[i]);
  diagnosis::Fit fit;
  fit.causes = {cause};
  fit.base = e.map->base(VectorXd::Zero(static_cast<Eigen::Index>(e.map->nuisances().size())));
  return diagnosis::check_against_full(chain.structure(), chain.places(), *e.map, fit, 6);
}

TEST(FullCheck, ReducedFrequenciesOfAnExtendedChainAreTheFullOnes) {
  ChainOptions options;
  options.masses = 120;
  options.channels = {9, 29, 49, 69, 89, 109};
  options.modes = 6;
  options.parameters = false;
  const Chain chain(options);
  ASSERT_LT(chain.reduced().common, 60);
  const std::string place = chain.places().sets.at("nodes").front().id;
  const int node = std::atoi(place.substr(place.find(':') + 1).c_str()) - 1;

  const diagnosis::FullCheck heavier = check_with(chain, "mass@" + place, VectorXd::Constant(1, 4000.0));
  ChainTruth truth = chain.as_modelled();
  truth.mass[node] += 4000.0;
  const VectorXd root = truth.mass.cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(root.asDiagonal() * chain.stiffness(truth) * root.asDiagonal());
  for (int m = 0; m < 6; ++m) {
    EXPECT_NEAR(heavier.full_Hz[m], std::sqrt(eigen.eigenvalues()[m]) / (2.0 * std::numbers::pi), 1e-9 * heavier.full_Hz[m]);
    EXPECT_GE(heavier.reduced_Hz[m], heavier.full_Hz[m] * (1.0 - 1e-10));
  }
  EXPECT_LT(heavier.largest_pct, 0.1);

  VectorXd hung(2);
  hung << 3000.0, 1.1 * heavier.full_Hz[1];
  const diagnosis::FullCheck swinging = check_with(chain, "osc@" + place, hung);
  EXPECT_LT(swinging.largest_pct, 0.1);
  // A body on a spring is one more mode: the sixth lies lower than without it.
  EXPECT_LT(swinging.full_Hz[5], 0.97 * heavier.full_Hz[5]);
}

using Eigen::MatrixXd;
using Eigen::Vector3d;

/// Two nodes that move in x, y and z, on springs of their own, coupled in each direction: the stiffness in y is twice that in
/// x, in z three times. Kilograms and N/m.
class TwoNodes {
 public:
  explicit TwoNodes(const std::function<void(diagnosis::Places&)>& more = {})
      : stiffness(stiffness_of()), model(dofs_of(), stiffness_of(), mass, {}, more) {
    model.add_frequencies(dense_hertz(stiffness, mass));
  }
  [[nodiscard]] diagnosis::FullCheck check(const std::vector<diagnosis::Cause>& causes, int modes = 6,
                                           const VectorXd& x = {}) const {
    const diagnosis::FeatureMap map = model.map();
    diagnosis::Fit fit;
    fit.causes = causes;
    fit.base = map.base(x.size() > 0 ? x : VectorXd::Zero(std::ssize(map.nuisances())));
    return diagnosis::check_against_full(model.structure(), model.places(), map, fit, modes);
  }
  /// The basis holds all six degrees of freedom: both sides are the dense matrices.
  void expect(const diagnosis::FullCheck& check, const MatrixXd& k, const MatrixXd& m) const {
    const VectorXd expected = dense_hertz(k, m);
    EXPECT_EQ(check.message, "");
    for (const VectorXd& found : {check.full_Hz, check.reduced_Hz})
      for (Eigen::Index i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i] / expected[i], 1.0, 1e-7) << i;
    EXPECT_LT(check.largest_pct, 1e-4);
  }
  static VectorXd axis(int node, int direction) { return VectorXd::Unit(6, 3 * node + direction); }

  MatrixXd stiffness, mass = 1000.0 * MatrixXd::Identity(6, 6);
  Predicted model;

 private:
  static std::vector<fe::DofLabel> dofs_of() {
    std::vector<fe::DofLabel> dofs;
    for (int node = 0; node < 2; ++node)
      for (int d = 0; d < 3; ++d)
        dofs.push_back({std::to_string(node + 1), d, Vector3d(7.0 + 3.0 * node, 2.0 + 4.0 * node, 1.0)});
    return dofs;
  }
  static MatrixXd stiffness_of() {
    MatrixXd k = MatrixXd::Zero(6, 6);
    for (int d = 0; d < 3; ++d) {
      const VectorXd between = axis(0, d) - axis(1, d);
      k += 1e6 * (d + 1) *
           (axis(0, d) * axis(0, d).transpose() + 1.5 * axis(1, d) * axis(1, d).transpose() +
            0.4 * between * between.transpose());
    }
    return k;
  }
};

MatrixXd squared(const VectorXd& b) { return b * b.transpose(); }

TEST(FullCheck, OfNoCauseIsTheStructure) {
  const TwoNodes nodes;
  const auto check = nodes.check({}, 4);
  ASSERT_EQ(check.full_Hz.size(), 4);
  nodes.expect(check, nodes.stiffness, nodes.mass);
  EXPECT_EQ(nodes.check({}, 40).full_Hz.size(), 6);  // no more modes than there are
}

// A prop holds a node vertically, a spring without a direction in all three.
TEST(FullCheck, APropHoldsInItsDirection) {
  const TwoNodes nodes;
  HandMade prop("element.spring", {{"stiffness", 8e5}}, {nodes.model.place("nodes", "node:2")});
  MatrixXd k = nodes.stiffness;
  for (int d = 0; d < 3; ++d) k += 8e5 * squared(nodes.axis(1, d));
  nodes.expect(nodes.check({prop.cause()}), k, nodes.mass);
  prop.with_text("direction", "vertical");
  nodes.expect(nodes.check({prop.cause()}), nodes.stiffness + 8e5 * squared(nodes.axis(1, 2)), nodes.mass);
}

TEST(FullCheck, ATiePullsAlongItsLine) {
  const TwoNodes nodes;
  HandMade tie("element.spring", {{"stiffness", 8e5}},
               {nodes.model.place("nodes", "node:1"), nodes.model.place("nodes", "node:2")});
  const VectorXd along = 0.6 * (nodes.axis(0, 0) - nodes.axis(1, 0)) + 0.8 * (nodes.axis(0, 1) - nodes.axis(1, 1));
  nodes.expect(nodes.check({tie.cause()}), nodes.stiffness + 8e5 * squared(along), nodes.mass);
}

TEST(FullCheck, BodiesAndCablesSwing) {
  const TwoNodes nodes;
  const double m = 150.0, hertz = 4.0, w2 = std::pow(2.0 * std::numbers::pi * hertz, 2);
  const std::vector<const diagnosis::ReducedPlace*> place = {nodes.model.place("nodes", "node:1")};
  for (const bool string : {false, true}) {
    MatrixXd k = MatrixXd::Zero(9, 9), mass = k;
    k.topLeftCorner(6, 6) = nodes.stiffness;
    mass.topLeftCorner(6, 6) = nodes.mass;
    for (int d = 0; d < 3; ++d) {
      const int own = 6 + d;
      if (string) {  // u = b (1 - x/L) + q sin(pi x/L): integrals of products over the length
        mass(d, d) += m / 3.0;
        mass(own, own) = m / 2.0;
        mass(d, own) = mass(own, d) = m / std::numbers::pi;
        k(own, own) = w2 * m / 2.0;
      } else {
        mass(own, own) = m;
        k(own, own) = w2 * m;
        k(d, d) += w2 * m;
        k(own, d) = k(d, own) = -w2 * m;
      }
    }
    const HandMade body(string ? "element.string" : "element.oscillator", {{"mass", m}, {"frequency", hertz}}, place);
    const auto check = nodes.check({body.cause()}, 9);
    ASSERT_EQ(check.full_Hz.size(), 9);
    nodes.expect(check, k, mass);
  }
}

// A body that only moves vertically has one degree of freedom, in the check as in the fit.
TEST(FullCheck, ABodySwingsVertically) {
  TwoNodes nodes;
  const double m = 150.0, hertz = 4.0, own = m * std::pow(2.0 * std::numbers::pi * hertz, 2);
  MatrixXd k = MatrixXd::Zero(7, 7), mass = k;
  k.topLeftCorner(6, 6) = nodes.stiffness;
  mass.topLeftCorner(6, 6) = nodes.mass;
  mass(6, 6) = m;
  k += own * squared(VectorXd::Unit(7, 6) - VectorXd::Unit(7, 2));
  HandMade body("element.oscillator", {{"mass", m}, {"frequency", hertz}}, {nodes.model.place("nodes", "node:1")});
  body.with_text("direction", "vertical");
  const auto check = nodes.check({body.cause()}, 9);
  ASSERT_EQ(check.full_Hz.size(), 7);
  nodes.expect(check, k, mass);
  nodes.model.features.rows.clear();
  nodes.model.add_frequencies(dense_hertz(k, mass));
  const auto predicted = nodes.model.predict({body.cause()});
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(predicted.g[i], std::log(dense_hertz(k, mass)[i]), 1e-7);
}

diagnosis::Place on_dof(const std::string& id, int node, int direction, double stiffness, double mass = 0.0) {
  diagnosis::Place place{id, Vector3d::Zero(), {}, {}, {}, {}, {}};
  place.stiffness = diagnosis::Symmetric(MatrixXd(stiffness * squared(TwoNodes::axis(node, direction))).sparseView());
  if (mass > 0.0) place.mass = diagnosis::Symmetric(MatrixXd(mass * squared(TwoNodes::axis(node, direction))).sparseView());
  return place;
}

// A support has springs against displacements and against rotations, places of two sets with one name.
TEST(FullCheck, OfTwoPlacesOfOneNameTheOneOfTheHypothesisChanges) {
  const TwoNodes nodes([](diagnosis::Places& places) {
    places.sets["foundations"] = {on_dof("support:A", 0, 0, 5e5)};
    places.sets["supports"] = {on_dof("support:A", 1, 2, 4e5, 200.0)};
  });
  for (const std::string set : {"foundations", "supports"}) {
    HandMade cause("scale.stiffness", {{"factor", 3.0}}, {nodes.model.place(set, "support:A")});
    cause.hypothesis.set = set;
    const MatrixXd change =
        set == "supports" ? MatrixXd(4e5 * squared(nodes.axis(1, 2))) : MatrixXd(5e5 * squared(nodes.axis(0, 0)));
    nodes.expect(nodes.check({cause.cause()}), nodes.stiffness + 2.0 * change, nodes.mass);
  }
  HandMade heavier("scale.mass", {{"factor", 1.5}}, {nodes.model.place("supports", "support:A")});
  heavier.hypothesis.set = "supports";
  nodes.expect(nodes.check({heavier.cause()}), nodes.stiffness, nodes.mass + 100.0 * squared(nodes.axis(1, 2)));
}

// Half way between two stations the spring holds the mean of their displacements.
TEST(FullCheck, ASupportThatMovesHoldsWhereItStands) {
  const TwoNodes nodes([](diagnosis::Places& places) {
    diagnosis::Place pier = on_dof("support:pier", 0, 2, 6e5);
    pier.directions.resize(6, 3);
    pier.directions.insert(2, 0) = 1.0;
    pier.directions.insert(5, 1) = 1.0;
    pier.directions.insert(4, 2) = 1.0;
    pier.attributes = {{"stations", 3.0}, {"x_0", 0.0}, {"x_1", 2.0}, {"x_2", 6.0}, {"k_0", 6e5}};
    places.sets["support_moves"] = {pier};
  });
  for (const auto& [position, b] : {std::pair<double, VectorXd>{1.5, 0.25 * nodes.axis(0, 2) + 0.75 * nodes.axis(1, 2)},
                                    {5.0, 0.25 * nodes.axis(1, 2) + 0.75 * nodes.axis(1, 1)},
                                    {9.0, nodes.axis(1, 1)}}) {  // no further than the last one
    const HandMade move("support.move", {{"position", position}}, {nodes.model.place("support_moves", "support:pier")});
    const MatrixXd k = nodes.stiffness - 6e5 * squared(nodes.axis(0, 2)) + 6e5 * squared(b);
    nodes.expect(nodes.check({move.cause()}), k, nodes.mass);
    const auto predicted = nodes.model.predict({move.cause()});
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(predicted.g[i], std::log(dense_hertz(k, nodes.mass)[i]), 1e-7) << position;
  }
}

// The springs that leave take their own error along; the foundation of the same name stays, and so does its error.
TEST(FullCheck, ASupportThatMovesLeavesItsFoundationBehind) {
  const TwoNodes nodes([](diagnosis::Places& places) {
    diagnosis::Place pier = on_dof("support:pier", 0, 2, 6e5);
    places.sets["supports"] = {pier};
    places.sets["foundations"] = {on_dof("support:pier", 0, 0, 5e5)};
    pier.directions.resize(6, 3);
    pier.directions.insert(2, 0) = 1.0;
    pier.directions.insert(5, 1) = 1.0;
    pier.directions.insert(4, 2) = 1.0;
    pier.attributes = {{"stations", 3.0}, {"x_0", 0.0}, {"x_1", 2.0}, {"x_2", 6.0}, {"k_0", 6e5}};
    places.sets["support_moves"] = {pier};
  });
  HandMade move("support.move", {{"position", 2.0}}, {nodes.model.place("support_moves", "support:pier")});
  move.hypothesis.set = "support_moves";
  const diagnosis::FeatureMap map = nodes.model.map();
  VectorXd x = VectorXd::Zero(std::ssize(map.nuisances()));
  MatrixXd k = nodes.stiffness - 6e5 * squared(nodes.axis(0, 2)) + 6e5 * squared(nodes.axis(1, 2));
  for (std::size_t j = 0; j < map.nuisances().size(); ++j) {
    const auto& v = map.nuisances()[j];
    if (v.set != "supports" && v.set != "foundations") continue;
    x[static_cast<Eigen::Index>(j)] = 3.0;
    if (v.set == "foundations") k += 3.0 * v.deviation * 5e5 * squared(nodes.axis(0, 0));
  }
  const VectorXd found = nodes.check({move.cause()}, 6, x).full_Hz, expected = dense_hertz(k, nodes.mass);
  for (Eigen::Index i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i] / expected[i], 1.0, 1e-7) << i;
}

// Each unknown of the scatter moves the matrix of its place by x of its deviations.
TEST(FullCheck, HasTheScatterOfTheFit) {
  const TwoNodes nodes([](diagnosis::Places& places) {
    places.sets["zones"] = {on_dof("element:1", 0, 0, 7e5, 300.0), on_dof("element:2", 1, 1, 9e5, 400.0)};
    places.sets["stays"] = {on_dof("stay:A", 1, 0, 5e5)};
  });
  const diagnosis::FeatureMap map = nodes.model.map();
  MatrixXd k = nodes.stiffness, m = nodes.mass;
  VectorXd x(std::ssize(map.nuisances()));
  std::map<std::string, int> seen;
  for (std::size_t j = 0; j < map.nuisances().size(); ++j) {
    const auto& v = map.nuisances()[j];
    const double own = x[static_cast<Eigen::Index>(j)] = 1.0 + 0.3 * static_cast<double>(j), by = own * v.deviation;
    const std::string of = v.set + (v.of_mass ? " mass" : "");
    ++seen[of];
    if (of == "zones")
      k += by * (v.index == 0 ? MatrixXd(7e5 * squared(nodes.axis(0, 0))) : MatrixXd(9e5 * squared(nodes.axis(1, 1))));
    if (of == "zones mass")
      m += by * (v.index == 0 ? MatrixXd(300.0 * squared(nodes.axis(0, 0))) : MatrixXd(400.0 * squared(nodes.axis(1, 1))));
    if (of == "stays") k += by * 5e5 * squared(nodes.axis(1, 0));
    if (of == "nodes mass")
      for (int d = 0; d < 3; ++d) m += by * 1000.0 * squared(nodes.axis(v.index, d));
  }
  EXPECT_EQ(seen["zones"], 2);
  EXPECT_EQ(seen["zones mass"], 2);
  EXPECT_EQ(seen["nodes mass"], 2);
  EXPECT_EQ(seen["stays"], 1);
  nodes.expect(nodes.check({}, 6, x), k, m);
}

TEST(FullCheck, SaysThatAnExtendedModelCannotBeSolved) {
  const TwoNodes nodes([](diagnosis::Places& places) { places.sets["supports"] = {on_dof("support:A", 0, 0, 5e5)}; });
  const HandMade cause("scale.stiffness", {{"factor", -9.0}}, {nodes.model.place("supports", "support:A")});
  const auto check = nodes.check({cause.cause()});  // 1.4 MN/m less 5 MN/m
  EXPECT_NE(check.message, "");
  EXPECT_EQ(check.full_Hz.size(), 0);
}

}  // namespace
}  // namespace twindeck::tests
