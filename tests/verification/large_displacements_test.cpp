/// Large displacements against closed forms and published paths, and their observed convergence.
#include "fe/large_displacement.hpp"
#include "verification_models.hpp"

namespace twindeck::fe::verification {
namespace {

/// The elastica of a cantilever of length 1 under a dead load across its tip, θ'' = -p cos θ, θ(0) = 0, θ'(1) = 0 (Bisshopp and
/// Drucker 1945), by shooting with Runge-Kutta: an integration of its own, with no elements.
struct Tip {
  double across, shortening;
};
Tip elastica(double p) {
  const auto shoot = [p](double curvature, Tip& tip) {
    Eigen::Vector4d y(0, curvature, 0, 0);  // θ, θ', ∫ sin θ, ∫ cos θ
    const auto rate = [p](const Eigen::Vector4d& s) {
      return Eigen::Vector4d(s[1], -p * std::cos(s[0]), std::sin(s[0]), std::cos(s[0]));
    };
    const int n = 2000;
    const double h = 1.0 / n;
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector4d a = rate(y), b = rate(y + 0.5 * h * a), c = rate(y + 0.5 * h * b), d = rate(y + h * c);
      y += h / 6.0 * (a + 2 * b + 2 * c + d);
    }
    tip = {y[2], 1.0 - y[3]};
    return y[1];
  };
  double low = 0.0, high = p;
  Tip tip{};
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (shoot(middle, tip) < 0.0 ? low : high) = middle;
  }
  return tip;
}

/// Cantilever of length 1 and EI = 1 (round and slender: EA = 1e6), n beams; tip load p across.
Tip cantilever_of_beams(int n, double p) {
  Model model = with_material(1.0, 0.0, 0.0);
  model.sections.push_back(beam_section(1e6, 1.0, 1.0, 1.0, 0.0));
  const int foot = add_node(model, 0, 0, 0), tip = add_beams(model, foot, {1, 0, 0}, n);
  fix(model, foot, {0, 1, 2, 3, 4, 5});
  Eigen::VectorXd load = no_load(model);
  load[6 * tip + 2] = p;
  const Configuration c = find_equilibrium(model, load, {}, 5);
  EXPECT_TRUE(c.status.converged) << c.status.message;
  return {c.displacement[6 * tip + 2], -c.displacement[6 * tip]};
}

// 0.5 %: forty chords; the error falls as 1/n².
TEST(LargeDisplacements, CantileverAgainstTheElastica) {
  for (const double p : {1.0, 2.0, 5.0, 10.0}) {
    const Tip exact = elastica(p), ours = cantilever_of_beams(40, p);
    check(fmt::format("elastica, PL²/EI = {:g}, 40 beams: deflection / L", p), exact.across, ours.across, 5e-3);
    check(fmt::format("elastica, PL²/EI = {:g}, 40 beams: shortening / L", p), exact.shortening, ours.shortening, 5e-3);
  }
  // Mattiasson (1981), IJNME 17, 145-153, printed: a check of the shooting.
  EXPECT_NEAR(elastica(10.0).across, 0.81061, 1e-5);
  EXPECT_NEAR(elastica(10.0).shortening, 0.55500, 1e-5);
}

TEST(LargeDisplacements, ConvergenceOfTheElastica) {
  const Tip exact = elastica(5.0);
  const double coarse = cantilever_of_beams(10, 5.0).across - exact.across,
               fine = cantilever_of_beams(20, 5.0).across - exact.across;
  check("observed order of co-rotational beams (elastica, 10 to 20)", 2.0, std::log2(coarse / fine), 0.1);
}

// A couple rolls the cantilever up: M L/EI = π makes half a circle, tip at (0, 2L/π): rotations beyond any small angle.
TEST(LargeDisplacements, HalfACircle) {
  Model model = with_material(1.0, 0.0, 0.0);
  model.sections.push_back(beam_section(1e6, 1.0, 1.0, 1.0, 0.0));
  const int foot = add_node(model, 0, 0, 0), tip = add_beams(model, foot, {1, 0, 0}, 20);
  fix(model, foot, {0, 1, 2, 3, 4, 5});
  fix_everywhere(model, {1, 3, 5});  // a couple about a fixed axis is no conservative load out of the plane
  Eigen::VectorXd load = no_load(model);
  load[6 * tip + 4] = -0.999 * kPi;  // the rotation vector is unique below π
  const Configuration c = find_equilibrium(model, load, {}, 5);
  ASSERT_TRUE(c.status.converged) << c.status.message;
  const double r = 1.0 / (0.999 * kPi);
  check("cantilever rolled to half a circle, 20 beams: height / L", r * (1.0 - std::cos(0.999 * kPi)),
        c.displacement[6 * tip + 2], 5e-3);
}

// Bathe and Bolourchi (1979): arc of 45 degrees, R = 100, 1 × 1, E = 1e7, ν = 0, load across its plane; tip at P = 300 and 600
// after Simo and Vu-Quoc (1986): (22.33, 58.84, 40.08), (15.79, 47.23, 53.37). Eight straight elements: 1 % of the radius.
TEST(LargeDisplacements, FortyFiveDegreeBend) {
  Model model = with_material(1e7, 0.0, 0.0);
  model.sections.push_back(beam_section(1.0, 1.0 / 12, 1.0 / 12, 0.1406, 1.0 / 1.2));
  for (int i = 0; i <= 8; ++i) {
    const double angle = 0.25 * kPi * i / 8;
    add_node(model, 100 * (1 - std::cos(angle)), 100 * std::sin(angle), 0);
    if (i > 0) add_element(model, ElementType::beam, "arc", 0, 0, {i - 1, i});
  }
  fix(model, 0, {0, 1, 2, 3, 4, 5});
  const std::vector<std::pair<double, Eigen::Vector3d>> path = {{300.0, {22.33, 58.84, 40.08}}, {600.0, {15.79, 47.23, 53.37}}};
  for (const auto& [p, target] : path) {
    Eigen::VectorXd load = no_load(model);
    load[6 * 8 + 2] = p;
    const Configuration c = find_equilibrium(model, load, {}, 6);
    ASSERT_TRUE(c.status.converged) << c.status.message;
    const Eigen::Vector3d tip = model.nodes[8].x_m + c.displacement.segment<3>(48);
    for (int d = 0; d < 3; ++d)
      check(fmt::format("45 degree bend, 8 beams, P = {:g}: tip {}", p, "xyz"[d]), target[d], tip[d], 0.02);
  }
}

// Sze, Liu and Lo (2004), FEAD 40, 1551-1569, problem 3.1: strip 10 × 1 × 0.1, E = 1.2e6, ν = 0, end shear 4: tip 6.698 across,
// 3.286 back. Shells (16 × 1) and solids (40 × 1 × 1); the shell's printed value is that of the elastica with PL²/EI = 4.
TEST(LargeDisplacements, StripOfShellsAndOfSolids) {
  Model shells = with_material(1.2e6, 0.0, 0.0);
  add_shells(shells, 16, 1, 0.1, [](double x, double y) { return Eigen::Vector3d(10 * x, y, 0); });
  for (const int node : {0, 17}) fix(shells, node, {0, 1, 2, 3, 4, 5});
  Model solids = with_material(1.2e6, 0.0, 0.0);
  add_solids(solids, 40, 1, 1, [](double x, double y, double z) { return Eigen::Vector3d(10 * x, y, 0.1 * z); });
  std::vector<int> solid_tip;
  for (int k = 0; k < 4; ++k) {
    fix(solids, 41 * k, {0, 1, 2});
    solid_tip.push_back(41 * k + 40);
  }
  struct Case {
    const char* name;
    const Model& model;
    std::vector<int> tip;
  };
  for (const Case& each : {Case{"16x1 shells", shells, {16, 33}}, Case{"40x1x1 solids", solids, solid_tip}}) {
    Eigen::VectorXd load = no_load(each.model);
    for (const int node : each.tip) load[6 * node + 2] = 4.0 / static_cast<double>(each.tip.size());
    const Configuration c = find_equilibrium(each.model, load, {}, 8);
    ASSERT_TRUE(c.status.converged) << c.status.message;
    Eigen::Vector3d u = Eigen::Vector3d::Zero();
    for (const int node : each.tip) u += c.displacement.segment<3>(6 * node) / static_cast<double>(each.tip.size());
    check(fmt::format("strip under end shear, {}: across", each.name), 6.698, u.z(), 0.01);
    check(fmt::format("strip under end shear, {}: back", each.name), 3.286, -u.x(), 0.01);
  }
}

}  // namespace
}  // namespace twindeck::fe::verification
