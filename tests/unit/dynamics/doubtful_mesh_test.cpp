// Oracle: meshes of a few nodes whose pairs are known by construction.
#include "dynamics/doubtful_mesh.hpp"

#include <gtest/gtest.h>

namespace twindeck::dynamics {
namespace {

/// Two beams end to end along x; the second begins at a node of its own, which lies `apart_m` from the end of the first.
fe::Model two_beams(double apart_m) {
  fe::Model model;
  for (const double x : {0.0, 1.0, 1.0 + apart_m, 2.0})
    model.nodes.push_back({static_cast<long>(model.nodes.size()) + 11, {x, 5.0, 0.0}});
  for (const int first : {0, 2}) {
    fe::Element beam;
    beam.id = first + 1;
    beam.material = beam.section = 0;
    beam.nodes = {first, first + 1};
    model.elements.push_back(beam);
  }
  return model;
}

TEST(DoubtfulMesh, NodesAtOnePlaceAreToldUnlessSomethingJoinsThem) {
  for (const double apart_m : {0.0, 1e-8, -1e-8}) {
    const auto lines = doubtful_mesh(two_beams(apart_m));
    ASSERT_EQ(lines.size(), 1U) << apart_m;
    EXPECT_NE(lines.front().find("nodes 12 and 13 lie at one place"), std::string::npos) << lines.front();
  }
  EXPECT_TRUE(doubtful_mesh(two_beams(1e-3)).empty());
  fe::Model linked = two_beams(0.0), hinged = linked, sprung = linked, tied = linked;
  linked.links.push_back({"link", 1, 2});
  hinged.constraints.push_back({"hinge", 2, 0, {{1, 0, 1.0}}});
  fe::Spring spring;
  spring.node = 2;
  spring.node2 = 1;
  sprung.springs.push_back(spring);
  tied.links = {{"to the first", 0, 1}, {"to the first", 0, 2}};  // by way of a third node
  fe::Model hub = two_beams(0.0);                                 // the far ends are one beam's
  hub.elements.push_back(hub.elements.front());
  hub.elements.back().nodes = {0, 3};
  for (const fe::Model& joined : {linked, hinged, sprung, tied, hub}) EXPECT_TRUE(doubtful_mesh(joined).empty());
}

TEST(DoubtfulMesh, AnElementThatIsListedTwiceIsTold) {
  fe::Model model = two_beams(0.5);
  EXPECT_TRUE(doubtful_mesh(model).empty());
  model.elements.push_back(model.elements.front());
  model.elements.back().id = 7;
  std::swap(model.elements.back().nodes[0], model.elements.back().nodes[1]);
  const auto lines = doubtful_mesh(model);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines.front().find("elements 1 and 7 are the same"), std::string::npos) << lines.front();
  model.elements.back().offset_m[0].y() = 0.2;  // of its second node
  EXPECT_TRUE(doubtful_mesh(model).empty());
  model.elements.front().offset_m[1].y() = 0.2;
  EXPECT_EQ(doubtful_mesh(model).size(), 1U);
  model.elements.back().section = 1;  // two beams side by side
  EXPECT_TRUE(doubtful_mesh(model).empty());
}

TEST(DoubtfulMesh, ShellsThatAreNoThinPlatesAreTold) {
  fe::Model model;
  for (const double x : {0.0, 10.0})
    for (const double y : {0.0, 10.0}) model.nodes.push_back({static_cast<long>(model.nodes.size()) + 1, {x, y, 0.0}});
  model.sections.emplace_back().thickness_m = 1.0;
  fe::Element& shell = model.elements.emplace_back();
  shell.type = fe::ElementType::shell;
  shell.group = "slab";
  shell.section = 0;
  shell.nodes = {0, 2, 3, 1};
  const auto lines = doubtful_mesh(model);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines.front().find("shells of group 'slab' are 1 m thick and all shells together 10 m wide"), std::string::npos);
  model.sections.front().shear_thickness_ratio = fe::homogeneous_shear_ratio;
  EXPECT_TRUE(doubtful_mesh(model).empty());
  model.formulation.shear_flexible = false;
  EXPECT_EQ(doubtful_mesh(model).size(), 1U);
  model.sections.front().thickness_m = 0.5;
  EXPECT_TRUE(doubtful_mesh(model).empty());
}

}  // namespace
}  // namespace twindeck::dynamics
