/// Oracles: Euler's cantilever, whose frequencies go with 1 / sqrt(mass per length), a plate's mass by hand, and the same mass
/// given in other words.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "model_io/inp.hpp"
#include "nastran_deck.hpp"

namespace twindeck::model_io::test::spread_masses {
namespace {

using std::numbers::pi;

constexpr double length_m = 10.0, side_m = 0.1, modulus_Pa = 2.1e11, density_kg_m3 = 8000.0;

/// Euler's cantilever of `per_length` kg/m.
double euler_Hz(double per_length) {
  const double inertia = std::pow(side_m, 4) / 12.0, beta = 1.875104068711961 / length_m;
  return beta * beta / (2.0 * pi) * std::sqrt(modulus_Pa * inertia / per_length);
}

ImportedModel abaqus(const std::string& mass, const std::string& more = "*BOUNDARY\n1, 1, 6\n") {
  const TestFolder folder;
  std::string deck = "*NODE\n";
  for (int i = 1; i <= 21; ++i) deck += fmt::format("{}, {}, 0, 0\n", i, 0.5 * (i - 1));
  deck += "*ELEMENT, TYPE=B33, ELSET=DECK\n";
  for (int i = 1; i <= 20; ++i) deck += fmt::format("{}, {}, {}\n", i, i, i + 1);
  folder.write("deck.inp", deck +
                               "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e11, 0.3\n*DENSITY\n8000.\n*BEAM SECTION, ELSET=DECK, "
                               "MATERIAL=STEEL, SECTION=RECT\n0.1, 0.1\n0, 1, 0\n" +
                               mass + more);
  return read_inp(folder.path() / "deck.inp");
}

TEST(SpreadMass, AbaqusGivesItInFourWays) {
  const double own = density_kg_m3 * side_m * side_m, added = 240.0;               // kg/m
  EXPECT_NEAR(frequencies(abaqus("").model, 1).at(0) / euler_Hz(own), 1.0, 1e-3);  // rotary inertia and mesh
  for (const char* units : {"MASS PER LENGTH\n240.", "MASS PER VOLUME\n24000.", "TOTAL MASS\n2400.",
                            "TOTAL MASS, DISTRIBUTION=VOLUME PROPORTIONAL\n2400."}) {
    const ImportedModel read = abaqus(fmt::format("*NONSTRUCTURAL MASS, ELSET=DECK, UNITS={}\n", units));
    EXPECT_NEAR(frequencies(read.model, 1).at(0) / euler_Hz(own + added), 1.0, 1e-3) << units;
    EXPECT_NE(fmt::format("{}", fmt::join(read.notes, " ")).find("a mass of 2400 in the deck's units"), std::string::npos);
  }
  const auto refused = [](const std::string& units) {
    return message_of([&] { (void)abaqus("*NONSTRUCTURAL MASS, ELSET=DECK, UNITS=" + units + "\n"); });
  };
  EXPECT_NE(refused("MASS PER AREA\n5.").find("is a mass per area, and element 1 has none"), std::string::npos);
  EXPECT_NE(refused("MASS\n5.").find("UNITS=MASS is not known"), std::string::npos);
  EXPECT_NE(refused("TOTAL MASS\n-5.").find("the mass is -5"), std::string::npos);
}

TEST(SpreadMass, AbaqusReleasesEndsOfBeams) {
  // Clamped at both nodes, and the end of the last beam turns freely: clamped and pinned.
  const ImportedModel read = abaqus("", "*RELEASE\n20, S2, M1-M2\n*BOUNDARY\n1, 1, 6\n21, 1, 6\n");
  const double ratio = std::pow(3.926602312 / 1.875104068711961, 2);
  EXPECT_NEAR(frequencies(read.model, 1).at(0) / (ratio * euler_Hz(density_kg_m3 * side_m * side_m)), 1.0, 1e-3);
  EXPECT_NE(message_of([] { (void)abaqus("*RELEASE\n20, S3, M1\n"); }).find("'M1' at end 'S3'"), std::string::npos);
}

std::string nastran_beam(const std::string& control, const std::string& cards) {
  std::string deck =
      control + "PARAM,COUPMASS,1\nMAT1,3,2.1+11,,.3,8000.\nSPC1,5,123456,1\nPBAR,7,3,.01,8.3333333-6,8.3333333-6,1.-5\n";
  for (int i = 1; i <= 21; ++i) deck += fmt::format("GRID,{},,{:.1f},0.,0.\n", i, 0.5 * (i - 1));
  for (int i = 1; i <= 20; ++i) deck += fmt::format("CBAR,{},,{},{}\n", i, i, i + 1);
  return deck + "BAROR,,7,,,0.,0.,1.\n" + cards;
}

TEST(SpreadMass, NastranGivesItByCardsOfItsOwnAndBarsByDefaults) {
  const TestFolder folder;
  const std::string chosen = "SOL 103\nCEND\nSPC = 5\nNSM = 9\nBEGIN BULK\n";
  const double heavy_Hz = euler_Hz(320.0);
  for (const char* cards :
       {"NSM1,9,PBAR,240.,7\n", "NSM1,9,ELEMENT,240.,1,THRU,20\n", "NSM,9,PBAR,7,240.\n", "NSML1,9,PBAR,2400.,ALL\n",
        "NSMADD,9,4\nNSM1,4,PBAR,240.,7\n", "NSM1,9,ELEMENT,240.,1,THRU,19,BY,2\nNSM1,9,ELEMENT,240.,2,THRU,20,BY,2\n"})
    EXPECT_NEAR(frequencies(import_deck(folder, nastran_beam(chosen, cards)).model, 1).at(0) / heavy_Hz, 1.0, 1e-3) << cards;
  // What no case control chooses is left out and said so; several sets without case control are refused.
  const ImportedModel other = import_deck(folder, nastran_beam("SOL 103\nCEND\nSPC = 5\nBEGIN BULK\n", "NSM1,9,PBAR,240.,7\n"));
  EXPECT_NEAR(frequencies(other.model, 1).at(0) / euler_Hz(80.0), 1.0, 1e-3);
  EXPECT_NE(fmt::format("{}", fmt::join(other.notes, " ")).find("nonstructural mass of set 9 is left out"), std::string::npos);
  EXPECT_NE(message_of([&] {
              (void)import_deck(folder, nastran_beam("", "NSM1,9,PBAR,240.,7\nNSM1,8,PBAR,24.,7\n"));
            }).find("several sets of nonstructural mass"),
            std::string::npos);
  // A plate: kg/m² over its thickness.
  const fe::Model plate = import_deck(folder,
                                      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,1.,0.\nGRID,4,,0.,1.,0.\n"
                                      "SPC1,1,123456,1,2\nCQUAD4,1,7,1,2,3,4\nPSHELL,7,3,.02,3\nMAT1,3,2.1+11,,.3,8000.\n"
                                      "NSM1,9,PSHELL,30.,7\n")
                              .model;
  EXPECT_NEAR(plate.materials.at(static_cast<std::size_t>(plate.elements.at(0).material)).density_kg_m3, 8000.0 + 30.0 / 0.02,
              1e-6);
}

}  // namespace
}  // namespace twindeck::model_io::test::spread_masses
