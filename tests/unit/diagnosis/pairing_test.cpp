// Which mode of the model is which measured one. Oracle: modes of the chain in ascending order, whose even ones have a node at
// the middle mass, where the damper is.
#include <gtest/gtest.h>

#include <algorithm>

#include "chain.hpp"
#include "diagnosis/prediction/predictor.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::FeatureSet;
using diagnosis::RowType;
using Eigen::Index;
using Eigen::VectorXd;

/// Frequencies alone of modes 1 to 4 of nine masses, in two conditions.
FeatureSet two_conditions(const Chain& chain, bool damped) {
  FeatureSet f = chain.measure(chain.as_modelled());
  for (const bool second : {false, true}) {
    if (second) f.conditions.push_back(f.conditions.front());
    f.conditions.back().name = second ? "second" : "first";
    f.conditions.back().dampers_on = second && damped;
  }
  return f;
}

double hertz(const FeatureSet& f, std::size_t mode) { return f.rows[mode].value; }

std::vector<int> paired(const Chain& chain, const FeatureSet& features) {
  const diagnosis::FeatureMap map(chain.reduced(), features, {});
  const VectorXd zero = VectorXd::Zero(static_cast<Index>(map.nuisances().size()));
  return map.predict(map.base(zero), {}, false).paired;
}

TEST(Pairing, AModeThatDoesNotMoveTheChannelsIsLikeNothing) {
  // An axial mode of a girder moves vertical channels by rounding alone, which may have the shape that was measured.
  Eigen::MatrixXcd shapes(3, 3);
  shapes << 1.0, 1e-13, 0.0, 2.0, 2e-13, 0.0, 1.0, 1e-13, 0.0;
  const VectorXd mac = diagnosis::likeness(shapes, shapes.col(0));
  EXPECT_NEAR(mac[0], 1.0, 1e-12);
  EXPECT_EQ(mac[1], 0.0);
  EXPECT_EQ(mac[2], 0.0);
}

TEST(Pairing, ModesThatFrequenciesDoNotTellApartAreKnownByWhatTheDamperAdds) {
  const Chain chain({.masses = 9, .modes = 4, .shapes = false, .dampers = true});
  for (const bool third_is_damped : {true, false}) {
    FeatureSet f = two_conditions(chain, true);
    const double between = std::sqrt(hertz(f, 2) * hertz(f, 3));
    for (const char* label : {"3", "4"}) {
      f.rows.push_back({RowType::frequency, label, -1, "", 1, between, 0.01 * between, false});
      const double damping_pct = (std::string(label) == "3") == third_is_damped ? 8.0 : 0.5;
      f.rows.push_back({RowType::damping, label, -1, "", 1, damping_pct, 0.2 * damping_pct, false});
    }
    const std::vector<int> found = paired(chain, f);
    ASSERT_EQ(found.size(), 6U);
    EXPECT_EQ(found[4], third_is_damped ? 2 : 3);  // the third mode moves the middle, the fourth does not
    EXPECT_EQ(found[5], third_is_damped ? 3 : 2);
  }
}

TEST(Pairing, OneNameIsOneModeWhereTheStructureIsTheSame) {
  const Chain chain({.masses = 9, .modes = 4, .shapes = false});
  FeatureSet f = two_conditions(chain, false);
  const double low = 0.98 * hertz(f, 3);  // nearer to the fourth mode, which the calm day knows by another name
  f.rows.push_back({RowType::frequency, "3", -1, "", 1, low, 0.01 * low, false});
  EXPECT_EQ(paired(chain, f), (std::vector<int>{0, 1, 2, 3, 2}));
}

/// Standard deviation of the angle by which the shapes of modes 1 and 2 may be turned into each other where their frequencies
/// are `gap` apart: what the covariance of the shapes has more than with frequencies far apart.
double turn_left_open(const Chain& chain, double gap) {
  const auto shapes_of = [&](double ratio) {
    FeatureSet f = chain.measure(chain.as_modelled());
    const auto second = std::find_if(f.rows.begin(), f.rows.end(),
                                     [](const auto& row) { return row.type == RowType::frequency && row.mode == "2"; });
    second->value = ratio * f.rows.front().value;
    second->std = 0.003 * second->value;
    double squares = 0.0;
    for (const auto& row : f.rows)
      if (row.type == RowType::shape) squares += row.value * row.value;
    return std::pair(diagnosis::FeatureMap(chain.reduced(), f, {}).covariance().trace(), squares);
  };
  const auto [close, squares] = shapes_of(1.0 + gap);
  return std::sqrt((close - shapes_of(2.0).first) / squares);
}

TEST(Pairing, ShapesOfCloseModesAreLeftOpenUpToTheAngleFromWhichTheirNamesChange) {
  // Oracle: angles of a uniform law within 45 degrees deviate by pi / (4 sqrt 3); a mode that is turned further is the other.
  const Chain chain({.masses = 9, .modes = 2});
  EXPECT_NEAR(turn_left_open(chain, 0.05), 0.3, 1e-9);
  const double most = std::numbers::pi / (4.0 * std::sqrt(3.0));
  for (const double gap : {0.03, 0.005, 1e-4}) EXPECT_NEAR(turn_left_open(chain, gap), most, 1e-9) << gap;
}

}  // namespace
}  // namespace twindeck::tests
