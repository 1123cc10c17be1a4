/// Decks of ANSYS. Oracles: closed forms (Euler-Bernoulli cantilever, masses on springs, Navier's plate, rods, a pendulum on a
/// rigid arm), which a wrong axis, constant or format would miss by far more than the tolerance.
#include "model_io/ansys.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "dynamics/eigenmodes.hpp"
#include "fe/assembly.hpp"
#include "model_io/deck_card.hpp"
#include "test_folder.hpp"

namespace twindeck::model_io::test::ansys_reading {
namespace {

using std::numbers::pi;

constexpr double within_beams = 0.01, within_shells = 0.02;  // [-] asked of the import

ImportedModel ansys_model(const std::string& deck) {
  const TestFolder folder;
  folder.write("deck.cdb", deck);
  return read_ansys(folder.path() / "deck.cdb");
}

Eigen::VectorXd ansys_frequencies_Hz(const fe::Model& model, int n_modes) {
  const fe::ParametricSystem system = fe::assemble(model, {});
  dynamics::ModalSolver solver(system);
  const dynamics::EigenModes modes = solver.solve_available(fe::initial_parameters(model), n_modes);
  EXPECT_TRUE(modes.status.converged) << modes.status.message;
  return modes.frequency_Hz;
}

Eigen::VectorXd deck_frequencies_Hz(const std::string& deck, int n_modes) {
  return ansys_frequencies_Hz(ansys_model(deck).model, n_modes);
}

void expect_near_part(double value, double target, double part) {
  EXPECT_NEAR(value / target, 1.0, part) << value << " " << target;
}

/// First bending frequency of a clamped beam of 10 m in steel.
double cantilever_Hz(double inertia_m4, double area_m2) {
  constexpr double root = 1.875104068711961, length = 10.0, modulus = 210e9, density = 7850.0;
  return root * root / (2.0 * pi) * std::sqrt(modulus * inertia_m4 / (density * area_m2 * std::pow(length, 4)));
}

constexpr const char* steel = "MP,EX,1,210E9\nMP,PRXY,1,0.3\nMP,DENS,1,7850\n";

/// 20 elements along X of the type, the section and the ending of E given, clamped at 0 and held in the plane of X and Z.
std::string cantilever(const std::string& type, const std::string& section, const std::string& third = "",
                       const std::string& held = "UY,,,,,ROTZ,ROTX") {
  std::string deck = "/BATCH\n/PREP7\nET,1," + type + "\n" + section + steel;
  for (int i = 0; i <= 20; ++i) deck += fmt::format("N,{},{}\n", i + 1, 0.5 * i);
  deck += "N,100,0,3,0 ! to the side\n";
  for (int i = 1; i <= 20; ++i) deck += fmt::format("E,{},{}{}\n", i, i + 1, third);
  return deck + "D,1,ALL\nNSEL,S,NODE,,2,21\nD,ALL," + held + "\nALLSEL\nFINISH\n/SOLU\nSOLVE\nnonsense, after it\n";
}

TEST(AnsysDeck, BeamsHaveTheirSectionTheRightWayRound) {
  // 0.1 m along y, 0.2 m along z, which is up: strong in the plane of X and Z.
  const double area = 0.02, strong = 0.1 * std::pow(0.2, 3) / 12.0, weak = 0.2 * std::pow(0.1, 3) / 12.0;
  const std::string rectangle = "SECTYPE,1,BEAM,RECT\nSECDATA,0.1,0.2\n";
  expect_near_part(deck_frequencies_Hz(cantilever("BEAM188", rectangle), 1)[0], cantilever_Hz(strong, area), 0.005);
  // A third node to the side turns z there.
  expect_near_part(deck_frequencies_Hz(cantilever("BEAM188", rectangle, ",100"), 1)[0], cantilever_Hz(weak, area), 0.005);
  const std::string whole = fmt::format("SECTYPE,1,BEAM,ASEC\nSECDATA,0.02,{},0,{},0,1E-5\n", strong, weak);
  expect_near_part(deck_frequencies_Hz(cantilever("188", whole), 1)[0], cantilever_Hz(strong, area), 0.005);
}

TEST(AnsysDeck, RealConstantsOfBeamsStandInTheirOrder) {
  const double area = 0.02, strong = 0.1 * std::pow(0.2, 3) / 12.0, weak = 0.2 * std::pow(0.1, 3) / 12.0;
  // A, IZZ, IYY, thicknesses, angle
  const std::string constants = fmt::format("R,1,0.02,{},{},0.2,0.1,", weak, strong);
  expect_near_part(deck_frequencies_Hz(cantilever("BEAM4", constants + "0\n"), 1)[0], cantilever_Hz(strong, area), 0.002);
  expect_near_part(deck_frequencies_Hz(cantilever("BEAM4", constants + "90\nRMORE,,1E-5\n"), 1)[0], cantilever_Hz(weak, area),
                   0.002);
  // BEAM3 lies in X-Y, and needs no support against the rest.
  const ImportedModel plane = ansys_model(cantilever("BEAM3", fmt::format("R,1,0.02,{},0.2\n", strong), "", "UZ"));
  expect_near_part(ansys_frequencies_Hz(plane.model, 1)[0], cantilever_Hz(strong, area), 0.002);
}

TEST(AnsysDeck, OffsetBeamsLieBesideTheirNodes) {
  // The node is 0.5 m above the centroid.
  const std::string deck = std::string("/PREP7\nET,1,BEAM188\nSECTYPE,1,BEAM,CTUBE\nSECDATA,0.09,0.1\nSECOFFSET,USER,0,0.5\n") +
                           steel + "N,1\nN,2,1\nE,1,2\nD,1,ALL\n";
  const fe::Element beam = ansys_model(deck).model.elements.at(0);
  EXPECT_NEAR((beam.offset_m[0] - Eigen::Vector3d(0.0, 0.0, -0.5)).norm(), 0.0, 1e-12);
  EXPECT_EQ(beam.offset_m[0], beam.offset_m[1]);
}

TEST(AnsysDeck, MassesOnSprings) {
  const std::string deck =
      "/prep7 $ et,1,combin14,,1 $ et,2,mass21,,,2 ! along x\n"
      "k = 8*10**2\nr,1,k\nr,2,2.0\nn,1\nn,2\nn,3\ntype,1 $ real,1\ne,1,2\ne,2,3\ntype,2 $ real,2\ne,2\ne,3\nd,1,ux\n";
  const Eigen::VectorXd f = deck_frequencies_Hz(deck, 2);
  ASSERT_EQ(f.size(), 2);
  for (int i = 0; i < 2; ++i)
    expect_near_part(f[i], std::sqrt(800.0 / 2.0 * (3.0 + (2 * i - 1) * std::sqrt(5.0)) / 2.0) / (2.0 * pi), 1e-9);
}

/// Plate 1.5 × 1 m, thickness in real constants, simply supported: as CDWRITE writes it, with blank coordinates at 0.
std::string plate(int nx, int ny) {
  std::string deck =
      "/COM,ANSYS RELEASE\n/PREP7\n/NOPR\n*IF,_CDRDOFF,EQ,1,THEN     !if solid\n_CDRDOFF=\n*ELSE\nNUMOFF,NODE, 9\n*ENDIF\n";
  const int nodes = (nx + 1) * (ny + 1);
  deck += fmt::format("ET,        1,181\nKEYOP,      1,    3,  2\nNBLOCK,6,SOLID,{0:10},{0:10}\n(3i9,6e21.13e3)\n", nodes);
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) {
      deck += fmt::format("{:9}{:9}{:9}{:21.13E}", j * (nx + 1) + i + 1, 0, 0, 1.5 * i / nx);
      deck += j > 0 ? fmt::format("{:21.13E}\n", 1.0 * j / ny) : "\n";
    }
  }
  deck += fmt::format("N,R5.3,LOC,       -1,\nEBLOCK,19,SOLID,{0:10},{0:10}\n(19i9)\n", nx * ny);
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const int a = j * (nx + 1) + i + 1;
      for (const int cell : {1, 1, 1, 1, 0, 0, 0, 0, 4, 0, j * nx + i + 1, a, a + 1, a + nx + 2, a + nx + 1})
        deck += fmt::format("{:9}", cell);
      deck += "\n";
    }
  }
  deck +=
      fmt::format("       -1\nCMBLOCK,PLATE   ,ELEM,       2  ! users element component\n(8i10)\n         1{:10}\n", -nx * ny);
  deck += "CMBLOCK,CORNER  ,NODE,       1  \n(8i10)\n         1\n";
  deck += "RLBLOCK,       1,       1,       1,       7\n(2i8,6g16.9)\n(7g16.9)\n       1       1 1.00000000E-02\n";
  deck += "MPTEMP,R5.0, 1, 1,  0.00000000    ,\nMPDATA,R5.0, 1,EX  ,       1, 1, 210000000000.    ,\n";
  deck += "MPDATA,R5.0, 1,NUXY,       1, 1, 0.300000000    ,\nMPDATA,R5.0, 1,DENS,       1, 1,  7850.00000    ,\n";
  deck += "NSEL,S,LOC,X,0\nNSEL,A,LOC,X,1.5\nD,ALL,UZ\nD,ALL,ROTX\nNSEL,S,LOC,Y,0\nNSEL,A,LOC,Y,1\nD,ALL,UZ,,,,,ROTY\nALLS\n";
  return deck + "D,ALL,UX,,,,,UY,ROTZ\nLUMPM, 0\n/GO\nFINISH\n";
}

TEST(AnsysArchive, PlateOfShells) {
  const fe::Model model = ansys_model(plate(16, 12)).model;
  EXPECT_EQ(model.nodes.size(), 221u);
  EXPECT_EQ(model.elements.at(7).group, "PLATE");
  EXPECT_EQ(model.monitoring_points.at("CORNER"), 0);
  EXPECT_FALSE(model.formulation.lumped_mass);
  const double stiffness = 210e9 * 1e-6 / (12.0 * (1.0 - 0.09)), mass = 7850.0 * 0.01;
  const Eigen::VectorXd f = ansys_frequencies_Hz(model, 2);
  for (int i = 0; i < 2; ++i)
    expect_near_part(f[i], pi / 2.0 * ((i + 1) * (i + 1) / 2.25 + 1.0) * std::sqrt(stiffness / mass), within_shells);
}

// Archives write the factors of hourglass and drilling stiffness of a shell section at their default, 1.
TEST(AnsysArchive, FactorsOfAShellSectionAtTheirDefault) {
  const std::string control = "SECTYPE,1,SHELL\nSECBLOCK,1\n0.02,1,0.0,3\nSECCONTROL,0.0,0.0,0.0,0.0,1.0,1.0,{}\n";
  EXPECT_EQ(ansys_model(plate(2, 2) + fmt::format(fmt::runtime(control), "1.0")).model.sections.at(0).thickness_m, 0.02);
  EXPECT_NE(message_of([&] { (void)ansys_model(plate(2, 2) + fmt::format(fmt::runtime(control), "10.0")); }).find("field 7"),
            std::string::npos);
}

TEST(AnsysArchive, OtherBlocksAndSelections) {
  // Two masses on two springs, in blocks without the word SOLID: element, type, real, material, axes, nodes.
  const std::string deck =
      "/PREP7\nET,1,COMBIN14,,3\nET,2,MASS21,,,2\nR,1,100\nR,2,4\n"
      "N,R5.3,LOC,1,0,0,0\nN,R5.3,LOC,2,0,0,1\nN,3,0,0,2\nN,9,5,5,5\n"
      "eblock,10,,,2\n(15i5)\n   11    1    1    1    0    1    2\n   12    1    1    1    0    2    3\n   -1\n"
      "eblock,10\n(15i5)\n   13    2    2    1    0    2    0    0\n   14    2    2    1    0    3\n-1\n"
      "ESEL,S,TYPE,,1\nCM,springs,ELEM\nNSLE,S\nNSEL,U,NODE,,2,3\nCM,ground,NODE\nD,ALL,ALL\n"
      "NSEL,INVE\nNSEL,R,LOC,Z,0.5,9\nD,ALL,UX\nALLSEL\n";
  const fe::Model model = ansys_model(deck).model;
  ASSERT_EQ(model.springs.size(), 2u);
  EXPECT_EQ(model.springs[1].group, "springs");
  EXPECT_EQ(model.masses.at(1).group, "mass21_real_2");
  EXPECT_EQ(model.monitoring_points.at("ground"), 0);
  ASSERT_EQ(model.supports.size(), 3u);
  EXPECT_EQ(model.supports[0].fixed, (std::array<bool, 6>{true, true, true, true, true, true}));
  EXPECT_EQ(model.supports[2].fixed, (std::array<bool, 6>{true, false, false, false, false, false}));
  const Eigen::VectorXd f = ansys_frequencies_Hz(model, 2);
  ASSERT_EQ(f.size(), 2);
  for (int i = 0; i < 2; ++i)
    expect_near_part(f[i], std::sqrt(25.0 * (3.0 + (2 * i - 1) * std::sqrt(5.0)) / 2.0) / (2.0 * pi), 1e-9);
}

TEST(AnsysArchive, TrianglesAreShellsOfThreeNodes) {
  const std::string deck = std::string("/PREP7\nET,1,SHELL181\nSECTYPE,1,SHELL\nSECDATA,0.01,2\n") + steel +
                           "MP,EX,2,70E9\nN,1\nN,2,1\nN,3,1,1\nN,4,0,1\nE,1,2,3,3\nE,1,3,4\nD,1,ALL\n";
  const fe::Model model = ansys_model(deck).model;
  EXPECT_EQ(model.elements.at(0).nodes, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(model.elements.at(1).nodes, (std::vector<int>{0, 2, 3}));
  EXPECT_EQ(model.materials.at(0).name, "mat_2");  // that of the layer
}

/// A rod along X of solids 1 × 1 × 1 m, held sideways: waves of dilatation.
std::string rod_of_solids(const std::string& type) {
  std::string deck = "/PREP7\nET,1," + type + "\n" + steel;
  int node = 0;
  for (int i = 0; i <= 10; ++i) {
    for (const auto& [y, z] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      deck += fmt::format("N,{},{},{},{}\n", ++node, i, y, z);
  }
  for (int i = 0; i < 10; ++i) {
    const int a = 4 * i;
    deck += fmt::format("EN,{},{},{},{},{},{},{},{},{}\n", i + 1, a + 1, a + 2, a + 3, a + 4, a + 5, a + 6, a + 7, a + 8);
  }
  return deck + "D,ALL,UY,,,,,UZ\nD,1,UX,0,,4,1\n";
}

TEST(AnsysDeck, RodsOfSolidsAndBars) {
  const double modulus = 210e9, wave = modulus * 0.7 / (1.3 * 0.4);
  for (const char* type : {"SOLID185", "SOLID45"})
    expect_near_part(deck_frequencies_Hz(rod_of_solids(type), 1)[0], std::sqrt(wave / 7850.0) / 40.0, within_beams);
  const std::string sideways = "UY,,,,,UZ";
  const double bar = std::sqrt(modulus / 7850.0) / 40.0;
  for (const std::string& section : {std::string("R,1,0.01\n"), std::string("SECTYPE,1,LINK\nSECDATA,0.01\n")})
    expect_near_part(deck_frequencies_Hz(cantilever("LINK180", section, "", sideways), 1)[0], bar, 0.001);
  expect_near_part(deck_frequencies_Hz(cantilever("LINK8", "R,1,0.01\n", "", sideways), 1)[0], bar, 0.001);
}

TEST(AnsysDeck, LumpedMassesAreThoseOfTheDeck) {
  // Rod of n = 20 elements: f = (c/(pi h)) sin(pi h/(4 L)) with lumped masses, below the exact one.
  std::string deck = cantilever("LINK8", "R,1,0.01\n", "", "UY,,,,,UZ");
  deck.insert(deck.find("/SOLU"), "LUMPM,ON\n");
  const double speed = std::sqrt(210e9 / 7850.0);
  expect_near_part(deck_frequencies_Hz(deck, 1)[0], speed / (pi * 0.5) * std::sin(pi * 0.5 / 40.0), 1e-6);
}

TEST(AnsysDeck, RigidArms) {
  // A mass of 3 kg, 2 m from a hinge with a spring of 1200 N m/rad.
  const std::string start =
      "/PREP7\nET,1,COMBIN14\nKEYOPT,1,2,6\nET,2,MASS21,,,2\nET,3,MPC184\nKEYOPT,3,1,1\nR,1,1200\nR,2,3\nN,1\nN,2\nN,3,2\n"
      "E,1,2\nTYPE,2\nREAL,2\nE,3\nD,1,ALL\nD,2,ALL\nDDELE,2,ROTZ\n";
  const double f = std::sqrt(1200.0 / 12.0) / (2.0 * pi);
  expect_near_part(deck_frequencies_Hz(start + "CERIG,2,3,ALL\n", 1)[0], f, 1e-9);
  expect_near_part(deck_frequencies_Hz(start + "TYPE,3\nE,2,3\n", 1)[0], f, 1e-9);
  // The arm as CDWRITE writes it: u_3 = u_2 + theta_2 x (2, 0, 0). The mass has no rotations to tie.
  const std::string equations =
      "CE,R5.0,DEFI,1,2,0.\nCE,R5.0,NODE,3,UX,1.,2,UX,-1.\nCE,R5.0,DEFI,2,3,0.\nCE,R5.0,NODE,3,UY,1.,2,UY,-1.\n"
      "CE,R5.0,NODE,2,ROTZ,-2.\nCE,3,0,3,UZ,1,2,UZ,-1,2,ROTY,2\n";
  expect_near_part(deck_frequencies_Hz(start + equations, 1)[0], f, 1e-9);
  // Nodes at one place, tied in all directions.
  expect_near_part(deck_frequencies_Hz(start + "N,4\nCP,1,ALL,2,4\nCERIG,4,3\n", 1)[0], f, 1e-9);
}

/// Two masses of 2 and 6 kg on springs of 600 N/m along X, free of each other.
const std::string two_oscillators =
    "/PREP7\nET,1,COMBIN14\nKEYOPT,1,2,1\nET,2,MASS21,,,2\nR,1,600\nR,2,2\nR,3,6\nN,1\nN,2,1\nN,11,,5\nN,12,1,5\n"
    "E,1,2\nE,11,12\nTYPE,2\nREAL,2\nE,2\nREAL,3\nE,12\nD,1,ALL\nD,11,ALL\nD,2,UY,,,12,10,UZ\n";

TEST(AnsysDeck, CoupledDisplacementsAndEquations) {
  const auto first_Hz = [](const std::string& rest) { return deck_frequencies_Hz(two_oscillators + rest, 1)[0] * 2.0 * pi; };
  EXPECT_NEAR(first_Hz(""), std::sqrt(600.0 / 6.0), 1e-6);
  EXPECT_NEAR(first_Hz("CP,1,UX,2,12\n"), std::sqrt(1200.0 / 8.0), 1e-6);  // apart, in one direction
  // u_2 = 2 u_12: k = 600 (4 + 1), m = 2 * 4 + 6. As CDWRITE and as a command write it, in either order.
  for (const char* equation :
       {"CE,1,0,2,UX,1,12,UX,-2\n", "CE,1,0,12,UX,-2,2,UX,1\n", "CE,R5.0,DEFI,1,2,0.\nCE,R5.0,NODE,2,UX,1.,12,UX,-2.\n"})
    EXPECT_NEAR(first_Hz(equation), std::sqrt(3000.0 / 14.0), 1e-6) << equation;
  // A displacement that is held takes its fellow with it; one that follows already lets another follow.
  EXPECT_NEAR(first_Hz("N,13,2,5\nE,12\nCP,1,UX,1,12\n"), std::sqrt(600.0 / 2.0), 1e-6);
}

TEST(AnsysDeck, RigidRegionsInSomeDirections) {
  // The mass follows the arm in Y alone, and hangs on a spring of its own in X.
  const std::string deck =
      "/PREP7\nET,1,COMBIN14\nKEYOPT,1,2,6\nET,2,MASS21,,,2\nET,3,COMBIN14\nKEYOPT,3,2,1\nR,1,1200\nR,2,3\nR,3,4800\nN,1\nN,2\n"
      "N,3,2\nN,4,3\nE,1,2\nTYPE,2\nREAL,2\nE,3\nTYPE,3\nREAL,3\nE,3,4\nD,1,ALL\nD,4,ALL\nD,2,ALL\nDDELE,2,ROTZ\nD,3,UZ\n"
      "CERIG,2,3,UY\n";
  const Eigen::VectorXd f = deck_frequencies_Hz(deck, 2);
  EXPECT_NEAR(f[0] * 2.0 * pi, 10.0, 1e-6);
  EXPECT_NEAR(f[1] * 2.0 * pi, 40.0, 1e-6);
}

TEST(AnsysDeck, TetrahedraAmongTheSolids) {
  // A confined rod of one tetrahedron: what is read has its four nodes.
  const fe::Model model = ansys_model("/PREP7\nET,1,SOLID185\n" + std::string(steel) +
                                      "N,1\nN,2,1\nN,3,0,1\nN,4,0,0,1\nE,1,2,3,3,4,4,4,4\nD,1,ALL,,,3\n")
                              .model;
  ASSERT_EQ(model.elements.size(), 1u);
  EXPECT_EQ(model.elements[0].nodes, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_NE(message_of([&] {
              (void)ansys_model("/PREP7\nET,1,SOLID185\n" + std::string(steel) +
                                "N,1\nN,2,1\nN,3,0,1\nN,4,0,0,1\nN,5,1,0,1\nN,6,0,1,1\nE,1,2,3,3,4,5,6,6\nD,1,ALL\n");
            }).find("of 6 different nodes: prism and pyramid are not supported"),
            std::string::npos);
}

TEST(AnsysDeck, FileBesideGivesWhatTheDeckDoesNot) {
  const TestFolder folder;
  folder.write("mast.cdb", cantilever("BEAM188", "SECTYPE,1,BEAM,CSOLID,rod\nSECDATA,0.05\n") + "\n");
  folder.write("mast.toml",
               "title = \"mast\"\n[[parameter]]\nname = \"E\"\ntarget = \"youngs_modulus\"\nof = [\"mat_1\"]\n"
               "unit = \"Pa\"\ninitial = 210e9\nlower = 150e9\nupper = 250e9\n");
  const fe::Model model = read_ansys(folder.path() / "mast.cdb").model;
  EXPECT_EQ(model.title, "mast");
  EXPECT_EQ(model.sections.at(0).name, "rod");
  EXPECT_EQ(model.nodes.size(), 21u);  // node 100 only gave a direction
  ASSERT_EQ(model.parameters.size(), 1u);
}

TEST(AnsysDeck, IsToldFromOtherPrograms) {
  const TestFolder folder;
  const auto is_deck = [&](const std::string& text) {
    folder.write("deck.dat", text);
    return is_ansys_deck(folder.path() / "deck.dat");
  };
  EXPECT_TRUE(is_deck("! a comment\n/COM,text\n*get,_w,active,,time,wall\n/prep7\n"));
  EXPECT_TRUE(is_deck("nblock,3,,2310\n(1i9,3e20.9e3)\n"));
  EXPECT_TRUE(is_deck("ET,1,BEAM188\n"));
  EXPECT_FALSE(is_deck("SOL 103\nCEND\nBEGIN BULK\nGRID,1,,0.,0.,0.\nENDDATA\n"));
  EXPECT_FALSE(is_deck("*HEADING\na plate\n*NODE\n1, 0., 0., 0.\n*ELEMENT, TYPE=S4\n1, 1, 2, 3, 4\n"));
  EXPECT_FALSE(is_ansys_deck(folder.path() / "not_there.cdb"));
}

TEST(AnsysExpression, IsPlainArithmetic) {
  const Parameters known = {{"A", 3.0}};
  const std::vector<std::pair<std::string, double>> sound = {{"0.375/2", 0.1875}, {"2*a**2+1", 19.0}, {"-(a-1)*2", -4.0},
                                                             {"1.E-002", 0.01},   {"2D3", 2000.0},    {" +4 ", 4.0},
                                                             {"1/2/2", 0.25}};
  for (const auto& [text, value] : sound) EXPECT_DOUBLE_EQ(evaluate(text, known).value_or(-1.0), value) << text;
  const std::vector<std::string> broken = {"",   "b",   "a(1)", "sqrt(4)", "1+",  "(1",
                                           "1)", "1/0", "'1'",  "%a%",     "1 2", std::string(9999, '(')};
  for (const std::string& text : broken) EXPECT_FALSE(evaluate(text, known).has_value()) << text;
}

}  // namespace
}  // namespace twindeck::model_io::test::ansys_reading
