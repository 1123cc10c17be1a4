/// Decks that ask for modes about a loaded state, in each dialect. Oracle: closed forms. A hinged bar under an axial force N
/// has f_n sqrt(1 + N / (n² P)), P its Euler load; the weight of a hanging part is in balance with its axial force; a square
/// plate pressed by half its buckling load keeps sqrt(1/2) of its frequency.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "deck_table.hpp"
#include "fe/prestress.hpp"
#include "model_io/ansys.hpp"
#include "model_io/any_model_folder.hpp"
#include "model_io/inp.hpp"
#include "model_io/write_model.hpp"
#include "nastran_deck.hpp"

namespace twindeck::model_io::test::deck_stage {
namespace {

constexpr double closed = 0.01;  // [-] asked of the import

/// The bar: 10 m along X in ten beams, 0.2 × 0.4 m, E 210 GPa, 7850 kg/m3, hinged; half of its Euler load.
constexpr double E = 2.1e11, A = 0.08, L = 10.0, weak = 0.4 * 0.2 * 0.2 * 0.2 / 12.0, strong = 0.2 * 0.4 * 0.4 * 0.4 / 12.0;
const double half_euler = 0.5 * std::numbers::pi * std::numbers::pi * E * weak / (L * L);

/// Frequencies [Hz] of the first bending modes about both axes under the compression P.
std::vector<double> bar_under(double compression) {
  std::vector<double> f;
  for (const double inertia : {weak, strong}) {
    const double euler = std::numbers::pi * std::numbers::pi * E * inertia / (L * L);
    f.push_back(std::numbers::pi / (2.0 * L * L) * std::sqrt(E * inertia / (7850.0 * A)) *
                std::sqrt(1.0 - compression / euler));
  }
  return f;
}

void expect_bar(const std::string& program, const std::string& name, const fe::Model& model, double compression = half_euler) {
  expect_known_frequencies({program, name, "closed form", closed}, frequencies(model, 2), bar_under(compression));
}

/// @param ends  the *BOUNDARY lines of both ends along X; @param steps  all steps
std::string inp_deck(const std::string& ends, const std::string& steps, const std::string& before) {
  std::string deck = "*NODE\n";
  for (int i = 0; i <= 10; ++i) deck += fmt::format("{}, {}., 0., 0.\n", i + 1, i);
  deck += "*ELEMENT, TYPE=B33, ELSET=BEAMS\n";
  for (int i = 1; i <= 10; ++i) deck += fmt::format("{}, {}, {}\n", i, i, i + 1);
  deck +=
      "*NSET, NSET=ALL, GENERATE\n1, 11, 1\n*BEAM SECTION, ELSET=BEAMS, MATERIAL=STEEL, SECTION=RECT\n0.2, 0.4\n0., 1., 0.\n"
      "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1E11, 0.3\n*DENSITY\n7850.\n*EXPANSION\n1.2E-5\n"
      "*BOUNDARY\n1, 2, 4\n11, 2, 3\n" +
      ends + before + steps;
  return deck;
}

fe::Model inp_bar(const std::string& ends, const std::string& steps, const std::string& before = "") {
  const TestFolder folder;
  folder.write("bar.inp", inp_deck(ends, steps, before));
  return read_inp(folder.path() / "bar.inp").model;
}

const std::string modes = "*STEP, PERTURBATION\n*FREQUENCY\n4\n*END STEP\n";
const std::string plain_modes = "*STEP\n*FREQUENCY\n4\n*END STEP\n";

TEST(DeckStage, KeysBesideADeckLeaveItsLoadStepsAlone) {
  const TestFolder folder;
  folder.write("bar.inp", inp_deck("1, 1\n", "*STEP, NLGEOM\n*STATIC\n*CLOAD\n11, 1, -1.\n*END STEP\n" + plain_modes, ""));
  const int of_the_deck = read_inp(folder.path() / "bar.inp").model.prestress.load_steps;
  EXPECT_GT(of_the_deck, 1);
  folder.write("bar.toml", "title = \"bar\"\n");
  EXPECT_EQ(read_inp(folder.path() / "bar.inp").model.prestress.load_steps, of_the_deck);
  folder.write("bar.toml", "[prestress]\nload_steps = 3\n");
  EXPECT_EQ(read_inp(folder.path() / "bar.inp").model.prestress.load_steps, 3);
}

TEST(DeckStage, AbaqusAndCalculixForcesMovementsTemperaturesStresses) {
  const std::string force = fmt::format("*CLOAD\n11, 1, {:.8E}\n", -half_euler);
  expect_bar("Abaqus, CalculiX", "force_before_perturbation",
             inp_bar("1, 1\n", "*STEP\n*STATIC\n" + force + "*END STEP\n" + modes));
  expect_bar("Abaqus, CalculiX", "nlgeom", inp_bar("1, 1\n", "*STEP, NLGEOM\n*STATIC\n" + force + "*END STEP\n" + plain_modes));
  expect_bar(
      "Abaqus, CalculiX", "support_moved",
      inp_bar("1, 1\n11, 1\n",
              fmt::format("*STEP\n*STATIC\n*BOUNDARY\n11, 1, 1, {:.8E}\n*END STEP\n", -half_euler * L / (E * A)) + modes));
  expect_bar(
      "Abaqus, CalculiX", "warmed",
      inp_bar(
          "1, 1\n11, 1\n",
          fmt::format("*STEP\n*STATIC\n*TEMPERATURE\nALL, {:.8E}\n*END STEP\n", 20.0 + half_euler / (E * A * 1.2e-5)) + modes,
          "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, 20.\n"));
  expect_bar("Abaqus, CalculiX", "initial_stress",
             inp_bar("1, 1\n11, 1\n", "*STEP, NLGEOM=YES\n*STATIC\n*END STEP\n" + plain_modes,
                     fmt::format("*INITIAL CONDITIONS, TYPE=STRESS\nBEAMS, {:.8E}\n", -half_euler / A)));
  // A load along the axis of q per length on a bar held at one end: the mean compression is q L / 2. To first order in the load
  // the first mode feels the compression weighed by cos²(pi x / L), whose mean is the same.
  const double q = 0.2 * half_euler / L;
  expect_bar("Abaqus, CalculiX", "load_per_length",
             inp_bar("1, 1\n", fmt::format("*STEP\n*STATIC\n*DLOAD\nBEAMS, PX, {:.8E}\n*END STEP\n", -q) + modes),
             0.1 * half_euler);
}

TEST(DeckStage, TheModelFolderKeepsTheStage) {
  const std::string step = fmt::format(
      "*STEP\n*STATIC\n*CLOAD\n6, 1, {:.8E}\n*DLOAD\n, GRAV, 9.81, 1., 0., -1.\n*TEMPERATURE\nALL, 20.\n"
      "*BOUNDARY\n11, 1, 1, -0.001\n*END STEP\n",
      -0.3 * half_euler);
  const fe::Model model = inp_bar("1, 1\n11, 1\n", step + modes);
  EXPECT_NEAR(model.gravity_direction.x(), std::sqrt(0.5), 1e-12);
  const TestFolder folder;
  write_model(model, folder.path());
  const fe::Model read = read_model(folder.path());
  EXPECT_EQ(read.prestress.loads.size(), model.prestress.loads.size());
  EXPECT_EQ(read.elements[0].free_strain, 20.0 * 1.2e-5);
  const std::vector<double> expected = frequencies(model, 3), found = frequencies(read, 3);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 1e-9 * expected[i]);
  folder.edit("model.toml", "load = \"static\"", "load = \"statik\"");
  EXPECT_NE(message_of([&] { (void)read_model(folder.path()); }).find("did you mean 'static'"), std::string::npos);
}

TEST(DeckStage, LoadsOfOneStepAddAndLaterOnesReplace) {
  const std::string half = fmt::format("*CLOAD\n11, 1, {:.8E}\n", -0.5 * half_euler);
  expect_bar("Abaqus, CalculiX", "two_loads_of_a_step",
             inp_bar("1, 1\n", "*STEP\n*STATIC\n" + half + half + "*END STEP\n" + modes));
  const std::string first = "*STEP\n*STATIC\n*CLOAD\n11, 1, -1.\n6, 1, -5.E6\n*END STEP\n";
  expect_bar("Abaqus, CalculiX", "load_replaced",
             inp_bar("1, 1\n", first + "*STEP\n*STATIC\n*CLOAD, OP=NEW\n" + fmt::format("11, 1, {:.8E}\n", -half_euler) +
                                   "*END STEP\n" + modes));
}

TEST(DeckStage, LoadsThatNoStepAsksForAreLeftOutWithANote) {
  const std::string deck = "*STEP\n*STATIC\n*CLOAD\n11, 1, -2.E6\n*END STEP\n" + plain_modes;
  expect_bar("Abaqus, CalculiX", "neither_nlgeom_nor_perturbation", inp_bar("1, 1\n", deck), 0.0);
}

/// Abaqus: "initial stress and load stiffness effects … if geometric nonlinearity is accounted for in the base state".
TEST(DeckStage, PerturbationInADeckOfAbaqusAlone) {
  const std::string force = fmt::format("*STATIC\n*CLOAD\n11, 1, {:.8E}\n*END STEP\n", -half_euler);
  const auto read = [&](const std::string& opening, const std::string& before = "") {
    const TestFolder folder;
    folder.write("bar.inp", inp_deck("1, 1\n", opening + force + modes, before));
    return read_inp(folder.path() / "bar.inp");
  };
  const auto expect = [&](const ImportedModel& found, const std::string& name, double compression, const std::string& said) {
    expect_bar("Abaqus", name, found.model, compression);
    EXPECT_TRUE(std::ranges::any_of(found.notes, [&](const auto& note) { return note.find(said) != std::string::npos; }))
        << said;
  };
  const std::string comment = "** Generated by: Abaqus/CAE 2022\n";
  expect(read("*STEP\n"), "perturbation", half_euler, "as in CalculiX; in Abaqus they would act only after");
  expect(read("*STEP\n", comment), "generated_by_cae", 0.0, "as in Abaqus without NLGEOM in a static step (line ");
  expect(read("*STEP, NAME=LOAD, NLGEOM=NO\n"), "named_step", 0.0, "has a NAME, which CalculiX does not know");
  expect(read("*STEP, NAME=LOAD, NLGEOM=YES\n", comment), "named_step_nlgeom", half_euler,
         "under the loads of the static step");
}

TEST(DeckStage, TheStateOfAnotherRunIsNotInTheDeck) {
  const auto answer = [](const std::string& card) { return message_of([&] { (void)inp_bar("1, 1\n", modes, card); }); };
  EXPECT_EQ(answer("*RESTART, WRITE, FREQUENCY=1\n"), "");
  for (const char* card : {"*RESTART, READ\n", "*RESTART, READ, STEP=1\n"})
    EXPECT_NE(answer(card).find("*RESTART: starts from the state of another run"), std::string::npos) << answer(card);
}

TEST(DeckStage, TheStateIsThatOfTheSupportsOfTheModes) {
  const std::string loaded = fmt::format("*STEP, NLGEOM\n*STATIC\n*CLOAD\n11, 1, {:.8E}\n*END STEP\n", -half_euler);
  const auto held = [&](const std::string& boundary) {
    return message_of([&] { (void)inp_bar("1, 1\n", loaded + "*STEP\n*FREQUENCY\n4\n" + boundary + "*END STEP\n"); });
  };
  EXPECT_EQ(held("*BOUNDARY, OP=NEW\n1, 1, 4\n11, 2\n11, 3\n"), held(""));  // the same directions
  EXPECT_NE(held("*BOUNDARY\n11, 1\n").find("otherwise than the static step"), std::string::npos);
  EXPECT_NE(held("*BOUNDARY, OP=NEW\n1, 1, 6\n").find("otherwise than the static step"), std::string::npos);
}

/// A mass of 5 t on a clamped column of ten beams that are all but massless, under its weight P, by one GRAV for each set.
/// f = sqrt(k / m) / (2 pi) with k = P / (tan(a L) / a - L), a² = P / (E I).
TEST(DeckStage, GravityOfASetOfPointMasses) {
  const double mass = 5000.0, weight = 2e5, a = std::sqrt(weight / (E * weak)), k = weight / (std::tan(a * L) / a - L);
  std::string deck = "*NODE\n";
  for (int i = 0; i <= 10; ++i) deck += fmt::format("{}, 0., 0., {}.\n", i + 1, i);
  deck += "*ELEMENT, TYPE=PIPE31, ELSET=COLUMN\n";
  for (int i = 1; i <= 10; ++i) deck += fmt::format("{}, {}, {}\n", i, i, i + 1);
  deck += fmt::format(
      "*ELEMENT, TYPE=MASS, ELSET=HEAD\n99, 11\n*MASS, ELSET=HEAD\n{}\n*BEAM SECTION, ELSET=COLUMN, MATERIAL=STEEL, "
      "SECTION=RECT\n0.2, 0.4\n1., 0., 0.\n*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1E11, 0.3\n*DENSITY\n1.\n*BOUNDARY\n"
      "1, ENCASTRE\n*STEP, NLGEOM\n*STATIC\n*DLOAD\nHEAD, GRAV, {}, 0., 0., -1.\nCOLUMN, GRAV, {}, 0., 0., -1.\n*END "
      "STEP\n",
      mass, weight / mass, weight / mass);
  const TestFolder folder;
  folder.write("column.inp", deck + plain_modes);
  expect_known_frequencies({"Abaqus, CalculiX", "column_under_its_mass", "closed form", closed},
                           frequencies(read_inp(folder.path() / "column.inp").model, 1),
                           {std::sqrt(k / mass) / (2.0 * std::numbers::pi)});
}

TEST(DeckStage, InpRefusesByNameWhatItDoesNotCarry) {
  const auto answer = [](const std::string& loads, const std::string& before = "", const std::string& opening = "*STEP\n") {
    return message_of([&] { (void)inp_bar("1, 1\n", opening + "*STATIC\n" + loads + "*END STEP\n" + modes, before); });
  };
  EXPECT_EQ(answer("*CLOAD\n11, 1, -1.\n"), "");
  EXPECT_NE(answer("*DLOAD\nBEAMS, CENTRIF, 100., 0., 0., 0., 0., 0., 1.\n").find("CENTRIF"), std::string::npos);
  EXPECT_NE(answer("*DLOAD\nBEAMS, P1, 100.\n").find("P1"), std::string::npos);
  EXPECT_NE(answer("*CLOAD, FOLLOWER\n11, 1, -1.\n").find("FOLLOWER"), std::string::npos);
  EXPECT_NE(answer("*CLOAD, AMPLITUDE=A\n11, 1, -1.\n").find("AMPLITUDE"), std::string::npos);
  EXPECT_NE(message_of([] {
              (void)inp_bar("1, 1\n", plain_modes, "*INITIAL CONDITIONS, TYPE=STRESS\nBEAMS, -1.E6\n");
            }).find("no step takes them up"),
            std::string::npos);
}

fe::Model nastran_bar(const std::string& control, const std::string& bulk, const std::string& units = si_units) {
  std::string deck = "SOL 103\nCEND\nSPC = 1\n" + control + "BEGIN BULK\nEIGRL,1,,,4\nPARAM,COUPMASS,1\n";
  for (int i = 0; i <= 10; ++i) deck += fmt::format("GRID,{},,{}.,0.,0.\n", i + 1, i);
  for (int i = 1; i <= 10; ++i) deck += fmt::format("CBAR,{},1,{},{},0.,1.,0.\n", i, i, i + 1);
  deck += "PBAR,1,1,8.-2,1.0666667-3,2.6666667-4,6.8-4\nMAT1,1,2.1+11,,0.3,7850.,1.2-5,20.\n" + bulk + "ENDDATA\n";
  const TestFolder folder;
  return import_deck(folder, deck, units).model;
}

const std::string statsub = "SUBCASE 1\n LOAD = 5\nSUBCASE 2\n STATSUB(PRELOAD) = 1\n METHOD = 1\n";
const std::string hinged = "SPC1,1,1234,1\nSPC1,1,234,11\n", held = "SPC1,1,1234,1\nSPC1,1,1234,11\n";

TEST(DeckStage, NastranForcesMovementsTemperatures) {
  expect_bar("Nastran", "statsub", nastran_bar(statsub, fmt::format("FORCE,5,11,,{:.6E},-1.,0.,0.\n", half_euler) + hinged));
  expect_bar(
      "Nastran", "load_combined",
      nastran_bar(statsub, fmt::format("LOAD,5,2.,0.5,7,0.5,8\nFORCE,7,11,,{0:.6E},-1.,0.,0.\nFORCE1,8,11,{0:.6E},11,1\n",
                                       0.5 * half_euler) +
                               hinged));
  expect_bar("Nastran", "spc_moved",
             nastran_bar("SUBCASE 1\n LOAD = 5\nSUBCASE 2\n STATSUB = 1\n METHOD = 1\n",
                         fmt::format("SPCD,5,11,1,{:.6E}\nFORCE,5,5,,0.,1.,0.,0.\n", -half_euler * L / (E * A)) + held));
  expect_bar("Nastran", "movement_and_force_by_load",
             nastran_bar("SUBCASE 1\n LOAD = 5\nSUBCASE 2\n STATSUB = 1\n METHOD = 1\n",
                         fmt::format("LOAD,5,1.,2.,7,1.,8\nSPCD,7,11,1,{:.6E}\nFORCE,8,5,,0.,1.,0.,0.\n",
                                     -0.5 * half_euler * L / (E * A)) +
                             held));
  for (const char* word : {"STATS", "STAT(PRELOAD)", "STATSUB (PRELOAD)"})
    expect_bar("Nastran", word,
               nastran_bar(fmt::format("SUBC 1\n LOAD = 5\nSUBCASE=2\n {} = 1\n METH = 1\n", word),
                           fmt::format("FORCE,5,11,,{:.6E},-1.,0.,0.\n", half_euler) + hinged));
  expect_bar("Nastran", "warmed",
             nastran_bar("SUBCASE 1\n TEMP(LOAD) = 6\nSUBCASE 2\n STATSUB(PRELOAD) = 1\n METHOD = 1\n",
                         fmt::format("TEMPD,6,{:.6E}\n", 20.0 + half_euler / (E * A * 1.2e-5)) + held));
}

TEST(DeckStage, NastranRefusesByName) {
  const auto answer = [](const std::string& loads) { return message_of([&] { (void)nastran_bar(statsub, loads + hinged); }); };
  EXPECT_EQ(answer("FORCE,5,11,,1.,-1.,0.,0.\n"), "");
  EXPECT_NE(answer("RFORCE,5,,,1.,0.,0.,1.\n").find("RFORCE"), std::string::npos);
  EXPECT_NE(answer("FORCE,6,11,,1.,-1.,0.,0.\n").find("chooses the loads 5"), std::string::npos);
  const std::string nonlinear = "SUBCASE 1\n STEP 1\n ANALYSIS = NLSTATIC\n LOAD = 5\n";
  EXPECT_NE(message_of([&] { (void)nastran_bar(nonlinear, hinged); }).find("ANALYSIS: starts the modes"), std::string::npos);
  EXPECT_NE(message_of([] { (void)nastran_bar("SUBCASE 1\n ANAL = NLSTATIC\n LOAD = 5\n", hinged); }).find("ANALYSIS: starts"),
            std::string::npos);
  EXPECT_NE(message_of([] { (void)nastran_bar("SUBCASE 2\n STATSUB = 9\n METHOD = 1\n", hinged); }).find("subcase 9"),
            std::string::npos);
}

/// A cable of forty beams, hanging along -Z from its clamped upper end, in millimetres and tonnes: 100 m, a mass of 50 t at its
/// end. f = 1/(2 pi) sqrt(g / L) of the pendulum, but for bending and the cable's own mass (a hundredth of the end's).
TEST(DeckStage, NastranGravityInOtherUnits) {
  constexpr int n = 40;
  std::string deck = "SOL 103\nCEND\nSPC = 1\n" + statsub + "BEGIN BULK\nEIGRL,1,,,4\nPARAM,COUPMASS,1\n";
  for (int i = 0; i <= n; ++i) deck += fmt::format("GRID,{},,0.,0.,{}.\n", i + 1, -2500 * i);
  for (int i = 1; i <= n; ++i) deck += fmt::format("CBAR,{},1,{},{},0.,1.,0.\n", i, i, i + 1);
  deck += fmt::format(
      "PBAR,1,1,600.,30000.,30000.,60000.\nMAT1,1,2.1+5,,0.3,7.85-9\nCONM2,99,{},,50.\n"
      "GRAV,5,,9810.,0.,0.,-1.\nSPC1,1,123456,1\nENDDATA\n",
      n + 1);
  const TestFolder folder;
  const fe::Model model = import_deck(folder, deck, "[units]\nlength = \"mm\"\nforce = \"N\"\n").model;
  EXPECT_NEAR(model.gravity_m_s2, 9.81, 1e-9);
  const double pendulum = std::sqrt(9.81 / 100.0) / (2.0 * std::numbers::pi);
  expect_known_frequencies({"Nastran", "pendulum_in_mm", "closed form", closed}, frequencies(model, 2), {pendulum, pendulum});
}

std::string ansys_bar(const std::string& steps, const std::string& ends = "D,1,UX\n") {
  std::string deck =
      "/PREP7\nET,1,BEAM4\nR,1,0.08,2.6666667E-4,1.0666667E-3,0.4,0.2\nMP,EX,1,2.1E11\nMP,PRXY,1,0.3\n"
      "MP,DENS,1,7850\nMP,ALPX,1,1.2E-5\n";
  for (int i = 0; i <= 10; ++i) deck += fmt::format("N,{},{}\n", i + 1, i);
  for (int i = 1; i <= 10; ++i) deck += fmt::format("E,{},{}\n", i, i + 1);
  return deck + "D,1,UY,,,,,UZ,ROTX\nD,11,UY,,,,,UZ\n" + ends + "FINISH\n" + steps;
}

fe::Model read_ansys_text(const std::string& deck) {
  const TestFolder folder;
  folder.write("deck.dat", deck);
  return read_ansys(folder.path() / "deck.dat").model;
}

const std::string ansys_modes = "FINISH\n/SOLU\nANTYPE,MODAL\nMODOPT,LANB,4\nPSTRES,ON\nSOLVE\nFINISH\n";
const std::string ansys_perturb =
    "FINISH\n/SOLU\nANTYPE,STATIC,RESTART,,,PERTURB\nPERTURB,MODAL\nSOLVE,ELFORM\nMODOPT,LANB,4\nSOLVE\nFINISH\n";

TEST(DeckStage, AnsysForcesMovementsTemperaturesAndBothWaysToAsk) {
  const std::string force = fmt::format("F,11,FX,{:.8E}\n", -half_euler), opening = "/SOLU\nANTYPE,STATIC\nPSTRES,ON\n";
  expect_bar("ANSYS", "pstres", read_ansys_text(ansys_bar(opening + force + "SOLVE\n" + ansys_modes)));
  expect_bar("ANSYS", "perturb", read_ansys_text(ansys_bar("/SOLU\nANTYPE,STATIC\n" + force + "SOLVE\n" + ansys_perturb)));
  expect_bar("ANSYS", "perturb_nlgeom",
             read_ansys_text(ansys_bar("/SOLU\nANTYPE,STATIC\nNLGEOM,ON\n" + force + "SOLVE\n" + ansys_perturb)));
  expect_bar("ANSYS", "support_moved",
             read_ansys_text(ansys_bar(opening + "SOLVE\n" + ansys_modes,
                                       fmt::format("D,1,UX\nD,11,UX,{:.8E}\n", -half_euler * L / (E * A)))));
  expect_bar(
      "ANSYS", "warmed",
      read_ansys_text(ansys_bar(opening + fmt::format("TREF,20\nBFUNIF,TEMP,{:.8E}\n", 20.0 + half_euler / (E * A * 1.2e-5)) +
                                    "SOLVE\n" + ansys_modes,
                                "D,1,UX\nD,11,UX\n")));
  expect_bar(
      "ANSYS", "end_pressed_by_sfbeam",
      read_ansys_text(ansys_bar(opening + fmt::format("SFBEAM,10,5,PRES,{:.8E}\n", half_euler) + "SOLVE\n" + ansys_modes)));
}

/// Half of the force in a first load step, all of it in a second.
TEST(DeckStage, AnsysLoadStepsAndSubsteps) {
  const auto solved = [](const std::string& before, const std::string& restart) {
    std::string steps = "/SOLU\nANTYPE,STATIC\n" + before;
    for (const double part : {0.5, 1.0}) steps += fmt::format("F,11,FX,{:.8E}\nSOLVE\n", -part * half_euler);
    return ansys_bar(steps + "FINISH\n/SOLU\nANTYPE,STATIC,RESTART," + restart +
                     ",PERTURB\nPERTURB,MODAL\nSOLVE,ELFORM\nMODOPT,LANB,4\nSOLVE\nFINISH\n");
  };
  expect_bar("ANSYS", "first_load_step", read_ansys_text(solved("", "1,1")), 0.5 * half_euler);
  expect_bar("ANSYS", "second_load_step", read_ansys_text(solved("", "2,1")));
  expect_bar("ANSYS", "last_load_step", read_ansys_text(solved("NSUBST,10\n", ",")));
  expect_bar("ANSYS", "last_substep", read_ansys_text(solved("NSUBST,10,10,10\n", "1,10")), 0.5 * half_euler);
  const auto answer = [&](const std::string& before, const std::string& restart) {
    return message_of([&] { (void)read_ansys_text(solved(before, restart)); });
  };
  EXPECT_NE(answer("", "3,1").find("names load step 3, but 2 static solutions stand before it"), std::string::npos);
  EXPECT_NE(answer("NSUBST,10,10,10\n", "1,5").find("substep 5 of a load step of 10 substeps"), std::string::npos);
  EXPECT_NE(answer("DELTIM,0.1\n", "1,5").find("an unknown number of substeps"), std::string::npos);
  EXPECT_NE(answer("SOLVE\nANTYPE,STATIC,NEW\n", "3,1").find("names load step 3, but 2"), std::string::npos);
}

TEST(DeckStage, AnsysRefusesByName) {
  const auto answer = [](const std::string& steps) { return message_of([&] { (void)read_ansys_text(ansys_bar(steps)); }); };
  const std::string opening = "/SOLU\nANTYPE,STATIC\nPSTRES,ON\n";
  EXPECT_EQ(answer(opening + "F,11,FX,-1\nSOLVE\n" + ansys_modes), "");
  EXPECT_NE(answer(opening + "OMEGA,,,10\nSOLVE\n" + ansys_modes).find("OMEGA"), std::string::npos);
  EXPECT_NE(answer(opening + "SF,ALL,PRES,10\nSOLVE\n" + ansys_modes).find("SF"), std::string::npos);
  EXPECT_NE(answer(ansys_modes).find("no static solution"), std::string::npos);
  for (const char* other : {"HARMIC", "TRANS", "BUCKLE", "3"})
    EXPECT_NE(answer(fmt::format("/SOLU\nANTYPE,{}\nF,11,FX,-1\nSOLVE\n", other) + ansys_modes).find("no static solution"),
              std::string::npos)
        << other;
  EXPECT_EQ(answer("/SOLU\nOMEGA,,,10\nANTYPE,MODAL\nSOLVE\n"), "");  // it does not act on these modes
}

/// String of VM59's kind: a bar of 10 beams pulled by a force far above its bending stiffness: f = n/(2 L) sqrt(T / rho A).
TEST(DeckStage, AnsysStringOfInitialStrain) {
  std::string deck = "/PREP7\nET,1,LINK8\nR,1,1E-4,1E-3\nMP,EX,1,2E11\nMP,DENS,1,8000\n";
  for (int i = 0; i <= 20; ++i) deck += fmt::format("N,{},{}\n", i + 1, 0.5 * i);
  for (int i = 1; i <= 20; ++i) deck += fmt::format("E,{},{}\n", i, i + 1);
  deck += "D,1,ALL\nD,21,ALL\nD,ALL,UZ\nFINISH\n/SOLU\nANTYPE,STATIC\nPSTRES,ON\nSOLVE\n" + ansys_modes;
  const double f = std::sqrt(1e-3 * 2e11 / 8000.0) / 20.0;
  expect_known_frequencies({"ANSYS", "string_by_initial_strain", "closed form", closed}, frequencies(read_ansys_text(deck), 2),
                           {f, 2.0 * f});
}

/// Square plate of 1 m, 10 mm, E 200 GPa, nu 0.25, pressed along X by half its buckling load, in S4 and CQUAD4. With 8 elements
/// a side the consistent mass makes the plate 1.4 % faster and bilinear slopes weaken the load by 1.3 %; both fall with the
/// square.
TEST(DeckStage, PlatesAtHalfTheirBucklingLoad) {
  constexpr int n = 12;
  const double bending = 200e9 * 1e-6 / (12.0 * (1.0 - 0.0625)), pi2 = std::numbers::pi * std::numbers::pi;
  const double f0 = std::numbers::pi * std::sqrt(bending / (8000.0 * 0.01)), press = 0.5 * 4.0 * pi2 * bending;
  std::string nodes, grids, shells, quads, edge_x, edge_z, loads, forces, spc;
  const auto at = [](int i, int j) { return j * (n + 1) + i + 1; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      nodes += fmt::format("{}, {}, {}, 0.\n", at(i, j), static_cast<double>(i) / n, static_cast<double>(j) / n);
      grids += fmt::format("GRID,{},,{:.6f},{:.6f},0.\n", at(i, j), static_cast<double>(i) / n, static_cast<double>(j) / n);
      if (i == 0) edge_x += fmt::format("{}, 1\n", at(i, j)), spc += fmt::format("SPC1,1,1,{}\n", at(i, j));
      if (i == 0 || i == n || j == 0 || j == n)
        edge_z += fmt::format("{}, 3\n", at(i, j)), spc += fmt::format("SPC1,1,3,{}\n", at(i, j));
      const double part = press / n * (j == 0 || j == n ? 0.5 : 1.0);
      if (i == n)
        loads += fmt::format("{}, 1, {:.8E}\n", at(i, j), -part),
            forces += fmt::format("FORCE,5,{},,{:.6E},-1.,0.,0.\n", at(i, j), part);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int e = j * n + i + 1;
      shells += fmt::format("{}, {}, {}, {}, {}\n", e, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      quads += fmt::format("CQUAD4,{},1,{},{},{},{}\n", e, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
  const TestFolder folder;
  folder.write("plate.inp", "*NODE\n" + nodes + "*ELEMENT, TYPE=S4, ELSET=PLATE\n" + shells +
                                "*SHELL SECTION, ELSET=PLATE, MATERIAL=M\n0.01\n*MATERIAL, NAME=M\n*ELASTIC\n2.E11, 0.25\n"
                                "*DENSITY\n8000.\n*BOUNDARY\n1, 2\n" +
                                edge_x + edge_z + "*STEP\n*STATIC\n*CLOAD\n" + loads + "*END STEP\n" + modes);
  constexpr double plates = 0.02;  // shells
  expect_known_frequencies({"Abaqus, CalculiX", "pressed_plate", "closed form", plates},
                           frequencies(read_inp(folder.path() / "plate.inp").model, 1), {f0 * std::sqrt(0.5)});
  const std::string deck = "SOL 103\nCEND\nSPC = 1\n" + statsub + "BEGIN BULK\nEIGRL,1,,,4\n" + grids + quads +
                           "PSHELL,1,1,0.01,1\nMAT1,1,2.+11,,0.25,8000.\nSPC1,1,2,1\n" + spc + forces + "ENDDATA\n";
  expect_known_frequencies({"Nastran", "pressed_plate", "closed form", plates}, frequencies(import_deck(folder, deck).model, 1),
                           {f0 * std::sqrt(0.5)});
}

}  // namespace
}  // namespace twindeck::model_io::test::deck_stage
