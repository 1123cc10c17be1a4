/// Oracles: closed means of Weibull's law, the probability factor of EN 1991-1-4 worked by hand.
#include "reliability/wind_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"

namespace twindeck::reliability {
namespace {

TEST(WindLaw, MeansOfWeibullsLawAreClosed) {
  WindLaw law;
  law.scale_m_s = 6.0;
  law.shape = 1.8;
  EXPECT_NEAR(law.average([](double v) { return v; }, 0.01), 6.0 * std::tgamma(1.0 + 1.0 / 1.8), 1e-4);
  EXPECT_NEAR(law.average([](double v) { return v * v * v; }, 0.01), 216.0 * std::tgamma(1.0 + 3.0 / 1.8), 1e-2);
  EXPECT_NEAR(law.exceedance(6.0), std::exp(-1.0), 1e-15);
}

TEST(WindLaw, TheCodesFiftyYearsWindIsTheBasicOne) {
  WindLaw law;
  law.kind = WindLaw::Kind::code;
  law.basic_m_s = 27.0;
  EXPECT_NEAR(law.exceedance(27.0), 0.02, 1e-12);
  // c_prob of 1 in 100 years: sqrt((1 - 0.2 ln(-ln 0.99))/(1 - 0.2 ln(-ln 0.98))) = 1.0386
  EXPECT_NEAR(
      law.exceedance(27.0 * std::sqrt((1.0 - 0.2 * std::log(-std::log(0.99))) / (1.0 - 0.2 * std::log(-std::log(0.98))))), 0.01,
      1e-12);
}

TEST(WindLaw, ATableSumsToOne) {
  WindLaw law;
  law.kind = WindLaw::Kind::table;
  law.speed_m_s = {2.0, 6.0, 10.0};
  law.probability = {0.5, 0.3, 0.2};
  EXPECT_NO_THROW(check_wind_law(law));
  EXPECT_NEAR(law.exceedance(5.0), 0.5, 1e-15);
  EXPECT_NEAR(law.average([](double v) { return v; }), 4.8, 1e-12);
  law.probability = {0.5, 0.3, 0.1};
  EXPECT_THROW(check_wind_law(law), InputError);
}

}  // namespace
}  // namespace twindeck::reliability
