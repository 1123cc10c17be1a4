/// Oracle: a stay of length 5 m along (3, 0, 4)/5 whose upper end is held: its force is E A/L times the elongation,
/// Dischinger's modulus being the full one without a static force. A damper's stroke is the motion of its node along it.
#include <gtest/gtest.h>

#include "reliability/varied_structure.hpp"

namespace twindeck::reliability {
namespace {

fe::Model one_stay() {
  fe::Model model;
  model.source = "one_stay";
  model.nodes = {{1, {0, 0, 0}}, {2, {3, 0, 4}}};
  model.materials = {{"steel", 2e11, 8e10, 0.25, 7850.0}};
  fe::Section section;
  section.name = "rope";
  section.area_m2 = 1e-3;
  model.sections = {section};
  fe::Element stay;
  stay.id = 1;
  stay.type = fe::ElementType::stay;
  stay.name = "NE1";
  stay.material = stay.section = 0;
  stay.nodes = {0, 1};
  model.elements = {stay};
  fe::Spring damper;
  damper.name = "A1";
  damper.group = "damper_A";
  damper.node = 0;
  damper.damping = 1e3;
  damper.direction = {1, 0, 0};
  damper.active = false;
  model.springs = {damper};
  model.supports = {{"ground", 0, {false, true, false, true, true, true}}, {"mast", 1, {true, true, true, true, true, true}}};
  for (const auto& axis : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 1)}) {
    fe::Spring spring;
    spring.name = axis.x() > 0 ? "x" : "z";
    spring.node = 0;
    spring.direction = axis;
    spring.stiffness = 1e6;
    model.springs.push_back(spring);
  }
  return model;
}

TEST(MemberRows, StaysHaveTheForceOfTheirElongationAndDampersTheirStroke) {
  const dynamics::LoadedModel loaded = dynamics::from_model(one_stay());
  ASSERT_EQ(loaded.system.size(), 2);
  const Eigen::MatrixXd motions = Eigen::MatrixXd::Identity(2, 2);  // x, then z of the lower end
  const MemberRows stays = stay_forces(loaded, motions);
  ASSERT_EQ(stays.names, std::vector<std::string>{"NE1"});
  EXPECT_NEAR(stays.rows(0, 0), -0.6 * 2e11 * 1e-3 / 5.0, 1e-3);  // towards the upper end it shortens
  EXPECT_NEAR(stays.rows(0, 1), -0.8 * 2e11 * 1e-3 / 5.0, 1e-3);
  EXPECT_EQ(stays.area_m2[0], 1e-3);
  const MemberRows dampers = damper_strokes(loaded, motions);
  ASSERT_EQ(dampers.names, std::vector<std::string>{"A1"});
  EXPECT_NEAR(dampers.rows(0, 0), 1.0, 1e-12);
  EXPECT_NEAR(dampers.rows(0, 1), 0.0, 1e-12);
}

}  // namespace
}  // namespace twindeck::reliability
