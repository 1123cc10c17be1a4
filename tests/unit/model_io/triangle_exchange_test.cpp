/// Oracles: identity (a shell of three nodes comes back from a folder, from an .inp file of ours and from a deck with each of
/// the four names of such an element), and messages that name line and column.
#include "fe/assembly.hpp"
#include "model_io/any_model_folder.hpp"
#include "model_io/inp.hpp"
#include "model_io/write_model.hpp"
#include "test_folder.hpp"

namespace twindeck::model_io::test {
namespace {

/// A square and a triangle on its right side, in each of the names that a three-node shell has; `section` is its card.
std::string deck_with(const std::string& type, const std::string& section) {
  return "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 2, 0.5, 0\n"
         "*ELEMENT, TYPE=S4, ELSET=SQUARE\n1, 1, 2, 3, 4\n"
         "*ELEMENT, TYPE=" +
         type +
         ", ELSET=TIP\n2, 2, 5, 3\n"
         "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e11, 0.3\n*DENSITY\n7850\n"
         "*SHELL SECTION, ELSET=SQUARE, MATERIAL=STEEL\n0.02\n" +
         section + "*BOUNDARY\n1, 1, 6\n4, 1, 6\n";
}

void expect_triangle(const fe::Model& model) {
  ASSERT_EQ(model.elements.size(), 2U);
  const fe::Element& e = model.elements[model.elements[0].nodes.size() == 3 ? 0 : 1];  // in whatever order they were written
  EXPECT_EQ(e.type, fe::ElementType::shell);
  EXPECT_EQ(e.nodes, (std::vector<int>{1, 4, 2}));
  EXPECT_EQ(e.group, "TIP");
  EXPECT_EQ(model.sections[static_cast<std::size_t>(e.section)].thickness_m, 0.03);
  EXPECT_NO_THROW(fe::validate(model));
}

TEST(TriangleExchange, EveryNameOfAThreeNodeShellIsRead) {
  const TestFolder folder;
  const std::string shell = "*SHELL SECTION, ELSET=TIP, MATERIAL=STEEL\n0.03\n",
                    user =
                        "*USER ELEMENT, TYPE=US3, NODES=3, INTEGRATION POINTS=3, MAXDOF=6\n"
                        "*USER SECTION, ELSET=TIP, MATERIAL=STEEL, CONSTANTS=6\n0.03\n";
  for (const char* type : {"S3", "S3R", "STRI3", "us3"}) {
    folder.write("tip.inp", deck_with(type, std::string(type) == "us3" ? user : shell));
    expect_triangle(read_inp(folder.path() / "tip.inp").model);
  }
  folder.write("tip.inp", deck_with("S3", shell) + "*USER ELEMENT, TYPE=U1, NODES=2\n");
  EXPECT_NE(message_of([&] { (void)read_inp(folder.path() / "tip.inp"); }).find("unsupported card"), std::string::npos);
}

// Oracle: the same deck without the comma. A comma at the end of a card that another card follows used to swallow that card:
// the supports were lost without a word.
TEST(InpCards, AMeaninglessCommaAtTheEndOfACardSwallowsNothing) {
  const TestFolder folder;
  const std::string body = deck_with("S3", "*SHELL SECTION, ELSET=TIP, MATERIAL=STEEL\n0.03\n"),
                    supports = body.substr(body.find("*BOUNDARY"));
  folder.write("step.inp", body.substr(0, body.find("*BOUNDARY")) + "*STEP,\n*FREQUENCY,\n10,\n\n" + supports + "*END STEP\n");
  const fe::Model model = read_inp(folder.path() / "step.inp").model;
  EXPECT_EQ(model.supports.size(), 2U);
  expect_triangle(model);
  folder.write("step.inp", "*MATERIAL,\nNAME=STEEL\n" +
                               body.substr(body.find("*ELASTIC"), body.find("*SHELL") - body.find("*ELASTIC")) +
                               body.substr(0, body.find("*MATERIAL")) + body.substr(body.find("*SHELL")));
  expect_triangle(read_inp(folder.path() / "step.inp").model);  // a parameter on the next line still belongs to its card
}

TEST(TriangleExchange, ComesBackFromItsOwnFilesAndFolder) {
  const TestFolder folder;
  folder.write("tip.inp", deck_with("S3", "*SHELL SECTION, ELSET=TIP, MATERIAL=STEEL\n0.03\n"));
  const fe::Model model = read_inp(folder.path() / "tip.inp").model;
  for (const InpFlavour flavour : {InpFlavour::abaqus, InpFlavour::calculix}) {
    const auto notes = write_inp(model, {}, flavour, 3, folder.path() / "again.inp");
    const std::string said = notes.empty() ? "" : notes.front();
    EXPECT_EQ(said.find("S3") != std::string::npos, flavour == InpFlavour::calculix) << said;
    expect_triangle(read_inp(folder.path() / "again.inp").model);
  }
  write_model(model, folder.path() / "model");
  expect_triangle(read_model(folder.path() / "model"));
}

TEST(TriangleExchange, AShellNeedsItsFirstThreeNodes) {
  const TestFolder folder;
  folder.write("tip.inp", deck_with("S3", "*SHELL SECTION, ELSET=TIP, MATERIAL=STEEL\n0.03\n"));
  write_model(read_inp(folder.path() / "tip.inp").model, folder.path());
  folder.edit("elements.csv", ",2,5,3,,", ",2,5,,,");
  const std::string message = message_of([&] { (void)read_model(folder.path()); });
  EXPECT_NE(message.find("elements.csv:3"), std::string::npos) << message;
  EXPECT_NE(message.find("node3"), std::string::npos) << message;
}

}  // namespace
}  // namespace twindeck::model_io::test
