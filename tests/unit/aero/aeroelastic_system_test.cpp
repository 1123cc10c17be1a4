// Oracles: matrices of two strips by hand; sums over strips and congruence of the coordinates; static stiffness as the change
// of the static force in a small rotation; subsets of coordinates.
#include "aero/aeroelastic_system.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "known_derivatives.hpp"
#include "linear_polar.hpp"
#include "unit/aero/static_forces.hpp"

namespace {

using namespace twindeck;

// All eighteen in Zasso's form, none like another.
aero::Derivatives18 eighteen() {
  aero::Derivatives18 values{};
  for (std::size_t i = 0; i < 18; ++i) values[i] = 0.3 + 0.17 * static_cast<double>(i) - (i % 3 == 0 ? 2.1 : 0.0);
  return values;
}

aero::StaticCoefficients six_coefficients() { return {0.2, -0.1, 0.03, 0.4, -3.0, 0.5}; }

std::vector<aero::SectionAero> two_sections() {
  return {{"foot", 4.5, aero::linear_polar(six_coefficients()), std::make_shared<aero::ConstantZasso>(eighteen())},
          {"cycle", 5.0, aero::linear_polar({0.3, 0.2, -0.01, 0.1, 2.0, 0.7}), std::make_shared<aero::FlatPlate>()}};
}

const aero::Wind east_wind{1.2, Eigen::Vector3d::UnitY()};

// A strip on each deck, at yaws of 15 and -40 degrees, and their motions by three coordinates.
std::vector<aero::Strip> two_yawed_strips() {
  return {aero::make_strip("foot", 0, 0, 3.0, {0, 0, 0}, {std::cos(15 * radians), -std::sin(15 * radians), 0}, east_wind),
          aero::make_strip("cycle", 1, 5, 2.0, {5, 0, 0}, {std::cos(40 * radians), std::sin(40 * radians), 0}, east_wind)};
}

std::vector<aero::StripMotion> two_motions() {
  std::vector<aero::StripMotion> motions(2, aero::StripMotion(6, 3));
  for (int i = 0; i < 18; ++i) {
    motions[0](i % 6, i / 6) = std::sin(1.0 + i);
    motions[1](i % 6, i / 6) = std::cos(2.0 + 3.0 * i);
  }
  return motions;
}

aero::ReducedStructure three_coordinates() {
  aero::ReducedStructure s;
  s.omega_rad_s = Eigen::Vector3d(2.0, 3.0, 5.0);
  s.damping_ratio = Eigen::Vector3d(0.01, 0.02, 0.03);
  return s;
}

aero::AeroelasticSystem two_strip_system(const std::string& rule = "A") {
  return {three_coordinates(), two_sections(), two_yawed_strips(),
          two_motions(),       east_wind,      aero::everywhere(aero::published_yaw_rule(rule))};
}

// By hand: 2 ξ ω on the diagonal, and the dashpots as they are.
TEST(ReducedStructure, DampingIsModalPlusDashpots) {
  aero::ReducedStructure s = three_coordinates();
  EXPECT_LT((s.damping() - Eigen::MatrixXd(Eigen::Vector3d(0.04, 0.12, 0.3).asDiagonal())).norm(), 1e-15);
  s.viscous.resize(3, 3);
  s.viscous << 1, 2, 3, 2, 5, 6, 3, 6, 9;
  Eigen::Matrix3d expected;
  expected << 1.04, 2, 3, 2, 5.12, 6, 3, 6, 9.3;
  EXPECT_LT((s.damping() - expected).norm(), 1e-14);
}

TEST(ReducedStructure, RestrictedKeepsTheCoordinatesListed) {
  aero::ReducedStructure s = three_coordinates();
  s.viscous.resize(3, 3);
  s.viscous << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  s.maxwell = {{10.0, 20.0, Eigen::Vector3d(1, 2, 3)}};
  const aero::ReducedStructure part = s.restricted({2, 0});
  EXPECT_EQ(part.omega_rad_s, Eigen::Vector2d(5.0, 2.0));
  EXPECT_EQ(part.damping_ratio, Eigen::Vector2d(0.03, 0.01));
  EXPECT_EQ(part.viscous, (Eigen::Matrix2d() << 9, 7, 3, 1).finished());
  ASSERT_EQ(part.maxwell.size(), 1U);
  EXPECT_EQ(part.maxwell[0].stiffness_N_m, 10.0);
  EXPECT_EQ(part.maxwell[0].damping_N_s_m, 20.0);
  EXPECT_EQ(part.maxwell[0].direction, Eigen::Vector2d(3, 1));
  EXPECT_EQ(three_coordinates().restricted({1}).viscous.size(), 0);
}

// One strip that moves by y, z and alpha themselves: the matrices are those of Eq. (8), here of one entry each by hand.
// H1 = -V* h1 and so L = -½ρVBL h1 ż; A3 = V*² a3 and so M = ½ρV²B²L a3 α; P5 = -V* p1 and so D = -½ρVBL p1 ż.
TEST(AeroelasticSystem, OneStripHasTheForcesOfEquation8) {
  const double rho = 1.2, B = 4.5, L = 3.0, V = 20.0, omega = 2.5;
  const aero::Strip strip = aero::make_strip("foot", 0, 0, L, {0, 0, 0}, Eigen::Vector3d::UnitX(), east_wind);
  aero::StripMotion own = aero::StripMotion::Zero(6, 3);
  own(1, 0) = 1.0;   // y
  own(2, 1) = 1.0;   // z
  own(3, 2) = -1.0;  // nose-up is about -X
  const aero::AeroelasticSystem system(three_coordinates(), two_sections(), {strip}, {own}, east_wind,
                                       aero::everywhere(aero::published_yaw_rule("A")));
  const auto found = system.self_excited(V, omega);
  const aero::Derivatives18 zasso = eighteen();
  EXPECT_NEAR(found.damping(1, 1), -0.5 * rho * V * B * L * zasso[0], 1e-10);           // h1
  EXPECT_NEAR(found.damping(0, 1), -0.5 * rho * V * B * L * zasso[6], 1e-10);           // p1
  EXPECT_NEAR(found.damping(2, 2), -0.5 * rho * V * B * B * B * L * zasso[13], 1e-9);   // a2
  EXPECT_NEAR(found.stiffness(2, 2), 0.5 * rho * V * V * B * B * L * zasso[14], 1e-9);  // a3
  EXPECT_NEAR(found.stiffness(1, 2), 0.5 * rho * V * V * B * L * zasso[2], 1e-9);       // h3
  // h4 goes with ω²: L = ½ρω²B²L (π/2) h4 z.
  EXPECT_NEAR(found.stiffness(1, 1), 0.5 * rho * omega * omega * B * B * L * 0.5 * std::acos(-1.0) * zasso[3], 1e-10);
}

// Virtual work: the sum over strips of R' F R with the blocks of each strip, along the rule's axes.
TEST(AeroelasticSystem, BlocksAreTheSumOverStrips) {
  for (const std::string rule : {"A", "D", "H"}) {
    const aero::AeroelasticSystem system = two_strip_system(rule);
    const auto found = system.self_excited(18.0, 3.0);
    Eigen::Matrix3d damping = Eigen::Matrix3d::Zero(), stiffness = damping;
    const auto strips = two_yawed_strips();
    for (std::size_t i = 0; i < 2; ++i) {
      const aero::YawRule& own = aero::published_yaw_rule(rule);
      const aero::StripBlock block = aero::self_excited(two_sections()[i], strips[i], own, 1.2, 18.0, 3.0);
      const Eigen::Matrix3d r = aero::kinematics(strips[i], own.axes, east_wind) * two_motions()[i];
      damping += r.transpose() * block.damping * r;
      stiffness += r.transpose() * block.stiffness * r;
    }
    EXPECT_LT((found.damping - damping).norm(), 1e-12 * damping.norm()) << rule;
    EXPECT_LT((found.stiffness - stiffness).norm(), 1e-12 * stiffness.norm()) << rule;
  }
}

TEST(AeroelasticSystem, StillAirHasNoForces) {
  const auto none = two_strip_system().self_excited(0.0, 3.0);
  EXPECT_EQ(none.damping, Eigen::Matrix3d::Zero());
  EXPECT_EQ(none.stiffness, Eigen::Matrix3d::Zero());
  EXPECT_EQ(aero::static_forces(two_strip_system(), 0.0), Eigen::Vector3d::Zero());
}

// Other coordinates q = T p of the same structure see T' Ca T, T' Ka T and T' f.
TEST(AeroelasticSystem, ForcesFollowAChangeOfCoordinates) {
  Eigen::Matrix3d t;
  t << 1, 2, 0, 0, 1, -1, 3, 0, 1;
  std::vector<aero::StripMotion> changed;
  for (const aero::StripMotion& motion : two_motions()) changed.emplace_back(motion * t);
  const aero::AeroelasticSystem before = two_strip_system("G"),
                                after(three_coordinates(), two_sections(), two_yawed_strips(), changed, east_wind,
                                      aero::everywhere(aero::published_yaw_rule("G")));
  const auto a = before.self_excited(15.0, 2.0), b = after.self_excited(15.0, 2.0);
  EXPECT_LT((b.damping - t.transpose() * a.damping * t).norm(), 1e-12 * b.damping.norm());
  EXPECT_LT((b.stiffness - t.transpose() * a.stiffness * t).norm(), 1e-12 * b.stiffness.norm());
  EXPECT_LT((aero::static_forces(after, 15.0) - t.transpose() * aero::static_forces(before, 15.0)).norm(), 1e-10);
  EXPECT_LT((after.static_stiffness() - t.transpose() * before.static_stiffness() * t).norm(), 1e-12);
}

// By hand, Eq. (7): a deck along X, one coordinate each of y, z and nose-up rotation with two strips.
TEST(AeroelasticSystem, StaticForceIsEquation7) {
  const double q = 0.5 * 1.2 * 30.0 * 30.0, B = 4.5;
  std::vector<aero::Strip> strips;
  std::vector<aero::StripMotion> motions;
  for (const double size : {1.0, 2.0}) {
    strips.push_back(aero::make_strip("foot", 0, 0, 3.0 * size, {0, 0, 0}, Eigen::Vector3d::UnitX(), east_wind));
    motions.push_back(aero::StripMotion::Zero(6, 3));
    motions.back()(1, 0) = motions.back()(2, 1) = size;
    motions.back()(3, 2) = -size;
  }
  const aero::AeroelasticSystem system(three_coordinates(), two_sections(), strips, motions, east_wind,
                                       aero::everywhere(aero::published_yaw_rule("A")));
  const double weight = 3.0 * 1.0 + 6.0 * 2.0;  // sum of L times motion
  const Eigen::Vector3d expected = q * B * weight * Eigen::Vector3d(0.2, -0.1, 0.03 * B);
  EXPECT_LT((aero::static_forces(system, 30.0) - expected).norm(), 1e-11 * expected.norm());
}

// A slow rotation changes the angle of attack and with it the static force. The polars are linear, so a difference of any size
// is exact to rounding.
TEST(AeroelasticSystem, StaticStiffnessIsTheChangeOfTheStaticForce) {
  for (const std::string name : {"A", "C", "G", "I"}) {
    const aero::YawRule& rule = aero::published_yaw_rule(name);
    const aero::AeroelasticSystem system = two_strip_system(name);
    const double step = 0.01, speed = 12.0;
    for (Eigen::Index j = 0; j < 3; ++j) {
      std::vector<aero::Strip> turned = two_yawed_strips();
      for (std::size_t i = 0; i < 2; ++i)
        turned[i].alpha_rad += step * (aero::kinematics(turned[i], rule.axes, east_wind) * two_motions()[i])(2, j);
      const aero::AeroelasticSystem other(three_coordinates(), two_sections(), turned, two_motions(), east_wind,
                                          aero::everywhere(rule));
      const Eigen::VectorXd change = (aero::static_forces(other, speed) - aero::static_forces(system, speed)) / step;
      EXPECT_LT((speed * speed * system.static_stiffness().col(j) - change).norm(), 1e-9 * change.norm()) << name << j;
    }
  }
}

// A zone of the deployment changes the strips of its deck alone.
TEST(AeroelasticSystem, EachStripTakesTheRuleOfItsPlace) {
  aero::Deployment mixed = aero::everywhere(aero::published_yaw_rule("A"));
  mixed.zones = {{"cycle", 30 * radians, aero::published_yaw_rule("D")}};
  const auto strips = two_yawed_strips();
  const aero::AeroelasticSystem system(three_coordinates(), two_sections(), strips, two_motions(), east_wind, mixed);
  EXPECT_EQ(system.rule(strips[0]).name, "A");
  EXPECT_EQ(system.rule(strips[1]).name, "D");
  const auto one = [&](std::size_t i, const std::string& rule) {
    return aero::AeroelasticSystem(three_coordinates(), two_sections(), {strips[i]}, {two_motions()[i]}, east_wind,
                                   aero::everywhere(aero::published_yaw_rule(rule)))
        .self_excited(18.0, 3.0)
        .stiffness;
  };
  const Eigen::MatrixXd sum = one(0, "A") + one(1, "D");
  EXPECT_LT((system.self_excited(18.0, 3.0).stiffness - sum).norm(), 1e-12 * sum.norm());
}

// A restricted system has the rows and columns of its coordinates.
TEST(AeroelasticSystem, RestrictedIsASubmatrix) {
  const aero::AeroelasticSystem whole = two_strip_system("I"), part = whole.restricted({2, 0});
  const std::vector<Eigen::Index> kept = {2, 0};
  EXPECT_LT((part.self_excited(15.0, 2.0).damping - whole.self_excited(15.0, 2.0).damping(kept, kept)).norm(), 1e-10);
  EXPECT_LT((aero::static_forces(part, 15.0) - aero::static_forces(whole, 15.0)(kept)).norm(), 1e-10);
  EXPECT_EQ(part.structure().omega_rad_s, Eigen::Vector2d(5.0, 2.0));
}

// Sizes that do not fit are our own mistake, and are told as one.
TEST(AeroelasticSystem, SizesThatDoNotFitAreAnInternalError) {
  const auto build = [](const std::vector<aero::Strip>& strips, const std::vector<aero::StripMotion>& motions) {
    const aero::AeroelasticSystem system(three_coordinates(), two_sections(), strips, motions, east_wind,
                                         aero::everywhere(aero::published_yaw_rule("A")));
  };
  std::vector<aero::Strip> strips = two_yawed_strips();
  EXPECT_THROW(build(strips, {two_motions()[0]}), InternalError);
  EXPECT_THROW(build(strips, {two_motions()[0], aero::StripMotion::Zero(6, 2)}), InternalError);
  strips[1].section = 2;
  EXPECT_THROW(build(strips, two_motions()), InternalError);
}

}  // namespace
