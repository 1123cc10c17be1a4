// Load cases and gauges of load tests on a model. Oracles: forces and strains of a cantilever by hand (strain = moment times
// fibre over EI); the message as a user reads it.
#include "diagnosis/files/load_test_files.hpp"

#include "unit/diagnosis/matrix_model.hpp"
#include "unit/io/temporary_folder.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::FeatureSet;
using diagnosis::LoadTests;
using diagnosis::RowType;

constexpr double kLength = 4.0, kFibre = 0.3;

/// A beam on x, built in at node 1 ("wall"), on a spring ("post") at node 2.
fe::Model cantilever() {
  fe::Model m;
  m.source = "cantilever";
  m.nodes = {{1, {0.0, 0.0, 0.0}}, {2, {kLength, 0.0, 0.0}}, {3, {kLength, 1.0, 0.0}}};
  m.materials = {{"steel", 2e11, 8e10, 0.25, 7800.0}};
  fe::Section section;
  section.name = "box";
  section.area_m2 = 0.01;
  section.inertia_y_m4 = section.inertia_z_m4 = 1e-4;
  section.torsion_m4 = 1e-4;
  m.sections = {section};
  fe::Element beam;
  beam.id = 17;
  beam.name = "arm";
  beam.material = beam.section = 0;
  beam.nodes = {0, 1};
  m.elements = {beam};
  beam.id = 18;
  beam.name = "";
  beam.nodes = {1, 2};
  m.elements.push_back(beam);
  m.supports = {{"wall", 0, {true, true, true, true, true, true}}};
  fe::Spring post;
  post.name = "post_z";
  post.group = "post";
  post.node = 1;
  post.stiffness = 5e4;
  m.springs = {post};
  return m;
}

class LoadTestFiles : public io::test::TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    loads("truck,2,z,-1000,N\ntruck,2,ry,40,N m\nunused,99,z,1,N\ncrowd,2,x,7,N\n");
    const char* names[] = {"w", "turn", "e", "f", "blind"};
    channels_.resize(5);
    for (std::size_t c = 0; c < 5; ++c) {
      channels_[c].name = names[c];
      channels_[c].line = static_cast<long>(c) + 2;
      features_.channels.push_back(names[c]);
    }
    channels_[0].point = channels_[1].point = "2";
    channels_[0].direction = channels_[3].direction = Eigen::Vector3d::UnitZ();
    channels_[1].direction = Eigen::Vector3d::UnitY();
    channels_[2].element = "arm";
    channels_[2].xi = 0.25;
    channels_[2].fibre_m = {0.0, kFibre};
    channels_[3].support = "post";
    features_.conditions = {{"day", "reference", {}, {}, "", {}, {}, {}, {}, 1, "truck"},
                            {"night", "reference", {}, {}, "", {}, {}, {}, {}, 2, ""}};
    row(RowType::static_displacement, 0);
    row(RowType::static_rotation, 1);
    row(RowType::static_strain, 2);
    row(RowType::static_force, 3);
    features_.rows.push_back({RowType::frequency, "1", -1, "", 1, 3.0, 0.1, false, 6});
  }
  void loads(const std::string& rows) const { write("loads.csv", "load,node,direction,value,unit\n" + rows); }
  void row(RowType type, int channel) {
    features_.rows.push_back({type, "", channel, "", 0, 1.0, 0.1, false, static_cast<long>(features_.rows.size()) + 2});
  }
  [[nodiscard]] diagnosis::LoadTestFiles files() const { return {folder_, folder_ / "channels.csv"}; }
  [[nodiscard]] LoadTests in_use() {
    features_.direction.clear();
    for (const auto& channel : channels_) features_.direction.push_back(channel.direction);
    prepared_ = diagnosis::prepare_model(dynamics::from_model(cantilever()), channels_, 0.01);
    structure_ = prepared_->structure();
    return diagnosis::load_tests_in_use(*prepared_, structure_, diagnosis::find_places(structure_, {}), features_, files());
  }
  std::string unplaced(const dynamics::ReadModel& model) const {
    return refusal([&] { diagnosis::refuse_unplaced_load_tests(features_, channels_, model, files()); });
  }
  std::string unplaced() const { return unplaced(dynamics::valid_model(cantilever())); }
  /// Position of a free degree of freedom.
  [[nodiscard]] Eigen::Index dof(const std::string& node, int direction) const {
    const auto& dofs = structure_.system->dofs;
    for (std::size_t i = 0; i < dofs.size(); ++i)
      if (dofs[i].node == node && dofs[i].direction == direction) return static_cast<Eigen::Index>(i);
    ADD_FAILURE() << "no dof";
    return 0;
  }

  FeatureSet features_;
  std::vector<matching::Channel> channels_;
  std::shared_ptr<diagnosis::DiagnosedModel> prepared_;
  diagnosis::Structure structure_;
};

TEST_F(LoadTestFiles, GiveTheCasesAndGaugesThatRowsAreOf) {
  const LoadTests tests = in_use();
  ASSERT_EQ(tests.cases, std::vector<std::string>{"truck"});  // neither the unused one nor the one of no row
  Eigen::VectorXd force = Eigen::VectorXd::Zero(structure_.system->size());
  force[dof("2", 2)] = -1000.0;
  force[dof("2", 4)] = 40.0;
  EXPECT_LT((tests.force.col(0) - force).norm(), 1e-9);
  EXPECT_NEAR(tests.rotation(1, dof("2", 4)), 1.0, 1e-12);
  EXPECT_NEAR(tests.rotation.row(1).norm(), 1.0, 1e-12);
  // A cantilever's tip that goes up by w has the curvature w'' = 6 w (1 - 2 xi)/L² where it does not turn; strain = -z w''.
  EXPECT_NEAR(tests.strain(2, dof("2", 2)), -kFibre * 6.0 * 0.5 / (kLength * kLength), 1e-9);
  EXPECT_EQ(tests.strain.row(0).norm(), 0.0);
  ASSERT_EQ(tests.forces.size(), 5U);
  EXPECT_GE(tests.forces[3].ground, 0);
  EXPECT_NEAR(tests.forces[3].pull[dof("2", 2)], 5e4, 1e-6);
  EXPECT_EQ(tests.forces[0].ground, -1);
}

TEST_F(LoadTestFiles, WithoutARowOfALoadTestAreNone) {
  features_.rows = {features_.rows.back()};
  loads("truck,99,z,-1000,N\n");
  EXPECT_TRUE(in_use().empty());
  EXPECT_EQ(unplaced(), "");
}

TEST_F(LoadTestFiles, AChannelThatNoRowIsOfMaySitAnywhere) {
  channels_[4].element = "nowhere";
  EXPECT_EQ(in_use().cases.size(), 1U);
  EXPECT_EQ(unplaced(), "");
  row(RowType::static_strain, 4);
  EXPECT_EQ(unplaced(), "channels.csv:6: element: 'nowhere' is no element of the model; name an element of its elements.csv");
  EXPECT_EQ(refusal([&] { (void)in_use(); }), unplaced());
}

TEST_F(LoadTestFiles, AChannelThatShowsNoMotionIsRefusedWithItsRow) {
  const std::string mend = "; give its point and dx, dy, dz (of a rotation: the axis), or leave the row out";
  row(RowType::static_displacement, 4);
  EXPECT_EQ(refusal([&] { (void)in_use(); }),
            "channels.csv: blind: shows nothing of the model's motion, but row 7 of rows.csv is a static_m of it" + mend);
  features_.rows.back().type = RowType::static_rotation;
  channels_[4].direction = Eigen::Vector3d::UnitX();  // along an axis, but nowhere
  EXPECT_EQ(
      refusal([&] { (void)in_use(); }),
      "channels.csv: blind: shows nothing of the model's motion, but row 7 of rows.csv is a static_rotation_rad of it" + mend);
  features_.rows.back().type = RowType::static_strain;
  EXPECT_EQ(refusal([&] { (void)in_use(); }),
            "channels.csv: blind: shows nothing of the model's motion, but row 7 of rows.csv is a static_strain of it" + mend);
  channels_[4].element = "18";
  channels_[4].fibre_m = {0.0, kFibre};
  EXPECT_EQ(refusal([&] { (void)in_use(); }), "");
}

TEST_F(LoadTestFiles, ALoadAtNoNodeIsRefusedWithItsLine) {
  loads("crowd,99,z,1,N\ntruck,2,z,-1,N\ntruck,20,z,-1,N\n");
  EXPECT_EQ(unplaced(), "loads.csv:4: node: '20' is no node of the model; name a node of its nodes.csv");
}

TEST_F(LoadTestFiles, AMovementNeedsASupportToMove) {
  for (const char* node : {"1", "2"}) {  // on the wall, on the post
    loads(std::string("truck,") + node + ",z,-0.01,m\n");
    EXPECT_EQ(unplaced(), "") << node;
  }
  loads("truck,3,z,-0.01,m\n");
  EXPECT_EQ(unplaced(),
            "loads.csv:2: node: no support holds node '3' in direction z, so that none can move it; move the node "
            "of a support, along a direction that it holds");
  // A link or a constraint may carry the ground's movement to it.
  fe::Model linked = cantilever();
  linked.elements.pop_back();
  linked.links = {{"arm", 1, 2}};
  EXPECT_EQ(unplaced(dynamics::valid_model(linked)), "");
  linked.links.clear();
  for (int d = 0; d < 6; ++d) linked.constraints.push_back({"c" + std::to_string(d), 2, d, {{1, d, 1.0}}});
  EXPECT_EQ(unplaced(dynamics::valid_model(linked)), "");
}

TEST_F(LoadTestFiles, AGaugeNeedsItsElementAndSupport) {
  channels_[2].element = "18";  // by its number
  channels_[3].support = "wall";
  EXPECT_EQ(unplaced(), "");
  channels_[3].support = "post fixed";  // what is rigid where springs have the name
  EXPECT_EQ(unplaced(), "");
  channels_[3].support = "posts";
  EXPECT_EQ(unplaced(),
            "channels.csv:5: support: 'posts' is no support of the model (did you mean 'post'?); name one of wall, post");
  channels_[3].support = "";
  channels_[2].element = "19";
  EXPECT_EQ(unplaced(), "channels.csv:4: element: '19' is no element of the model; name an element of its elements.csv");
}

TEST_F(LoadTestFiles, ASupportWithoutANameGoesByItsNode) {
  fe::Model model = cantilever();
  model.supports[0].name = "";
  model.springs[0].group = "";
  channels_[3].support = "node_1";
  EXPECT_EQ(unplaced(dynamics::valid_model(model)), "");
  channels_[3].support = "post_z";
  EXPECT_EQ(unplaced(dynamics::valid_model(model)), "");
  channels_[3].support = "wall";
  EXPECT_EQ(unplaced(dynamics::valid_model(model)),
            "channels.csv:5: support: 'wall' is no support of the model; name one of node_1, post_z");
}

TEST_F(LoadTestFiles, OfMatricesAreAtTheirNodes) {
  dynamics::ReadModel matrices;
  matrices.matrices.dofs = nodes_in_a_row(2);
  channels_[2].element = "nowhere";  // matrices have no elements to be named
  EXPECT_EQ(unplaced(matrices), "");
  loads("truck,3,x,-1,N\n");
  EXPECT_EQ(unplaced(matrices), "loads.csv:2: node: '3' is no node of the model; name a node of its nodes.csv");
}

}  // namespace
}  // namespace twindeck::tests
