/// Oracles: closed forms of oscillators whose stiffness is known by hand (arms, bushes, hinges, torsion), areas and second
/// moments of sections by formula, the mass of a deck by hand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "nastran_deck.hpp"

namespace twindeck::model_io::test {
namespace {

using std::numbers::pi;

double oscillator_Hz(double stiffness, double mass) { return std::sqrt(stiffness / mass) / (2.0 * pi); }

/// Grids 1 at the origin and 2 one metre along x; grid 1 clamped.
const std::string two_grids = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nMAT1,1,2.+11,8.+10,.25,7800.\nSPC1,1,123456,1\n";

fe::Model of(const TestFolder& folder, const std::string& cards) { return import_deck(folder, two_grids + cards).model; }

TEST(NastranElements, MassOnARigidArmAndMassOffItsGrid) {
  const TestFolder folder;
  // A torsion spring of 200 N m/rad about z at grid 1, a mass of 2 kg half a metre off: f = sqrt(k/(m d²)).
  const std::string spring = "GRID,1,,0.,0.,0.,,12345\nCELAS2,1,200.,1,6\n";
  const double expected = oscillator_Hz(200.0, 2.0 * 0.25);
  const fe::Model link = import_deck(folder, spring + "GRID,2,,.5,0.,0.\nRBE2,5,1,123456,2\nCONM2,9,2,,2.\n").model;
  EXPECT_NEAR(frequencies(link, 1).at(0), expected, 1e-9);
  const fe::Model bar = import_deck(folder, spring + "GRID,2,,.5,0.,0.\nRBAR,5,1,2,123456\nCONM2,9,2,,2.\n").model;
  EXPECT_NEAR(frequencies(bar, 1).at(0), expected, 1e-9);
  const fe::Model offset = import_deck(folder, spring + "CONM2,9,1,,2.,.3,.4\n").model;
  EXPECT_NEAR(frequencies(offset, 1).at(0), expected, 1e-9);
  // The same place in basic coordinates, and an inertia of its own about z.
  const fe::Model inertia = import_deck(folder, spring + "CONM2,9,1,-1,2.,.3,.4\n,,,,,,.5\n").model;
  EXPECT_NEAR(frequencies(inertia, 1).at(0), oscillator_Hz(200.0, 1.0), 1e-9);
  EXPECT_EQ(of(folder, "RBE2,5,1,123456,2\nCONM2,9,2,,2.\nCELAS2,1,5.,2,1\n").links.at(0).name, "rbe2_5_2");
}

TEST(NastranElements, BushApart) {
  const TestFolder folder;
  // Half-way between its grids: a force F at grid 2 moves it by F/K2 + F (L/2)²/K6.
  const fe::Model middle =
      of(folder, "CBUSH,1,4,1,2,0.,1.,0.\nPBUSH,4,K,1.+6,300.,300.,1.+6,1.+6,100.\nCONM2,9,2,,2.\nCONROD,7,1,2,1,1.-9\n");
  EXPECT_NEAR(frequencies(middle, 1).at(0), oscillator_Hz(1.0 / (1.0 / 300.0 + 0.25 / 100.0), 2.0),
              1e-5);  // a rod of 8 mg joins them too
  const fe::Model at_two =
      of(folder, "CBUSH,1,4,1,2,0.,1.,0.\n,1.0\nPBUSH,4,K,1.+6,300.,500.,1.+6,1.+6,1.+9\nCONM2,9,2,,2.\nCONROD,7,1,2,1,1.-9\n");
  EXPECT_NEAR(frequencies(at_two, 1).at(0), oscillator_Hz(300.0, 2.0), 1e-5);
  // Along its line alone it is a spring, and in the axes of CID to ground.
  EXPECT_EQ(of(folder, "CBUSH,1,4,1,2\nPBUSH,4,K,7.\n").springs.at(0).direction.x(), 1.0);
  const fe::Model ground = of(folder, "CBUSH,1,4,2,,,,,3\nCORD2R,3,0,0.,0.,0.,0.,0.,1.\n,0.,1.,0.\nPBUSH,4,K,7.,,,,9.\n");
  ASSERT_EQ(ground.springs.size(), 2U);
  EXPECT_NEAR((ground.springs[0].direction - Eigen::Vector3d::UnitY()).norm(), 0.0, 1e-12);
  EXPECT_TRUE(ground.springs[1].rotation);
  EXPECT_NEAR((ground.springs[1].direction + Eigen::Vector3d::UnitX()).norm(), 0.0, 1e-12);
}

TEST(NastranElements, ScalarSpringsAndMasses) {
  const TestFolder folder;
  const fe::Model m =
      of(folder,
         "PELAS,3,10.,,,4,20.\nCELAS1,1,4,1,2,2,2\nCELAS2,2,5.,2,1,1,3\nPMASS,7,2.5\nCMASS1,5,7,2,1\nCMASS2,6,2.5,2,2\n"
         "CMASS1,8,7,2,3\nCMASS2,9,1.5,1,2\n");
  ASSERT_EQ(m.springs.size(), 1U);
  EXPECT_EQ(m.springs[0].group, "pelas_4");
  EXPECT_TRUE(m.springs[0].direction.isApprox(Eigen::Vector3d::UnitY(), 1e-15));
  EXPECT_DOUBLE_EQ(m.springs[0].stiffness, 20.0);
  // Components that differ: a matrix on x of one grid and z of the other; a mass along y alone too.
  ASSERT_EQ(m.matrix_elements.size(), 2U);
  EXPECT_TRUE(m.matrix_elements[0].stiffness.isApprox((Eigen::Matrix2d() << 5.0, -5.0, -5.0, 5.0).finished(), 1e-15));
  EXPECT_EQ(m.matrix_elements[1].dofs.at(0).direction, 1);
  ASSERT_EQ(m.masses.size(), 1U);
  EXPECT_DOUBLE_EQ(m.masses[0].mass_kg, 2.5);
}

TEST(NastranElements, MemberWithOffsetsPinsAndVectorByGrid) {
  const TestFolder folder;
  const std::string cards = "GRID,3,,0.,0.,5.\nPBAR,4,1,.01,2.-5,1.-5,3.-5,78.\n,,,,,,,,\n,.8,.5,4.-6\n";
  const fe::Model m = of(folder, cards + "CBAR,1,4,1,2,3,,,,+\n+,,45,0.,0.,.1,0.,0.,.2\n");
  const fe::Element& e = m.elements.at(0);
  EXPECT_NEAR(e.orientation.dot(-Eigen::Vector3d::UnitY()), 1.0, 1e-2);  // v = z, so that local y is z, nearly
  EXPECT_EQ(e.releases, (1U << 9) | (1U << 10));
  EXPECT_TRUE(e.offset_m[1].isApprox(Eigen::Vector3d(0.0, 0.0, 0.2), 1e-15));
  const fe::Section& s = m.sections.at(0);
  EXPECT_DOUBLE_EQ(s.inertia_z_m4, 2e-5);
  EXPECT_DOUBLE_EQ(s.inertia_y_m4, 1e-5);
  EXPECT_DOUBLE_EQ(s.inertia_yz_m4, 4e-6);
  EXPECT_DOUBLE_EQ(s.shear_area_y_m2, 0.008);
  EXPECT_DOUBLE_EQ(s.shear_area_z_m2, 0.005);
  EXPECT_DOUBLE_EQ(m.materials.at(0).density_kg_m3, 7800.0 + 78.0 / 0.01);
  EXPECT_EQ(m.materials.at(0).name, "mat1_1_pbar_4");
}

// Mass along a member turns with its section; a rod has no such motion.
TEST(NastranElements, SaysThatNonstructuralMassTurnsWithTheSection) {
  const TestFolder folder;
  const auto notes = [&](const std::string& cards) {
    return fmt::format("{}", fmt::join(import_deck(folder, two_grids + cards).notes, "\n"));
  };
  const std::string bar = "CBAR,1,4,1,2,0.,1.,0.\nPBAR,4,1,.01,2.-5,1.-5,3.-5", turns = "(NSM) turns with the section";
  EXPECT_NE(notes(bar + ",78.\n").find("pbar_4: the spread mass " + turns), std::string::npos);
  EXPECT_EQ(notes(bar + "\n").find(turns), std::string::npos);
  EXPECT_EQ(notes("CONROD,7,1,2,1,.5,,,39.\nSPC1,1,23,2\n").find(turns), std::string::npos);
}

TEST(NastranElements, SectionsOfTheLibraries) {
  const TestFolder folder;
  const auto section = [&](const std::string& type, const std::string& dimensions) {
    return of(folder, "CBAR,1,4,1,2,0.,1.,0.\nPBARL,4,1,," + type + "\n," + dimensions + "\n").sections.at(0);
  };
  const fe::Section bar = section("BAR", "0.1,0.2");  // 0.1 along z, 0.2 along y
  EXPECT_NEAR(bar.inertia_z_m4, 0.1 * std::pow(0.2, 3) / 12.0, 1e-15);
  EXPECT_NEAR(bar.inertia_y_m4, 0.2 * std::pow(0.1, 3) / 12.0, 1e-15);
  EXPECT_NEAR(section("ROD", "0.1").torsion_m4, pi / 2.0 * 1e-4, 1e-15);
  EXPECT_NEAR(section("TUBE", "0.1,0.08").area_m2, pi * (0.01 - 0.0064), 1e-15);
  EXPECT_NEAR(section("TUBE2", "0.1,0.02").area_m2, pi * (0.01 - 0.0064), 1e-15);
  EXPECT_NEAR(section("BOX", "0.1,0.2,0.02,0.01").inertia_z_m4, (0.1 * 0.008 - 0.08 * std::pow(0.16, 3)) / 12.0, 1e-15);
  const fe::Section i = section("I", "0.3,0.15,0.15,0.007,0.01,0.01");
  EXPECT_NEAR(i.inertia_z_m4, (0.15 * 0.027 - 0.143 * std::pow(0.28, 3)) / 12.0, 1e-15);
  EXPECT_NEAR(i.shear_area_y_m2, 0.28 * 0.007, 1e-15);
}

TEST(NastranElements, BeamsThatTaper) {
  const TestFolder folder;
  const std::string beam = "CBEAM,1,4,1,2,0.,1.,0.\n";
  // End B by a line without stress points (YESA), K by the line below.
  const fe::Model m = of(folder, beam + "PBEAM,4,1,.01,2.-5,1.-5,,3.-5\n,0.,0.,0.,0.\n,YESA,1.0,.02\n,.5,.25\n");
  const fe::Element& e = m.elements.at(0);
  ASSERT_GE(e.section2, 0);
  const fe::Section& b = m.sections.at(static_cast<std::size_t>(e.section2));
  EXPECT_DOUBLE_EQ(b.area_m2, 0.02);
  EXPECT_DOUBLE_EQ(b.inertia_z_m4, 2e-5);  // blank: as at end A
  EXPECT_DOUBLE_EQ(b.shear_area_y_m2, 0.01);
  const fe::Model uniform = of(folder, beam + "PBEAM,4,1,.01,2.-5,1.-5,,3.-5\n");
  EXPECT_EQ(uniform.elements.at(0).section2, -1);
  EXPECT_DOUBLE_EQ(uniform.sections.at(0).shear_area_y_m2, 0.01);  // K1 blank: 1
  const fe::Model rod = of(folder, beam + "PBEAML,4,1,,ROD\n,.1,0.,YES,1.,.05\n");
  EXPECT_NEAR(rod.sections.at(1).area_m2, pi * 0.0025, 1e-15);
}

TEST(NastranElements, RodsTwistWhereSomethingHoldsTheirEnds) {
  const TestFolder folder;
  // The rod's torsion alone turns a disc about the axis: f = sqrt(G J/(L I)).
  const std::string rod = "CROD,1,4,1,2\nPROD,4,1,.01,1.-6\nCONM2,9,2\n,3.0\n";
  const fe::Model held = of(
      folder, rod + "SPC,1,2,12356\nCBAR,2,5,2,3,0.,1.,0.\nPBAR,5,1,.01,1.-7,1.-7,1.-12\nGRID,3,,2.,0.,0.\nSPC,1,3,123456\n");
  ASSERT_EQ(held.springs.size(), 1U);
  EXPECT_DOUBLE_EQ(held.springs[0].stiffness, 8e10 * 1e-6);
  EXPECT_NEAR(frequencies(held, 1).at(0) / oscillator_Hz(8e4, 3.0), 1.0, 1e-3);  // the bar's half inertia is 8e-4 of it
  const ImportedModel free = import_deck(folder, two_grids + rod + "CONROD,7,1,2,1,.5,,,39.\n");
  EXPECT_TRUE(free.model.springs.empty());
  EXPECT_EQ(free.model.elements.at(1).group, "conrod_7");
  EXPECT_DOUBLE_EQ(free.model.materials.at(1).density_kg_m3, 7878.0);
}

TEST(NastranElements, ShellsAndSolids) {
  const TestFolder folder;
  const fe::Model m =
      import_deck(folder,
                  "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\nGRID,5,,0.,0.,1.\nGRID,6,,1.,0.,1.\n"
                  "GRID,7,,1.,1.,1.\nGRID,8,,0.,1.,1.\nMAT1,1,1.+9,,.3,1000.\nCQUAD4,1,2,1,2,3,4\nPSHELL,2,1,.1,1,1.5,,,7.\n"
                  "CHEXA,2,3,1,2,3,4,5,6,+\n+,7,8\nPSOLID,3,1\n")
          .model;
  ASSERT_EQ(m.elements.size(), 2U);
  EXPECT_DOUBLE_EQ(m.sections.at(0).bending_inertia_ratio, 1.5);
  EXPECT_DOUBLE_EQ(m.materials.at(0).density_kg_m3, 1070.0);
  EXPECT_EQ(m.elements[1].type, fe::ElementType::solid);
  EXPECT_EQ(m.elements[1].nodes.size(), 8U);
  EXPECT_EQ(m.elements[1].group, "psolid_3");
}

TEST(NastranElements, AMeanOfGridsThatCarriesAMass) {
  const TestFolder folder;
  // Springs of 300 and 700 N/m under the ends of a line; the mean with weights 3 and 1 at a quarter of it hangs on
  // 1 / (0.75²/300 + 0.25²/700).
  const std::string deck =
      "GRID,1,,0.,0.,0.,,12456\nGRID,2,,1.,0.,0.,,12456\nGRID,5,,.25,0.,0.,,12456\nCELAS2,1,300.,1,3\n"
      "CELAS2,2,700.,2,3\nRBE3,7,,5,3,3.,3,1,1.\n,3,2\nCONM2,9,5,,2.\n";
  const double k = 1.0 / (0.75 * 0.75 / 300.0 + 0.25 * 0.25 / 700.0);
  EXPECT_NEAR(frequencies(import_deck(folder, deck).model, 1).at(0), oscillator_Hz(k, 2.0), 1e-9);
  // With the slope of the line too, the reference grid moves as the line does at its place, whatever the weights.
  const std::string with_slope =
      "GRID,1,,0.,0.,0.,,12456\nGRID,2,,1.,0.,0.,,12456\nGRID,5,,.25,0.,0.,,1246\nCELAS2,1,300.,1,3\n"
      "CELAS2,2,700.,2,3\nRBE3,7,,5,35,3.,3,1,1.\n,3,2\nCONM2,9,5,,2.\n";
  const fe::Model line = import_deck(folder, with_slope).model;
  ASSERT_EQ(line.constraints.size(), 2U);
  EXPECT_NEAR(line.constraints[0].terms.at(0).factor, 0.75, 1e-12);
  EXPECT_NEAR(line.constraints[1].terms.at(0).factor, 1.0, 1e-12);  // ry = (z1 - z2) / 1 m
  EXPECT_NEAR(line.constraints[1].terms.at(1).factor, -1.0, 1e-12);
  const fe::Model millimetres =
      import_deck(folder,
                  "GRID,1,,0.,0.,0.,,12456\nGRID,2,,1000.,0.,0.,,12456\nGRID,5,,250.,0.,0.,,1246\nCELAS2,1,.3,1,3\n"
                  "CELAS2,2,.7,2,3\nRBE3,7,,5,35,3.,3,1,1.\n,3,2\nCONM2,9,5,,.002\n",
                  "[units]\nlength = \"mm\"\nforce = \"N\"\n")
          .model;
  EXPECT_NEAR(millimetres.constraints[1].terms.at(0).factor, 1.0, 1e-12);
  EXPECT_NEAR(frequencies(millimetres, 1).at(0), frequencies(line, 1).at(0), 1e-9);
}

TEST(NastranElements, EquationsAndHinges) {
  const TestFolder folder;
  // A lever: z of grid 2 is -3 times that of grid 1, whose mass is 2 kg; the spring under grid 2 counts nine times.
  const std::string lever =
      "CEND\nSPC = 1\nMPC = 4\nBEGIN BULK\nGRID,1,,0.,0.,0.,,12456\nGRID,2,,1.,0.,0.,,12456\n"
      "MPC,4,2,3,2.,1,3,6.\nCELAS2,1,50.,2,3\nCONM2,9,1,,2.\nSPC1,1,1,1\n";
  EXPECT_NEAR(frequencies(import_deck(folder, lever).model, 1).at(0), oscillator_Hz(450.0, 2.0), 1e-9);
  // In a displacement system whose z points against the basic x.
  const std::string turned =
      "CEND\nSPC = 1\nMPC = 4\nBEGIN BULK\nCORD2R,3,,0.,0.,0.,-1.,0.,0.\n,0.,0.,1.\n"
      "GRID,1,,0.,0.,0.,,12456\nGRID,2,,1.,0.,0.,3\nMPC,4,2,3,2.,1,3,6.\nCELAS2,1,50.,2,3\n"
      "CONM2,9,1,,2.\nSPC1,1,12456,2\n";
  EXPECT_NEAR(frequencies(import_deck(folder, turned).model, 1).at(0), oscillator_Hz(450.0, 2.0), 1e-9);
  // RBE2 of 123: the bar that begins there is hinged, so that nothing but a torsion spring holds its rotation about y.
  const fe::Model hinge = of(folder,
                             "GRID,3,,1.,0.,0.,,46\nGRID,4,,3.,0.,0.,,1246\nRBE2,1,2,123,3\nSPC1,1,123456,2\n"
                             "CBAR,1,4,3,4,0.,1.,0.\nPBAR,4,2,1.,1.,1.,1.\nMAT1,2,2.+11,8.+10,.25,1.-9\nCELAS2,8,60.,3,5\n"
                             "CONM2,9,4,,2.\nCONROD,7,1,2,1,1.-9\n");
  EXPECT_NEAR(frequencies(hinge, 1).at(0), oscillator_Hz(60.0, 8.0), 1e-6);
}

TEST(NastranElements, DirectMatricesInTurnedAxes) {
  const TestFolder folder;
  // 40 N/m along the second direction of a system whose y is the basic -x; half of it by the factor of the case control.
  const std::string deck =
      "CEND\nSPC = 1\nK2GG = 0.5*kx\nBEGIN BULK\nCORD2R,3,,0.,0.,0.,0.,0.,1.\n,0.,1.,0.\n"
      "GRID,1,,0.,0.,0.,3\nDMIG,KX,0,6,1\nDMIG,KX,1,2,,1,2,40.\nCONM2,9,1,,2.\nSPC1,1,13456,1\nPARAM,WTMASS,.5\n";
  const fe::Model m = import_deck(folder, deck).model;
  EXPECT_NEAR(frequencies(m, 1).at(0), oscillator_Hz(20.0, 1.0), 1e-9);
  ASSERT_EQ(m.matrix_elements.size(), 1U);
  EXPECT_EQ(m.matrix_elements[0].dofs.at(0).direction, 0);
  EXPECT_EQ(m.matrix_elements[0].group, "dmig_KX");
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& words) {
    std::string changed = deck;
    changed.replace(changed.find(from), from.size(), to);
    const std::string message = message_of([&] { (void)import_deck(folder, changed); });
    EXPECT_NE(message.find("deck.bdf:"), std::string::npos) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  refused("0.5*kx", "KY", "3: K2GG: chooses the matrix KY, which no DMIG card has");
  refused("0.5*kx", "a*kx", "expected a number");
  refused("DMIG,KX,0,6,1", "DMIG,KX,0,1,1", "IFO 1, expected 6");
  refused("DMIG,KX,0,6,1", "DMIG,KX,0,6,3", "TIN 3, expected 1 or 2");
  refused("DMIG,KX,1,2,,1,2,40.", "DMIG,KX,1,0,,1,2,40.", "component 0 of point 1");
  refused("1,2,40.", "1,2,40.,,\n,1,2,41.", "stands twice");
  refused("K2GG", "K2PP", "K2PP");
}

struct Refusal {
  const char* cards;
  const char* words;
};

TEST(NastranElements, EveryRefusalNamesItsLine) {
  const TestFolder folder;
  // Each stands in line 5, below the four of two_grids.
  const std::vector<Refusal> refusals = {
      {"CTETRA,1,2,1,2,1,2,1,2", "2 of 6 grids on its edges"},
      {"CTRIA6,1,2,1,2,1,2,2", "2 of 3 grids on its edges"},
      {"CPENTA,1,2,1,2,3,4,5,6", "hexahedra"},
      {"RBE3,1,,1,456,1.,123,2", "do not determine component 4 of node 1"},
      {"RBE3,1,,1,123,1,123,2", "a weight is '1'"},
      {"RBE3,1,,1,123,1.,123,2\n,UM,2,1", "UM"},
      {"RBE3,1,,1,123,1.,123,7", "grid 7 is not defined"},
      {"DMIG,KX,0,6,1", "no case control chooses it"},
      {"PCOMP,1", "PSHELL"},
      {"CBAT,1,2,1,2", "unknown card (did you mean 'CBAR'?)"},
      {"MPC,1,1,1,1.,2,1,-1.", "no case control chooses its set"},
      {"=,*1", "repeats the card above"},
      {"CBAR,1,4,1,2,0.,1.,0.", "property 4 is no PBAR or PBARL"},
      {"CBAR,1,4,1,2,1.,0.,0.\nPBAR,4,1,1.,1.,1.,1.", "lies along the member"},
      {"CBAR,1,4,1,9,0.,1.,0.\nPBAR,4,1,1.,1.,1.,1.", "grid 9 is not defined"},
      {"CBAR,1,4,1,2,0.,1.,0.,GOO\nPBAR,4,1,1.,1.,1.,1.", "OFFT"},
      {"PBAR,4,1,1.,1.,1.\nCBAR,1,4,1,2,0.,1.,0.", "J is 0"},
      {"PBARL,4,1,,GBOX\n,1.,1.,1.,1.\nCBAR,1,4,1,2,0.,1.,0.", "'GBOX' is not read"},
      {"PBEAM,4,1,1.,1.,1.,,1.\n,YES,.5,2.\nCBEAM,1,4,1,2,0.,1.,0.", "between its ends"},
      {"PBAR,4,2,1.,1.,1.,1.\nCBAR,1,4,1,2,0.,1.,0.", "material 2 is no MAT1"},
      {"PELAS,4,1.\nPELAS,4,2.", "defined twice"},
      {"CELAS2,1,-5.,1,1", "0 or more"},
      {"CELAS2,1,5.,7,1\nSPOINT,7", "scalar point"},
      {"RBAR,1,1,2,123,456", "shares its six motions"},
      {"CONM2,1,1,,-1.", "negative"},
      {"GRID,3,5,0.,0.,0.\nCELAS2,1,1.,3,1", "coordinate system 5 is not defined"},
      {"CORD2R,5,5,0.,0.,0.,0.,0.,1.\n,1.\nGRID,3,5,0.,0.,0.\nCELAS2,1,1.,3,1", "leans on itself"},
      {"CORD2R,5,,0.,0.,0.,0.,0.,1.\n,0.,0.,2.\nGRID,3,5,0.,0.,0.\nCELAS2,1,1.,3,1", "one line"},
      {"CONM2,1,1,,x", "field 5 is 'x', expected a number"},
      {"CELAS2,1.5,3.,1,1,2,1.5", "whole number"},
      {"CONM2,1,1,,1.,,,,,+A\n+B,1.", "continuation of another card"},
      {"CELAS2,1,2,3,4,5,6,7,8,9,10", "more than ten fields"},
      {"PARAM,CK1,2.", "scales the matrices"}};
  for (const Refusal& refusal : refusals) {
    const std::string deck = two_grids + refusal.cards + "\nCONROD,99,1,2,1,1.\n";
    const std::string message = message_of([&] { (void)import_deck(folder, deck); });
    EXPECT_NE(message.find("deck.bdf:"), std::string::npos) << refusal.cards << "\n" << message;
    EXPECT_NE(message.find(refusal.words), std::string::npos) << refusal.cards << "\n" << message;
  }
  const std::string line = message_of([&] { (void)import_deck(folder, two_grids + "CPENTA,1,2,1,2,3,4,5,6\n"); });
  EXPECT_NE(line.find("deck.bdf:5: CPENTA 1: "), std::string::npos) << line;
}

TEST(NastranElements, WhatIsPassedOverIsSaid) {
  const TestFolder folder;
  const ImportedModel m =
      import_deck(folder, two_grids + "CONROD,1,1,2,1,1.\nGRID,7,,9.,9.,9.\nFORCE,1,2,,5.,1.,0.,0.\nFORCE,1,2,,5.,0.,1.,0.\n");
  const std::string notes = fmt::format("{}", fmt::join(m.notes, "\n"));
  EXPECT_NE(notes.find("FORCE cards (2, first in line 7 of deck.bdf) are left out: they are loads"), std::string::npos)
      << notes;
  EXPECT_NE(notes.find("grids that no element, mass or link uses are left out: 1"), std::string::npos) << notes;
}

}  // namespace
}  // namespace twindeck::model_io::test
