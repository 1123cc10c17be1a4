/// Oracles: the table's points, and the exponential law that a table of it stands for.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/error.hpp"
#include "two_arcs.hpp"
#include "wind/turbulence.hpp"

namespace twindeck::wind {
namespace {

TEST(CoherenceTable, IsLinearBetweenItsPointsAndZeroBeyond) {
  const CoherenceTable table(Eigen::Vector3d(0.0, 1.0, 4.0), Eigen::Vector3d(1.0, 0.4, -0.2));
  EXPECT_EQ(table.at(0.0), 1.0);
  EXPECT_NEAR(table.at(0.25), 0.85, 1e-15);
  EXPECT_NEAR(table.at(2.0), 0.2, 1e-15);
  EXPECT_EQ(table.at(4.0), -0.2);
  EXPECT_EQ(table.at(4.0001), 0.0);
}

TEST(CoherenceTable, OfTheExponentialLawGivesItsField) {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(20001, 0.0, 40.0);
  FieldDefinition own = test::two_arcs(Component::vertical);
  const FieldDefinition law = own;
  own.coherence_table = std::make_shared<const CoherenceTable>(x, (-x.array()).exp().matrix());
  for (const double f : {0.01, 0.7244, 3.0}) {
    // a chord over 0.002 errs by 0.002²/8 at most
    EXPECT_LT((coherence(own, f) - coherence(law, f)).cwiseAbs().maxCoeff(), 5.1e-7) << f;
    EXPECT_LT((coherence_factor(own, f) - coherence_factor(law, f)).cwiseAbs().maxCoeff(), 1e-3) << f;
  }
}

TEST(CoherenceTable, ThatIsNoCoherenceIsRefused) {
  // Neighbours are one, points two apart are nothing to each other: no three signals can be so.
  FieldDefinition field = test::two_arcs(Component::vertical, 3);
  field.coherence_table =
      std::make_shared<const CoherenceTable>(Eigen::Vector4d(0.0, 1.5, 1.6, 9.0), Eigen::Vector4d(1.0, 0.99, 0.0, 0.0));
  field.position_m.setZero();
  field.position_m.col(1) << 0.0, 1.0, 2.0, 3.0, 4.0, 5.0;
  field.decay = {1.0, 1.0, 1.0};
  try {
    static_cast<void>(coherence_factor(field, 19.1));
    FAIL() << "a matrix with a negative eigenvalue has no factor";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("not positive definite at 19.1 Hz"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("fall ever more slowly"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace twindeck::wind
