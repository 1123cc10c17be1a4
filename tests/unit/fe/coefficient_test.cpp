#include "fe/coefficient.hpp"

#include <gtest/gtest.h>

namespace twindeck::fe {
namespace {

// Oracle: product rule by hand for a thickness in t and t³: base 3, t = 2 over 1: 3·2·8 = 48, slope 3·4 t³ = 96.
TEST(Coefficient, AParameterMayStandInSeveralFactors) {
  Coefficient c;
  c.base = 3.0;
  c.factors = {{0, 1.0, 1.0}, {0, 3.0, 1.0}, {1, -1.0, 5.0}};
  const Eigen::Vector2d theta(2.0, 5.0);
  EXPECT_NEAR(c.value(theta), 48.0, 1e-12);
  EXPECT_NEAR(c.derivative(theta, 0), 96.0, 1e-12);
  EXPECT_NEAR(c.derivative(theta, 1), -48.0 / 5.0, 1e-12);
  EXPECT_EQ(c.derivative(theta, 2), 0.0);
  EXPECT_EQ(Coefficient{}.value(theta), 1.0);
}

// Oracle: Ernst (1965) by hand.
TEST(Coefficient, ErnstModulusAndItsDerivative) {
  // gamma l = 4.8e6 N/m2, sigma = 100 MPa: q = (gamma l)²/(12 sigma³) = 1.92e-12 1/Pa, E_eq = E/(1 + qE), dE_eq/dE = 1/(1 +
  // qE)².
  const Dischinger sag{80e3, 60.0, 100e6};
  EXPECT_NEAR(sag.modulus(200e9), 200e9 / 1.384, 1.0);
  EXPECT_NEAR(sag.modulus_derivative(200e9), 1.0 / (1.384 * 1.384), 1e-12);
}

// Oracle: Ernst (1965) by hand, E_eq A with gamma ~ density and sigma = T/A; the slope by central differences, whose third
// derivative costs (h/theta)² = 1e-8.
TEST(Coefficient, StayFollowsErnst) {
  Coefficient c;
  c.base = 2.0;
  c.stay = StayModulus{
      {8e4, 50.0, 1e8}, 160e9, ParameterFactor{0, 1.0, 160e9}, ParameterFactor{1, 1.0, 8000.0}, ParameterFactor{2, 1.0, 0.01}};
  c.factors = {{2, 1.0, 0.01}};
  const auto lessened = [](double E, double weight, double stress) {
    const double sag = weight * 50.0;
    return E / (1.0 + sag * sag * E / (12.0 * stress * stress * stress));
  };
  const Eigen::Vector3d theta(200e9, 9000.0, 0.012);
  EXPECT_NEAR(c.value(theta), 2.0 * 1.2 * lessened(200e9, 9e4, 1e8 / 1.2) / lessened(160e9, 8e4, 1e8), 1e-12);
  EXPECT_EQ(c.value(Eigen::Vector3d(160e9, 8000.0, 0.01)), 2.0);
  for (int p = 0; p < 3; ++p) {
    const double h = 1e-4 * theta[p];
    Eigen::Vector3d up = theta, down = theta;
    up[p] += h, down[p] -= h;
    const double slope = (c.value(up) - c.value(down)) / (2.0 * h);
    EXPECT_NEAR(c.derivative(theta, p) / slope, 1.0, 1e-7) << p;
  }
}

// Oracle: a parameter scales what it names by theta / reference, also where a stay's modulus is twice the reference.
TEST(Coefficient, AStaysModulusKeepsItsRatioToTheParameter) {
  Coefficient c;
  c.stay = StayModulus{{8e4, 50.0, 1e8}, 160e9, ParameterFactor{0, 1.0, 80e9}, std::nullopt, std::nullopt};
  const Dischinger law = c.stay->law;
  EXPECT_NEAR(c.value(Eigen::VectorXd::Constant(1, 88e9)), law.modulus(176e9) / law.modulus(160e9), 1e-14);
}

// Oracle: a stay without weight has no sag, whatever its density's parameter does.
TEST(Coefficient, AStayWithoutWeightHasItsWholeModulus) {
  EXPECT_EQ(Dischinger({0.0, 50.0, 1e8}).modulus(160e9), 160e9);
  Coefficient c;
  c.stay = StayModulus{{0.0, 50.0, 1e8}, 160e9, std::nullopt, ParameterFactor{0, 1.0, 8000.0}, std::nullopt};
  const Eigen::VectorXd theta = Eigen::VectorXd::Constant(1, 9000.0);
  EXPECT_EQ(c.value(theta), 1.0);
  EXPECT_EQ(c.derivative(theta, 0), 0.0);
}

// Oracle: by definition.
TEST(Coefficient, IsConstantWhereNoParameterMovesIt) {
  Coefficient c;
  EXPECT_TRUE(c.is_constant());
  c.stay = StayModulus{{8e4, 50.0, 1e8}, 160e9, std::nullopt, std::nullopt, std::nullopt};
  EXPECT_TRUE(c.is_constant());
  c.stay->density = ParameterFactor{1, 1.0, 8000.0};
  EXPECT_FALSE(c.is_constant());
  EXPECT_EQ(c.derivative(Eigen::Vector2d(1.0, 8000.0), 0), 0.0);
}

}  // namespace
}  // namespace twindeck::fe
