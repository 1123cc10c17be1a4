/// Oracle: identity (what was written comes back), the VTK numbers of a hexahedron (type 12, eight points), and messages that
/// name file, line and column.
#include "model_io/any_model_folder.hpp"
#include "model_io/inp.hpp"
#include "model_io/vtu.hpp"
#include "model_io/write_model.hpp"
#include "test_folder.hpp"

namespace twindeck::model_io::test {
namespace {

/// A cube of one solid with a bar on top.
fe::Model cube() {
  fe::Model m;
  m.title = "cube";
  for (long i = 0; i < 8; ++i) {
    const double x = i % 4 == 1 || i % 4 == 2 ? 1.0 : 0.0, y = i % 4 >= 2 ? 1.0 : 0.0;
    m.nodes.push_back({i + 1, {x, y, i >= 4 ? 1.0 : 0.0}});
  }
  m.materials = {{"concrete", 30e9, 12.5e9, 0.2, 2500.0}};
  fe::Section rod;
  rod.name = "rod";
  rod.area_m2 = 1e-3;
  m.sections = {rod};
  fe::Element solid;
  solid.id = 1;
  solid.type = fe::ElementType::solid;
  solid.group = "end_block";
  solid.material = 0;
  solid.nodes = {0, 1, 2, 3, 4, 5, 6, 7};
  fe::Element bar;
  bar.id = 2;
  bar.type = fe::ElementType::bar;
  bar.material = 0;
  bar.section = 0;
  bar.nodes = {4, 6};
  m.elements = {solid, bar};
  m.supports = {{"ground", 0, {true, true, true, false, false, false}}};
  m.parameters = {{"E_c", fe::Target::youngs_modulus, {"concrete"}, "Pa", 30e9, 20e9, 40e9}};
  return m;
}

TEST(SolidFolder, ComesBackAsItWas) {
  const TestFolder folder;
  write_model(cube(), folder.path());
  const fe::Model back = read_model(folder.path());
  ASSERT_EQ(back.elements.size(), 2u);
  EXPECT_EQ(back.elements[0].type, fe::ElementType::solid);
  EXPECT_EQ(back.elements[0].nodes, cube().elements[0].nodes);
  EXPECT_EQ(back.elements[0].section, -1);
  EXPECT_EQ(back.elements[1].nodes, cube().elements[1].nodes);
  const std::string first = folder.read("elements.csv");
  write_model(back, folder.path());
  EXPECT_EQ(folder.read("elements.csv"), first);
}

TEST(SolidFolder, TetrahedraComeBackFromFolderAndInp) {
  const TestFolder folder;
  fe::Model model = cube();
  model.nodes.resize(4);
  for (const int i : {0, 1, 2, 3})
    model.nodes[static_cast<std::size_t>(i)].x_m =
        i == 0 ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(Eigen::Vector3d::Unit(i - 1));
  model.elements = {model.elements[0]};
  model.elements[0].nodes = {0, 1, 2, 3};
  write_model(model, folder.path());
  EXPECT_EQ(read_model(folder.path()).elements.at(0).nodes, model.elements[0].nodes);
  EXPECT_EQ(folder.read("elements.csv").find("node5"), std::string::npos);
  (void)write_inp(model, {}, InpFlavour::abaqus, 3, folder.path() / "again.inp");
  EXPECT_NE(folder.read("again.inp").find("TYPE=C3D4"), std::string::npos) << folder.read("again.inp");
  EXPECT_EQ(read_inp(folder.path() / "again.inp").model.elements.at(0).nodes, model.elements[0].nodes);
}

// Twenty nodes: the corners of the cube, and the middles of its edges in the order of VTK_QUADRATIC_HEXAHEDRON.
fe::Model quadratic_cube() {
  fe::Model model = cube();
  const std::vector<std::array<int, 2>> edges = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                                 {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  for (const auto& [a, b] : edges) {
    const Eigen::Vector3d x = 0.5 * (model.nodes[fe::slot(a)].x_m + model.nodes[fe::slot(b)].x_m);
    model.elements[0].nodes.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back({static_cast<long>(model.nodes.size()) + 1, x});
  }
  return model;
}

TEST(SolidFolder, SolidsOfTwentyNodesComeBackFromFolderAndInp) {
  const TestFolder folder;
  const fe::Model model = quadratic_cube();
  write_model(model, folder.path());
  EXPECT_EQ(read_model(folder.path()).elements.at(0).nodes, model.elements[0].nodes);
  fe::Model alone = model;
  alone.elements.resize(1);
  for (const auto& [flavour, file] : {std::pair{InpFlavour::abaqus, "a.inp"}, {InpFlavour::calculix, "c.inp"}}) {
    (void)write_inp(alone, {}, flavour, 3, folder.path() / file);
    EXPECT_NE(folder.read(file).find("TYPE=C3D20,"), std::string::npos) << folder.read(file);
    EXPECT_EQ(read_inp(folder.path() / file).model.elements.at(0).nodes, model.elements[0].nodes);
  }
  const std::string row = "concrete,,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20";
  folder.edit("elements.csv", row, "concrete,,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,");
  EXPECT_NE(message_of([&] { (void)read_model(folder.path()); }).find("elements.csv:2: node20"), std::string::npos);
}

TEST(TaperedFolder, ComesBackAsItWas) {
  const TestFolder folder;
  fe::Model model = cube();
  fe::Section foot = model.sections[0], tip = model.sections[0];
  foot.name = "foot";
  tip.name = "tip";
  model.sections = {tip, foot};
  model.elements[1].type = fe::ElementType::beam;
  model.elements[1].section = 1;
  model.elements[1].section2 = 0;
  write_model(model, folder.path());
  const fe::Model back = read_model(folder.path());
  EXPECT_EQ(back.elements[1].section, 1);
  EXPECT_EQ(back.elements[1].section2, 0);
  EXPECT_EQ(back.elements[0].section2, -1);
  folder.edit("elements.csv", ",tip,", ",top,");
  EXPECT_NE(message_of([&] {
              (void)read_model(folder.path());
            }).find("elements.csv:3: section2: section2 'top' is not in sections.csv (did you mean 'tip'?)"),
            std::string::npos);
}

TEST(SolidFolder, FaultsNameLineAndColumn) {
  const auto says = [](const char* from, const char* to) {
    const TestFolder folder;
    write_model(cube(), folder.path());
    folder.edit("elements.csv", from, to);
    return message_of([&] { (void)read_model(folder.path()); });
  };
  EXPECT_NE(says("concrete,,1", "concrete,rod,1").find("elements.csv:2: section: is filled, but a solid has no section"),
            std::string::npos);
  EXPECT_NE(says("concrete,,1,2,3,4,5,6,7,8", "concrete,,1,2,3,4,5,6,7,").find("elements.csv:2: node8"), std::string::npos);
  EXPECT_NE(says("concrete,,1,2,3,4,5,6,7,8", "concrete,,1,2,3,4,,6,7,8")
                .find("elements.csv:2: node6: is filled, but a solid has four, eight, ten or twenty nodes"),
            std::string::npos);
  EXPECT_NE(says("rod,5,7,,", "rod,5,7,,3").find("elements.csv:3: node4: is filled, but a bar has two nodes"),
            std::string::npos);
}

TEST(SolidFolder, IsAHexahedronInParaView) {
  const TestFolder folder;
  const fe::Model model = cube();
  fe::ParametricSystem system;
  system.pattern.resize(48, 48);
  system.expansion.resize(48, 48);
  system.expansion.setIdentity();
  dynamics::EigenModes modes;
  modes.frequency_Hz = Eigen::VectorXd::Constant(1, 1.0);
  modes.shapes = Eigen::VectorXd::Unit(48, 0);
  write_vtu(model, system, modes, folder.path() / "model.vtu");
  const std::string text = folder.read("model.vtu");
  EXPECT_NE(text.find("Name=\"connectivity\" format=\"ascii\">\n0 1 2 3 4 5 6 7\n4 6\n"), std::string::npos);
  EXPECT_NE(text.find("Name=\"offsets\" format=\"ascii\">\n8\n10\n"), std::string::npos);
  EXPECT_NE(text.find("Name=\"types\" format=\"ascii\">\n12\n3\n"), std::string::npos);
}

TEST(SolidFolder, QuadraticSolidsHaveTheirCellsInParaView) {
  const TestFolder folder;
  const fe::Model model = quadratic_cube();
  const auto size = 6 * static_cast<int>(model.nodes.size());
  fe::ParametricSystem system;
  system.pattern.resize(size, size);
  system.expansion.resize(size, size);
  system.expansion.setIdentity();
  dynamics::EigenModes modes;
  modes.frequency_Hz = Eigen::VectorXd::Constant(1, 1.0);
  modes.shapes = Eigen::VectorXd::Unit(size, 0);
  write_vtu(model, system, modes, folder.path() / "model.vtu");
  EXPECT_NE(folder.read("model.vtu").find("Name=\"types\" format=\"ascii\">\n25\n3\n"), std::string::npos);
}

}  // namespace
}  // namespace twindeck::model_io::test
