/// Oracles: Eq. (10) worked by hand, derivatives of the static force of Eq. (7) by differences (the gust as a change of the
/// mean wind), factors of Table 11.
#include "buffeting/loads.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "known_derivatives.hpp"
#include "linear_polar.hpp"

namespace twindeck::buffeting {
namespace {

using aero::Equations;

aero::SectionAero section() {
  aero::StaticCoefficients c;
  c.drag = 0.2;
  c.lift = -0.1;
  c.moment = 0.03;
  c.drag_slope = 0.4;
  c.lift_slope = -3.0;
  c.moment_slope = 0.5;
  return {"deck", 4.5, aero::linear_polar(c), std::make_shared<aero::ConstantZasso>(aero::Derivatives18{})};
}

aero::Strip strip_at(double yaw_rad, const aero::Wind& wind) {
  // tangent turned away from the wind's normal by the yaw
  return aero::make_strip("deck", 0, 0.0, 5.0, Eigen::Vector3d::Zero(),
                          Eigen::Vector3d(std::cos(yaw_rad), -std::sin(yaw_rad), 0.0), wind);
}

TEST(BuffetingLoads, FollowEquation10) {
  const LoadFactor f =
      buffeting_factor(section(), strip_at(0.0, {}), aero::published_yaw_rule("A"), 1.25, 20.0, Equations::consistent);
  const double q = 0.5 * 1.25 * 20.0 * 4.5 * 5.0;
  LoadFactor expected;
  expected << 2.0 * 0.2, 0.4 + 0.1, -2.0 * 0.1, -3.0 + 0.2, 2.0 * 0.03 * 4.5, 0.5 * 4.5;
  EXPECT_LT((f - q * expected).norm(), 1e-10);
  const LoadFactor printed =
      buffeting_factor(section(), strip_at(0.0, {}), aero::published_yaw_rule("A"), 1.25, 20.0, Equations::as_printed);
  expected(1, 1) = -3.0 - 0.2;
  EXPECT_LT((printed - q * expected).norm(), 1e-10);
}

TEST(BuffetingLoads, AreTheChangeOfTheStaticForceInAChangedWind) {
  // A gust v' raises V; a gust w' turns the wind by w'/V: drag and lift turn with it. Linear parts by central differences of
  // Eq. (7).
  const aero::Wind wind;
  const aero::YawRule& rule = aero::published_yaw_rule("A");
  const double speed = 20.0, step = 1e-4;
  const auto force = [&](double v, double w) {
    aero::Strip strip = strip_at(0.0, wind);
    strip.alpha_rad = std::atan2(w, v);
    Eigen::Vector3d f = aero::static_force(section(), strip, rule, 1.25, std::hypot(v, w));
    const double c = std::cos(strip.alpha_rad), s = std::sin(strip.alpha_rad);
    return Eigen::Vector3d(c * f[0] - s * f[1], s * f[0] + c * f[1], f[2]);
  };
  const LoadFactor found = buffeting_factor(section(), strip_at(0.0, wind), rule, 1.25, speed, Equations::consistent);
  EXPECT_LT((found.col(0) - (force(speed + step, 0.0) - force(speed - step, 0.0)) / (2.0 * step)).norm() / found.norm(), 1e-7);
  EXPECT_LT((found.col(1) - (force(speed, step) - force(speed, -step)) / (2.0 * step)).norm() / found.norm(), 1e-7);
}

TEST(BuffetingLoads, TakeTheFactorsOfTheRule) {
  const aero::Wind wind;
  const double yaw = 0.6, c = std::cos(yaw);
  const auto of = [&](const std::string& rule, Equations equations) {
    return buffeting_factor(section(), strip_at(yaw, wind), aero::published_yaw_rule(rule), 1.25, 20.0, equations);
  };
  const LoadFactor a = of("A", Equations::consistent);
  // cosine rule: (V + v')² cos², and the angle w'/(V cos) with (V cos)²
  EXPECT_LT((of("C", Equations::consistent).col(0) - c * c * a.col(0)).norm(), 1e-10);
  EXPECT_LT((of("C", Equations::consistent).col(1) - c * a.col(1)).norm(), 1e-10);
  EXPECT_LT((of("D", Equations::as_printed) - c * c * of("A", Equations::as_printed)).norm(), 1e-10);
  // oblique strip: B' L' = B L for forces, B'² L' = B² L / cos for the moment
  EXPECT_LT((of("H", Equations::consistent).topRows<2>() - a.topRows<2>()).norm(), 1e-10);
  EXPECT_LT((of("H", Equations::consistent).row(2) - a.row(2) / c).norm(), 1e-10);
}

TEST(BuffetingLoads, AGustAcrossTurnsTheWind) {
  // Central differences of Eq. (7), as global forces, in a wind whose direction and speed are those of V and u' together.
  const aero::Wind wind;
  const double speed = 20.0, step = 1e-3;
  for (const double yaw : {0.0, 0.6, -0.4}) {
    const Eigen::Vector3d tangent(std::cos(yaw), -std::sin(yaw), 0.0);
    for (const std::string name : {"A", "C", "D", "G", "H", "I"}) {
      const aero::YawRule& rule = aero::published_yaw_rule(name);
      const auto force = [&](double u) -> Eigen::VectorXd {
        const aero::Wind turned{wind.density_kg_m3, Eigen::Vector3d(-u, speed, 0.0).normalized()};  // across = up × along = -X
        aero::Strip strip = aero::make_strip("deck", 0, 0.0, 5.0, Eigen::Vector3d::Zero(), tangent, turned);
        strip.alpha_rad = 0.02;
        return aero::kinematics(strip, rule.axes, turned).transpose() *
               aero::static_force(section(), strip, rule, wind.density_kg_m3, std::hypot(speed, u));
      };
      aero::Strip strip = strip_at(yaw, wind);
      strip.alpha_rad = 0.02;
      const Eigen::VectorXd found = across_load(section(), strip, rule, wind, speed);
      const Eigen::VectorXd expected = (force(step) - force(-step)) / (2.0 * step);
      EXPECT_LT((found - expected).norm(), 1e-6 * force(0.0).norm() / speed) << name << " at " << yaw;
      // Wind taken along the normal knows no direction; along it, a cosine is level.
      EXPECT_EQ(found.norm() > 0.0, rule.axes == aero::ForceAxes::wind || (name != "A" && yaw != 0.0)) << name << " at " << yaw;
      const Eigen::MatrixXd all = strip_load(section(), strip, rule, wind, speed, Equations::consistent,
                                             {wind::Component::along, wind::Component::vertical, wind::Component::across});
      EXPECT_EQ((all.col(2) - found).norm(), 0.0);
      EXPECT_EQ((all.leftCols(2) - aero::kinematics(strip, rule.axes, wind).transpose() *
                                       buffeting_factor(section(), strip, rule, 1.25, speed, Equations::consistent))
                    .norm(),
                0.0);
    }
  }
}

}  // namespace
}  // namespace twindeck::buffeting
