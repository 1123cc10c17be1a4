// Oracles: structures that move freely by inspection, and the solution of a chain of springs by hand.
#include "fe/mechanism.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <functional>

#include "assembly_models.hpp"
#include "core/error.hpp"
#include "fe/assembly.hpp"

namespace twindeck::fe {
namespace {

std::string refused(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string refused(const Model& model) {
  return refused([&] {
    const ParametricSystem system = assemble(model, {});
    check_no_mechanism(system, system.initial(), model.source);
  });
}

std::vector<DofLabel> labels(int n) {
  std::vector<DofLabel> dofs;
  for (int i = 0; i < n; ++i) dofs.push_back({std::to_string(i + 1), 0, Eigen::Vector3d(i, 0.0, 0.0)});
  return dofs;
}

std::string refused(const Eigen::MatrixXd& k, const std::vector<DofLabel>& dofs) {
  return refused([&] {
    const linalg::SparseMatrix lower = Eigen::MatrixXd(k.triangularView<Eigen::Lower>()).sparseView();
    (void)factorize_or_refuse(lower, dofs, "model", " without its stays");
  });
}

// Oracle: [[2, -1], [-1, 2]] x = (1, 0) gives (2/3, 1/3).
TEST(Mechanism, SoundStiffnessIsFactorised) {
  Eigen::Matrix2d k;
  k << 2.0, 0.0, -1.0, 2.0;
  const linalg::Cholesky factor = factorize_or_refuse(k.sparseView(), labels(2), "model", "");
  EXPECT_LT((factor.solve(Eigen::Vector2d(1.0, 0.0)) - Eigen::Vector2d(2.0, 1.0) / 3.0).norm(), 1e-14);
}

// Oracle: a chain on the ground by springs of 1, the last two parts joined by one of 1e17: by inspection no mechanism, and no
// digit of the other springs is left beside it in the sum at its ends.
TEST(Mechanism, VeryStiffElementIsNamedInsteadOfAMechanismElsewhere) {
  constexpr double stiff = 1e17;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(6, 6);
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double above = i == 4 ? stiff : i == 5 ? 0.0 : 1.0, below = i == 5 ? stiff : 1.0;
    k(i, i) = above + below;
    if (i > 0) k(i, i - 1) = k(i - 1, i) = -below;
  }
  const std::string text = refused(k, labels(6));
  EXPECT_NE(text.find("very short or very stiff"), std::string::npos) << text;
  EXPECT_NE(text.find("node 5"), std::string::npos) << text;
  EXPECT_NE(text.find("node 6"), std::string::npos) << text;
  EXPECT_EQ(text.find("mechanism"), std::string::npos) << text;
}

// Oracle: two springs in a row without ground move alike; a third part on its own spring does not.
TEST(Mechanism, FreeChainIsNamedAndItsNeighbourIsNot) {
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(3, 3);
  k << 1.0, -1.0, 0.0, -1.0, 1.0, 0.0, 0.0, 0.0, 5.0;
  const std::string text = refused(k, labels(3));
  EXPECT_NE(text.find("the structure without its stays is a mechanism"), std::string::npos) << text;
  EXPECT_EQ(text.find("node 3"), std::string::npos) << text;
}

// Oracle: an unknown that nothing joins; a kind with soft rotations only is judged by its own kind.
TEST(Mechanism, EmptyDirectionIsNamed) {
  Eigen::Matrix3d k = Eigen::Vector3d(1.0, 0.0, 2.0).asDiagonal();
  std::vector<DofLabel> dofs = labels(3);
  dofs[1] = {"9", 4, Eigen::Vector3d::Zero()};
  EXPECT_NE(refused(k, dofs).find("node 9"), std::string::npos) << refused(k, dofs);
  EXPECT_NE(refused(k, dofs).find("moves freely in ry"), std::string::npos) << refused(k, dofs);
  k(1, 1) = 1e-17;  // small beside translations, but the largest of the rotations
  EXPECT_EQ(refused(k, dofs), "");
}

TEST(Mechanism, NothingFreeIsRefused) {
  EXPECT_NE(refused(Eigen::MatrixXd(0, 0), {}).find("no degree of freedom is free"), std::string::npos);
}

// Oracle: statics of frames. A cantilever on a ball joint turns about it; a torsion release in the middle spins; a soft spring
// that closes the mechanism makes it sound, whatever its size beside the beams (1e9 N/m).
TEST(Mechanism, FramesThatMoveAreNamed) {
  Model model = test::cantilever();
  EXPECT_EQ(refused(model), "");
  model.supports[0].fixed = {true, true, true, true, false, true};
  EXPECT_NE(refused(model).find("is a mechanism"), std::string::npos);
  Spring prop;
  prop.name = prop.group = "prop";
  prop.node = 2;
  prop.stiffness = 1.0;
  model.springs.push_back(prop);
  EXPECT_EQ(refused(model), "");
  model = test::cantilever();
  model.elements[1].releases = 1U << 3;
  EXPECT_NE(refused(model).find("rx"), std::string::npos) << refused(model);
}

}  // namespace
}  // namespace twindeck::fe
