// Oracle: rigid-body motion written out by hand, and the dense transformation T'KT of a hand-made T.
#include "fe/dof_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "assembly_models.hpp"
#include "core/error.hpp"
#include "fe/assembly.hpp"

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

TEST(DofMap, AnArmOfRoundingTurnsNothing) {
  Model model = test::with_steel();
  for (int i = 0; i < 3; ++i) test::add_node(model, i == 0 ? -3.0 : 3.0 * (i - 1), 0.0, i == 1 ? 4.0 : 0.0);
  const int twin = test::add_node(model, 1e-13, -1e-14, 4.0);
  test::add_element(model, ElementType::bar, "truss", 0, 0, {0, 1});
  test::add_element(model, ElementType::bar, "truss", 0, 0, {twin, 2});
  model.links = {{"joint", 1, twin}};
  test::fix(model, 0, {true, true, true, false, false, false});
  test::fix(model, 2, {true, true, true, false, false, false});
  EXPECT_EQ(make_dof_map(model).dofs.size(), 3U);  // the rotations of the joint carry nothing
}

TEST(DofMap, AConstraintEqualsTheTransformationByHand) {
  // A spring k under a point that follows a quarter of one node's movement and three quarters of another's: adds k b b', b = (z
  // of node 1: 1/4, z of node 2: 3/4). A second point follows the first by half, and a rotation of node 2.
  Model model = test::cantilever();
  const ParametricSystem bare = assemble(model, {});
  const int first = test::add_node(model, 3.0, 0.0, 0.0), second = test::add_node(model, 3.0, 1.0, 0.0);
  model.constraints = {{"follower", second, 0, {{first, 2, 0.5}, {2, 4, 2.0}}},  // listed before the one that it hangs on
                       {"tie", first, 2, {{1, 2, 0.25}, {2, 2, 0.75}}}};
  for (const int node : {first, second}) {
    Spring spring;
    spring.name = std::to_string(node);
    spring.node = node;
    spring.direction = node == first ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
    spring.stiffness = 5e4;
    model.springs.push_back(spring);
  }
  const ParametricSystem system = assemble(model, {});
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(12, 2);
  b(2, 0) = 0.25, b(8, 0) = 0.75;
  b.col(1) = 0.5 * b.col(0);
  b(10, 1) = 2.0;
  const Eigen::MatrixXd expected = test::full(bare.stiffness(bare.initial())) + 5e4 * b * b.transpose();
  EXPECT_LT((test::full(system.stiffness(system.initial())) - expected).cwiseAbs().maxCoeff(), 1e-4);
  // What hangs rigidly on a follower moves with it too.
  const int hung = test::add_node(model, 3.0, 0.0, 2.0);
  model.links.push_back({"hung", first, hung});
  const DofMap map = make_dof_map(model);
  const Eigen::VectorXd u = map.expansion * Eigen::VectorXd::Unit(map.expansion.cols(), 8);
  EXPECT_DOUBLE_EQ(u[6 * hung + 2], 0.75);
}

TEST(DofMap, RefusesConstraintsThatContradict) {
  const auto refusal = [](std::vector<Constraint> constraints, std::vector<RigidLink> links = {}) {
    Model model = test::cantilever();
    model.constraints = std::move(constraints);
    model.links = std::move(links);
    return refusal_of_links(model);
  };
  const auto expect = [](const std::string& message, const std::string& words) {
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  expect(refusal({{"a", 1, 2, {{2, 2, 1.0}}}, {"b", 2, 2, {{1, 2, 1.0}}}}), "depends on itself");
  expect(refusal({{"a", 1, 2, {{2, 2, 1.0}}}, {"b", 1, 2, {{2, 4, 1.0}}}}), "constraint b: node 2 in z depends by two");
  expect(refusal({{"a", 0, 2, {{2, 2, 1.0}}}}), "node 1 in z is held by a support");
  expect(refusal({{"a", 2, 1, {{0, 2, 1.0}}}}, {{"link", 1, 2}}), "node 3 in y is the slave of a rigid link");
  std::vector<Constraint> chain;  // longer than any real one, and than the stack of a small machine should have to hold
  Model model = test::cantilever();
  for (int i = 0; i < 400; ++i) {
    const int next = test::add_node(model, 4.0, 0.0, 0.0);
    chain.push_back({"c", i == 0 ? 1 : next - 1, 0, {{next, 0, 1.0}}});
  }
  model.constraints = chain;
  expect(refusal_of_links(model), "chain of more than 200");
}

}  // namespace
}  // namespace twindeck::fe
