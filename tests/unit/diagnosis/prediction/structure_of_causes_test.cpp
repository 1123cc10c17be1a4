// Oracles: the same change written into dense matrices; roots of the damped problem as a first-order system; the shape
// functions of a string, integrated; the closed form of one mass with friction.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "diagnosis/reduction/structure_state.hpp"
#include "hand_made.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::Cause;
using diagnosis::Place;
using diagnosis::RowType;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kPi = std::numbers::pi, kSameFrequency = 1e-9;  // of ln f: two eigensolvers of well-conditioned matrices

Place damper_at(Index size, int dof, const std::map<std::string, double>& attributes) {
  Place damper;
  damper.id = "damper:D";
  damper.directions.resize(size, 1);
  damper.directions.insert(dof, 0) = 1.0;
  damper.attributes = {{"damping", 0.0}, {"stiffness", 0.0}, {"series", 0.0}, {"always_on", 0.0}};
  for (const auto& [name, value] : attributes) damper.attributes[name] = value;
  return damper;
}

/// Four unequal masses in a row between two walls. The third spring is a parameter.
class FourMasses {
 public:
  explicit FourMasses(const std::function<void(diagnosis::Places&)>& more = {})
      : model(nodes_in_a_row(4), k - third(), m, {{{"k2", fe::Target::matrix_stiffness, {}, "-", 1.0, 0.8, 1.2}, third()}},
              more) {}
  static MatrixXd third() { return springs_in_a_row((VectorXd(5) << 0, 0, 2.4e6, 0, 0).finished()); }
  [[nodiscard]] const diagnosis::ReducedPlace* node(int i) const { return model.place("nodes", "node:" + std::to_string(i)); }
  [[nodiscard]] const diagnosis::ReducedPlace* group() const { return model.place("groups", "group:k2"); }
  diagnosis::Condition& condition() { return model.features.conditions[0]; }
  /// The modes with some causes are those of dense matrices.
  void expect(const std::vector<Cause>& causes, const MatrixXd& stiffness, const MatrixXd& mass) {
    const VectorXd hertz = dense_hertz(stiffness, mass);
    model.features.rows.clear();
    model.add_frequencies(hertz);
    const auto p = model.predict(causes);
    ASSERT_TRUE(p.valid);
    EXPECT_LT((p.g - VectorXd(hertz.array().log())).cwiseAbs().maxCoeff(), kSameFrequency);
  }
  /// The same with roots s of the damped problem: frequency |s| / 2 pi, damping -Re s / |s| beside 0.5 % of the structure.
  void expect_roots(const std::vector<Cause>& causes, const Eigen::VectorXcd& roots) {
    model.features.rows.clear();
    for (Index i = 0; i < roots.size(); ++i) {
      const double hertz = std::abs(roots[i]) / (2.0 * kPi), zeta_pct = 0.5 - 100.0 * roots[i].real() / std::abs(roots[i]);
      model.add_row(RowType::frequency, std::to_string(i + 1), -1, hertz, 0.01 * hertz);
      model.add_row(RowType::damping, std::to_string(i + 1), -1, zeta_pct, 0.1 * zeta_pct);
    }
    const auto p = model.predict(causes);
    ASSERT_TRUE(p.valid);
    for (Index i = 0; i < 2 * roots.size(); ++i)
      EXPECT_NEAR(p.g[i], std::log(model.features.rows[static_cast<std::size_t>(i)].value), 1e-8) << "row " << i;
  }

  MatrixXd k = springs_in_a_row((VectorXd(5) << 2.0e6, 1.6e6, 2.4e6, 1.8e6, 2.2e6).finished());
  MatrixXd m = Eigen::Vector4d(900.0, 1200.0, 1000.0, 800.0).asDiagonal();
  Predicted model;
};

/// Roots with positive imaginary part of x' = a x, ascending in modulus.
Eigen::VectorXcd roots_of(const MatrixXd& a) {
  const Eigen::VectorXcd all = a.eigenvalues();
  std::vector<std::complex<double>> kept;
  for (const auto& s : all)
    if (s.imag() > 1e-6) kept.push_back(s);
  std::sort(kept.begin(), kept.end(), [](const auto& p, const auto& q) { return std::abs(p) < std::abs(q); });
  return Eigen::Map<Eigen::VectorXcd>(kept.data(), std::ssize(kept));
}

/// x = (u, v) of M u'' + C u' + K u = 0.
Eigen::VectorXcd damped_roots(const MatrixXd& k, const MatrixXd& m, const MatrixXd& c) {
  const Index n = k.rows();
  MatrixXd a = MatrixXd::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).setIdentity();
  a.bottomLeftCorner(n, n) = -m.inverse() * k;
  a.bottomRightCorner(n, n) = -m.inverse() * c;
  return roots_of(a);
}

/// x = (u, v, y) with a spring and a dashpot in series at a dof: y is between them, c y' = spring (u - y).
Eigen::VectorXcd roots_in_series(const MatrixXd& k, const MatrixXd& m, int dof, double spring, double c) {
  const Index n = k.rows();
  MatrixXd a = MatrixXd::Zero(2 * n + 1, 2 * n + 1);
  a.block(0, n, n, n).setIdentity();
  MatrixXd held = k;
  held(dof, dof) += spring;
  a.block(n, 0, n, n) = -m.inverse() * held;
  a.block(n, 2 * n, n, 1) = spring * m.inverse().col(dof);
  a(2 * n, dof) = spring / c;
  a(2 * n, 2 * n) = -spring / c;
  return roots_of(a);
}

TEST(CausesOfStiffness, AFactorScalesItsPart) {
  FourMasses four;
  const HandMade factor("scale.stiffness", {{"factor", 0.6}}, {four.group()});
  four.expect({factor.cause()}, four.k - 0.4 * FourMasses::third(), four.m);
  four.expect({factor.cause(), factor.cause()}, four.k - 0.8 * FourMasses::third(), four.m);  // changes of the part as modelled
}

TEST(CausesOfStiffness, AFactorScalesWhatTheParameterHasMadeOfItsPart) {
  // The parameter at 1.1: the part is 1.1 times as stiff before a factor of 0.6.
  FourMasses four;
  const HandMade factor("scale.stiffness", {{"factor", 0.6}}, {four.group()});
  const VectorXd hertz = dense_hertz(four.k + (1.1 * 0.6 - 1.0) * FourMasses::third(), four.m);
  four.model.add_frequencies(hertz);
  const diagnosis::FeatureMap map = four.model.map();
  VectorXd x = VectorXd::Zero(std::ssize(map.nuisances()));
  ASSERT_EQ(map.nuisances()[0].name, "k2");
  x[0] = 0.1 / map.nuisances()[0].deviation;
  const auto p = map.predict(map.base(x), {factor.cause()}, false);
  EXPECT_LT((p.g - VectorXd(hertz.array().log())).cwiseAbs().maxCoeff(), kSameFrequency);
}

TEST(CausesOfStiffness, AFactorScalesABearingWithItsOwnError) {
  // The last spring is a bearing 15 % stiffer than the model says: with a factor of 0.3 it has 0.3 times that.
  const MatrixXd bearing = springs_in_a_row((VectorXd(5) << 0, 0, 0, 0, 2.2e6).finished());
  const Place place{"support:S", {}, diagnosis::Symmetric(bearing.sparseView()), {}, {}, {{"f_high", 30.0}}, {}};
  FourMasses four([&](diagnosis::Places& places) { places.sets["supports"] = {place}; });
  const HandMade factor("scale.stiffness", {{"factor", 0.3}}, {four.model.place("supports", "support:S")});
  const VectorXd hertz = dense_hertz(four.k + (1.15 * 0.3 - 1.0) * bearing, four.m);
  four.model.add_frequencies(hertz);
  const diagnosis::FeatureMap map = four.model.map();
  VectorXd x = VectorXd::Zero(std::ssize(map.nuisances()));
  const auto& all = map.nuisances();
  const Index own = std::ranges::find(all, "support:S stiffness", &diagnosis::Nuisance::name) - all.begin();
  ASSERT_LT(own, x.size());
  EXPECT_DOUBLE_EQ(all[static_cast<std::size_t>(own)].deviation, 0.03);
  x[own] = 5.0;
  const auto p = map.predict(map.base(x), {factor.cause()}, true);
  ASSERT_TRUE(p.valid);
  EXPECT_LT((p.g - VectorXd(hertz.array().log())).cwiseAbs().maxCoeff(), kSameFrequency);
  const auto at = [&](double moved) {
    VectorXd there = x;
    there[own] += moved;
    return map.predict(map.base(there), {factor.cause()}, false).g;
  };
  const VectorXd slope = (at(1e-4) - at(-1e-4)) / 2e-4;
  EXPECT_LT((p.jacobian.col(own) - slope).norm(), 1e-6 * slope.norm());
}

TEST(CausesOfStiffness, AFieldScalesWhatTheParameterHasMadeOfItsPart) {
  // The same factor of 0.6 by 20 degrees at -0.02 per degree.
  FourMasses four;
  four.condition().temperature_C = 30.0;
  const HandMade field("field.stiffness", {{"rate", -0.02}, {"reference", 10.0}}, {four.group()});
  const VectorXd hertz = dense_hertz(four.k + (1.1 * 0.6 - 1.0) * FourMasses::third(), four.m);
  four.model.add_frequencies(hertz);
  const diagnosis::FeatureMap map = four.model.map();
  VectorXd x = VectorXd::Zero(std::ssize(map.nuisances()));
  x[0] = 0.1 / map.nuisances()[0].deviation;
  const auto p = map.predict(map.base(x), {field.cause()}, false);
  EXPECT_LT((p.g - VectorXd(hertz.array().log())).cwiseAbs().maxCoeff(), kSameFrequency);
}

TEST(CausesOfStiffness, FollowTheirVariable) {
  FourMasses four;
  const HandMade field("field.stiffness", {{"rate", -0.02}, {"reference", 10.0}}, {four.group()});
  const HandMade step("step.stiffness", {{"factor", 3.0}, {"below", 0.0}}, {four.group()});
  HandMade slip("slip.stiffness", {{"factor", 0.5}, {"above", 0.004}}, {four.group()});
  HandMade soften("soften.stiffness", {{"half", 0.004}}, {four.group()});
  slip.with_text("variable", "amplitude_m");
  soften.with_text("variable", "amplitude_m");
  const auto expect = [&](const HandMade& made, double factor) {
    four.expect({made.cause()}, four.k + (factor - 1.0) * FourMasses::third(), four.m);
  };
  for (const auto& made : std::vector<const HandMade*>{&field, &step, &slip, &soften})
    expect(*made, 1.0);  // the condition does not tell
  four.condition().temperature_C = -5.0;
  four.condition().amplitude_m = 0.006;
  expect(field, 1.3);
  expect(step, 3.0);
  expect(slip, 0.5);
  expect(soften, 0.4);  // 1 / (1 + 1.5)
  four.condition().temperature_C = 20.0;
  four.condition().amplitude_m = 0.002;
  expect(field, 0.8);
  expect(step, 1.0);
  expect(slip, 1.0);
  expect(soften, 1.0 / 1.5);
}

TEST(CausesOfStiffness, ActInTheirStateAlone) {
  FourMasses four;
  HandMade factor("scale.stiffness", {{"factor", 0.6}}, {four.group()});
  factor.candidate.state = "after";
  four.expect({factor.cause()}, four.k, four.m);
  four.condition().state = "after";
  four.expect({factor.cause()}, four.k - 0.4 * FourMasses::third(), four.m);
}

TEST(CausesOfMass, AreAddedAndScaled) {
  FourMasses four;
  MatrixXd m = four.m;
  m(2, 2) += 250.0;
  four.expect({HandMade("mass.add", {{"mass", 250.0}}, {four.node(3)}).cause()}, four.k, m);
  m = four.m;
  m(1, 1) *= 1.4;
  four.expect({HandMade("scale.mass", {{"factor", 1.4}}, {four.node(2)}).cause()}, four.k, m);
}

TEST(CausesOfMass, PeopleWeighWhatIsSaidOfThem) {
  // Twenty people of 75 kg are spread like the mass of 3,900 kg; the cause says 80 kg of each.
  FourMasses four;
  const HandMade heavier("mass.per_count", {{"mass", 80.0}, {"assumed", 75.0}}, {four.model.place("global", "global")});
  four.expect({heavier.cause()}, four.k, four.m);
  four.condition().people = 20.0;
  four.expect({}, four.k, (1.0 + 20.0 * 75.0 / 3900.0) * four.m);
  four.expect({heavier.cause()}, four.k, (1.0 + 20.0 * 80.0 / 3900.0) * four.m);
}

TEST(CausesOfElements, SpringsToTheGroundAndBetweenNodes) {
  FourMasses four;
  MatrixXd k = four.k;
  k(0, 0) += 7e5;
  four.expect({HandMade("element.spring", {{"stiffness", 7e5}}, {four.node(1)}).cause()}, k, four.m);
  k = four.k;
  const VectorXd b = VectorXd::Unit(4, 0) - VectorXd::Unit(4, 3);
  k += 7e5 * b * b.transpose();
  four.expect({HandMade("element.spring", {{"stiffness", 7e5}}, {four.node(1), four.node(4)}).cause()}, k, four.m);
}

TEST(CausesOfElements, AnOscillatorIsAMassOnASpring) {
  FourMasses four;
  const double mass = 90.0, stiffness = mass * std::pow(2.0 * kPi * 3.1, 2);
  MatrixXd k = MatrixXd::Zero(5, 5), m = k;
  k.topLeftCorner(4, 4) = four.k;
  m.topLeftCorner(4, 4) = four.m;
  m(4, 4) = mass;
  const VectorXd b = VectorXd::Unit(5, 4) - VectorXd::Unit(5, 1);
  k += stiffness * b * b.transpose();
  four.expect({HandMade("element.oscillator", {{"mass", mass}, {"frequency", 3.1}}, {four.node(2)}).cause()}, k, m);
}

TEST(CausesOfElements, AStringSwingsOnItsMovingEnd) {
  // Motion along the chord: end (1 - x/L) + q sin(pi x/L). Its mass matrix by Simpson's rule, 2,000 intervals: to 1e-12. Alone,
  // on an end that is held, the string has its frequency.
  FourMasses four;
  const double mass = 90.0;
  Eigen::Matrix2d inertia = Eigen::Matrix2d::Zero();
  constexpr int kIntervals = 2000;
  for (int i = 0; i <= kIntervals; ++i) {
    const double x = static_cast<double>(i) / kIntervals, weight = (i == 0 || i == kIntervals ? 1.0 : i % 2 ? 4.0 : 2.0);
    const Eigen::Vector2d shape(1.0 - x, std::sin(kPi * x));
    inertia += mass * weight / (3.0 * kIntervals) * shape * shape.transpose();
  }
  MatrixXd k = MatrixXd::Zero(5, 5), m = k;
  k.topLeftCorner(4, 4) = four.k;
  m.topLeftCorner(4, 4) = four.m;
  m(1, 1) += inertia(0, 0);
  m(1, 4) = m(4, 1) = inertia(0, 1);
  m(4, 4) = inertia(1, 1);
  k(4, 4) = inertia(1, 1) * std::pow(2.0 * kPi * 3.1, 2);
  four.expect({HandMade("element.string", {{"mass", mass}, {"frequency", 3.1}}, {four.node(2)}).cause()}, k, m);
}

/// Two nodes with three translations each, coupled, 5 m apart along (3, 4, 0).
class TiedNodes {
 public:
  TiedNodes() {
    std::vector<fe::DofLabel> dofs;
    for (const bool second : {false, true})
      for (int d = 0; d < 3; ++d)
        dofs.push_back({second ? "q" : "p", d, second ? Eigen::Vector3d(3, 4, 0) : Eigen::Vector3d(0, 0, 0)});
    for (Index i = 0; i < 6; ++i)
      for (Index j = 0; j < 6; ++j)
        k(i, j) = i == j ? 2e6 + 3e5 * static_cast<double>(i) : 1e5 * std::cos(static_cast<double>(i * j));
    model = std::make_unique<Predicted>(dofs, k, m);
  }
  void expect(const Cause& cause, const MatrixXd& stiffness) {
    const VectorXd hertz = dense_hertz(stiffness, m);
    model->features.rows.clear();
    model->add_frequencies(hertz);
    EXPECT_LT((model->predict({cause}).g - VectorXd(hertz.array().log())).cwiseAbs().maxCoeff(), kSameFrequency);
  }
  MatrixXd k = MatrixXd::Zero(6, 6), m = 1000.0 * MatrixXd::Identity(6, 6);
  std::unique_ptr<Predicted> model;
};

TEST(CausesOfElements, ATieInSpacePullsAlongItsLine) {
  TiedNodes nodes;
  const auto *p = nodes.model->place("nodes", "node:p"), *q = nodes.model->place("nodes", "node:q");
  const VectorXd b = (VectorXd(6) << 0.6, 0.8, 0.0, -0.6, -0.8, 0.0).finished();
  nodes.expect(HandMade("element.spring", {{"stiffness", 9e5}}, {p, q}).cause(), nodes.k + 9e5 * b * b.transpose());
}

TEST(CausesOfElements, AVerticalSpringHoldsTheVerticalMotion) {
  TiedNodes nodes;
  const auto* q = nodes.model->place("nodes", "node:q");
  HandMade spring("element.spring", {{"stiffness", 9e5}}, {q});
  MatrixXd k = nodes.k;
  k.diagonal().tail(3).array() += 9e5;
  nodes.expect(spring.cause(), k);
  spring.with_text("direction", "vertical");
  k = nodes.k;
  k(5, 5) += 9e5;
  nodes.expect(spring.cause(), k);
}

TEST(CausesOfSupports, OneThatIsMovedStandsBetweenTwoNodes) {
  // Stations at the four nodes, 0 to 3 m. At 2.25 m it holds a quarter of the fourth node's and three quarters of the third's
  // motion, instead of the second node; beyond the last one it stands at the last.
  const auto with_support = [](diagnosis::Places& places) {
    Place support;
    support.id = "support:pier";
    MatrixXd own = MatrixXd::Zero(4, 4);
    own(1, 1) = 6e5;
    support.stiffness = diagnosis::Symmetric(own.sparseView());
    support.directions = MatrixXd::Identity(4, 4).sparseView();
    support.attributes = {{"stations", 4.0}, {"k_0", 6e5}, {"x_0", 0.0}, {"x_1", 1.0}, {"x_2", 2.0}, {"x_3", 3.0}};
    places.sets["support_moves"] = {support};
  };
  FourMasses four(with_support);
  const auto* support = four.model.place("support_moves", "support:pier");
  MatrixXd without = four.k;
  without(1, 1) -= 6e5;
  const auto moved = [&](double position, const VectorXd& b) {
    four.expect({HandMade("support.move", {{"position", position}}, {support}).cause()}, without + 6e5 * b * b.transpose(),
                four.m);
  };
  moved(1.0, VectorXd::Unit(4, 1));
  moved(2.25, 0.75 * VectorXd::Unit(4, 2) + 0.25 * VectorXd::Unit(4, 3));
  moved(0.5, 0.5 * VectorXd::Unit(4, 0) + 0.5 * VectorXd::Unit(4, 1));
  moved(7.0, VectorXd::Unit(4, 3));

  // A support of two springs: each goes along on directions of its own, the second ones after the first of each station.
  FourMasses two([](diagnosis::Places& places) {
    Place pier;
    pier.id = "support:pier";
    pier.stiffness = diagnosis::Symmetric(MatrixXd(Eigen::Vector4d(4e5, 3e5, 0.0, 0.0).asDiagonal()).sparseView());
    pier.directions = MatrixXd::Identity(4, 4).sparseView();
    pier.attributes = {{"stations", 2.0}, {"k_0", 4e5}, {"k_1", 3e5}, {"x_0", 0.0}, {"x_1", 1.0}};
    places.sets["support_moves"] = {pier};
  });
  MatrixXd bare = two.k;
  bare(0, 0) -= 4e5;
  bare(1, 1) -= 3e5;
  const VectorXd first = 0.75 * VectorXd::Unit(4, 0) + 0.25 * VectorXd::Unit(4, 2);
  const VectorXd second = 0.75 * VectorXd::Unit(4, 1) + 0.25 * VectorXd::Unit(4, 3);
  two.expect({HandMade("support.move", {{"position", 0.25}}, {two.model.place("support_moves", "support:pier")}).cause()},
             bare + 4e5 * first * first.transpose() + 3e5 * second * second.transpose(), two.m);
}

/// Four masses with one damper at the second, switched on.
FourMasses damped(const std::map<std::string, double>& attributes) {
  return FourMasses([=](diagnosis::Places& places) { places.sets["dampers"] = {damper_at(4, 1, attributes)}; });
}

MatrixXd dashpot(double c) { return c * VectorXd::Unit(4, 1) * VectorXd::Unit(4, 1).transpose(); }

TEST(CausesOfDampers, ActWhereTheyAreOn) {
  FourMasses four = damped({{"damping", 8e3}});
  const auto* damper = four.model.place("dampers", "damper:D");
  const Eigen::VectorXcd on = damped_roots(four.k, four.m, dashpot(8e3)), off = damped_roots(four.k, four.m, dashpot(0.0));
  four.expect_roots({}, off);  // the condition does not tell, and it is not always on
  four.condition().dampers_on = true;
  four.expect_roots({}, on);
  four.expect_roots({HandMade("damper.damping", {{"factor", 0.3}}, {damper}).cause()},
                    damped_roots(four.k, four.m, dashpot(2.4e3)));
  four.expect_roots({HandMade("damper.absent", {}, {damper}).cause()}, off);
  four.condition().dampers_on = false;
  four.expect_roots({}, off);
  FourMasses always = damped({{"damping", 8e3}, {"always_on", 1.0}});
  always.expect_roots({}, on);
}

TEST(CausesOfDampers, SpringBesideOrInSeries) {
  FourMasses beside = damped({{"damping", 8e3}, {"stiffness", 4e5}});
  beside.condition().dampers_on = true;
  MatrixXd stiffer = beside.k;
  stiffer(1, 1) += 4e5;
  beside.expect_roots({}, damped_roots(stiffer, beside.m, dashpot(8e3)));
  FourMasses series = damped({{"damping", 8e3}, {"stiffness", 4e5}, {"series", 1.0}});
  series.condition().dampers_on = true;
  series.expect_roots({}, roots_in_series(series.k, series.m, 1, 4e5, 8e3));
  const HandMade mount("damper.series", {{"stiffness", 2e5}}, {series.model.place("dampers", "damper:D")});
  series.expect_roots({mount.cause()}, roots_in_series(series.k, series.m, 1, 2e5, 8e3));
}

TEST(CausesOfDampers, TheSpringOfAFittedOneIsInTheModelAlready) {
  FourMasses four = damped({{"damping", 8e3}, {"stiffness", 4e5}, {"always_on", 1.0}});
  const auto* damper = four.model.place("dampers", "damper:D");
  four.expect_roots({}, damped_roots(four.k, four.m, dashpot(8e3)));
  MatrixXd without = four.k;
  without(1, 1) -= 4e5;
  const Eigen::VectorXcd off = damped_roots(without, four.m, dashpot(0.0));
  four.expect_roots({HandMade("damper.absent", {}, {damper}).cause()}, off);
  four.expect_roots({HandMade("damper.series", {{"stiffness", 2e5}}, {damper}).cause()},
                    roots_in_series(without, four.m, 1, 2e5, 8e3));
  four.condition().dampers_on = false;
  four.expect_roots({}, off);
}

TEST(CausesOfDampers, OneThatIsMovedActsElsewhere) {
  FourMasses four([](diagnosis::Places& places) {
    places.sets["dampers"] = {damper_at(4, 1, {{"damping", 8e3}})};
    places.sets["damper_moves"] = {damper_at(4, 2, {})};
    places.sets["damper_moves"][0].id = "dampers:D@third";
  });
  four.condition().dampers_on = true;
  const HandMade moved("damper.move", {},
                       {four.model.place("dampers", "damper:D"), four.model.place("damper_moves", "dampers:D@third")});
  const MatrixXd c = 8e3 * VectorXd::Unit(4, 2) * VectorXd::Unit(4, 2).transpose();
  four.expect_roots({moved.cause()}, damped_roots(four.k, four.m, c));
}

TEST(CausesOfDampers, FrictionGoesByTheAmplitudeOfTheRecord) {
  // One mass: the damper moves by sqrt(2) times the RMS, and s² m + k + d = 0 with Caughey's d. Where no amplitude is known
  // nothing slips.
  const double k = 2e6, m = 1000.0, spring = 5e5, threshold = 800.0, rms = 0.004;
  Predicted one(nodes_in_a_row(1), MatrixXd::Constant(1, 1, k), MatrixXd::Constant(1, 1, m), {}, [](diagnosis::Places& places) {
    places.sets["dampers"] = {damper_at(1, 0, {{"damping", 0.0}})};
  });
  one.features.conditions[0].dampers_on = true;
  const HandMade friction("damper.friction", {{"stiffness", spring}, {"threshold", threshold}},
                          {one.place("dampers", "damper:D")});
  one.add_frequencies(VectorXd::Constant(1, std::sqrt(k / m) / (2.0 * kPi)));
  const auto hertz = [&](std::complex<double> d) { return std::abs(std::sqrt((k + d) / m)) / (2.0 * kPi); };
  EXPECT_NEAR(one.predict({friction.cause()}).frequency_Hz[0], hertz(spring), 1e-7);
  one.features.conditions[0].amplitude_m = rms;
  one.features.conditions[0].amplitude_channel = "c0";
  const auto d = diagnosis::jenkins_stiffness(spring, threshold, std::sqrt(2.0) * rms);
  EXPECT_NEAR(one.predict({friction.cause()}).frequency_Hz[0], hertz(d), 1e-7);
  EXPECT_LT(hertz(d), hertz(spring) - 0.1);  // a change that could have been missed
}

TEST(Causes, AWalkerOnKneesIsASprungMassInsteadOfARigidOne) {
  // To first order in the walker's mass, a hundred-thousandth of the structure's. It is spread over the masses in proportion to
  // them.
  const double part = 1e-5, own_Hz = 8.0, damping = 0.3, omega = 2.0 * kPi * own_Hz;
  FourMasses four;
  four.condition().people = 1.0;
  const diagnosis::ReducedPlace* deck = four.model.place("global", four.model.reduced().sets.at("global")[0].id);
  const double total = four.m.trace(), walker = part * total;
  const HandMade person("person.oscillator", {{"mass", walker}, {"frequency", own_Hz}, {"damping", damping}}, {deck});
  // The base model has a rigid person of 75 kg, spread in the same way.
  const MatrixXd base = four.m * (1.0 + 75.0 / total);
  MatrixXd k = MatrixXd::Zero(8, 8), m = k, c = k, relative = MatrixXd::Zero(4, 8);
  relative << -MatrixXd::Identity(4, 4), MatrixXd::Identity(4, 4);
  const MatrixXd share = part * four.m;
  k.topLeftCorner(4, 4) = four.k;
  k += relative.transpose() * (omega * omega * share) * relative;
  c = relative.transpose() * (2.0 * damping * omega * share) * relative;
  m.topLeftCorner(4, 4) = base - share;  // the walker is part of the rigid person
  m.bottomRightCorner(4, 4) = share;
  const VectorXd hertz = dense_hertz(four.k, base);
  for (Index i = 0; i < 4; ++i) {
    four.model.add_row(RowType::frequency, std::to_string(i + 1), -1, hertz[i], 0.01 * hertz[i]);
    four.model.add_row(RowType::damping, std::to_string(i + 1), -1, 0.5, 0.05);
  }
  const auto without = four.model.predict(), with = four.model.predict({person.cause()});
  ASSERT_TRUE(with.valid);
  const Eigen::VectorXcd roots = damped_roots(k, m, c);
  for (Index i = 0; i < 4; ++i) {
    Index nearest = 0;  // the walkers' own roots are damped by 30 %
    double least = 1e300;
    for (Index j = 0; j < roots.size(); ++j) {
      const double off = std::abs(std::abs(roots[j]) / (2.0 * kPi) - hertz[i]) +
                         1e3 * std::max(0.0, -roots[j].real() / std::abs(roots[j]) - 0.1);
      if (off < least) {
        least = off;
        nearest = j;
      }
    }
    const double change = std::log(std::abs(roots[nearest]) / (2.0 * kPi * hertz[i])),
                 zeta_pct = -100.0 * roots[nearest].real() / std::abs(roots[nearest]);
    EXPECT_NEAR(with.g[2 * i] - without.g[2 * i], change, 1e-3 * part) << i;
    EXPECT_NEAR(std::exp(with.g[2 * i + 1]) - std::exp(without.g[2 * i + 1]), zeta_pct, 1e-3 * 100.0 * part) << i;
    EXPECT_GT(zeta_pct, 5.0 * part) << i;  // a change that could have been missed
  }
}

TEST(Causes, OfTwoConditionsAreKeptApart) {
  // Temperatures -5 and 20 °C in one measurement: the state of one condition is not that of the other.
  FourMasses four;
  const HandMade field("field.stiffness", {{"rate", -0.02}, {"reference", 10.0}}, {four.group()});
  four.condition().temperature_C = -5.0;
  const VectorXd cold = dense_hertz(four.k + 0.3 * FourMasses::third(), four.m),
                 warm = dense_hertz(four.k - 0.2 * FourMasses::third(), four.m);
  four.model.add_frequencies(cold);
  four.model.add_condition("warm").temperature_C = 20.0;
  four.model.add_frequencies(warm);
  const auto p = four.model.predict({field.cause()});
  EXPECT_LT((p.g.head(4) - VectorXd(cold.array().log())).cwiseAbs().maxCoeff(), kSameFrequency);
  EXPECT_LT((p.g.tail(4) - VectorXd(warm.array().log())).cwiseAbs().maxCoeff(), kSameFrequency);
}

}  // namespace
}  // namespace twindeck::tests
