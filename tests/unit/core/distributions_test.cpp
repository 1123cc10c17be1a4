/// Oracles: printed tables (Abramowitz and Stegun, tables 26.1, 26.8 and 26.10), the closed form of Student's law with one
/// degree of freedom.
#include "core/distributions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace twindeck {
namespace {

TEST(Distributions, NormalLawIsTheTabulatedOne) {
  EXPECT_NEAR(normal_probability(1.0), 0.841344746068543, 1e-14);
  EXPECT_NEAR(normal_tail(5.0) / 2.866515719e-7, 1.0, 1e-9);
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-13);
  EXPECT_NEAR(two_sided_normal_quantile(0.99), 2.575829303548901, 1e-13);
}

TEST(Distributions, StudentsLawIsTheTabulatedOne) {
  EXPECT_NEAR(student_quantile(1.0, 0.975), std::tan(0.475 * std::numbers::pi), 1e-9);
  EXPECT_NEAR(student_quantile(2.0, 0.975), 4.303, 5e-4);
  EXPECT_NEAR(student_quantile(120.0, 0.995), 2.617, 5e-4);
  EXPECT_NEAR(student_two_sided_tail(-2.093, 19.0), 0.05, 5e-5);
}

TEST(Distributions, TailOfChiSquaredIsTheTabulatedOne) {
  EXPECT_NEAR(chi_squared_tail(3.84146, 1.0), 0.05, 1e-6);
  EXPECT_NEAR(chi_squared_tail(18.3070, 10.0), 0.05, 1e-6);
  EXPECT_NEAR(chi_squared_tail(149.449, 100.0), 0.001, 1e-6);
  EXPECT_DOUBLE_EQ(chi_squared_tail(0.0, 5.0), 1.0);
}

}  // namespace
}  // namespace twindeck
