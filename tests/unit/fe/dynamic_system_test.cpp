#include "fe/dynamic_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <complex>
#include <functional>

#include "assembly_models.hpp"
#include "core/error.hpp"
#include "fe/assembly_elements.hpp"

namespace twindeck::fe {
namespace {

using std::complex;
constexpr complex<double> kI(0.0, 1.0);

Spring damper(bool series, double k, double c) {
  Spring s;
  s.name = series ? "maxwell" : "kelvin";
  s.group = "damper";
  s.node = 2;
  s.direction = {0.0, 0.6, 0.8};
  s.stiffness = k;
  s.damping = c;
  s.series = series;
  return s;
}

/// Dynamic stiffness -ω² M + i ω C + K with the unknowns beyond the first n eliminated.
Eigen::MatrixXcd dynamic_stiffness(const DynamicSystem& s, Eigen::Index n, double omega) {
  const Eigen::MatrixXcd d = Eigen::MatrixXd(s.stiffness).cast<complex<double>>() -
                             omega * omega * Eigen::MatrixXd(s.mass).cast<complex<double>>() +
                             kI * omega * Eigen::MatrixXd(s.damping).cast<complex<double>>();
  const Eigen::Index own = d.rows() - n;
  if (own == 0) return d;
  return d.topLeftCorner(n, n) -
         d.topRightCorner(n, own) * d.bottomRightCorner(own, own).partialPivLu().solve(d.bottomLeftCorner(own, n));
}

Eigen::MatrixXcd dynamic_stiffness_of(const Model& model, double omega) {
  const ParametricSystem system = assemble(model, {});
  return dynamic_stiffness(assemble_dynamic(model, system, system.initial()), system.size(), omega);
}

Eigen::MatrixXcd added(const Model& model, double omega) {
  return dynamic_stiffness_of(model, omega) - dynamic_stiffness_of(test::cantilever(), omega);
}

// Oracle: closed forms of the complex stiffness along d: Kelvin k + iωc, Maxwell iωck/(k + iωc); to ground at node 3 (dofs
// 6-8).
TEST(DynamicSystem, KelvinAndMaxwellInHarmonicMotion) {
  const double k = 2e5, c = 3e4;
  const Eigen::Vector3d d(0.0, 0.6, 0.8);
  for (const double omega : {0.1, 5.0, 300.0}) {
    for (const bool series : {false, true}) {
      Model model = test::cantilever();
      model.springs.push_back(damper(series, k, c));
      const complex<double> expected = series ? kI * omega * c * k / (k + kI * omega * c) : k + kI * omega * c;
      Eigen::MatrixXcd rest = added(model, omega);
      rest.block<3, 3>(6, 6) -= expected * (d * d.transpose()).cast<complex<double>>();
      EXPECT_LT(rest.norm() / (std::abs(expected) + 1e-10 * dynamic_stiffness_of(model, omega).norm()), 1e-5);
    }
  }
}

// Oracle: a Maxwell element written as an element given by its matrices, with its inner point as an unknown of its own, is the
// same system; so is a beam, whose K and M are then seen by the modes too.
TEST(DynamicSystem, MatrixElementsReplaceOthers) {
  Model maxwell = test::cantilever();
  Spring s = damper(true, 2e5, 3e4);
  s.direction = Eigen::Vector3d::UnitZ();
  maxwell.springs.push_back(s);
  Model given = test::cantilever();
  MatrixElement e;
  e.name = "maxwell";
  e.dofs = {{2, 2}};
  e.internal = 1;
  e.stiffness = (Eigen::Matrix2d() << 2e5, -2e5, -2e5, 2e5).finished();
  e.damping = (Eigen::Matrix2d() << 0.0, 0.0, 0.0, 3e4).finished();
  given.matrix_elements = {e};
  const Eigen::MatrixXcd a = dynamic_stiffness_of(maxwell, 7.0), b = dynamic_stiffness_of(given, 7.0);
  EXPECT_LT((a - b).norm(), 1e-12 * a.norm());
  // Its spring alone gives way to a steady force: the modes see nothing of it.
  const ParametricSystem seen = assemble(given, {}), bare = assemble(test::cantilever(), {});
  EXPECT_LT((seen.stiffness({}) - bare.stiffness({})).norm(), 1e-12 * bare.stiffness({}).norm());

  const Model whole = test::cantilever();
  Model replaced = whole;
  replaced.elements.pop_back();
  MatrixElement beam;
  beam.name = "right";
  for (const int node : {1, 2})
    for (int d = 0; d < 6; ++d) beam.dofs.push_back({node, d});
  beam.stiffness = beam_stiffness(beam_geometry(whole, whole.elements[1]), beam_properties(whole, whole.elements[1]));
  beam.mass = element_mass(whole, whole.elements[1]).matrix;
  replaced.matrix_elements = {beam};
  const ParametricSystem one = assemble(whole, {}), other = assemble(replaced, {});
  EXPECT_LT((one.stiffness({}) - other.stiffness({})).norm(), 1e-14 * one.stiffness({}).norm());
  EXPECT_LT((one.mass({}) - other.mass({})).norm(), 1e-14 * one.mass({}).norm());
}

// Oracle: by definition. An unsymmetric K enters the dynamic system as it is, the modes see its symmetric part.
TEST(DynamicSystem, UnsymmetricMatricesStayUnsymmetric) {
  Model model = test::cantilever();
  MatrixElement e;
  e.name = "wind";
  e.dofs = {{2, 1}, {2, 2}};
  e.stiffness = (Eigen::Matrix2d() << 10.0, 500.0, -300.0, 20.0).finished();
  e.damping = (Eigen::Matrix2d() << 7.0, 1.0, -2.0, -8.0).finished();
  model.matrix_elements = {e};
  const ParametricSystem system = assemble(model, {}), bare = assemble(test::cantilever(), {});
  const DynamicSystem dynamic = assemble_dynamic(model, system, {});
  const Eigen::MatrixXd plain = linalg::SparseMatrix(bare.stiffness({}).selfadjointView<Eigen::Lower>());
  const Eigen::MatrixXd k = Eigen::MatrixXd(dynamic.stiffness) - plain, c = dynamic.damping;
  EXPECT_NEAR(k(7, 8), 500.0, 1e-6);
  EXPECT_NEAR(k(8, 7), -300.0, 1e-6);
  EXPECT_EQ(c(8, 7), -2.0);
  EXPECT_EQ(c(8, 8), -8.0);
  EXPECT_NEAR(Eigen::MatrixXd(system.stiffness({}))(8, 7) - plain(8, 7), 100.0, 1e-6);
}

// Oracle: a fault made on purpose; the message names the element.
TEST(DynamicSystem, FaultyMatricesAreNamed) {
  const auto message = [](const std::function<void(MatrixElement&)>& fault) -> std::string {
    Model model = test::cantilever();
    MatrixElement e;
    e.name = "wind";
    e.dofs = {{2, 1}, {2, 2}};
    e.stiffness = Eigen::Matrix2d::Identity();
    fault(e);
    model.matrix_elements = {e};
    try {
      validate(model);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message([](MatrixElement&) {}), "");
  const auto expect = [](const std::string& text, const char* part) { EXPECT_NE(text.find(part), std::string::npos) << text; };
  expect(message([](MatrixElement& e) { e.dofs.pop_back(); }), "matrix element wind: stiffness is 2 x 2, expected 1 x 1");
  expect(message([](MatrixElement& e) { e.dofs[0].node = 9; }), "acts on direction 1 of node number 9");
  expect(message([](MatrixElement& e) { e.stiffness(0, 0) = std::nan(""); }), "not finite");
  expect(message([](MatrixElement& e) { e.dofs.pop_back(), e.internal = 1, e.stiffness(1, 1) = 0.0; }),
         "leaves its own unknowns without a static position");
}

}  // namespace
}  // namespace twindeck::fe
