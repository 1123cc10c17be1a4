// Places where dampers might stand. Oracles: the lines that were written; the message as a user reads it.
#include "diagnosis/files/damper_places.hpp"

#include "unit/io/temporary_folder.hpp"

namespace twindeck::tests {
namespace {

/// Of four springs, two are dampers between a node and the ground.
fe::Model with_two_dampers() {
  fe::Model model;
  for (const char* name : {"C1", "C2", "between", "turning", "bearing"}) {
    fe::Spring spring;
    spring.name = name;
    spring.node = 0;
    spring.damping = 10.0;
    model.springs.push_back(spring);
  }
  model.springs[2].node2 = 1;
  model.springs[3].rotation = true;
  model.springs[4].damping = 0.0;
  model.springs[4].stiffness = 1e6;
  return model;
}

class DamperPlaces : public io::test::TemporaryFolder {
 protected:
  std::filesystem::path places(const std::string& rows) const {
    return write("places.csv", "alternative,damper,x_m,y_m,z_m\n" + rows);
  }
  std::string said(const std::string& rows, const fe::Model* model) const {
    return refusal([&] { (void)diagnosis::read_damper_places(places(rows), model); });
  }
};

TEST_F(DamperPlaces, RowsOfOneNameAreOneAlternative) {
  const fe::Model model = with_two_dampers();
  const auto moves = diagnosis::read_damper_places(places("foot,C1,1,2,3\nfoot,C2,4,5,6.5\nhead,C2,-7,8,9\n"), &model);
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_EQ(moves[0].name, "foot");
  EXPECT_EQ(moves[0].dampers, (std::vector<std::string>{"C1", "C2"}));
  ASSERT_EQ(moves[0].x_m.size(), 2U);
  EXPECT_EQ(moves[0].x_m[0], Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(moves[0].x_m[1], Eigen::Vector3d(4.0, 5.0, 6.5));
  EXPECT_EQ(moves[1].name, "head");
  EXPECT_EQ(moves[1].dampers, std::vector<std::string>{"C2"});
  EXPECT_EQ(moves[1].x_m, std::vector<Eigen::Vector3d>{Eigen::Vector3d(-7.0, 8.0, 9.0)});
}

TEST_F(DamperPlaces, WhatIsNoDamperToTheGroundIsRefusedWithThoseThatAre) {
  const fe::Model model = with_two_dampers();
  for (const std::string name : {"between", "turning", "bearing"})
    EXPECT_EQ(said("foot,C1,1,2,3\nfoot," + name + ",1,2,3\n", &model),
              "places.csv:3: damper: '" + name +
                  "' is no damper of the model between a node and the ground; name one of its springs.csv: C1, C2");
  EXPECT_EQ(said("foot,c1,1,2,3\n", &model),
            "places.csv:2: damper: 'c1' is no damper of the model between a node and the ground (did you mean 'C1'?); name one "
            "of its springs.csv: C1, C2");
}

TEST_F(DamperPlaces, OfAModelWithoutDampersAreRefused) {
  const std::string expected =
      "places.csv:2: damper: 'C1' is no damper of the model between a node and the ground; the model has none: leave "
      "damper_places out";
  const fe::Model empty;
  EXPECT_EQ(said("foot,C1,1,2,3\n", nullptr), expected);
  EXPECT_EQ(said("foot,C1,1,2,3\n", &empty), expected);
}

TEST_F(DamperPlaces, ACoordinateThatIsNoneIsRefused) {
  const fe::Model model = with_two_dampers();
  EXPECT_TRUE(said("foot,C1,1,2,\n", &model).starts_with("places.csv:2: z_m: ")) << said("foot,C1,1,2,\n", &model);
}

}  // namespace
}  // namespace twindeck::tests
