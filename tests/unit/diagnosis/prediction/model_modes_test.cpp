// Oracles: the closed form of masses in a row; orthonormality in the mass, where every dof is a channel.
#include <gtest/gtest.h>

#include "hand_made.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::FormModes;
using diagnosis::RowType;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMasses = 5;
constexpr double kSpring = 2e6, kMass = 1000.0;

double row_omega(int i) { return 2.0 * std::sqrt(kSpring / kMass) * std::sin(i * std::numbers::pi / (2.0 * (kMasses + 1))); }

class EqualMasses {
 public:
  explicit EqualMasses(const std::function<void(diagnosis::Places&)>& more = {})
      : model(nodes_in_a_row(kMasses), springs_in_a_row(VectorXd::Constant(kMasses + 1, kSpring)),
              kMass * MatrixXd::Identity(kMasses, kMasses), {}, more) {}
  void measure(const std::vector<int>& modes) {
    for (const int i : modes) {
      const double hertz = row_omega(i) / (2.0 * std::numbers::pi);
      const std::string label = std::to_string(i);
      model.add_row(RowType::frequency, label, -1, hertz, 0.01 * hertz);
      for (int c = 0; c < kMasses; ++c)
        model.add_row(RowType::shape, label, c, std::sin(i * (c + 1) * std::numbers::pi / (kMasses + 1)), 0.02);
    }
  }
  [[nodiscard]] FormModes found(const std::vector<diagnosis::Cause>& causes = {}, double gain_of_first = 0.0) const {
    const diagnosis::FeatureMap map = model.map();
    VectorXd x = VectorXd::Zero(std::ssize(map.nuisances()));
    for (Index j = 0; j < x.size(); ++j) {
      const auto& v = map.nuisances()[static_cast<std::size_t>(j)];
      if (v.kind == diagnosis::Nuisance::Kind::gain && v.index == 0) x[j] = gain_of_first / v.deviation;
    }
    return map.form_modes(map.base(x), causes);
  }
  [[nodiscard]] static std::vector<int> positions(const FormModes& modes) {
    std::vector<int> out;
    for (const auto& mode : modes.paired) out.push_back(mode.model_mode);
    return out;
  }
  Predicted model;
};

TEST(FormModesOfARow, AreAllModesMassNormalisedAtTheChannels) {
  EqualMasses row;
  row.measure({2, 4});
  const FormModes modes = row.found();
  ASSERT_EQ(modes.structures.front().omega_rad_s.size(), kMasses);  // measured or not
  for (int i = 0; i < kMasses; ++i) EXPECT_NEAR(modes.structures.front().omega_rad_s[i] / row_omega(i + 1), 1.0, 1e-12) << i;
  const MatrixXd inertia = kMass * modes.structures.front().shapes.transpose() * modes.structures.front().shapes;
  EXPECT_LT((inertia - MatrixXd::Identity(kMasses, kMasses)).norm(), 1e-10);
}

TEST(FormModesOfARow, EachMeasuredModeIsPairedWithItsRows) {
  EqualMasses row;
  row.measure({2, 4});
  const FormModes modes = row.found();
  EXPECT_EQ(EqualMasses::positions(modes), (std::vector<int>{1, 3}));
  EXPECT_EQ(modes.paired[1].frequency_row, 6);
  EXPECT_EQ(modes.paired[1].shape_rows, (std::vector<int>{7, 8, 9, 10, 11}));
  EXPECT_EQ(modes.paired[1].shape_channels, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(FormModesOfARow, ShowTheGainsOfTheirChannels) {
  EqualMasses row;
  row.measure({1, 2});
  const MatrixXd plain = row.found().structures.front().shapes;
  MatrixXd expected = plain;
  expected.row(0) *= 1.03;
  EXPECT_LT((row.found({}, 0.03).structures.front().shapes - expected).norm(), 1e-12 * plain.norm());
}

TEST(FormModesOfARow, AreThoseWithoutTheDamper) {
  // A damper that turns the modes changes neither frequencies nor shapes of what form errors are made of.
  EqualMasses row([](diagnosis::Places& places) {
    diagnosis::Place damper;
    damper.id = "damper:D";
    damper.directions.resize(kMasses, 1);
    damper.directions.insert(1, 0) = 1.0;
    damper.attributes = {{"damping", 6e3}, {"stiffness", 0.0}, {"series", 0.0}, {"always_on", 1.0}};
    places.sets["dampers"] = {damper};
  });
  row.measure({1, 2, 3});
  const FormModes modes = row.found();
  for (int i = 0; i < kMasses; ++i) EXPECT_NEAR(modes.structures.front().omega_rad_s[i] / row_omega(i + 1), 1.0, 1e-10) << i;
  EXPECT_EQ(EqualMasses::positions(modes), (std::vector<int>{0, 1, 2}));
}

TEST(FormModesOfARow, AnOscillatorsOwnModeIsNoneOfTheStructures) {
  // A light oscillator between modes 1 and 2 adds a mode. The measured ones stay those that move the structure.
  EqualMasses row;
  row.measure({1, 2, 3});
  const double between = 0.5 * (row_omega(1) + row_omega(2)) / (2.0 * std::numbers::pi);
  const HandMade light("element.oscillator", {{"mass", 1.0}, {"frequency", between}}, {row.model.place("nodes", "node:3")});
  const FormModes modes = row.found({light.cause()});
  EXPECT_EQ(modes.structures.front().omega_rad_s.size(), kMasses + 1);
  EXPECT_EQ(EqualMasses::positions(modes), (std::vector<int>{0, 2, 3}));
}

TEST(FormModesOfARow, AMeasuredModeTooManyHasNone) {
  EqualMasses row;
  for (int i = 0; i < kMasses + 1; ++i) row.model.add_row(RowType::frequency, std::to_string(i), -1, 1.0 + i, 0.1);
  const std::vector<int> positions = EqualMasses::positions(row.found());
  EXPECT_EQ(std::count(positions.begin(), positions.end(), -1), 1);
  EXPECT_TRUE(EqualMasses().found().paired.empty());  // without a measured mode
}

TEST(AddCovariance, AddsToTheRowsErrors) {
  EqualMasses row;
  row.measure({1});
  diagnosis::FeatureMap map = row.model.map();
  const MatrixXd before = map.covariance(), further = MatrixXd::Constant(6, 6, 0.5);
  map.add_covariance(further);
  EXPECT_LT((map.covariance() - before - further).norm(), 1e-15);
}

}  // namespace
}  // namespace twindeck::tests
