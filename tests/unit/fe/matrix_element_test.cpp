// Oracles: springs and masses in a row, condensed by hand.
#include "fe/matrix_element.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "assembly_models.hpp"
#include "core/error.hpp"

namespace twindeck::fe {
namespace {

/// Springs 2 and 3 in a row between two displacements, a mass of 5 on the unknown between them.
MatrixElement springs_in_a_row() {
  MatrixElement e;
  e.name = "row";
  e.dofs = {{0, 2}, {1, 4}};
  e.internal = 1;
  e.stiffness.resize(3, 3);
  e.stiffness << 2.0, 0.0, -2.0, 0.0, 3.0, -3.0, -2.0, -3.0, 5.0;
  e.mass = Eigen::Vector3d(1.0, 0.0, 5.0).asDiagonal();
  return e;
}

// Oracle: in a row 2·3/(2 + 3) = 1.2; the middle follows as 0.4 u1 + 0.6 u2, its mass as 5 (0.4, 0.6)'(0.4, 0.6).
TEST(MatrixElement, OwnUnknownsAreCondensed) {
  const ConservativePart part = conservative_part(springs_in_a_row());
  EXPECT_EQ(part.stiffness.dofs, (std::vector<int>{2, 10}));
  EXPECT_EQ(part.mass.dofs, part.stiffness.dofs);
  Eigen::Matrix2d k, m;
  k << 1.2, -1.2, -1.2, 1.2;
  m << 1.8, 1.2, 1.2, 1.8;
  EXPECT_LT((part.stiffness.matrix - k).norm(), 1e-14);
  EXPECT_LT((part.mass.matrix - m).norm(), 1e-14);
}

// Oracle: the symmetric part by hand, without and with an own unknown: K_uu - K_uz K_zz⁻¹ K_zu = 4 - 2·3/6 = 3.
TEST(MatrixElement, UnsymmetricMatrices) {
  MatrixElement e;
  e.dofs = {{0, 0}, {0, 1}};
  e.stiffness.resize(2, 2);
  e.stiffness << 1.0, 4.0, -2.0, 3.0;
  Eigen::Matrix2d expected;
  expected << 1.0, 1.0, 1.0, 3.0;
  EXPECT_LT((conservative_part(e).stiffness.matrix - expected).norm(), 1e-15);
  EXPECT_EQ(conservative_part(e).mass.matrix, Eigen::MatrixXd::Zero(2, 2));
  e.dofs = {{0, 0}};
  e.internal = 1;
  e.stiffness << 4.0, 2.0, 3.0, 6.0;
  EXPECT_NEAR(conservative_part(e).stiffness.matrix(0, 0), 3.0, 1e-15);
}

std::string complaint(const MatrixElement& e) {
  Model model = test::cantilever();
  model.matrix_elements.push_back(e);
  try {
    validate_matrix_elements(model);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Oracle: the contract. Each element has one fault made on purpose.
TEST(MatrixElement, FaultsAreNamed) {
  EXPECT_EQ(complaint(springs_in_a_row()), "");
  const auto says = [](const char* part, const auto& spoil) {
    MatrixElement e = springs_in_a_row();
    spoil(e);
    EXPECT_NE(complaint(e).find(part), std::string::npos) << complaint(e);
    EXPECT_NE(complaint(e).find("matrix element row"), std::string::npos) << complaint(e);
  };
  says("acts on no degree of freedom", [](MatrixElement& e) { e.dofs.clear(); });
  says("has -1 unknowns", [](MatrixElement& e) { e.internal = -1; });
  says("direction 6", [](MatrixElement& e) { e.dofs[1].direction = 6; });
  says("node number 3", [](MatrixElement& e) { e.dofs[0].node = 3; });
  says("node number -1", [](MatrixElement& e) { e.dofs[0].node = -1; });
  says("mass is 2 x 2, expected 3 x 3", [](MatrixElement& e) { e.mass = Eigen::MatrixXd::Zero(2, 2); });
  says("damping is 3 x 2", [](MatrixElement& e) { e.damping = Eigen::MatrixXd::Zero(3, 2); });
  says("stiffness holds a number that is not finite",
       [](MatrixElement& e) { e.stiffness(1, 2) = std::numeric_limits<double>::infinity(); });
  says("is singular", [](MatrixElement& e) { e.stiffness(2, 2) = 0.0; });
  says("is singular", [](MatrixElement& e) { e.stiffness.resize(0, 0); });
}

}  // namespace
}  // namespace twindeck::fe
