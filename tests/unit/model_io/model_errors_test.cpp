/// Oracle: the promise of every error: one line that names the file, the line and the column, what was found, the nearest known
/// name.
#include <vector>

#include "model_io/any_model_folder.hpp"
#include "model_io/write_model.hpp"
#include "test_folder.hpp"

namespace twindeck::model_io::test {
namespace {

struct BadInput {
  const char* what;
  const char* file;
  const char* from;
  const char* to;
  std::vector<const char*> said;  ///< parts of the message
};

const std::vector<BadInput> kBadInputs = {
    {"missing column", "nodes.csv", "node,x_m,y_m,z_m", "node,x_m,y_m,height", {"nodes.csv:1", "z_m"}},
    {"NaN coordinate", "nodes.csv", "5,1,1,0.1", "5,1,nan,0.1", {"nodes.csv:4", "y_m", "nan"}},
    {"node twice", "nodes.csv", "5,1,1,0.1", "2,1,1,0.1", {"nodes.csv:4", "node", "node 2 appears twice"}},
    {"node with a fraction", "nodes.csv", "5,1,1,0.1", "5.5,1,1,0.1", {"nodes.csv:4", "node", "5.5"}},
    {"negative modulus",
     "materials.csv",
     "steel,210000000000",
     "steel,-210000000000",
     {"materials.csv:2", "youngs_modulus_Pa", "-210000000000", "above 0"}},
    {"no modulus", "materials.csv", "steel,210000000000", "steel,", {"materials.csv:2", "youngs_modulus_Pa"}},
    {"Poisson's ratio of a half", "materials.csv", ",0.3,7850", ",0.5,7850", {"materials.csv:2", "poisson_ratio", "0.5"}},
    {"material twice", "materials.csv", "\"concrete, light\"", "steel", {"materials.csv:3", "'steel' appears twice"}},
    {"negative thickness", "sections.csv", "0.0617,1.25", "-0.0617,1.25", {"sections.csv:3", "thickness_m", "-0.0617"}},
    {"impossible product of inertia", "sections.csv", "-1e-06", "-1e-03", {"sections.csv:2", "inertia_yz_m4"}},
    {"unknown type", "elements.csv", "11,stay", "11,stray", {"elements.csv:3", "type", "'stray'", "did you mean 'stay'"}},
    {"unknown material",
     "elements.csv",
     "chord,steel",
     "chord,steal",
     {"elements.csv:2", "material 'steal' is not in materials.csv", "did you mean 'steel'"}},
    {"unknown section",
     "elements.csv",
     "steel,tube,1,2",
     "steel,tub,1,2",
     {"elements.csv:2", "section 'tub' is not in sections.csv", "did you mean 'tube'"}},
    {"unknown node",
     "elements.csv",
     "steel,tube,1,2",
     "steel,tube,1,99",
     {"elements.csv:2", "node2", "node 99 is not in nodes.csv"}},
    {"element twice", "elements.csv", "11,stay", "10,stay", {"elements.csv:3", "element 10 appears twice"}},
    {"same node twice", "elements.csv", "steel,tube,1,2", "steel,tube,1,1", {"elements.csv:2", "same node twice"}},
    {"section without area", "elements.csv", "steel,tube,1,2", "steel,slab,1,2", {"elements.csv:2", "'slab' has no area"}},
    {"shell without thickness", "elements.csv", "light\",slab", "light\",tube", {"elements.csv:5", "'tube' has no thickness"}},
    {"third node of a stay", "elements.csv", "steel,tube,2,5,,", "steel,tube,2,5,1,", {"elements.csv:3", "node3", "two nodes"}},
    {"negative pull", "elements.csv", ",286000", ",-286000", {"elements.csv:3", "pull_N", "-286000"}},
    {"unknown column", "elements.csv", "pull_N", "pul_N", {"elements.csv:1", "pul_N", "did you mean 'pull_N'"}},
    {"fixity of 2", "supports.csv", "1,1,1,1,0,1,0", "1,1,1,2,0,1,0", {"supports.csv:2", "z", "expected 0 or 1"}},
    {"spring without direction", "springs.csv", "0.6,0,0.8", "0,0,0", {"springs.csv:2", "direction"}},
    {"unknown arrangement", "springs.csv", "series", "serial", {"springs.csv:2", "'serial'", "did you mean 'series'"}},
    {"spring's name twice",
     "springs.csv",
     "turn,bearing",
     "C1,bearing",
     {"springs.csv:3", "spring", "'C1' is the name of row 1 too"}},
    {"slave of itself", "links.csv", "1,7", "1,1", {"links.csv:2", "slave"}},
    {"negative mass", "masses.csv", "120.5", "-120.5", {"masses.csv:2", "mass_kg", "-120.5"}},
    {"no mass", "masses.csv", "120.5,1,2,3", ",,,", {"masses.csv:2", "mass_kg", "is empty, and so are inertia_x_kg_m2"}},
    {"spring without values",
     "springs.csv",
     "1000000,20000,3000",
     ",,",
     {"springs.csv:2", "stiffness_N_m", "is empty, and so are damping_N_s_m, friction_N"}},
    {"no stiffness in series", "springs.csv", "1000000,20000", ",20000", {"springs.csv:2", "stiffness_N_m", "is empty"}},
    {"support without a direction",
     "supports.csv",
     "1,1,1,1,0,1,0",
     "1,,,,,,",
     {"supports.csv:2", "x", "is empty, and so are y"}},
    {"point on no node", "points.csv", "M2,5", "M2,6", {"points.csv:3", "node 6 is not in nodes.csv"}},
    {"unknown key", "model.toml", "gravity", "gravty", {"model.toml:", "gravty", "did you mean 'gravity'"}},
    {"unknown part of a parameter",
     "model.toml",
     "[\"steel\"]",
     "[\"steels\"]",
     {"model.toml:", "E_s", "'steels'", "did you mean 'steel'"}},
    {"bounds beside the value",
     "model.toml",
     "upper = 220000000000",
     "upper = 200000000000",
     {"model.toml:", "E_s", "lower <= initial <= upper"}},
    {"unknown target", "model.toml", "target = \"thickness\"", "target = \"thicknes\"", {"model.toml:", "target", "thickness"}},
    {"condition on no node", "model.toml", "2:z", "3:z", {"model.toml:", "'3:z'"}},
    {"condition on a rotation", "model.toml", "2:z", "2:rz", {"model.toml:", "'2:rz'", "x, y or z"}},
    {"broken TOML", "model.toml", "[formulation]", "[formulation", {"model.toml:"}},
};

class ModelErrors : public ::testing::TestWithParam<std::size_t> {};

TEST_P(ModelErrors, SayWhereAndWhatOnOneLine) {
  const BadInput& bad = kBadInputs[GetParam()];
  const auto path = std::filesystem::temp_directory_path() / ("twindeck_model_errors_" + std::to_string(GetParam()));
  std::filesystem::remove_all(path);
  write_model(one_of_everything(), path);
  ASSERT_EQ(message_of([&] { (void)read_model(path); }), "");
  std::ifstream in(path / bad.file);
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const auto at = text.find(bad.from);
  ASSERT_NE(at, std::string::npos) << bad.what << "\n" << text;
  std::ofstream(path / bad.file) << text.replace(at, std::string(bad.from).size(), bad.to);

  const std::string message = message_of([&] { (void)read_model(path); });
  EXPECT_FALSE(message.empty()) << bad.what << " was accepted";
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  for (const char* part : bad.said) EXPECT_NE(message.find(part), std::string::npos) << bad.what << ": " << message;
  std::filesystem::remove_all(path);
}

INSTANTIATE_TEST_SUITE_P(Each, ModelErrors, ::testing::Range<std::size_t>(0, kBadInputs.size()));

TEST(ModelErrorsOfFolders, TwoNodesAtOnePlace) {
  const TestFolder folder;
  folder.write("model.toml", "title = \"two nodes\"\n");
  folder.write("nodes.csv", "node,x_m,y_m,z_m\n1,0,0,0\n2,0,0,0\n");
  folder.write("materials.csv", "material,youngs_modulus_Pa,poisson_ratio,density_kg_m3\nsteel,2e11,0.25,7850\n");
  folder.write("sections.csv", "section,area_m2\nrod,0.01\n");
  folder.write("elements.csv", "element,type,material,section,node1,node2\n1,beam,steel,rod,1,2\n");
  const std::string message = message_of([&] { (void)read_model(folder.path()); });
  EXPECT_NE(message.find("elements.csv:2"), std::string::npos) << message;
  EXPECT_NE(message.find("nodes 1 and 2 lie at one place"), std::string::npos) << message;
}

// Oracle: what docs/my_model.md says: a cell beside a filled one is 0, here the stiffness of a dashpot and the mass of a
// flywheel.
TEST(ModelErrorsOfFolders, ACellBesideAFilledOneIsZero) {
  const TestFolder folder;
  write_model(one_of_everything(), folder.path());
  folder.write("springs.csv", "spring,node,direction_x,direction_y,direction_z,stiffness_N_m,damping_N_s_m\nd,5,0,0,1,,2e4\n");
  folder.write("masses.csv", "group,node,mass_kg,inertia_x_kg_m2\nrail,2,,7\n");
  folder.write("model.toml", "title = \"no parameters\"\n");
  const fe::Model model = read_model(folder.path());
  EXPECT_EQ(model.springs[0].stiffness, 0.0);
  EXPECT_EQ(model.springs[0].damping, 2e4);
  EXPECT_EQ(model.masses[0].mass_kg, 0.0);
  EXPECT_EQ(model.masses[0].inertia_kg_m2, Eigen::Vector3d(7.0, 0.0, 0.0));
}

TEST(ModelErrorsOfFolders, SayThatAFileOrFolderIsMissing) {
  const TestFolder folder;
  EXPECT_NE(message_of([&] { (void)read_model(folder.path() / "absent"); }).find("is no folder"), std::string::npos);
  EXPECT_NE(message_of([&] { (void)read_model(folder.path()); }).find("model.toml"), std::string::npos);
  folder.write("model.toml", "title = \"\"\n");
  EXPECT_NE(message_of([&] { (void)read_model(folder.path()); }).find("nodes.csv"), std::string::npos);
}

}  // namespace
}  // namespace twindeck::model_io::test
