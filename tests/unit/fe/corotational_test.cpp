#include "fe/corotational.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "assembly_models.hpp"
#include "fe/bar.hpp"
#include "fe/beam.hpp"
#include "fe/large_displacement.hpp"
#include "fe/shell_triangle.hpp"
#include "fe/solid.hpp"
#include "linalg/cholesky.hpp"

namespace twindeck::fe {
namespace {

using corotational::Frame;
using corotational::Motion;

corotational::Element element_of(Frame frame) {
  corotational::Element e;
  e.frame = frame;
  if (frame == Frame::chord) {
    BeamGeometry g;
    g.node_m = {Eigen::Vector3d(1.0, 2.0, 0.5), Eigen::Vector3d(3.0, 1.0, 2.0)};
    e.start_m = {g.node_m[0], g.node_m[1]};
    e.across = beam_axes(g).row(1).transpose();
    e.stiffness = beam_stiffness(g, {200e9, 80e9, 1e-2, 4e-5, 1e-5, 5e-6, 3e-5, 6e-3, 5e-3});
  } else if (frame == Frame::quad) {
    ShellGeometry g;
    g.node_m = {Eigen::Vector3d(0, 0, 0.01), Eigen::Vector3d(1.0, 0.1, 0), Eigen::Vector3d(1.2, 0.9, 0.01),
                Eigen::Vector3d(-0.1, 1.0, 0)};
    e.start_m.assign(g.node_m.begin(), g.node_m.end());
    const ShellProperties s{30e9, 0.2, 0.1, 1.0};
    e.stiffness = shell_bending_stiffness(g, s) + shell_membrane_stiffness(g, s, DrillingRule::penalty, 0.0);
  } else if (frame == Frame::triangle) {
    TriangleGeometry g;
    g.node_m = {Eigen::Vector3d(0, 0, 0.01), Eigen::Vector3d(1.0, 0.1, 0), Eigen::Vector3d(0.3, 0.9, 0.2)};
    e.start_m.assign(g.node_m.begin(), g.node_m.end());
    const ShellProperties s{30e9, 0.2, 0.1, 1.0};
    e.stiffness = triangle_bending_stiffness(g, s) + triangle_membrane_stiffness(g, s);
  } else {
    SolidGeometry g;
    for (std::size_t i = 0; i < 8; ++i)
      g.node_m[i] = {i % 4 == 1 || i % 4 == 2 ? 1.1 : 0.05 * static_cast<double>(i), i % 4 >= 2 ? 0.8 : 0.0,
                     i >= 4 ? 0.6 : 0.0};
    e.start_m.assign(g.node_m.begin(), g.node_m.end());
    const MatrixSolid k = solid_stiffness(g, {30e9, 0.2});
    e.stiffness = Eigen::MatrixXd::Zero(48, 48);
    for (int a = 0; a < 8; ++a)
      for (int b = 0; b < 8; ++b) e.stiffness.block<3, 3>(6 * a, 6 * b) = k.block<3, 3>(3 * a, 3 * b);
  }
  return e;
}

/// The element turned by a large angle about a skew axis and moved away.
Motion turned(const corotational::Element& e, const Eigen::Matrix3d& turn) {
  Motion m;
  for (const Eigen::Vector3d& x : e.start_m) {
    m.displacement_m.emplace_back(turn * x - x + Eigen::Vector3d(5.0, -3.0, 1.0));
    m.rotation.push_back(turn);
  }
  return m;
}

void move(Motion& m, const Eigen::VectorXd& step) {
  for (std::size_t a = 0; a < m.displacement_m.size(); ++a) {
    const auto at = static_cast<Eigen::Index>(6 * a);
    m.displacement_m[a] += step.segment<3>(at);
    m.rotation[a] = corotational::rotation_of(step.segment<3>(at + 3)) * m.rotation[a];
  }
}

/// A fixed, irregular direction.
Eigen::VectorXd irregular(Eigen::Index n, double phase) {
  Eigen::VectorXd v(n);
  for (Eigen::Index i = 0; i < n; ++i) v[i] = std::sin(phase + 2.3 * static_cast<double>(i));
  return v;
}

class Corotational : public ::testing::TestWithParam<Frame> {};

// Oracle: a body that turns as a whole by 130 degrees has no forces (to the rounding of its coordinates), and the tangent there
// is the linear stiffness turned with it.
TEST_P(Corotational, ARigidTurnIsFree) {
  const corotational::Element e = element_of(GetParam());
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.27, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const corotational::Response r = corotational::respond(e, turned(e, turn), true);
  EXPECT_LT(r.force.norm(), 1e-13 * e.stiffness.norm());
  EXPECT_LT((r.rotation - turn).norm(), 1e-12);
  Eigen::MatrixXd expected = e.stiffness;
  for (Eigen::Index i = 0; i < expected.rows(); i += 3)
    for (Eigen::Index j = 0; j < expected.cols(); j += 3)
      expected.block<3, 3>(i, j) = (turn * e.stiffness.block<3, 3>(i, j) * turn.transpose()).eval();
  EXPECT_LT((r.tangent - expected).norm(), 1e-9 * expected.norm());
}

// Oracle: central differences of the forces after a large turn and a deformation of strain 1e-4, in their symmetric part (spins
// do not commute, so the whole derivative is not symmetric); the terms left out are of the order of the strain times K.
TEST_P(Corotational, TheTangentIsTheDerivative) {
  const corotational::Element e = element_of(GetParam());
  const Eigen::Index n = e.stiffness.rows();
  Motion m = turned(e, Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 1).normalized()).toRotationMatrix());
  Eigen::VectorXd deformation = 1e-4 * irregular(n, 0.7);
  if (GetParam() == Frame::box)
    for (Eigen::Index i = 3; i < n; i += 6) deformation.segment<3>(i).setZero();
  move(m, deformation);
  const Eigen::MatrixXd tangent = corotational::respond(e, m, true).tangent;
  Eigen::MatrixXd difference(n, n);
  const double h = 1e-6;
  for (Eigen::Index i = 0; i < n; ++i) {
    Motion plus = m, minus = m;
    move(plus, h * Eigen::VectorXd::Unit(n, i));
    move(minus, -h * Eigen::VectorXd::Unit(n, i));
    difference.col(i) =
        (corotational::respond(e, plus, false).force - corotational::respond(e, minus, false).force) / (2.0 * h);
  }
  difference = (0.5 * (difference + difference.transpose())).eval();
  EXPECT_LT((tangent - difference).norm(), 1e-3 * tangent.norm());
}

INSTANTIATE_TEST_SUITE_P(EachFrame, Corotational, ::testing::Values(Frame::chord, Frame::quad, Frame::triangle, Frame::box));

// Oracle: rotation vectors come back, H is the derivative of the vector by a spin from the left.
TEST(Rotation, VectorsAndSpins) {
  for (const double angle : {1e-9, 1e-3, 0.04, 0.06, 2.9}) {
    const Eigen::Vector3d v = angle * Eigen::Vector3d(0.36, -0.48, 0.8);
    EXPECT_LT((corotational::rotation_vector(corotational::rotation_of(v)) - v).norm(), 1e-14 + 1e-15 * angle);
    const Eigen::Vector3d w(0.3, 0.5, -0.2);
    const double h = 1e-6;
    const auto at = [&](double s) {
      return corotational::rotation_vector(corotational::rotation_of(s * w) * corotational::rotation_of(v));
    };
    EXPECT_LT(((at(h) - at(-h)) / (2 * h) - corotational::spin_to_vector(v) * w).norm(), 1e-8);
  }
}

// Oracle: linear statics, which large displacements approach as the load falls: relative difference of the order of the
// rotation. One of everything: plate, beams, bar, stay with given pull, rigid link, spring.
TEST(LargeDisplacement, SmallLoadsAreLinear) {
  Model model = test::one_of_everything();
  model.elements[6].pull_N = 60.0;  // a thousandth of it all
  model.gravity_m_s2 = 1e-2;
  const Eigen::VectorXd theta = initial_parameters(model);
  const PrestressState linear = find_prestress(model, theta);
  model.prestress.displacements = Displacements::large;
  const PrestressState large = find_prestress(model, theta);
  ASSERT_TRUE(large.status.converged) << large.status.message;
  EXPECT_LT((large.displacement - linear.displacement).norm(), 1e-3 * linear.displacement.norm());
  EXPECT_LT((large.axial_force_N - linear.axial_force_N).norm(), 1e-3 * linear.axial_force_N.norm());
  EXPECT_GT((large.displacement - linear.displacement).norm(), 0.0);
}

// Oracle: the same structure told in two ways, an offset of a beam and a rigid link to its end; both turn with their node.
TEST(LargeDisplacement, OffsetsAndLinksTurnWithTheirNodes) {
  Model offset = test::cantilever();
  offset.sections[0].inertia_y_m4 = 1e-7;  // soft: large rotations
  Model link = offset;
  offset.elements[1].offset_m = {Eigen::Vector3d(0.0, 0.0, 0.5), Eigen::Vector3d(0.0, 0.0, 0.5)};
  const int a = test::add_node(link, 2.0, 0.0, 0.5), b = test::add_node(link, 4.0, 0.0, 0.5);
  link.elements[1].nodes = {a, b};
  link.links = {{"a", 1, a}, {"b", 2, b}};
  const auto tip = [](const Model& model) {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(6 * std::ssize(model.nodes));
    load[6 * 2 + 2] = -2000.0;
    load[6 * 2 + 1] = 100.0;
    const Configuration c = find_equilibrium(model, load, {}, 4);
    EXPECT_TRUE(c.status.converged) << c.status.message;
    return Eigen::Matrix<double, 6, 1>(c.displacement.segment<6>(12));
  };
  const Eigen::Matrix<double, 6, 1> u = tip(offset), v = tip(link);
  EXPECT_LT((u - v).norm(), 1e-7 * u.norm());
  EXPECT_GT(u.tail<3>().norm(), 0.2);
}

// Oracle: Euler. A column loaded beyond π² EI/(4 L²) has no equilibrium that Newton can hold; the status says where and why.
TEST(LargeDisplacement, BeyondBucklingTheStatusSaysSo) {
  const Model model = test::cantilever();
  Eigen::VectorXd load = Eigen::VectorXd::Zero(18);
  const double euler = std::pow(std::numbers::pi / 4.0, 2) * 200e9 * 1e-5 / 4.0;  // L = 4 m: π² EI/(2L)²
  load[12] = -0.9 * euler;
  EXPECT_TRUE(find_equilibrium(model, load, {}, 1).status.converged);
  load[12] = -1.5 * euler;
  const Configuration c = find_equilibrium(model, load, {}, 1);
  EXPECT_FALSE(c.status.converged);
  EXPECT_NE(c.status.message.find("not positive definite at node"), std::string::npos) << c.status.message;
}

// Oracle: the finite difference of equilibrium itself. The matrices about the deformed state answer a small further load as a
// second solution of the large-displacement problem does (to the size of the strain, since they are those of the moved mesh).
TEST(LargeDisplacement, TheAssembledStateIsTheTangent) {
  Model model = test::with_steel();
  model.sections[0].inertia_y_m4 = model.sections[0].inertia_z_m4 = 1e-7;
  const int n = 32;
  for (int i = 0; i <= n; ++i) test::add_node(model, 4.0 * i / n, 0.0, 0.0);
  for (int i = 0; i < n; ++i) test::add_element(model, ElementType::beam, "girder", 0, 0, {i, i + 1});
  test::fix(model, 0);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(6 * (n + 1)), more = load;
  load[6 * n + 2] = -2000.0;
  more[6 * n + 2] = -1.0;
  const Configuration c = find_equilibrium(model, load, {}, 4);
  const Configuration next = find_equilibrium(model, load + more, {}, 1, &c);
  ASSERT_TRUE(c.status.converged && next.status.converged);
  PrestressState state;
  state.displacement = c.displacement;
  state.rotation = c.rotation;
  state.axial_force_N = c.axial_force_N;
  state.stay_pull_N = Eigen::VectorXd::Zero(n);
  const ParametricSystem system = assemble(model, state);
  linalg::Cholesky factor;
  ASSERT_TRUE(factor.factorize(system.stiffness({})).converged);
  const Eigen::VectorXd u = system.expand(factor.solve(system.expansion.transpose() * more));
  const double expected = next.displacement[6 * n + 2] - c.displacement[6 * n + 2];
  EXPECT_NEAR(u[6 * n + 2] / expected, 1.0, 5e-3);
  EXPECT_GT(std::abs(c.displacement[6 * n + 2]), 1.0);  // far from linear
}

}  // namespace
}  // namespace twindeck::fe
