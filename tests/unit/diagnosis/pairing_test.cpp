// Which mode of the model is which measured one. Oracle: modes of the chain in ascending order, whose even ones have a node at
// the middle mass, where the damper is.
#include <gtest/gtest.h>

#include "chain.hpp"
#include "diagnosis/predictor.hpp"

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

}  // namespace
}  // namespace twindeck::tests
