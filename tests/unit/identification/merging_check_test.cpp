// Oracle: modes, clusters and poles written by hand; a channel of acceleration that was not scaled keeps its shape.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "identification/merge_preger.hpp"

namespace twindeck::identification {
namespace {

using Eigen::VectorXcd;

VectorXcd shape(double a, double b) { return Eigen::Vector2cd(a, b); }

identification::MergedMode mode(double frequency_Hz, const VectorXcd& phi) {
  identification::MergedMode m;
  m.frequency_Hz = frequency_Hz;
  m.damping_ratio = 0.01;
  m.shape = phi;
  return m;
}

/// What PreGER found; its records were not scaled.
struct Preger {
  identification::Identification found;

  void cluster(double frequency_Hz, const VectorXcd& phi) {
    identification::Cluster c;
    c.frequency_Hz = frequency_Hz;
    c.damping_ratio = 0.02;
    c.shape = phi;
    found.modes.push_back(c);
  }
  void pole(int order, double frequency_Hz, double damping_ratio, const VectorXcd& phi) {
    identification::DiagramPole p;
    p.pole.order = order;
    p.pole.frequency_Hz = frequency_Hz;
    p.pole.damping_ratio = damping_ratio;
    p.pole.shape = phi;
    found.diagram.push_back(p);
  }
  [[nodiscard]] std::vector<MergingCheck> checks(const std::vector<identification::MergedMode>& modes) const {
    return merging_checks(modes, found, std::vector<records::CampaignChannel>(2), Eigen::Vector2d::Ones());
  }
};

TEST(MergingChecks, OfCloseModesEachHasItsOwn) {
  Preger preger;
  preger.cluster(1.005, shape(0.1, 1.0));
  preger.cluster(1.012, shape(1.0, 0.0));
  const auto checks = preger.checks({mode(1.0, shape(1.0, 0.1)), mode(1.01, shape(0.0, 1.0))});
  ASSERT_TRUE(checks[0].found && checks[1].found);
  EXPECT_EQ(checks[0].frequency_Hz, 1.012);
  EXPECT_EQ(checks[1].frequency_Hz, 1.005);
  EXPECT_NEAR(checks[0].mac, 1.0 / 1.01, 1e-12);
  EXPECT_EQ(checks[1].damping_ratio, 0.02);
}

// The second mode has poles of the first one's frequency within reach; they are not its own.
TEST(MergingChecks, NoModeOfPregerBelongsToTwo) {
  Preger preger;
  preger.cluster(1.002, shape(1.0, 0.3));
  for (int order = 4; order <= 10; order += 2) preger.pole(order, 1.002, 0.02, shape(1.0, 0.3));
  const auto checks = preger.checks({mode(1.0, shape(1.0, 0.25)), mode(1.004, shape(0.2, 1.0))});
  EXPECT_TRUE(checks[0].found);
  EXPECT_FALSE(checks[1].found);
}

TEST(MergingChecks, ChannelsThatAShapeLacksAreLeftOut) {
  Preger preger;
  preger.cluster(1.0, shape(1.0, 0.5));
  const auto checks = preger.checks({mode(1.0, shape(1.0, std::numeric_limits<double>::quiet_NaN()))});
  EXPECT_EQ(checks[0].mac, 1.0);
}

// Of each order the nearest pole; 3 % off is another mode. A shape's phase is arbitrary.
TEST(MergingChecks, WhereNoModeIsNearThePolesOfItsFrequencyAreTaken) {
  Preger preger;
  preger.cluster(1.03, shape(1.0, 1.0));
  preger.pole(4, 0.999, 0.011, shape(1.0, 0.5));
  preger.pole(4, 0.997, 0.5, shape(1.0, -5.0));
  preger.pole(6, 1.001, 0.012, -shape(1.0, 0.5));
  preger.pole(6, 1.02, 0.5, shape(1.0, -5.0));
  preger.pole(8, 1.004, 0.013, shape(1.0, 0.5));
  const auto checks = preger.checks({mode(1.0, shape(1.0, 0.5))});
  ASSERT_TRUE(checks[0].found);
  EXPECT_EQ(checks[0].frequency_Hz, 1.001);
  EXPECT_EQ(checks[0].damping_ratio, 0.012);
  EXPECT_NEAR(checks[0].mac, 1.0, 1e-12);
}

TEST(MergingChecks, APoleOfTwoOrdersIsNone) {
  Preger preger;
  preger.pole(4, 1.0, 0.01, shape(1.0, 0.5));
  preger.pole(6, 1.0, 0.01, shape(1.0, 0.5));
  EXPECT_FALSE(preger.checks({mode(1.0, shape(1.0, 0.5))})[0].found);
}

// Deviations (3, 4) -> 5 by hand. A shape of the other sign is the same shape; the third channel, which PoSER lacks, stays NaN
// and out of the norm: (3, 4, 12)/13 becomes (0.6, 0.8).
TEST(TakePreger, DeviationsHoldTheDifferenceAndUnknownChannelsStayUnknown) {
  const double kUnknown = std::numeric_limits<double>::quiet_NaN();
  identification::MergedMode m = mode(1.0, Eigen::Vector3cd(-0.8, -0.6, kUnknown));
  m.deviation.frequency_Hz = 0.03;
  m.deviation.damping_ratio = 0.003;
  m.deviation.shape_real = m.deviation.shape_imag = Eigen::Vector3d(0.15, 0.2, 0.0);
  MergingCheck check;
  take_preger(m, check);  // not found: all stays
  EXPECT_EQ(m.frequency_Hz, 1.0);
  check.found = true;
  check.frequency_Hz = 1.04;
  check.damping_ratio = 0.014;
  check.shape = Eigen::Vector3cd(3.0, 4.0, 12.0) / 13.0;
  take_preger(m, check);
  EXPECT_EQ(m.frequency_Hz, 1.04);
  EXPECT_EQ(m.damping_ratio, 0.014);
  EXPECT_NEAR(m.deviation.frequency_Hz, 0.05, 1e-15);
  EXPECT_NEAR(m.deviation.damping_ratio, 0.005, 1e-15);
  EXPECT_NEAR(std::abs(m.shape[0] - 0.6), 0.0, 1e-15);
  EXPECT_NEAR(std::abs(m.shape[1] - 0.8), 0.0, 1e-15);
  EXPECT_TRUE(std::isnan(m.shape[2].real()));
  EXPECT_NEAR(m.deviation.shape_real[0], 0.25, 1e-15);                  // 0.15 and 0.2
  EXPECT_NEAR(m.deviation.shape_real[1], std::hypot(0.2, 0.2), 1e-15);  // 0.2 and 0.2
  EXPECT_NEAR(m.deviation.shape_imag[1], 0.2, 1e-15);
}

}  // namespace
}  // namespace twindeck::identification
