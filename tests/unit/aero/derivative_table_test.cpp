// Oracles: a function that is linear in angle and in velocity, a + b alpha + c v + d alpha v, which bilinear interpolation
// gives back exactly; end values by hand; ranges and refusals by hand.
#include "aero/derivative_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/error.hpp"

namespace {

using namespace twindeck;
using aero::Convention;
using aero::OutOfRange;

const std::vector<double> table_angles = {-0.05, 0.01, 0.06};

// Of the i-th derivative: coefficients of its own, so that no curve can stand for another.
double bilinear(std::size_t i, double alpha, double v) {
  const double n = static_cast<double>(i) + 1.0;
  return n + 3.0 * n * alpha - 0.2 * n * v + (7.0 - n) * alpha * v;
}

// Curves of odd and even numbers have different velocities, as those of rotation have in some tests.
std::vector<double> velocities_of(std::size_t i) {
  return i % 2 == 0 ? std::vector<double>{0.5, 1.0, 3.0} : std::vector<double>{0.3, 2.0, 2.5, 4.0};
}

std::array<aero::DerivativeCurve, 18> bilinear_curves(const std::vector<double>& alpha = table_angles) {
  std::array<aero::DerivativeCurve, 18> curves;
  for (std::size_t i = 0; i < 18; ++i) {
    curves[i].v_over_omegaB = velocities_of(i);
    curves[i].value.resize(static_cast<Eigen::Index>(alpha.size()), static_cast<Eigen::Index>(curves[i].v_over_omegaB.size()));
    for (std::size_t a = 0; a < alpha.size(); ++a) {
      for (std::size_t k = 0; k < curves[i].v_over_omegaB.size(); ++k)
        curves[i].value(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(k)) =
            bilinear(i, alpha[a], curves[i].v_over_omegaB[k]);
    }
  }
  return curves;
}

aero::DerivativeTable bilinear_table(Convention convention, OutOfRange below = OutOfRange::refuse,
                                     OutOfRange above = OutOfRange::refuse) {
  return {convention, table_angles, bilinear_curves(), "wind/flutter.csv", below, above};
}

void expect_block(const aero::DerivativeTable& table, Convention convention, double alpha, double v,
                  const std::function<double(std::size_t)>& expected) {
  const aero::Derivatives18 found = aero::from_block(convention, table.at(alpha, v), v);
  for (std::size_t i = 0; i < 18; ++i) EXPECT_NEAR(found[i], expected(i), 1e-13 * 40) << i;  // values are below 40
}

std::string refusal_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Points of the grid, its corners, and points between. Interpolation is in the table's own convention.
TEST(DerivativeTable, ABilinearFunctionComesBackExactly) {
  for (const Convention convention : {Convention::zasso, Convention::scanlan}) {
    const aero::DerivativeTable table = bilinear_table(convention);
    for (const double alpha : {-0.05, -0.013, 0.01, 0.033, 0.06}) {
      for (const double v : {0.5, 0.7, 1.0, 1.9, 2.0, 2.7, 3.0})
        expect_block(table, convention, alpha, v, [&](std::size_t i) { return bilinear(i, alpha, v); });
    }
  }
}

// Entry H1 of Scanlan's form by hand: it stands in row L, column z of the damping.
TEST(DerivativeTable, TheFirstDerivativeIsLiftPerHeaveVelocity) {
  const aero::DerivativeBlock scanlan = bilinear_table(Convention::scanlan).at(0.02, 1.5);
  EXPECT_NEAR(scanlan.damping(1, 1), bilinear(0, 0.02, 1.5), 1e-14);
  EXPECT_NEAR(scanlan.stiffness(2, 2), bilinear(14, 0.02, 1.5), 1e-12);  // A3
  EXPECT_NEAR(bilinear_table(Convention::zasso).at(0.02, 1.5).damping(1, 1), -1.5 * bilinear(0, 0.02, 1.5), 1e-14);
}

// Each curve holds at its own end; the conversion takes the velocity that was asked for.
TEST(DerivativeTable, HoldKeepsTheEndValuesOfEachCurve) {
  const aero::DerivativeTable table = bilinear_table(Convention::zasso, OutOfRange::hold, OutOfRange::hold);
  const double alpha = 0.03;
  expect_block(table, Convention::zasso, alpha, 0.1,
               [&](std::size_t i) { return bilinear(i, alpha, velocities_of(i).front()); });
  expect_block(table, Convention::zasso, alpha, 9.0,
               [&](std::size_t i) { return bilinear(i, alpha, velocities_of(i).back()); });
  // 0.4 lies below the even curves alone, 3.5 above them alone.
  for (const double v : {0.4, 3.5}) {
    expect_block(table, Convention::zasso, alpha, v, [&](std::size_t i) {
      return bilinear(i, alpha, i % 2 == 1 ? v : v < 1.0 ? 0.5 : 3.0);
    });
  }
}

TEST(DerivativeTable, VelocitiesOutsideAreRefusedByDerivativeAndRange) {
  const auto refuses = bilinear_table(Convention::zasso, OutOfRange::hold, OutOfRange::refuse);
  EXPECT_NO_THROW(static_cast<void>(refuses.at(0.0, 0.1)));
  const std::string above = refusal_of([&] { static_cast<void>(refuses.at(0.0, 3.01)); });
  EXPECT_NE(above.find("wind/flutter.csv: h1: covers V/(omega B) from 0.5 to 3 (V/(f B) 3.14159 to 18.8496), 3.01 is needed"),
            std::string::npos)
      << above;
  const auto other = bilinear_table(Convention::scanlan, OutOfRange::refuse, OutOfRange::hold);
  EXPECT_NO_THROW(static_cast<void>(other.at(0.0, 9.0)));
  const std::string below = refusal_of([&] { static_cast<void>(other.at(0.0, 0.29)); });
  EXPECT_NE(below.find("H1: covers"), std::string::npos) << below;
  EXPECT_NO_THROW(static_cast<void>(other.at(0.0, 0.5)));  // the ends belong to the range
  EXPECT_NO_THROW(static_cast<void>(refuses.at(0.0, 3.0)));
}

// A narrow curve in the middle of the list is named by its group and number: the 13th is the first of the moment.
// Covered is what is not refused: inside all curves (0.5 to 3), beyond an end that is held, and the angles of the table.
TEST(DerivativeTable, CoversWhatItDoesNotRefuse) {
  const auto refuses = bilinear_table(Convention::zasso), holds = bilinear_table(Convention::zasso, OutOfRange::hold);
  for (const double v : {0.1, 0.4, 0.5, 2.0, 3.0, 3.01}) {
    EXPECT_EQ(refuses.covers(0.0, v), v >= 0.5 && v <= 3.0) << v;
    EXPECT_EQ(holds.covers(0.0, v), v <= 3.0) << v;
    EXPECT_EQ(refuses.covers(0.0, v), refusal_of([&] { static_cast<void>(refuses.at(0.0, v)); }).empty()) << v;
  }
  for (const double alpha : {-0.051, -0.05, 0.06, 0.061})
    EXPECT_EQ(refuses.covers(alpha, 1.0), alpha >= -0.05 && alpha <= 0.06) << alpha;
  const aero::DerivativeTable single(Convention::zasso, {0.0}, bilinear_curves({0.0}), "single");
  EXPECT_TRUE(single.covers(0.2, 1.0));
}

TEST(DerivativeTable, TheRefusedDerivativeIsNamed) {
  auto curves = bilinear_curves();
  for (auto& curve : curves) curve.v_over_omegaB.back() = 5.0;
  curves[12].v_over_omegaB.back() = 3.5;
  const aero::DerivativeTable table(Convention::zasso, table_angles, curves, "flutter.csv");
  const std::string told = refusal_of([&] { static_cast<void>(table.at(0.0, 4.0)); });
  EXPECT_NE(told.find("a1: covers V/(omega B) from 0.5 to 3.5"), std::string::npos) << told;
}

TEST(DerivativeTable, AnglesOutsideAreRefusedExceptForASingleAngle) {
  const aero::DerivativeTable table = bilinear_table(Convention::zasso, OutOfRange::hold, OutOfRange::hold);
  for (const double alpha : {-0.051, 0.061, std::nan("")}) {
    const std::string told = refusal_of([&] { static_cast<void>(table.at(alpha, 1.0)); });
    EXPECT_NE(told.find("covers -2.86479 to 3.43775 degrees"), std::string::npos) << told;
  }
  // A section tested at one angle stands for all.
  const aero::DerivativeTable single(Convention::zasso, {0.0}, bilinear_curves({0.0}), "flutter.csv");
  expect_block(single, Convention::zasso, 0.4, 1.2, [](std::size_t i) { return bilinear(i, 0.0, 1.2); });
}

// Linearity: all derivatives are multiplied, and the table it came from is left.
TEST(DerivativeTable, ScaledMultipliesAllEighteen) {
  const aero::DerivativeTable table = bilinear_table(Convention::zasso), scaled = table.scaled(-2.5);
  expect_block(scaled, Convention::zasso, 0.02, 1.3, [](std::size_t i) { return -2.5 * bilinear(i, 0.02, 1.3); });
  expect_block(table, Convention::zasso, 0.02, 1.3, [](std::size_t i) { return bilinear(i, 0.02, 1.3); });
  EXPECT_EQ(scaled.source(), table.source());
}

// The odd curves go from 0.3 to 4, the even from 0.5 to 3.
TEST(DerivativeTable, RangeIsWhatAllCurvesCover) {
  const auto range = bilinear_table(Convention::zasso).range_v_over_omegaB();
  EXPECT_EQ(range.first, 0.5);
  EXPECT_EQ(range.second, 3.0);
}

TEST(DerivativeTable, AxesThatDoNotAscendAndMissingValuesAreRefused) {
  const auto build = [](const std::vector<double>& alpha, const std::array<aero::DerivativeCurve, 18>& curves) {
    return refusal_of([&] { const aero::DerivativeTable table(Convention::zasso, alpha, curves, "flutter.csv"); });
  };
  EXPECT_EQ(build(table_angles, bilinear_curves()), "");
  EXPECT_NE(build({}, bilinear_curves()), "");
  EXPECT_NE(build({-0.05, -0.05, 0.06}, bilinear_curves()), "");
  EXPECT_NE(build({-0.05, 0.06}, bilinear_curves()), "");  // a row too many
  for (const std::vector<double>& axis : {std::vector<double>{},
                                          {0.0, 1.0, 3.0},
                                          {-1.0, 1.0, 3.0},
                                          {1.0, 1.0, 3.0},
                                          {3.0, 1.0, 0.5},
                                          {0.5, 1.0},
                                          {0.5, 1.0, 3.0, 4.0}}) {
    auto curves = bilinear_curves();
    curves[8].v_over_omegaB = axis;
    EXPECT_NE(build(table_angles, curves).find("p3"), std::string::npos) << axis.size();
  }
}

}  // namespace
