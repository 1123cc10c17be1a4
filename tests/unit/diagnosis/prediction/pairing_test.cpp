// Oracles: invariances of the MAC and its value by hand; modes whose shapes say plainly which they are.
#include <gtest/gtest.h>

#include "diagnosis/prediction/predictor.hpp"
#include "hand_made.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::likeness;
using diagnosis::RowType;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

TEST(Likeness, IsTheSquareOfTheCosine) {
  MatrixXcd shapes(2, 3);
  shapes << 1.0, 0.0, 1.0, 0.0, 2.0, 1.0;
  const VectorXd mac = likeness(shapes, Eigen::Vector2cd(Complex(std::sqrt(3.0)), Complex(1.0)));  // at 30 degrees
  EXPECT_NEAR(mac[0], 0.75, 1e-15);
  EXPECT_NEAR(mac[1], 0.25, 1e-15);
  EXPECT_NEAR(mac[2], std::pow(std::cos(15.0 / 180.0 * std::numbers::pi), 2), 1e-15);
}

TEST(Likeness, DoesNotDependOnComplexScales) {
  MatrixXcd shapes(3, 2);
  shapes << Complex(1, 0.2), Complex(0, 1), Complex(-0.5, 0.1), Complex(2, 0), Complex(0.3, -0.4), Complex(1, 1);
  const VectorXcd measured = shapes.col(0) + 0.3 * shapes.col(1);
  const VectorXd mac = likeness(shapes, measured), turned = likeness(Complex(-2.0, 3.0) * shapes, Complex(0.1, 0.7) * measured);
  EXPECT_LT((mac - turned).norm(), 1e-14);
  EXPECT_NEAR(likeness(shapes, Complex(0.0, 5.0) * shapes.col(1))[1], 1.0, 1e-14);
}

TEST(Likeness, OfNothingIsNone) {
  EXPECT_EQ(likeness(MatrixXcd(3, 0), VectorXcd::Ones(3)).size(), 0);
  EXPECT_EQ(likeness(MatrixXcd::Ones(3, 1), VectorXcd::Zero(3))[0], 0.0);
  EXPECT_EQ(likeness(MatrixXcd::Zero(3, 1), VectorXcd::Ones(3))[0], 0.0);
}

/// Five equal masses in a row; shape i is sin(i j pi / 6).
class FiveMasses {
 public:
  FiveMasses() : model(nodes_in_a_row(5), springs_in_a_row(VectorXd::Constant(6, 2e6)), 1000.0 * MatrixXd::Identity(5, 5)) {}
  static double hertz(int i) {
    return 2.0 * std::sqrt(2000.0) * std::sin(i * std::numbers::pi / 12.0) / (2.0 * std::numbers::pi);
  }
  static double shape(int i, int channel) { return std::sin(i * (channel + 1) * std::numbers::pi / 6.0); }
  /// A measured mode with the shape of mode i, where there is one (0: none).
  void measure(const std::string& label, double frequency, int i) {
    model.add_row(RowType::frequency, label, -1, frequency, 0.01 * frequency);
    for (int c = 0; c < 5 && i > 0; ++c) model.add_row(RowType::shape, label, c, shape(i, c), 0.02);
  }
  [[nodiscard]] std::vector<int> paired(const std::vector<diagnosis::Cause>& causes = {}) const {
    return model.predict(causes).paired;
  }
  Predicted model;
};

TEST(Pair, ByFrequencyEachIsItself) {
  FiveMasses five;
  for (const int i : {3, 1, 5}) five.measure(std::to_string(i), 1.02 * FiveMasses::hertz(i), 0);
  EXPECT_EQ(five.paired(), (std::vector<int>{2, 0, 4}));
}

// Both measured frequencies lie above both of the model: the sum of the distances is the same crossed.
TEST(Pair, FrequenciesAloneArePairedInTheirOrder) {
  for (int turn = 0; turn < 20; ++turn) {
    FiveMasses five;
    const double lower = FiveMasses::hertz(5) * (1.01 + 0.002 * turn), higher = lower * 1.03;
    const bool swapped = turn % 2 == 1;
    five.measure("A", swapped ? higher : lower, 0);
    five.measure("B", swapped ? lower : higher, 0);
    EXPECT_EQ(five.paired(), swapped ? (std::vector<int>{4, 3}) : (std::vector<int>{3, 4})) << turn;
  }
}

TEST(Pair, ShapesDecideAgainstNearerFrequencies) {
  // Both frequencies lie between those of modes 4 and 5, each nearer to the other's mode.
  FiveMasses five;
  const double middle = std::sqrt(FiveMasses::hertz(4) * FiveMasses::hertz(5));
  five.measure("a", 1.01 * middle, 4);
  five.measure("b", 0.99 * middle, 5);
  EXPECT_EQ(five.paired(), (std::vector<int>{3, 4}));
  EXPECT_GT(five.model.predict().mac[0], 0.999999);
}

// Five masses that nothing holds: 2 sqrt(k/m) sin(i pi/10), i = 0 … 4. The eigenvalue of the rigid body is rounding, of either
// sign.
TEST(Pair, ARigidBodyIsNoMeasuredMode) {
  VectorXd springs = VectorXd::Constant(6, 2e6);
  springs[0] = springs[5] = 0.0;
  for (int mass = 700; mass < 1000; mass += 13) {
    Predicted free(nodes_in_a_row(5), springs_in_a_row(springs), mass * MatrixXd::Identity(5, 5));
    for (int i = 1; i <= 3; ++i) {
      const double f = std::sqrt(2e6 / mass) * std::sin(i * std::numbers::pi / 10.0) / std::numbers::pi;
      free.add_row(RowType::frequency, std::to_string(i), -1, 1.03 * f, 0.01 * f);
    }
    EXPECT_EQ(free.predict().paired, (std::vector<int>{1, 2, 3})) << mass;
  }
}

TEST(Pair, IsOneToOne) {
  // Two measured modes are nearest to mode 2; the one that is nearer gets it.
  FiveMasses five;
  five.measure("a", 1.001 * FiveMasses::hertz(2), 0);
  five.measure("b", 1.1 * FiveMasses::hertz(2), 0);
  EXPECT_EQ(five.paired(), (std::vector<int>{1, 2}));
}

TEST(Pair, OfMoreMeasuredModesThanComputedOnesOneIsNoneOfTheModels) {
  FiveMasses five;
  for (int i = 0; i < 6; ++i) five.measure(std::to_string(i), 1.0 + i, 0);
  const auto prediction = five.model.predict();
  EXPECT_TRUE(prediction.valid);
  EXPECT_EQ(std::count(prediction.paired.begin(), prediction.paired.end(), -1), 1);
  EXPECT_EQ(prediction.open.size(), 1U);
}

TEST(Pair, AMeasuredModeOfAnotherShapeIsNoneOfTheModels) {
  // The second of two modes near mode 2 has the shape of mode 4, which has been measured too.
  FiveMasses five;
  five.measure("a", FiveMasses::hertz(2), 2);
  five.measure("twice", 1.02 * FiveMasses::hertz(2), 4);
  five.measure("b", FiveMasses::hertz(4), 4);
  EXPECT_EQ(five.paired(), (std::vector<int>{1, -1, 3}));
}

TEST(Pair, AShapeOfTheSameNameInAnotherConditionTells) {
  FiveMasses five;
  const double middle = std::sqrt(FiveMasses::hertz(4) * FiveMasses::hertz(5));
  five.measure("a", FiveMasses::hertz(5), 5);
  five.measure("b", FiveMasses::hertz(4), 4);
  five.model.add_condition("crowd").people = 1.0;  // another state of the solver, the same structure
  five.measure("a", 0.999 * middle, 0);
  five.measure("b", 1.001 * middle, 0);
  EXPECT_EQ(five.paired(), (std::vector<int>{4, 3, 4, 3}));
}

TEST(Pair, ABoundNameIsTheModelsMode) {
  // Without a shape the frequencies decide, unless the names are bound to modes of the model.
  FiveMasses five;
  const double middle = std::sqrt(FiveMasses::hertz(4) * FiveMasses::hertz(5));
  five.measure("a", 0.999 * middle, 0);
  five.measure("b", 1.001 * middle, 0);
  diagnosis::FeatureMap map = five.model.map();
  const auto base = map.base(VectorXd::Zero(std::ssize(map.nuisances())));
  EXPECT_EQ(map.predict(base, {}, false).paired, (std::vector<int>{3, 4}));
  map.bind_modes({{"a", 4}, {"b", 3}});
  EXPECT_EQ(map.predict(base, {}, false).paired, (std::vector<int>{4, 3}));
}

// Modes 1 and 5 are 16 steps of frequency apart, each measured where the other is.
TEST(Pair, ABoundNameDecidesHoweverFarTheFrequencyIs) {
  FiveMasses five;
  five.measure("a", FiveMasses::hertz(1), 0);
  five.measure("b", FiveMasses::hertz(5), 0);
  diagnosis::FeatureMap map = five.model.map();
  map.bind_modes({{"a", 4}, {"b", 0}});
  EXPECT_EQ(map.predict(map.base(VectorXd::Zero(std::ssize(map.nuisances()))), {}, false).paired, (std::vector<int>{4, 0}));
}

// Two masses on springs of their own, 1 and 1.8 Hz, and a damper between them that mixes their motions a quarter turn apart.
// Each name is bound to its undamped mode and measured at the other's frequency. The names must outweigh 8.7 steps of frequency
// undamped, and 8.5 damped (1.12 and 1.61 Hz). They weigh 12 undamped and 7.2 damped, by dense matrices.
TEST(Pair, ABoundNameWeighsLessWhereADamperMixesItsMode) {
  constexpr double kEach = 1000.0, kOmega = 2.0 * std::numbers::pi, kRatio = 1.8, kDamping = 2.0 * 0.33 * kEach * kOmega;
  const double soft = kEach * kOmega * kOmega, stiff = kRatio * kRatio * soft;
  for (const bool damped : {false, true}) {
    Predicted model(
        nodes_in_a_row(2), springs_in_a_row(Eigen::Vector3d(soft, 0.0, stiff)), kEach * MatrixXd::Identity(2, 2), {},
        [&](diagnosis::Places& places) {
          diagnosis::Place damper;
          damper.id = "damper:D";
          damper.directions.resize(2, 1);
          damper.directions.insert(0, 0) = 1.0;
          damper.directions.insert(1, 0) = -1.0;
          damper.attributes = {{"damping", damped ? kDamping : 1e-3}, {"stiffness", 0.0}, {"series", 0.0}, {"always_on", 1.0}};
          places.sets["dampers"] = {damper};
        });
    model.add_row(RowType::frequency, "a", -1, damped ? 1.61 : kRatio, 0.01);
    model.add_row(RowType::frequency, "b", -1, damped ? 1.12 : 1.0, 0.01);
    diagnosis::FeatureMap map = model.map();
    map.bind_modes({{"a", 0}, {"b", 1}});
    EXPECT_EQ(map.predict(map.base(VectorXd::Zero(std::ssize(map.nuisances()))), {}, false).paired,
              damped ? (std::vector<int>{1, 0}) : (std::vector<int>{0, 1}));
  }
}

TEST(Pair, AMeasuredShapeOutweighsAFarFrequency) {
  FiveMasses five;
  five.measure("a", FiveMasses::hertz(1), 5);
  five.measure("b", FiveMasses::hertz(5), 1);
  EXPECT_EQ(five.paired(), (std::vector<int>{4, 0}));
}

TEST(Pair, ExchangedNamesHaveEachOthersShapes) {
  // Frequencies are right; the shapes of modes 2 and 3 stand under each other's names. The cause says so.
  FiveMasses five;
  for (const int i : {1, 2, 3}) five.measure(std::to_string(i), FiveMasses::hertz(i), i == 2 ? 3 : i == 3 ? 2 : 1);
  HandMade exchange("modes.exchange", {});
  exchange.candidate.mode = "2";
  const auto p = five.model.predict({exchange.cause()});
  EXPECT_EQ(p.paired, (std::vector<int>{0, 1, 2}));
  for (Index r = 0; r < p.g.size(); ++r) {
    const auto& row = five.model.features.rows[static_cast<std::size_t>(r)];
    const double expected = row.type == RowType::frequency ? std::log(row.value) : row.value;
    EXPECT_NEAR(p.g[r], expected, 1e-9) << r;
  }
}

TEST(Pair, ExchangedNamesArePairedByEachOthersShapes) {
  // Frequencies say little: the shape of mode 4 stands under "a", that of mode 5 under "b". If the names were exchanged, "a" is
  // mode 5.
  FiveMasses five;
  const double middle = std::sqrt(FiveMasses::hertz(4) * FiveMasses::hertz(5));
  five.measure("a", 0.999 * middle, 4);
  five.measure("b", 1.001 * middle, 5);
  HandMade exchange("modes.exchange", {});
  exchange.candidate.mode = "a";
  EXPECT_EQ(five.paired(), (std::vector<int>{3, 4}));
  EXPECT_EQ(five.paired({exchange.cause()}), (std::vector<int>{4, 3}));
}

}  // namespace
}  // namespace twindeck::tests
