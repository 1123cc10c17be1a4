/// Oracles: closed forms of cantilevers and oscillators; the same deck in three field formats must give the same model; the
/// definitions of the coordinate systems; and for every refusal the words and the line that help to mend the deck.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "nastran_deck.hpp"

namespace twindeck::model_io::test {
namespace {

using std::numbers::pi;

enum class FieldFormat { free, small, large };

/// A card in one of the three formats; fields of at most eight letters.
std::string card(FieldFormat format, const std::vector<std::string>& fields) {
  std::string text = fields[0] + (format == FieldFormat::large ? "*" : "");
  if (format != FieldFormat::free) text.resize(8, ' ');
  for (std::size_t i = 1; i < fields.size(); ++i) {
    if (format == FieldFormat::free) {
      text += (i > 1 && (i - 1) % 8 == 0 ? ",\n," : ",") + fields[i];
      continue;
    }
    const std::size_t width = format == FieldFormat::large ? 16 : 8, per_line = format == FieldFormat::large ? 4 : 8;
    if (i > 1 && (i - 1) % per_line == 0) text += format == FieldFormat::large ? "\n*       " : "\n        ";
    std::string cell = fields[i];
    cell.resize(width, ' ');
    text += cell;
  }
  return text + "\n";
}

/// Ten metres of steel bar in twenty members along x, clamped at grid 1; plane 1 is vertical, I1 four times I2.
std::string cantilever_deck(FieldFormat format) {
  std::string deck = "SOL 103\nCEND\nTITLE = cantilever\nSPC = 5\nBEGIN BULK\nPARAM,COUPMASS,1\n";
  for (int i = 1; i <= 21; ++i)
    deck += card(format, {"GRID", std::to_string(i), "", fmt::format("{:.1f}", 0.5 * (i - 1)), "0.0", "0.0"});
  for (int i = 1; i <= 20; ++i)
    deck += card(format, {"CBAR", std::to_string(i), "7", std::to_string(i), std::to_string(i + 1), "0.0", "0.0", "1.0"});
  deck += card(format, {"PBAR", "7", "3", "0.02", "4.0-5", "1.0-5", "2.0-5"});
  deck += card(format, {"MAT1", "3", "2.1+11", "", "0.3", "7.85+3"});
  deck += card(format, {"SPC1", "5", "123456", "1"});
  return deck + "EIGRL,1,,,10\nENDDATA\nwhat stands here is not read\n";
}

/// First bending frequency of the cantilever by Euler.
double euler_Hz(double inertia_m4) {
  return 1.875104068711961 * 1.875104068711961 / (2.0 * pi) * std::sqrt(2.1e11 * inertia_m4 / (7850.0 * 0.02 * 1e4));
}

void expect_cantilever(const TestFolder& folder, FieldFormat format) {
  const ImportedModel imported = import_deck(folder, cantilever_deck(format));
  const fe::Model& model = imported.model;
  EXPECT_EQ(model.title, "cantilever");
  ASSERT_EQ(model.nodes.size(), 21U);
  ASSERT_EQ(model.elements.size(), 20U);
  EXPECT_EQ(model.elements[0].group, "pbar_7");
  EXPECT_EQ(model.materials[0].name, "mat1_3");
  EXPECT_NEAR(model.elements[0].orientation.dot(Eigen::Vector3d::UnitY()), -1.0, 1e-12);  // z = x × v
  const std::vector<double> f = frequencies(model, 2);
  EXPECT_NEAR(f[0] / euler_Hz(1e-5), 1.0, 1e-5);  // I2: across the vertical plane
  EXPECT_NEAR(f[1] / euler_Hz(4e-5), 1.0, 1e-5);
}

TEST(Nastran, CantileverHasItsClosedFormInEachFormat) {
  const TestFolder folder;
  for (const FieldFormat format : {FieldFormat::free, FieldFormat::small, FieldFormat::large})
    expect_cantilever(folder, format);
}

TEST(Nastran, LumpedMassUnlessTheDeckSaysCoupled) {
  const TestFolder folder;
  std::string deck = cantilever_deck(FieldFormat::free);
  EXPECT_FALSE(import_deck(folder, deck).model.formulation.lumped_mass);
  deck.replace(deck.find("PARAM,COUPMASS,1\n"), 17, "");
  EXPECT_TRUE(import_deck(folder, deck).model.formulation.lumped_mass);
  // The TOML file beside the deck has the last word.
  EXPECT_FALSE(import_deck(folder, deck, si_units + "[formulation]\nlumped_mass = false\n").model.formulation.lumped_mass);
}

TEST(Nastran, DrillingAsK6rot) {
  const TestFolder folder;
  const std::string deck = cantilever_deck(FieldFormat::free);
  EXPECT_DOUBLE_EQ(import_deck(folder, deck).model.formulation.drilling_factor, 1e-4);
  std::string stiffer = deck;
  stiffer.insert(deck.find("PARAM"), "PARAM,K6ROT,1.+4\n");
  EXPECT_DOUBLE_EQ(import_deck(folder, stiffer).model.formulation.drilling_factor, 1e-2);
}

const std::string oscillator_cards =
    "GRID           1             0.0     0.0     0.0           23456\n"
    "CELAS2         1    50.0       1       1\n";

TEST(Nastran, NumbersAsNastranWritesThem) {
  const TestFolder folder;
  const auto mass = [&](const std::string& field) {
    return import_deck(folder, oscillator_cards + "CONM2,9,1,," + field + "\n").model.masses.at(0).mass_kg;
  };
  EXPECT_DOUBLE_EQ(mass("3.0000+7"), 3e7);
  EXPECT_DOUBLE_EQ(mass("7.4851-4"), 7.4851e-4);
  EXPECT_DOUBLE_EQ(mass("+1.D2"), 100.0);
  EXPECT_DOUBLE_EQ(mass(".5"), 0.5);
  EXPECT_DOUBLE_EQ(mass("2.E-1"), 0.2);
  EXPECT_NE(message_of([&] { (void)mass("1.0x"); }).find("'1.0x'"), std::string::npos);
  // Eight columns a field, whatever runs together; a tab goes to the next multiple of eight; a comment ends the line.
  const ImportedModel run_together = import_deck(folder,
                                                 "GRID\t1\t\t0.0\t0.0\t0.0 $ origin\nGRID    2               "
                                                 "10.000001.0000002.000000\nCONROD  1       1       2       3       0.5\n"
                                                 "MAT1           32.0000+93.0000+8\nSPC1,1,123456,1\n");
  EXPECT_TRUE(run_together.model.nodes.at(1).x_m.isApprox(Eigen::Vector3d(10.0, 1.0, 2.0), 1e-15));
  EXPECT_DOUBLE_EQ(run_together.model.materials.at(0).shear_modulus_Pa, 3e8);
}

TEST(Nastran, MixedFieldsAndContinuations) {
  const TestFolder folder;
  // A large first line, a small continuation; and a free card that goes on behind a comma.
  const ImportedModel m = import_deck(folder, oscillator_cards +
                                                  "CONM2*                 9               1                             2.0\n"
                                                  "*\n"
                                                  "+           1.25             2.5                     4.0\n"
                                                  "PARAM,COUPMASS,1\nCONM2,10,1,,3.0,,,,,+A\n+A,1.0,,1.0,,,1.0\n");
  ASSERT_EQ(m.model.masses.size(), 2U);
  EXPECT_TRUE(m.model.masses[0].inertia_kg_m2.isApprox(Eigen::Vector3d(1.25, 2.5, 4.0), 1e-15));
  EXPECT_TRUE(m.model.masses[1].inertia_kg_m2.isOnes(1e-15));
}

TEST(Nastran, OscillatorInPoundsAndInches) {
  const TestFolder folder;
  const double k = 50.0, weight = 38.6088, g = 386.088;  // lbf/in, lbf, in/s2
  const ImportedModel m =
      import_deck(folder, oscillator_cards + fmt::format("PARAM,WTMASS,{}\nCONM2,9,1,,{}\n", 1.0 / g, weight),
                  "[units]\nlength = \"in\"\nforce = \"lbf\"\n");
  EXPECT_NEAR(frequencies(m.model, 1).at(0), std::sqrt(k * g / weight) / (2.0 * pi), 1e-9);
  EXPECT_NEAR(m.model.masses.at(0).mass_kg, weight * 0.45359237, 1e-4);  // 386.088 is standard gravity to five digits
  EXPECT_NEAR(m.model.springs.at(0).stiffness, 50.0 * 4.4482216152605 / 0.0254, 1e-6);
}

TEST(Nastran, CoordinateSystems) {
  const TestFolder folder;
  // System 1 has its origin at (1, 2, 3), z along global x and x along global y.
  const ImportedModel m =
      import_deck(folder,
                  "CORD2R,1,0,1.,2.,3.,2.,2.,3.\n,1.,3.,3.\n"
                  "CORD2C,2,1,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
                  "CORD2S,3,1,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
                  "GRID,1,1,1.,2.,3.\nGRID,2,2,2.,90.,5.\nGRID,3,3,2.,30.,90.\n"
                  "GRID,10,,0.,0.,0.\nGRID,11,,0.,1.,0.\nGRID,12,,0.,0.,1.\nCORD1R,4,10,11,12\nGRID,4,4,1.,0.,7.\n"
                  "CONROD,1,1,2,1,1.\nCONROD,2,2,3,1,1.\nCONROD,3,3,4,1,1.\nMAT1,1,1.+9,,.3\n");
  const auto near = [&](std::size_t i, const Eigen::Vector3d& x) {
    EXPECT_NEAR((m.model.nodes.at(i).x_m - x).norm(), 0.0, 1e-12) << i;
  };
  near(0, {1.0 + 3.0, 2.0 + 1.0, 3.0 + 2.0});
  near(1, {1.0 + 5.0, 2.0, 3.0 + 2.0});
  near(2, {1.0 + 2.0 * std::cos(pi / 6.0), 2.0, 3.0 + 2.0 * std::sin(pi / 6.0)});  // z, x = 0, y
  near(3, {0.0, 7.0, 1.0});  // system 4: z along global y, x along global z
}

TEST(Nastran, SupportsInTheGridsOwnAxes) {
  const TestFolder folder;
  const std::string rods = "GRID,1,,0.,0.,0.,1\nGRID,2,,1.,0.,0.\nCONROD,1,1,2,1,1.\nMAT1,1,1.+9,,.3\n";
  const std::string turned = "CORD2R,1,0,0.,0.,0.,1.,0.,0.\n,0.,1.,0.\n";  // its x is global y, y is z, z is x
  const ImportedModel m = import_deck(folder, rods + turned + "SPC1,1,34,1\n");
  EXPECT_EQ(m.model.supports.at(0).fixed, (std::array{true, false, false, false, true, false}));
  const std::string skew = "CORD2R,1,0,0.,0.,0.,0.,0.,1.\n,1.,1.,0.\n";
  EXPECT_EQ(import_deck(folder, rods + skew + "SPC1,1,123,1\n").model.supports.at(0).fixed,
            (std::array{true, true, true, false, false, false}));
  const ImportedModel guided = import_deck(folder, rods + skew + "SPC1,1,1,1\n");  // no motion along (1, 1, 0)
  EXPECT_TRUE(guided.model.supports.empty());
  const fe::Constraint& c = guided.model.constraints.at(0);
  EXPECT_EQ(c.terms.at(0).node, c.node);
  EXPECT_NE(c.terms.at(0).direction, c.direction);
  EXPECT_NEAR(c.terms.at(0).factor, -1.0, 1e-12);
  // Held along two of three axes it moves along (1, -1, 0) or z alone.
  EXPECT_EQ(import_deck(folder, rods + skew + "SPC1,1,13,1\n").model.supports.at(0).fixed,
            (std::array{false, false, true, false, false, false}));
}

TEST(Nastran, CaseControlChoosesTheSupports) {
  const TestFolder folder;
  const std::string cards =
      "BEGIN "
      "BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,2.,0.,0.\nCONROD,1,1,2,1,1.\nCONROD,2,2,3,1,1.\nMAT1,1,1.+9,,.3\n"
      "SPC1,1,123,1\nSPC,2,2,12\nSPC1,3,3,1,THRU,3\nSPCADD,9,1,2\nENDDATA\n";
  const auto held = [&](const std::string& control) {
    std::string list;
    for (const fe::Support& s : import_deck(folder, control + cards).model.supports) list += s.name + " ";
    return list;
  };
  EXPECT_EQ(held("SPC = 1\n"), "grid_1 ");
  EXPECT_EQ(held("CEND\nSUBCASE 1\n  SPC=9\n"), "grid_1 grid_2 ");
  EXPECT_EQ(held("CEND\nSPC = 3 $ all\n"), "grid_1 grid_2 grid_3 ");
  EXPECT_EQ(held("CEND\n"), "");
  EXPECT_NE(message_of([&] { held("SPC = 7\n"); }).find("the supports 7"), std::string::npos);
  EXPECT_NE(message_of([&] { held("SUBCASE 1\nSPC = 1\nSUBCASE 2\nSPC = 2\n"); }).find("another subcase"), std::string::npos);
}

TEST(Nastran, IncludedFiles) {
  const TestFolder folder;
  std::filesystem::create_directories(folder.path() / "parts");
  folder.write("parts/grids.inc", "GRID,1,,0.,0.,0.\nINCLUDE 'more.inc'\n");
  folder.write("parts/more.inc", "GRID,2,,1.,0.,0.\n");
  const std::string rest = "CONROD,1,1,2,1,1.\nMAT1,1,1.+9,,.3\n";
  const ImportedModel m = import_deck(folder, "BEGIN BULK\ninclude 'parts/\n  grids.inc'\n" + rest);
  EXPECT_EQ(m.model.nodes.size(), 2U);
  EXPECT_EQ(m.files.size(), 3U);
  EXPECT_NE(message_of([&] { (void)import_deck(folder, rest + "INCLUDE 'gone.inc'\n"); }).find("deck.bdf:3"),
            std::string::npos);
  folder.write("parts/more.inc", "INCLUDE 'grids.inc'\n");
  EXPECT_NE(message_of([&] { (void)import_deck(folder, "INCLUDE 'parts/grids.inc'\n" + rest); }).find("includes itself"),
            std::string::npos);
}

TEST(NastranReader, IncludesStayBelowTheFolderAndMessagesEchoNamesAlone) {
  const TestFolder folder;
  std::filesystem::create_symlink("/proc/self/environ", folder.path() / "inside.inc");
  for (const char* outside : {"/proc/self/environ", "../../proc/self/environ", "inside.inc"}) {
    const std::string said =
        message_of([&] { (void)import_deck(folder, fmt::format("BEGIN BULK\nINCLUDE '{}'\nENDDATA\n", outside)); });
    EXPECT_NE(said.find("deck.bdf:2: INCLUDE: the file does not lie below the folder of the deck"), std::string::npos) << said;
  }
  folder.write("shadow.inc", "username:secretword:19000,fieldtwo,fieldthree\n");
  const std::string said = message_of([&] { (void)import_deck(folder, "BEGIN BULK\nINCLUDE 'shadow.inc'\nENDDATA\n"); });
  EXPECT_NE(said.find("shadow.inc:1: USERNAME: unknown card"), std::string::npos) << said;
  for (const char* of_the_file : {"secret", "SECRET", "field"}) EXPECT_EQ(said.find(of_the_file), std::string::npos) << said;
}

TEST(Nastran, FilesAreKnownByTheirNames) {
  const TestFolder folder;
  folder.write("a.dat", "$ a comment\nGRID,1,,0.,0.,0.\n");
  folder.write("b.dat", "/PREP7\nN,1,0,0,0\n");
  EXPECT_TRUE(is_nastran_file(folder.path() / "a.dat"));
  EXPECT_FALSE(is_nastran_file(folder.path() / "b.dat"));
  EXPECT_TRUE(is_nastran_file("x.BDF"));
  EXPECT_FALSE(is_nastran_file("x.inp"));
}

TEST(Nastran, UnitsAreNotGuessed) {
  const TestFolder folder;
  const std::string deck = oscillator_cards + "CONM2,9,1,,1.0\n";
  const auto message = [&](const std::string& toml) { return message_of([&] { (void)import_deck(folder, deck, toml); }); };
  EXPECT_NE(message("").find("units.length: is missing"), std::string::npos) << message("");
  EXPECT_NE(message("[units]\nlength = \"mm\"\n").find("units.force"), std::string::npos);
  EXPECT_NE(message("[units]\nlength = \"yd\"\nforce = \"N\"\n").find("'yd' is unknown"), std::string::npos);
}

TEST(Nastran, DamagedDecksAreRefusedOrRead) {
  const TestFolder folder;
  const std::string sound = cantilever_deck(FieldFormat::small);
  std::mt19937 random(7);
  int refused = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::string deck = sound;
    for (int change = 0; change < 3; ++change) {
      const char letter = "0123456789 ,.-+*$=\tEABRGX\n"[random() % 26];
      deck[random() % deck.size()] = letter;
    }
    refused += message_of([&] { (void)import_deck(folder, deck); }).empty() ? 0 : 1;  // any other exception fails the test
  }
  EXPECT_GT(refused, 500);
  EXPECT_LT(refused, 2000);
}

}  // namespace
}  // namespace twindeck::model_io::test
