/// Oracles: eigenvalues of matrices of two and three degrees of freedom, by hand; a chain of springs with one of the wrong
/// sign.
#include "fe/definite.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "fe/mechanism.hpp"

namespace twindeck::fe {
namespace {

linalg::SparseMatrix lower(const Eigen::MatrixXd& dense) {
  linalg::SparseMatrix matrix = Eigen::MatrixXd(dense.triangularView<Eigen::Lower>()).sparseView();
  for (Eigen::Index i = 0; i < dense.rows(); ++i) matrix.coeffRef(i, i) += 0.0;
  matrix.makeCompressed();
  return matrix;
}

std::vector<DofLabel> dofs_of(Eigen::Index n) {
  std::vector<DofLabel> dofs;
  for (Eigen::Index i = 0; i < n; ++i)
    dofs.push_back({std::to_string(i / 3 + 1), static_cast<int>(i % 3), Eigen::Vector3d::Constant(static_cast<double>(i / 3))});
  return dofs;
}

template <class Call>
std::string refusal(Call call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string mass_refusal(const Eigen::MatrixXd& m) {
  return refusal([&] { check_mass(lower(m), dofs_of(m.rows()), "model", false); });
}

std::string stiffness_refusal(const Eigen::MatrixXd& k) {
  return refusal([&] { refuse_negative_stiffness(lower(k), dofs_of(k.rows()), "model", " as it stands"); });
}

/// Springs between neighbours and from both ends to the ground.
Eigen::MatrixXd chain(const std::vector<double>& spring) {
  const auto n = static_cast<Eigen::Index>(spring.size()) - 1;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i <= n; ++i) {
    const double s = spring[static_cast<std::size_t>(i)];
    if (i < n) k(i, i) += s;
    if (i > 0) k(i - 1, i - 1) += s;
    if (i > 0 && i < n) k(i, i - 1) -= s, k(i - 1, i) -= s;
  }
  return k;
}

TEST(Definite, MassMayBeSingular) {
  EXPECT_EQ(mass_refusal(Eigen::Vector3d(1.0, 0.0, 2.0).asDiagonal()), "");  // a degree of freedom without mass
  EXPECT_EQ(mass_refusal(Eigen::Matrix3d::Constant(4.0)), "");               // one mass that three move together
  EXPECT_EQ(mass_refusal(Eigen::Matrix3d{{2.0, 1.0, 0.0}, {1.0, 2.0, 0.0}, {0.0, 0.0, 0.0}}), "");
  // The same to six digits: its least eigenvalue is about -1e-6 of the diagonal, which is rounding.
  EXPECT_EQ(mass_refusal(Eigen::Matrix2d{{0.333333, 0.577350}, {0.577350, 1.0}}), "");
}

TEST(Definite, NegativeMassIsRefusedWithItsDegreeOfFreedom) {
  const std::string said = mass_refusal(Eigen::Vector4d(1.0, 2.0, 3.0, -0.5).asDiagonal());
  EXPECT_NE(said.find("model: node 2, direction x (degree of freedom 4): its mass is -0.5, expected 0 or more"),
            std::string::npos)
      << said;
}

TEST(Definite, IndefiniteMassIsRefused) {
  // Eigenvalues -1 and 3.
  const std::string pair = mass_refusal(Eigen::Matrix2d{{1.0, 2.0}, {2.0, 1.0}});
  EXPECT_NE(pair.find("degree of freedom 2"), std::string::npos) << pair;
  EXPECT_NE(pair.find("couples it with node 1, direction x (degree of freedom 1) by 2"), std::string::npos) << pair;
  // A coupling to a degree of freedom without mass.
  EXPECT_NE(mass_refusal(Eigen::Matrix2d{{1.0, 1e-3}, {1e-3, 0.0}}).find("couples it"), std::string::npos);
  // Every pair is sound, the three are not: eigenvalues 1.9, 1.9 and -0.8.
  const std::string three = mass_refusal(Eigen::Matrix3d{{1.0, -0.9, -0.9}, {-0.9, 1.0, -0.9}, {-0.9, -0.9, 1.0}});
  EXPECT_NE(three.find("indefinite"), std::string::npos) << three;
  EXPECT_NE(three.find("degree of freedom"), std::string::npos) << three;
}

TEST(Definite, NoMassAtAllIsRefused) {
  EXPECT_NE(mass_refusal(Eigen::Matrix2d::Zero()).find("no degree of freedom carries mass"), std::string::npos);
}

TEST(Definite, SizesThatCannotBeComputedWithAreRefused) {
  EXPECT_NE(mass_refusal(Eigen::Vector2d(1.0, 1e300).asDiagonal()).find("its mass is 1e+300"), std::string::npos);
  EXPECT_NE(mass_refusal(Eigen::Vector2d(1e-300, 1e-301).asDiagonal()).find("expected at least 1e-40"), std::string::npos);
  EXPECT_NE(stiffness_refusal(Eigen::Vector2d(1.0, std::nan("")).asDiagonal()).find("its stiffness is nan"), std::string::npos);
}

TEST(Definite, SoundStiffnessPasses) {
  EXPECT_EQ(stiffness_refusal(chain({1.0, 2.0, 3.0, 4.0})), "");
  EXPECT_EQ(stiffness_refusal(chain({0.0, 2.0, 3.0, 0.0})), "");  // free
  EXPECT_EQ(stiffness_refusal(chain({1.0, 1e9, 1e-3, 1.0})), "");
}

TEST(Definite, NegativeSpringsAreRefusedWithTheNodeThatTheyMove) {
  // -3 in the middle leaves a negative entry on the diagonal; -0.9 between 1 and 1 does not: K = [0.1 0.9; 0.9 0.1].
  const std::string diagonal = stiffness_refusal(chain({1.0, -3.0, 1.0}));
  EXPECT_NE(diagonal.find("its stiffness as it stands is -2, expected 0 or more"), std::string::npos) << diagonal;
  std::vector<double> springs(8, 1.0);
  springs[6] = -0.14;  // between masses 6 and 7, which the others join by 1/(6 + 1) = 0.1428 through the ground
  EXPECT_EQ(stiffness_refusal(chain(springs)), "");
  springs[6] = -0.15;
  const std::string unstable = stiffness_refusal(chain(springs));
  EXPECT_NE(unstable.find("the structure as it stands is unstable"), std::string::npos) << unstable;
  const bool at_its_ends = unstable.find("node 2: ") != std::string::npos || unstable.find("node 3: ") != std::string::npos;
  EXPECT_TRUE(at_its_ends) << unstable;  // degrees of freedom 6 and 7
}

TEST(Definite, AMechanismIsStillCalledOne) {
  Eigen::MatrixXd k = chain({1.0, 2.0, 0.0, 0.0});  // the third mass hangs on nothing
  const std::string said = refusal([&] { static_cast<void>(factorize_or_refuse(lower(k), dofs_of(k.rows()), "model", "")); });
  EXPECT_NE(said.find("is a mechanism: this node at (0, 0, 0) m moves freely in z"), std::string::npos) << said;
  std::vector<double> springs(8, 1.0);
  springs[6] = -0.9;
  k = chain(springs);
  const std::string unstable =
      refusal([&] { static_cast<void>(factorize_or_refuse(lower(k), dofs_of(k.rows()), "model", "")); });
  EXPECT_NE(unstable.find("unstable"), std::string::npos) << unstable;
}

TEST(Definite, ElementsWithoutNegativeMassNeedNoCheck) {
  Model model;
  model.nodes = {{1, Eigen::Vector3d::Zero()}};
  EXPECT_TRUE(mass_is_a_sum_of_squares(model));
  MatrixElement element;
  element.dofs = {{0, 0}, {0, 1}};
  element.mass = Eigen::Matrix2d{{1.0, 0.5}, {0.5, 1.0}};
  model.matrix_elements = {element};
  EXPECT_TRUE(mass_is_a_sum_of_squares(model));
  model.matrix_elements[0].mass(1, 1) = -1e-3;
  EXPECT_FALSE(mass_is_a_sum_of_squares(model));
  model.matrix_elements[0].mass = Eigen::Matrix2d{{1.0, 1.5}, {1.5, 1.0}};
  EXPECT_FALSE(mass_is_a_sum_of_squares(model));
}

}  // namespace
}  // namespace twindeck::fe
