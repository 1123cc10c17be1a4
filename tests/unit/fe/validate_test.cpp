// Oracle: each model has one fault made on purpose; the message must name the part, what was found, and how to mend it.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <functional>

#include "assembly_models.hpp"
#include "core/error.hpp"
#include "fe/assembly.hpp"

namespace twindeck::fe {
namespace {

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string message_of(const Model& model) {
  return message_of([&] { validate(model); });
}

std::string mechanism_of(const Model& model) {
  return message_of([&] {
    const ParametricSystem system = assemble(model, {});
    check_no_mechanism(system, system.initial(), model.source);
  });
}

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

TEST(Validate, SoundModelsPass) {
  EXPECT_EQ(message_of(test::cantilever()), "");
  EXPECT_EQ(message_of(test::one_of_everything()), "");
  EXPECT_EQ(mechanism_of(test::cantilever()), "");
  EXPECT_EQ(mechanism_of(test::one_of_everything()), "");
}

TEST(Validate, NegativeModulusIsNamed) {
  Model model = test::cantilever();
  model.materials[0].youngs_modulus_Pa = -3e9;
  EXPECT_SAYS(message_of(model), "material 'steel'");
  EXPECT_SAYS(message_of(model), "Young's modulus is -3e+09 Pa, expected a positive number");
}

TEST(Validate, CoincidentNodesJoinedByABeamAreNamed) {
  Model model = test::cantilever();
  model.nodes[2].x_m = model.nodes[1].x_m;
  EXPECT_SAYS(message_of(model), "element 2: nodes 2 and 3 are at the same place");
}

TEST(Validate, UnknownNamesOfParametersComeWithTheNearestName) {
  Model model = test::one_of_everything();
  model.parameters[0].of = {"stel"};
  EXPECT_SAYS(message_of(model), "parameter 'E_s': there is no material 'stel' (did you mean 'steel'?)");
  model = test::one_of_everything();
  model.parameters[4].of = {"slabb"};
  EXPECT_SAYS(message_of(model), "there is no section 'slabb' (did you mean 'slab'?)");
  model = test::one_of_everything();
  model.parameters[7].of = {"bearing"};
  EXPECT_SAYS(message_of(model), "there is no group of springs 'bearing' (did you mean 'bearings'?)");
}

TEST(Validate, ReferencesThatLeadNowhereAreNamed) {
  Model model = test::cantilever();
  model.elements[1].material = -1;
  EXPECT_SAYS(message_of(model), "element 2: material has number -1 in the list of 1");
  model = test::cantilever();
  model.elements[0].section = 4;
  EXPECT_SAYS(message_of(model), "element 1: section has number 4 in the list of 1");
  model = test::cantilever();
  model.elements[0].nodes = {0, 1, 2};
  EXPECT_SAYS(message_of(model), "element 1: has 3 nodes, expected 2");
}

TEST(Validate, NodesThatNothingReachesAreNamed) {
  Model model = test::cantilever();
  test::add_node(model, 9.0, 9.0, 9.0);
  EXPECT_SAYS(message_of(model), "node 4: no element, spring, link or support reaches this node");
}

TEST(Validate, ParametersMustStartWhereTheModelStands) {
  Model model = test::one_of_everything();
  model.parameters[1].initial = 31e9;
  EXPECT_SAYS(message_of(model), "parameter 'E_c': the initial value is 3.1e+10 Pa, but 'concrete' stands at 3e+10");
  model = test::one_of_everything();
  model.parameters[1].upper = 29e9;
  EXPECT_SAYS(message_of(model), "lies outside its bounds");
  model = test::one_of_everything();
  model.parameters[1].of = {"concrete", "steel"};
  EXPECT_SAYS(message_of(model), "'steel' is scaled by another parameter already");
}

TEST(Validate, GivenPullsAndShapeFindingNeedTheirData) {
  Model model = test::one_of_everything();
  model.elements[6].pull_N = 0.0;
  EXPECT_SAYS(message_of(model), "element 7 (N1): the pull is 0 N, expected a positive force");
  model = test::one_of_everything();
  model.prestress.rule = PullRule::shape_finding;
  EXPECT_SAYS(message_of(model), "shape finding has no displacement to bring to zero");
}

TEST(Validate, SectionsNoMaterialCouldHaveAreRefused) {
  Model model = test::cantilever();
  model.sections[0].inertia_yz_m4 = 3e-5;  // sqrt(4e-5 * 1e-5) = 2e-5
  EXPECT_SAYS(message_of(model), "section 'girder': inertia_yz is 3e-05 m4");
  model = test::one_of_everything();
  model.materials[1].poisson_ratio = 0.5;
  EXPECT_SAYS(message_of(model), "Poisson's ratio is 0.5, expected a value in [0, 0.5[");
}

TEST(Mechanism, HingedBeamNamesANodeAndItsDirections) {
  Model model = test::cantilever();
  model.supports.front().fixed = {true, true, true, true, true, false};  // free to swing in plan about the left end
  const std::string text = mechanism_of(model);
  EXPECT_SAYS(text, "small_model: node 3: the structure is a mechanism");  // the tip moves most: 4 m for 1 rad
  EXPECT_SAYS(text, "moves freely in y, rz");
}

TEST(Mechanism, TrussWithoutBracingNamesTheLooseDirection) {
  Model model = test::with_steel();
  for (int i = 0; i < 3; ++i) test::add_node(model, i == 0 ? -3.0 : 3.0 * (i - 1), 0.0, i == 1 ? 4.0 : 0.0);
  test::add_element(model, ElementType::bar, "truss", 0, 0, {0, 1});
  test::add_element(model, ElementType::bar, "truss", 0, 0, {1, 2});
  test::fix(model, 0, {true, true, true, false, false, false});
  test::fix(model, 2, {true, true, true, false, false, false});
  EXPECT_SAYS(mechanism_of(model), "node 2: the structure is a mechanism: this node at (0, 0, 4) m moves freely in y");
}

TEST(Mechanism, StructureInTwoPartsIsFound) {
  Model model = test::cantilever();
  const int a = test::add_node(model, 0.0, 50.0, 0.0), b = test::add_node(model, 2.0, 50.0, 0.0);
  test::add_element(model, ElementType::beam, "lost", 0, 0, {a, b});
  EXPECT_SAYS(mechanism_of(model), "the structure is a mechanism");
}

TEST(Mechanism, NothingFreeIsSaid) {
  Model model = test::cantilever();
  test::fix(model, 1);
  test::fix(model, 2);
  EXPECT_SAYS(mechanism_of(model), "no degree of freedom is free");
}

}  // namespace
}  // namespace twindeck::fe
