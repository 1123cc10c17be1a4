#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "assembly_models.hpp"
#include "core/error.hpp"
#include "fe/assembly.hpp"
#include "fe/beam.hpp"
#include "fe/beam_frame.hpp"
#include "fe/static_stage.hpp"

namespace twindeck::fe {
namespace {

constexpr double kE = 210e9, kG = 80e9, kPi = std::numbers::pi;

/// A round bar.
BeamStiffnessProperties round_bar(double d, bool shear = false) {
  const double a = kPi * d * d / 4, i = kPi * std::pow(d, 4) / 64;
  return {kE, kG, a, i, i, 0.0, 2 * i, shear ? 0.9 * a : 0.0, shear ? 0.9 * a : 0.0};
}

BeamGeometry along(const Eigen::Vector3d& axis) {
  BeamGeometry g;
  g.node_m = {Eigen::Vector3d(1.0, 2.0, 3.0), Eigen::Vector3d(Eigen::Vector3d(1.0, 2.0, 3.0) + axis)};
  return g;
}

// Oracle: the truncated cone as a cantilever, closed forms: tip deflection 64 P L³/(3 π E d₂ d₁³) (d₁ at the clamp), extension
// 4 P L/(π E d₁ d₂), twist 32 T L (d₁² + d₁ d₂ + d₂²)/(3 π G d₁³ d₂³), volume π L (d₁² + d₁ d₂ + d₂²)/12.
TEST(TaperedBeam, TruncatedCone) {
  const double l = 3.0, d1 = 0.4, d2 = 0.2;
  const TaperedProperties cone{round_bar(d1), round_bar(d2)};
  const BeamGeometry g = along({l, 0.0, 0.0});
  const Matrix12 k = tapered_beam_stiffness(g, cone);
  const Matrix6 tip = k.bottomRightCorner<6, 6>();
  const Matrix6 flexibility = Eigen::MatrixXd(tip).partialPivLu().inverse();
  const double bending = 64 * l * l * l / (3 * kPi * kE * d2 * d1 * d1 * d1);
  EXPECT_NEAR(flexibility(1, 1) / bending, 1.0, 1e-8);
  EXPECT_NEAR(flexibility(2, 2) / bending, 1.0, 1e-8);
  EXPECT_NEAR(flexibility(0, 0) / (4 * l / (kPi * kE * d1 * d2)), 1.0, 1e-8);
  const double squares = d1 * d1 + d1 * d2 + d2 * d2;
  EXPECT_NEAR(flexibility(3, 3) / (32 * l * squares / (3 * kPi * kG * std::pow(d1 * d2, 3))), 1.0, 1e-8);
  const double mass = 7850.0 * kPi * l * squares / 12.0;
  for (const Matrix12& m : {tapered_beam_mass(g, cone, 7850.0, false), tapered_beam_mass_lumped(g, cone, 7850.0, true)}) {
    Vector12 up = Vector12::Zero();
    up[2] = up[8] = 1.0;
    EXPECT_NEAR(up.dot(m * up) / mass, 1.0, 1e-12);
  }
  Vector12 stretch = Vector12::Zero();
  stretch[6] = 1e-3;
  EXPECT_NEAR(tapered_beam_axial_force(g, cone, stretch) / (1e-3 * kPi * kE * d1 * d2 / (4 * l)), 1.0, 1e-8);
}

// Oracle: equal ends are the uniform beam, shear flexible and skew in space; a rigid motion meets no resistance.
TEST(TaperedBeam, EqualEndsAndRigidMotions) {
  BeamGeometry g = along({1.0, 2.0, -0.7});
  g.offset_m = {Eigen::Vector3d(0.0, 0.1, 0.0), Eigen::Vector3d(0.1, 0.0, 0.2)};
  g.releases = 1U << 10;
  BeamStiffnessProperties p = round_bar(0.3, true);
  p.inertia_yz_m4 = 0.3 * p.inertia_y_m4;
  p.inertia_z_m4 *= 2.0;
  const Matrix12 uniform = beam_stiffness(g, p), same = tapered_beam_stiffness(g, {p, p});
  EXPECT_NEAR((same - uniform).norm() / uniform.norm(), 0.0, 1e-12);
  const Matrix12 mass = beam_mass(g, p, 7850.0, true);
  EXPECT_NEAR((tapered_beam_mass(g, {p, p}, 7850.0, true) - mass).norm() / mass.norm(), 0.0, 1e-12);
  const Matrix12 k = tapered_beam_stiffness(g, {p, round_bar(0.2, true)});
  Eigen::Matrix<double, 12, 6> rigid = Eigen::Matrix<double, 12, 6>::Zero();
  for (int i = 0; i < 2; ++i) {
    rigid.block<6, 6>(6 * i, 0).setIdentity();
    rigid.block<3, 3>(6 * i, 3) = -beam::cross_matrix(g.node_m[static_cast<std::size_t>(i)]);
  }
  EXPECT_LT((k * rigid).norm() / k.norm(), 1e-13);
}

// Oracle: in a model the taper acts like many short uniform beams with the section of their middle (error ~ 1/n²), and an area
// parameter must name both of its ends.
TEST(TaperedBeam, InAModel) {
  const auto section = [](const char* name, double d) {
    const BeamStiffnessProperties p = round_bar(d);
    Section s;
    s.name = name;
    s.area_m2 = p.area_m2;
    s.inertia_y_m4 = s.inertia_z_m4 = p.inertia_y_m4;
    s.torsion_m4 = p.torsion_m4;
    return s;
  };
  Model model = test::with_steel();
  model.sections = {section("foot", 0.4), section("tip", 0.2)};
  test::add_node(model, 0, 0, 0);
  test::add_node(model, 0, 0, 3);
  test::add_element(model, ElementType::beam, "mast", 0, 0, {0, 1}).section2 = 1;
  test::fix(model, 0);
  model.parameters = {{"A", Target::area, {"foot", "tip"}, "m2", model.sections[0].area_m2, 1e-3, 1.0}};
  const ParametricSystem system = assemble(model, {});
  const Eigen::MatrixXd k = linalg::SparseMatrix(system.stiffness(system.initial()).selfadjointView<Eigen::Lower>());
  const double d1 = 0.4, d2 = 0.2;
  EXPECT_NEAR(Eigen::MatrixXd(k).partialPivLu().inverse()(0, 0) / (64 * 27.0 / (3 * kPi * 200e9 * d2 * d1 * d1 * d1)), 1.0,
              1e-8);
  EXPECT_NEAR(dead_load(model).sum() / (-10.0 * 8000.0 * kPi * 3.0 * (0.16 + 0.08 + 0.04) / 12.0), 1.0, 1e-9);
  model.parameters[0].of = {"foot"};
  EXPECT_THROW(validate(model), InputError);
}

// Oracle: a body that moves as a whole has ½ m v² however its mass is spread, and lumped masses are diagonal. The frequencies
// of a cantilever with lumped mass rise towards Euler's 1.87510² √(EI/ρA L⁴) as 1/n².
TEST(LumpedMass, TotalAndConvergence) {
  Model model = test::one_of_everything();
  const auto total = [&model] {
    const ParametricSystem system = assemble(model, {});
    const linalg::SparseMatrix m = system.mass(system.initial()).selfadjointView<Eigen::Lower>();
    Eigen::VectorXd up = Eigen::VectorXd::Zero(system.size());
    for (std::size_t i = 0; i < system.dofs.size(); ++i)
      if (system.dofs[i].direction == 2) up[static_cast<Eigen::Index>(i)] = 1.0;
    return up.dot(m * up);
  };
  model.supports.clear();
  const double consistent = total();
  model.formulation.lumped_mass = true;
  EXPECT_NEAR(total() / consistent, 1.0, 1e-12);

  const double exact = std::pow(1.8751040687, 2) * std::sqrt(200e9 * 4e-5 / (8000 * 0.01 * 256.0));
  std::array<double, 2> error{};
  for (const int n : {4, 8}) {
    Model beam = test::with_steel();
    beam.formulation.lumped_mass = true;
    for (int i = 0; i <= n; ++i) test::add_node(beam, 4.0 * i / n, 0, 0);
    for (int i = 0; i < n; ++i) test::add_element(beam, ElementType::beam, "girder", 0, 0, {i, i + 1});
    test::fix(beam, 0);
    for (int i = 1; i <= n; ++i) test::fix(beam, i, {true, true, false, true, false, true});
    const ParametricSystem system = assemble(beam, {});
    const Eigen::MatrixXd k = linalg::SparseMatrix(system.stiffness({}).selfadjointView<Eigen::Lower>());
    const Eigen::MatrixXd m = linalg::SparseMatrix(system.mass({}).selfadjointView<Eigen::Lower>());
    EXPECT_TRUE(m.isDiagonal());
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(m, k, Eigen::EigenvaluesOnly);
    const double omega = 1.0 / std::sqrt(solver.eigenvalues()[m.rows() - 1]);
    error[n == 8] = omega / exact - 1.0;
  }
  EXPECT_LT(error[1], 0.0);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2.0, 0.1);
}

}  // namespace
}  // namespace twindeck::fe
