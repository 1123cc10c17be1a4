// Oracles: a section that is quasi-steady by construction breaks no law; a thin plate (Theodorsen 1935), whose derivatives tend
// to those of its polar C_L' = 2 pi, C_M' = pi/2, breaks none either; each sign turned breaks the law that holds it.
#include "aero/laws.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "aero/derivative_table.hpp"
#include "aero/polar.hpp"
#include "known_derivatives.hpp"

namespace {

using namespace twindeck;

constexpr double pi = std::numbers::pi;
const aero::QuasiSteady::Arms arms{-0.06, -0.06, 0.3};

aero::Polar polar(double drag = 0.2, double lift_slope = 4.0, double moment_slope = 0.9) {
  std::vector<double> alpha;
  std::vector<aero::StaticCoefficients> rows;
  for (int i = -4; i <= 4; ++i) {
    const double a = 0.02 * i;
    alpha.push_back(a);
    rows.push_back({drag, 0.1 + lift_slope * a, 0.02 + moment_slope * a, 0.0, lift_slope, moment_slope});
  }
  return {alpha, rows, "polar.csv"};
}

// A table of a model at two angles and up to V/(f B) = `highest`, its values changed by `change(number, value)` in Zasso's
// form.
aero::DerivativeTable table(
    const aero::FlutterDerivatives& model, double highest = 40.0,
    const std::function<double(int, double)>& change = [](int, double value) { return value; }) {
  const std::vector<double> alpha = {-0.04, 0.0, 0.04}, v = {0.5 / (2 * pi), 0.5 * highest / (2 * pi), highest / (2 * pi)};
  std::array<aero::DerivativeCurve, 18> curves;
  for (std::size_t d = 0; d < 18; ++d) {
    curves[d].v_over_omegaB = v;
    curves[d].value.resize(3, 3);
    for (Eigen::Index i = 0; i < 3; ++i) {
      for (Eigen::Index j = 0; j < 3; ++j) {
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
        const auto zasso = aero::from_block(aero::Convention::zasso, model.at(alpha[a], v[b]), v[b]);
        curves[d].value(i, j) = change(static_cast<int>(d), zasso[d]);
      }
    }
  }
  return {aero::Convention::zasso, alpha, curves, "flutter.csv"};
}

std::vector<std::string> broken(const aero::Polar& p, const aero::DerivativeTable& t, const aero::QuasiSteady::Arms& a = arms) {
  std::vector<std::string> names;
  for (const aero::BrokenLaw& law : aero::broken_laws(p, t, a)) names.push_back(law.law);
  return names;
}

TEST(AeroLaws, AQuasiSteadySectionBreaksNone) {
  EXPECT_TRUE(broken(polar(), table(aero::QuasiSteady(polar(), arms))).empty());
  EXPECT_TRUE(broken(polar(0.2, -4.0), table(aero::QuasiSteady(polar(0.2, -4.0), arms))).empty()) << "lift may fall: galloping";
}

TEST(AeroLaws, AThinPlateBreaksNone) {
  // Theodorsen's plate has no mean lift, so it is held against its polar at zero angle alone; C(k) at V/(f B) = 60 is 0.91 -
  // 0.15i.
  std::vector<aero::StaticCoefficients> rows;
  for (const double a : {-0.01, 0.0, 0.01}) rows.push_back({1e-3, 2 * pi * a, pi / 2 * a, 0.0, 2 * pi, pi / 2});
  const aero::Polar plate({-0.01, 0.0, 0.01}, rows, "plate");
  for (const double highest : {15.0, 60.0}) {
    for (const aero::BrokenLaw& law : aero::broken_laws(plate, table(aero::FlatPlate(), highest), {}))
      ADD_FAILURE() << law.told;
  }
}

TEST(AeroLaws, EachTurnedSignBreaksTheLawThatHoldsIt) {
  const aero::QuasiSteady model(polar(), arms);
  for (const int d : {0, 1, 2, 6, 10, 12, 14}) {  // h1 h2 h3 p1 p5 a1 a3
    const auto turned = table(model, 40.0, [d](int i, double value) { return i == d ? -value : value; });
    const auto names = broken(polar(), turned);
    EXPECT_EQ(names.size(), 1U) << d;
    EXPECT_EQ(names.front(), "quasi_steady") << d;
  }
  const auto a2 = table(model, 40.0, [](int i, double value) { return i == 13 ? -value : value; });
  EXPECT_EQ(broken(polar(), a2).front(), "pitching_damping");
  EXPECT_EQ(broken(polar(), a2, {}), std::vector<std::string>{"pitching_damping"}) << "also where its arm is not known";
}

TEST(AeroLaws, AllOfTheMomentTurnedBreaksItsSlope) {
  const aero::Polar turned = polar(0.2, 4.0, -0.9);
  EXPECT_EQ(broken(turned, table(aero::QuasiSteady(turned, {-0.06, -0.06, 0.0})), {-0.06, -0.06, 0.0}),
            std::vector<std::string>{"moment_slope"});
}

TEST(AeroLaws, SlopesAreThoseOfTheCoefficients) {
  const aero::Polar right = polar();
  std::vector<aero::StaticCoefficients> rows;
  for (const double a : right.alpha_rad()) rows.push_back({0.2, 0.1 + 4.0 * a, 0.02 + 0.9 * a, 0.0, 4.0, -0.9});
  const aero::Polar turned(right.alpha_rad(), rows, "polar.csv");
  const auto laws = aero::broken_laws(turned, table(aero::QuasiSteady(polar(), arms)), arms);
  ASSERT_FALSE(laws.empty());
  EXPECT_EQ(laws.front().law, "slopes");
  EXPECT_NE(laws.front().told.find("dC_M/dalpha is given as -0.9 per radian"), std::string::npos) << laws.front().told;
}

TEST(AeroLaws, DragIsPositive) {
  const aero::Polar turned = polar(-0.2);
  EXPECT_EQ(broken(turned, table(aero::QuasiSteady(turned, arms))), std::vector<std::string>{"drag"});
}

TEST(AeroLaws, BelowTheSteadyRangeOnlySignsOfRotationAreHeld) {
  const aero::QuasiSteady model(polar(), arms);
  const auto other_size = [](int i, double value) { return i == 14 || i == 0 ? 3.0 * value : value; };
  EXPECT_TRUE(broken(polar(), table(model, 10.0, other_size)).empty());
  EXPECT_EQ(broken(polar(), table(model, 40.0, other_size)), std::vector<std::string>{"quasi_steady"});
  const auto turned = [](int i, double value) { return i == 14 ? -value : value; };
  EXPECT_EQ(broken(polar(), table(model, 10.0, turned)), std::vector<std::string>{"quasi_steady"});
}

}  // namespace
