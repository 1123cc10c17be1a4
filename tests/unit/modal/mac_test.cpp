#include "modal/mac.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace {

using twindeck::modal::mac;

// Oracle: hand calculation. (1, 1) against (1, 0) has the squared cosine 1/2; orthogonal shapes 0.
TEST(Mac, IsTheSquaredCosine) {
  Eigen::MatrixXd n(2, 2), x(2, 1);
  n << 1.0, 0.0, 1.0, 1.0;
  x << 1.0, 0.0;
  const Eigen::MatrixXd m = mac(n, x);
  EXPECT_DOUBLE_EQ(m(0, 0), 0.5);
  EXPECT_DOUBLE_EQ(m(1, 0), 0.0);
}

// Oracle: hand calculation. A shape turned by a phase is the same shape; its real part alone is not.
TEST(Mac, TakesComplexShapesAsTheyAre) {
  Eigen::MatrixXcd a(2, 1), turned(2, 1), plain(2, 1);
  a << std::complex<double>(1.0, 0.0), std::complex<double>(0.0, 1.0);
  turned = a * std::polar(3.0, 0.7);
  plain << 1.0, 1.0;
  EXPECT_NEAR(mac(a, turned)(0, 0), 1.0, 1e-14);
  EXPECT_NEAR(mac(a, plain)(0, 0), 0.5, 1e-14);
}

// Oracle: the contract of the header. Rows and columns are numerical by experimental; sizes and zero columns are refused.
TEST(Mac, RefusesWhatCannotBeCompared) {
  EXPECT_EQ(mac(Eigen::MatrixXd::Random(5, 3), Eigen::MatrixXd::Random(5, 2)).rows(), 3);
  EXPECT_THROW(static_cast<void>(mac(Eigen::MatrixXd::Random(5, 3), Eigen::MatrixXd::Random(4, 2))), twindeck::InputError);
  Eigen::MatrixXd zero = Eigen::MatrixXd::Random(5, 2);
  zero.col(1).setZero();
  try {
    (void)mac(Eigen::MatrixXd::Random(5, 3), zero);
    FAIL() << "a zero shape was accepted";
  } catch (const twindeck::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("experimental shape 2"), std::string::npos) << error.what();
  }
}

// Oracle: hand calculation over the channels that measured the mode: (1, 5, 1) without its middle is (1, 1), (1, 0, 0) is (1,
// 0).
TEST(MacWhereMeasured, LeavesOutTheChannelsThatDidNotMeasure) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXcd n(3, 3), x(3, 2);
  n << 1.0, 1.0, 0.0, 5.0, 0.0, 1.0, 1.0, 0.0, 0.0;
  x << 2.0, 1.0, kNone, 1.0, 2.0, 0.0;
  const Eigen::MatrixXd m = twindeck::modal::mac_where_measured(n, x);
  EXPECT_DOUBLE_EQ(m(0, 0), 1.0);
  EXPECT_DOUBLE_EQ(m(1, 0), 0.5);
  EXPECT_DOUBLE_EQ(m(2, 0), 0.0);  // zero where it was measured
  EXPECT_DOUBLE_EQ(m(0, 1), 36.0 / (27.0 * 2.0));
  EXPECT_EQ(twindeck::modal::measured_rows(x.col(0)), (std::vector<Eigen::Index>{0, 2}));
  x(0, 0) = x(2, 0) = std::complex<double>(0.0, kNone);
  try {
    (void)twindeck::modal::mac_where_measured(n, x);
    FAIL() << "a mode without a channel was accepted";
  } catch (const twindeck::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("experimental shape 1"), std::string::npos) << error.what();
  }
}

// Oracle: by construction. With M = diag(4, 1) the shapes (1/2, 0) and (0, 1) are mass-normalised and M-orthogonal.
TEST(MassWeightedMac, IsOneForTheSameMode) {
  const Eigen::MatrixXd phi = Eigen::Vector2d(0.5, 1.0).asDiagonal();
  const Eigen::MatrixXd mass = Eigen::Vector2d(4.0, 1.0).asDiagonal();
  const Eigen::MatrixXd m = twindeck::modal::mass_weighted_mac(mass * phi, phi);
  EXPECT_LT((m - Eigen::Matrix2d::Identity()).norm(), 1e-15);
}

}  // namespace
