// Oracle: rigid-body motion written out by hand, and the dense transformation T'KT of a hand-made T.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/error.hpp"
#include "fe/assembly.hpp"
#include "fe/dof_map.hpp"
#include "test_assembly_models.hpp"

namespace twindeck::fe {
namespace {

std::string refusal_of_links(const Model& model) {
  try {
    static_cast<void>(make_dof_map(model));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(DofMap, SlaveAtTheEndOfAChainMovesRigidlyWithTheMaster) {
  Model model = test::cantilever();
  const int middle = test::add_node(model, 4.0, 1.0, 0.0), end = test::add_node(model, 4.0, 1.0, 3.0);
  model.links.push_back({"second", middle, end});  // listed before the link that it hangs on
  model.links.push_back({"first", 2, middle});
  const DofMap map = make_dof_map(model);
  ASSERT_EQ(map.dofs.size(), 12U);
  EXPECT_EQ(map.root[static_cast<std::size_t>(end)], 2);
  // Arm (0, 1, 3) m: rotation of 0.1 rad about x moves it by theta × r = (0, -0.3, 0.1); about y by (0.3, 0, 0); z by (-0.1, 0,
  // 0).
  for (int d = 0; d < 3; ++d) {
    const Eigen::VectorXd u = map.expansion * (0.1 * Eigen::VectorXd::Unit(12, 9 + d));
    const std::array<Eigen::Vector3d, 3> expected = {Eigen::Vector3d(0, -0.3, 0.1), Eigen::Vector3d(0.3, 0, 0),
                                                     Eigen::Vector3d(-0.1, 0, 0)};
    EXPECT_LT((u.segment<3>(6 * end) - expected[static_cast<std::size_t>(d)]).norm(), 1e-15);
    EXPECT_LT((u.segment<3>(6 * end + 3) - 0.1 * Eigen::Vector3d::Unit(d)).norm(), 1e-15);
  }
}

TEST(DofMap, EliminatedLinkEqualsTheTransformationByHand) {
  // A spring k at the end of a bracket r = (0, 2, 0) under the tip of the cantilever: adds k b b', b = (z: 1, rx: 2).
  Model model = test::cantilever();
  const ParametricSystem bare = assemble(model, {});
  const int bracket = test::add_node(model, 4.0, 2.0, 0.0);
  model.links.push_back({"bracket", 2, bracket});
  Spring spring;
  spring.name = "k";
  spring.node = bracket;
  spring.stiffness = 5e4;
  model.springs.push_back(spring);
  const ParametricSystem system = assemble(model, {});
  Eigen::VectorXd b = Eigen::VectorXd::Zero(12);
  b[8] = 1.0, b[9] = 2.0;
  const Eigen::MatrixXd expected = test::full(bare.stiffness(bare.initial())) + 5e4 * b * b.transpose();
  EXPECT_LT((test::full(system.stiffness(system.initial())) - expected).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(DofMap, RotationsWhereOnlyBarsMeetAreLeftOut) {
  Model model = test::with_steel();
  for (int i = 0; i < 3; ++i) test::add_node(model, i == 0 ? -3.0 : 3.0 * (i - 1), 0.0, i == 1 ? 4.0 : 0.0);
  test::add_element(model, ElementType::bar, "truss", 0, 0, {0, 1});
  test::add_element(model, ElementType::bar, "truss", 0, 0, {1, 2});
  test::fix(model, 0, {true, true, true, false, false, false});
  test::fix(model, 2, {true, true, true, false, false, false});
  const DofMap map = make_dof_map(model);
  ASSERT_EQ(map.dofs.size(), 3U);
  EXPECT_EQ(map.dofs[2].node, "2");
  EXPECT_EQ(map.dofs[2].direction, 2);
  EXPECT_EQ(map.dofs[2].x_m, Eigen::Vector3d(0.0, 0.0, 4.0));
}

TEST(DofMap, RefusesCirclesTwoMastersAndHeldSlaves) {
  Model circle = test::cantilever();
  circle.links = {{"a", 1, 2}, {"b", 2, 1}};
  EXPECT_NE(refusal_of_links(circle).find("circle"), std::string::npos) << refusal_of_links(circle);
  Model twice = test::cantilever();
  twice.links = {{"a", 0, 2}, {"b", 1, 2}};
  EXPECT_NE(refusal_of_links(twice).find("node 3 is the slave of two rigid links"), std::string::npos)
      << refusal_of_links(twice);
  Model held = test::cantilever();
  held.links = {{"a", 1, 0}};
  EXPECT_NE(refusal_of_links(held).find("node 1 is held by a support and is the slave"), std::string::npos)
      << refusal_of_links(held);
}

}  // namespace
}  // namespace twindeck::fe
