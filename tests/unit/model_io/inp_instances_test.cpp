/// Oracles: coordinates worked out by hand, the same structure written flat (frequencies to nine digits), and six motions
/// without frequency of a free structure whose halves are tied across a gap.
#include <fmt/format.h>

#include <cmath>

#include "model_io/inp.hpp"
#include "nastran_deck.hpp"

namespace twindeck::model_io::test {
namespace {

const std::string steel_card = "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e11, 0.3\n*DENSITY\n7850\n";

/// Two beams of 1 m along x; a set of both, one of the end.
const std::string arm_part =
    "*PART, NAME=ARM\n*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 2, 0, 0\n*ELEMENT, TYPE=B31, ELSET=GIRDER\n1, 1, 2\n2, 2, 3\n"
    "*NSET, NSET=END\n3\n*BEAM SECTION, ELSET=GIRDER, MATERIAL=STEEL, SECTION=RECT\n0.1, 0.2\n0., 1., 0.\n*END PART\n";

std::string two_arms(const std::string& second, const std::string& rest) {
  return arm_part + "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=LEFT, PART=arm\n*END INSTANCE\n*INSTANCE, NAME=RIGHT, PART=ARM\n" +
         second + "*END INSTANCE\n" + rest + "*END ASSEMBLY\n" + steel_card;
}

ImportedModel read_text(const std::string& deck) {
  const TestFolder folder;
  folder.write("deck.inp", deck);
  return read_inp(folder.path() / "deck.inp");
}

const fe::Node& node_at(const fe::Model& model, long id) {
  const auto found = std::find_if(model.nodes.begin(), model.nodes.end(), [id](const fe::Node& n) { return n.id == id; });
  EXPECT_NE(found, model.nodes.end()) << id;
  return found == model.nodes.end() ? model.nodes.front() : *found;
}

TEST(InpInstances, AreMovedThenTurnedAndKeepTheirSetsApart) {
  // Moved by (0, 5, 0), then a quarter turn about a line along z through (0, 5, 0): x points along y, y against x.
  const ImportedModel read = read_text(two_arms("0., 5., 0.\n0., 5., 0., 0., 5., 1., 90.\n",
                                                "*NSET, NSET=FEET, INSTANCE=LEFT\n1\n*NSET, NSET=FEET, INSTANCE=RIGHT\n1\n"
                                                "*BOUNDARY\nFEET, 1, 6\n"));
  const fe::Model& m = read.model;
  ASSERT_EQ(m.nodes.size(), 6U);
  EXPECT_EQ(node_at(m, 3).x_m, Eigen::Vector3d(2.0, 0.0, 0.0));
  EXPECT_LT((node_at(m, 13).x_m - Eigen::Vector3d(0.0, 7.0, 0.0)).norm(), 1e-12);
  ASSERT_EQ(m.elements.size(), 4U);
  EXPECT_EQ(m.elements[0].group, "LEFT.GIRDER");
  EXPECT_EQ(m.elements[2].group, "RIGHT.GIRDER");
  EXPECT_EQ(m.elements[2].id, 11);
  EXPECT_EQ(m.sections.size(), 1U);  // one section card, one section
  EXPECT_EQ(m.sections[0].name, "GIRDER");
  // n1 = y of the part: z of the beam is x × y, and stays z under this turn.
  EXPECT_LT((m.elements[2].orientation - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_EQ(m.supports.size(), 2U);
  EXPECT_TRUE(m.monitoring_points.contains("LEFT.END"));
  EXPECT_TRUE(m.monitoring_points.contains("RIGHT.END"));
  EXPECT_EQ(m.nodes[static_cast<std::size_t>(m.monitoring_points.at("RIGHT.END"))].id, 13);
  const std::string notes = fmt::format("{}", fmt::join(read.notes, "\n"));
  EXPECT_NE(notes.find("instance RIGHT: node n of the file is node 10 + n of the model"), std::string::npos) << notes;
  // About the member's own line the turn is seen by its section alone.
  const fe::Model rolled =
      read_text(two_arms("0., 5., 0.\n0., 5., 0., 1., 5., 0., 90.\n", "*BOUNDARY\nLEFT.1, 1, 6\nRIGHT.1, 1, 6\n")).model;
  EXPECT_LT((rolled.elements[2].orientation + Eigen::Vector3d::UnitY()).norm(), 1e-12);
}

TEST(InpInstances, AJoinedPairIsTheFlatStructure) {
  const std::string foot = "*BOUNDARY\n";
  const fe::Model joined =
      read_text(two_arms("2., 0., 0.\n", "*MPC\nTIE, RIGHT.1, LEFT.3\n*EQUATION\n2\nRIGHT.3, 2, 1., LEFT.3, 2, -1.\n") + foot +
                "LEFT.1, 1, 6\n")
          .model;
  const fe::Model flat = read_text(
                             "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 2, 0, 0\n4, 3, 0, 0\n5, 4, 0, 0\n*ELEMENT, TYPE=B31, ELSET=G\n"
                             "1, 1, 2\n2, 2, 3\n3, 3, 4\n4, 4, 5\n*BEAM SECTION, ELSET=G, MATERIAL=STEEL, SECTION=RECT\n"
                             "0.1, 0.2\n0., 1., 0.\n*EQUATION\n2\n5, 2, 1., 3, 2, -1.\n" +
                             steel_card + foot + "1, 1, 6\n")
                             .model;
  ASSERT_EQ(joined.constraints.size(), 1U);
  const std::vector<double> a = frequencies(joined, 6), b = frequencies(flat, 6);
  for (std::size_t i = 0; i < b.size(); ++i) EXPECT_NEAR(a[i] / b[i], 1.0, 1e-9);
}

TEST(InpInstances, OneInstanceKeepsItsNumbersAndTheAssemblyMayOverlap) {
  const std::string deck = arm_part +
                           "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=ARM-1, PART=ARM\n*END INSTANCE\n*NODE\n1, 9, 0, 0\n"
                           "*ELEMENT, TYPE=SPRINGA, ELSET=ROPE\n1, 1, ARM-1.3\n*SPRING, ELSET=ROPE\n\n100.\n*END ASSEMBLY\n" +
                           steel_card + "*BOUNDARY\nARM-1.1, ENCASTRE\n1, 1, 3\n";
  const fe::Model m = read_text(deck).model;
  ASSERT_EQ(m.nodes.size(), 4U);
  EXPECT_EQ(node_at(m, 3).x_m.x(), 2.0);
  EXPECT_EQ(node_at(m, 11).x_m.x(), 9.0);
  EXPECT_EQ(m.springs.at(0).direction.x(), -1.0);
  EXPECT_EQ(m.elements[0].group, "GIRDER");
}

TEST(InpSteps, SupportsAreThoseOfTheStepWithTheModes) {
  const std::string model = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n9, 0, 0, 7\n*ELEMENT, TYPE=B31, ELSET=G\n1, 1, 2\n" + steel_card +
                            "*BEAM SECTION, ELSET=G, MATERIAL=STEEL, SECTION=RECT\n0.1, 0.2\n0., 1., 0.\n";
  const std::string steps =
      "*STEP\n*STATIC\n*BOUNDARY\n1, 1, 3\n*END STEP\n*STEP\n*FREQUENCY\n3\n{}*END STEP\n"
      "*STEP\n*STEADY STATE DYNAMICS\n1, 2\n*BOUNDARY\n1, 1, 6\n*END STEP\n";
  const auto held = [&](const std::string& here) {
    const ImportedModel read = read_text(model + fmt::format(fmt::runtime(steps), here));
    EXPECT_EQ(read.model.nodes.size(), 2U);  // node 9 belongs to nothing
    const std::string notes = fmt::format("{}", fmt::join(read.notes, "\n"));
    EXPECT_NE(notes.find("behind the step with *FREQUENCY, are left out"), std::string::npos) << notes;
    std::string all;
    for (const fe::Support& support : read.model.supports) {
      all += support.name + ":";
      for (const bool fixed : support.fixed) all += fixed ? '1' : '0';
      all += ' ';
    }
    return all;
  };
  EXPECT_EQ(held(""), "node_1:111000 ");
  EXPECT_EQ(held("*BOUNDARY\n2, 2\n"), "node_1:111000 node_2:010000 ");
  EXPECT_EQ(held("*BOUNDARY, OP=NEW\n2, 2\n*BOUNDARY, OP=NEW\n1, 6\n"), "node_2:010000 node_1:000001 ");
}

/// A block of nx × ny × nz solids over 2 × 1 × 1 m as a part, with its faces at x = 0 and x = 2.
std::string block_part(const std::string& name, int nx, int ny, int nz) {
  std::string nodes, elements, near, far;
  const auto id = [&](int i, int j, int k) { return (k * (ny + 1) + j) * (nx + 1) + i + 1; };
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
        nodes += fmt::format("{}, {}, {}, {}\n", id(i, j, k), 2.0 * i / nx, 1.0 * j / ny, 1.0 * k / nz);
  int e = 0;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        elements +=
            fmt::format("{}, {}, {}, {}, {}, {}, {}, {}, {}\n", ++e, id(i, j, k), id(i + 1, j, k), id(i + 1, j + 1, k),
                        id(i, j + 1, k), id(i, j, k + 1), id(i + 1, j, k + 1), id(i + 1, j + 1, k + 1), id(i, j + 1, k + 1));
        if (i == 0) near += fmt::format("{}, S6\n", e);
        if (i == nx - 1) far += fmt::format("{}, S4\n", e);
      }
  return "*PART, NAME=" + name + "\n*NODE\n" + nodes + "*ELEMENT, TYPE=C3D8, ELSET=" + name + "\n" + elements +
         "*SURFACE, NAME=NEAR\n" + near + "*SURFACE, NAME=FAR, TYPE=ELEMENT\n" + far + "*SOLID SECTION, ELSET=" + name +
         ", MATERIAL=STEEL\n*END PART\n";
}

std::string tied(const std::string& first, const std::string& second, double gap,
                 const std::string& tie = "*TIE, NAME=JOINT\n") {
  return first + second +
         fmt::format(
             "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=ONE, PART=ONE\n*END INSTANCE\n*INSTANCE, NAME=TWO, PART=TWO\n{}, 0., 0.\n"
             "*END INSTANCE\n{}TWO.NEAR, ONE.FAR\n*END ASSEMBLY\n",
             2.0 + gap, tie) +
         steel_card;
}

TEST(InpTies, MatchingMeshesAreOneMesh) {
  const fe::Model apart = read_text(tied(block_part("ONE", 2, 2, 1), block_part("TWO", 2, 2, 1), 0.0)).model;
  EXPECT_EQ(apart.constraints.size(), 18U);
  for (const fe::Constraint& c : apart.constraints) EXPECT_EQ(c.terms.size(), 1U);  // node on node
  const std::vector<double> f = frequencies(apart, 12);
  // The same block in one part of twice the length, shrunk to 4 m by its own nodes.
  std::string whole = block_part("ONE", 4, 2, 1);
  const fe::Model one = [&] {
    fe::Model model =
        read_text(whole + "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=ONE, PART=ONE\n*END INSTANCE\n*END ASSEMBLY\n" + steel_card)
            .model;
    for (fe::Node& node : model.nodes) node.x_m.x() *= 2.0;
    return model;
  }();
  const std::vector<double> g = frequencies(one, 12);
  for (std::size_t i = 6; i < 12; ++i) EXPECT_NEAR(f[i] / g[i], 1.0, 1e-8) << i;
}

TEST(InpTies, OtherMeshesAcrossAGapStillMoveAsOneBody) {
  for (const double gap : {0.0, 0.02}) {
    const ImportedModel read = read_text(tied(block_part("ONE", 2, 2, 2), block_part("TWO", 2, 3, 3), gap));
    const std::vector<double> f = frequencies(read.model, 7);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_LT(f[i], 1e-4 * f[6]) << "gap " << gap << ", mode " << i + 1;
    EXPECT_GT(f[6], 100.0);
    const std::string notes = fmt::format("{}", fmt::join(read.notes, "\n"));
    EXPECT_NE(notes.find("tie 'JOINT': 16 nodes of 'NEAR' follow the facets of 'FAR'"), std::string::npos) << notes;
  }
}

TEST(InpTies, ComeBackFromAFileOfOurs) {
  // Turned by 90 degrees, so that coordinates are rounded.
  std::string deck = tied(block_part("ONE", 2, 2, 2), block_part("TWO", 2, 3, 3), 0.0);
  const std::string moved = "2, 0., 0.\n";
  deck.replace(deck.find(moved), moved.size(), "2., 0., 1.\n2., 0., 1., 3., 0., 1., -90.\n");
  const fe::Model model = read_text(deck).model;
  const TestFolder folder;
  for (const InpFlavour flavour : {InpFlavour::abaqus, InpFlavour::calculix}) {
    (void)write_inp(model, {}, flavour, 3, folder.path() / "again.inp");
    const fe::Model again = read_inp(folder.path() / "again.inp").model;
    const std::vector<double> f = frequencies(model, 10), g = frequencies(again, 10);
    for (std::size_t i = 6; i < 10; ++i) EXPECT_NEAR(g[i] / f[i], 1.0, 1e-8) << i;
  }
}

TEST(InpTies, RefusalsNameTheirLine) {
  const std::string one = block_part("ONE", 1, 1, 1), two = block_part("TWO", 1, 1, 1);
  const auto message = [&](const std::string& deck) { return message_of([&] { (void)read_text(deck); }); };
  const auto expect = [](const std::string& said, const std::string& words) {
    EXPECT_NE(said.find("deck.inp:"), std::string::npos) << said;
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  expect(message(tied(one, two, 0.5)), "no node of 'NEAR' lies within 0.05 of 'FAR'");
  expect(message(tied(one, two, 0.0, "*TIE, NAME=J, CYCLIC SYMMETRY\n")), "unsupported parameter CYCLIC SYMMETRY");
  expect(message(tied(one, two, 0.0, "*TIE, NAME=J, POSITION TOLERANCE=-1.\n")), "POSITION TOLERANCE is negative");
  expect(message(tied(one, two, 0.0, "*TIE, NAME=J\nTWO.NEER, ONE.FAR\n")), "no surface is called 'TWO.NEER'");
  expect(message(tied(one, two, 0.0, "*BOUNDARY\nTWO.1, 1, 3\n*TIE, NAME=J\n")), "which *BOUNDARY holds");
  expect(message(tied(one, two, 0.0, "*EQUATION\n2\nTWO.1, 1, 1., ONE.1, 1, -1.\n*TIE, NAME=J\n")),
         "follows a link or an equation already");
  std::string deck = tied(one, two, 0.0);
  deck.replace(deck.find("PART=TWO"), 8, "PART=TOW");
  expect(message(deck), "no part above is called 'TOW'");
  deck = tied(one, two, 0.0);
  deck.replace(deck.find("NAME=TWO, PART"), 14, "NAME=one, PART");
  expect(message(deck), "a second instance is called 'one'");
  deck = tied(one, two, 0.0);
  deck.replace(deck.find("2, 0., 0.\n"), 10, "2, 0., 0.\n1., 1., 1., 1., 1., 1., 30.\n");
  expect(message(deck), "the two points of the axis of rotation are one");
  deck = tied(one, two, 0.0);
  deck.replace(deck.find("1, S4"), 5, "1, S7");
  expect(message(deck), "'S7' is no face of element 1, a C3D8");
  deck = tied(one, two, 0.0);
  deck.erase(deck.find("*END INSTANCE\n"), 14);
  expect(message(deck), "stands inside of *INSTANCE");
  expect(message(two_arms("", "*BOUNDARY\n1, 1, 6\n")), "write INSTANCE.number for a node of an instance");
  expect(message(two_arms("", "*NSET, NSET=X, GENERATE\n1, 3\n")), "name the instance by INSTANCE=");
  expect(message(two_arms("", "*NSET, NSET=X, INSTANCE=RIHGT\n1\n")), "no instance is called 'RIHGT'");
  expect(message(two_arms("", "*SURFACE, NAME=X\n1, SPOS\n")), "element 1 is not defined in the assembly");
  expect(message(two_arms("", "*MPC\nPIN, LEFT.1, RIGHT.3\n")), "MPC PIN joins two nodes that do not lie at one place");
}

// The plate's mesh in a file of its own, its section on the card of general sections, with directions that isotropy makes idle.
TEST(InpIncludes, AreReadInTheirPlace) {
  const TestFolder folder;
  std::filesystem::create_directories(folder.path() / "mesh");
  folder.write("mesh/plate.inc",
               "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n*INCLUDE, INPUT=shells.inc\n");
  folder.write("mesh/shells.inc", "*ELEMENT, TYPE=S4R, ELSET=PLATE\n1, 1, 2, 3, 4\n");
  const std::string rest =
      "*ORIENTATION, NAME=ALONG\n1., 0., 0., 0., 1., 0.\n3, 0.\n*SHELL GENERAL SECTION, ELSET=PLATE, MATERIAL=M, "
      "ORIENTATION=ALONG, OFFSET=0.\n0.01\n*MATERIAL, NAME=M\n*ELASTIC\n2.E11, 0.3\n*DENSITY\n8000.\n*BOUNDARY\n1, 1, 6\n";
  folder.write("deck.inp", "*INCLUDE, INPUT=mesh/plate.inc\n" + rest);
  const ImportedModel imported = read_inp(folder.path() / "deck.inp");
  EXPECT_EQ(imported.files.size(), 3u);
  EXPECT_EQ(imported.model.elements.size(), 1u);
  EXPECT_EQ(imported.model.sections.at(0).thickness_m, 0.01);
  folder.write("mesh/shells.inc", "*INCLUDE, INPUT=plate.inc\n");
  EXPECT_NE(message_of([&] {
              (void)read_inp(folder.path() / "deck.inp");
            }).find("shells.inc:1: *INCLUDE: the file 'plate.inc' includes itself"),
            std::string::npos);
}

}  // namespace
}  // namespace twindeck::model_io::test
