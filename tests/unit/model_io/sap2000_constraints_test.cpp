/// Diaphragms and bodies of SAP2000. Oracle: closed forms of rigid floors on clamped columns without mass, of storeys and of a
/// rigid plate on springs; equal decks give equal frequencies.
#include "model_io/sap2000_constraints.hpp"

#include <cmath>
#include <numbers>

#include "deck_table.hpp"
#include "model_io/sap2000.hpp"
#include "nastran_deck.hpp"

namespace twindeck::model_io::test::sap2000_constraints {
namespace {

constexpr double exact = 1e-6;                                                         // [-] solver
constexpr double height = 3.0, width = 4.0, depth = 6.0, mass = 5000.0, young = 2e11;  // [m], of a floor, [kg] a joint, [Pa]
constexpr double i33 = 6e-5, i22 = 2e-5, twist = 1e-5;                                 // [m4]; local 2 lies along X

/// Four columns of `floors` storeys: joints 1-4 at the base, 11-14, 21-24 above, each with a mass.
std::string tower(int floors) {
  std::string joints = "TABLE:  \"JOINT COORDINATES\"\n", frames = "TABLE:  \"CONNECTIVITY - FRAME\"\n",
              assigned = "TABLE:  \"FRAME SECTION ASSIGNMENTS\"\n", masses = "TABLE:  \"JOINT ADDED MASS ASSIGNMENTS\"\n",
              held = "TABLE:  \"JOINT RESTRAINT ASSIGNMENTS\"\n";
  for (int floor = 0; floor <= floors; ++floor)
    for (int i = 1; i <= 4; ++i) {
      const int joint = 10 * floor + i;
      joints += fmt::format("   Joint={}   XorR={}   Y={}   Z={}\n", joint, i % 2 * width, i / 3 * depth, floor * height);
      if (floor == 0) {
        held += fmt::format("   Joint={}   U1=Yes   U2=Yes   U3=Yes   R1=Yes   R2=Yes   R3=Yes\n", joint);
        continue;
      }
      frames += fmt::format("   Frame={}   JointI={}   JointJ={}\n", joint, joint - 10, joint);
      assigned += fmt::format("   Frame={}   AnalSect=S   MatProp=Default\n", joint);
      masses += fmt::format("   Joint={}   Mass1={}   Mass2={}   Mass3=0   MMI1=0   MMI2=0   MMI3=0\n", joint, mass, mass);
    }
  return "TABLE:  \"PROGRAM CONTROL\"\n   CurrUnits=\"N, m, C\"\n"
         "TABLE:  \"MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES\"\n   Material=M   UnitMass=0   E1=2E11   G12=8E10   "
         "U12=0.25\n"
         "TABLE:  \"FRAME SECTION PROPERTIES 01 - GENERAL\"\n   SectionName=S   Material=M   Area=0.01   TorsConst=1E-5   "
         "I33=6E-5   I22=2E-5\n" +
         joints + frames + assigned + held + masses;
}

std::string diaphragm(const std::string& name, const std::string& words, const std::vector<int>& joints) {
  std::string text =
      fmt::format("TABLE:  \"CONSTRAINT DEFINITIONS - DIAPHRAGM\"\n   Name={}   CoordSys=GLOBAL   {}\n", name, words) +
      "TABLE:  \"JOINT CONSTRAINT ASSIGNMENTS\"\n";
  for (const int joint : joints) text += fmt::format("   Joint={}   Constraint={}   Type=Diaphragm\n", joint, name);
  return text;
}

const std::string across_z = "Axis=Z   MultiLevel=No";

fe::Model import_constrained(const std::string& text) {
  const TestFolder folder;
  folder.write("deck.s2k", text + "END TABLE DATA\n");
  return read_sap2000(folder.path() / "deck.s2k").model;
}

double hertz(double stiffness, double of_mass) { return std::sqrt(stiffness / of_mass) / (2.0 * std::numbers::pi); }

/// Sway along y and x and torsion of one floor whose columns resist with c E I / h³ each.
std::vector<double> floor_Hz(double c) {
  const double of_one = c * young / std::pow(height, 3), x2 = width * width / 4.0, y2 = depth * depth / 4.0;
  return {hertz(of_one * i22, mass), hertz(of_one * i33, mass),
          hertz(of_one * (i33 * y2 + i22 * x2) + 8e10 * twist / height, mass * (x2 + y2))};
}

void expect_floor(const std::string& deck, const std::string& text, std::vector<double> known_Hz) {
  std::ranges::sort(known_Hz);
  expect_known_frequencies({"SAP2000", deck, "closed form", exact}, frequencies(import_constrained(text), 3), known_Hz);
}

/// Frequencies of two decks that say the same.
void expect_alike(const std::string& deck, const std::string& other) {
  const auto found = frequencies(import_constrained(deck), 6), known = frequencies(import_constrained(other), 6);
  ASSERT_EQ(found.size(), known.size());
  for (std::size_t i = 0; i < known.size(); ++i) EXPECT_NEAR(found[i], known[i], exact * known[i]) << deck;
}

// The tops of the columns turn freely about x and y: 3 E I / h³, and G J / h of each.
TEST(SapConstraints, AFloorOnFourColumnsSwaysAndTwists) {
  const std::vector<int> floor = {11, 12, 13, 14};
  const std::string sound = tower(1) + diaphragm("D", across_z, floor);
  expect_floor("diaphragm", sound, floor_Hz(3.0));
  EXPECT_EQ(import_constrained(sound).constraints.size(), 9U);
  for (const char* words : {"Axis=Z   MultiLevel=Yes", "Axis=Auto   MultiLevel=No", "MultiLevel=No"})
    expect_alike(tower(1) + diaphragm("D", words, floor), sound);
  // Two joints lie in planes across z and x: Auto takes z.
  expect_alike(tower(1) + diaphragm("D", "Axis=Auto", {11, 13}), tower(1) + diaphragm("D", "Axis=Z", {11, 13}));
}

// A heavy joint at the centre, that no frame joins, comes first: the others follow it.
TEST(SapConstraints, AFloorHasItsMassAtAJointThatNoFrameJoins) {
  std::string text = tower(1);
  const std::string centre = fmt::format("   Joint=C   XorR={}   Y={}   Z={}\n", width / 2.0, depth / 2.0, height);
  text.insert(text.find("   Joint=1 "), centre);
  text += "   Joint=C   Mass1=20000   Mass2=20000   Mass3=0   MMI1=0   MMI2=0   MMI3=90000\n" +
          diaphragm("D", across_z, {11, 12, 13, 14});
  text += "   Joint=C   Constraint=D   Type=Diaphragm\n";
  std::vector<double> known = floor_Hz(3.0);
  known[0] *= std::sqrt(0.5);
  known[1] *= std::sqrt(0.5);
  const double turning = mass * (width * width + depth * depth);
  known[2] *= std::sqrt(turning / (turning + 90000.0));
  expect_floor("diaphragm with a centre", text, known);
}

// Both floors as one: no displacement between them, and no part of theta_x, theta_y times the height. The column is clamped
// below, and the storey above holds its turning by 3 E I / h: 12 - 6² / (4 + 3).
TEST(SapConstraints, LevelsAreFloorsOfTheirOwnOrOne) {
  const std::vector<int> both = {11, 12, 13, 14, 21, 22, 23, 24};
  std::vector<double> one = floor_Hz(48.0 / 7.0);
  for (double& f : one) f *= std::sqrt(0.5);
  const double x2 = width * width / 4.0, y2 = depth * depth / 4.0;
  one[2] = hertz(48.0 / 7.0 * young / 27.0 * (i33 * y2 + i22 * x2) + 8e10 * twist / height, 2.0 * mass * (x2 + y2));
  expect_floor("two floors as one", tower(2) + diaphragm("D", across_z, both), one);
  const std::string each = diaphragm("A", across_z, {11, 12, 13, 14}) + diaphragm("B", across_z, {21, 22, 23, 24});
  // The base is a level too, whose joints are held: nothing is left to tie.
  const std::string levels = diaphragm("D", "Axis=Z   MultiLevel=Yes", {21, 1, 11, 12, 2, 22, 13, 23, 3, 14, 24, 4});
  expect_alike(tower(2) + levels, tower(2) + each);
}

// A plane frame: directions that the analysis leaves out are tied to nothing.
TEST(SapConstraints, APlaneFrameHasDiaphragmsToo) {
  const std::string plane = "TABLE:  \"ACTIVE DEGREES OF FREEDOM\"\n   UX=Yes   UY=No   UZ=Yes   RX=No   RY=Yes   RZ=No\n";
  const auto model = import_constrained(tower(1) + plane + diaphragm("D", across_z, {11, 12, 13, 14}));
  EXPECT_EQ(model.constraints.size(), 3U);
  EXPECT_NEAR(frequencies(model, 1)[0], floor_Hz(3.0)[1], exact * floor_Hz(3.0)[1]);
}

// One joint that stands still leaves the floor its turning about it.
TEST(SapConstraints, AFloorTurnsAboutAJointThatIsHeld) {
  std::string text = tower(1) + diaphragm("D", across_z, {12, 11, 13, 14});
  text.insert(text.find("   Joint=1   U1"), "   Joint=11   U1=Yes   U2=Yes\n");
  const double x2 = 2.0 * width * width, y2 = 2.0 * depth * depth, of_one = 3.0 * young / 27.0;
  const double known = hertz(of_one * (i33 * y2 + i22 * x2) + 4.0 * 8e10 * twist / height, mass * (x2 + y2));
  expect_floor("diaphragm about a joint", text, {known});
}

// Joints in the plane x = 7: u_y, u_z and theta_x, with u_z = u_z,m + theta_x (y - y_m).
TEST(SapConstraints, AutoFindsAWall) {
  std::string text = "TABLE:  \"PROGRAM CONTROL\"\n   CurrUnits=\"N, m, C\"\nTABLE:  \"JOINT COORDINATES\"\n";
  const std::vector<std::string> places = {"XorR=7   Y=0   Z=0", "XorR=7   Y=4   Z=0", "XorR=7   Y=0   Z=6"};
  for (std::size_t i = 0; i < 3; ++i) text += fmt::format("   Joint={}   {}\n", i + 1, places[i]);
  text += "TABLE:  \"JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED\"\n";
  for (int i = 1; i <= 3; ++i) text += fmt::format("   Joint={}   U1=1   U2=1   U3=1\n", i);
  const fe::Model model = import_constrained(text + diaphragm("W", "Axis=Auto   MultiLevel=No", {1, 2, 3}));
  ASSERT_EQ(model.constraints.size(), 6U);
  EXPECT_EQ(model.constraints[0].direction, 1);
  EXPECT_EQ(model.constraints[1].direction, 2);
  EXPECT_EQ(model.constraints[2].direction, 3);
  ASSERT_EQ(model.constraints[1].terms.size(), 2U);
  EXPECT_EQ(model.constraints[1].terms[1].direction, 3);
  EXPECT_DOUBLE_EQ(model.constraints[1].terms[1].factor, 4.0);
}

const std::string whole_body = "UX=Yes   UY=Yes   UZ=Yes   RX=Yes   RY=Yes   RZ=Yes";

/// A rigid plate with springs k and masses m at its corners and M at its centre: 4 k / (4 m + M) three times, then k / m.
std::string plate_on_springs(const std::string& directions) {
  std::string
      text =
          "TABLE:  \"PROGRAM CONTROL\"\n   CurrUnits=\"N, m, C\"\nTABLE:  \"JOINT COORDINATES\"\n   Joint=5   XorR=2   Y=3"
          "   Z=0\n",
      springs = "TABLE:  \"JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED\"\n",
      masses = "TABLE:  \"JOINT ADDED MASS ASSIGNMENTS\"\n   Joint=5   Mass1=8   Mass2=8   Mass3=8\n",
      assigned = "TABLE:  \"CONSTRAINT DEFINITIONS - BODY\"\n   Name=B   CoordSys=GLOBAL   " + directions +
                 "\nTABLE:  \"JOINT CONSTRAINT ASSIGNMENTS\"\n";
  for (int i = 1; i <= 5; ++i) {
    assigned += fmt::format("   Joint={}   Constraint=B   Type=Body\n", i);
    if (i == 5) break;
    text += fmt::format("   Joint={}   XorR={}   Y={}   Z=0\n", i, i % 2 * width, i / 3 * depth);
    springs += fmt::format("   Joint={}   U1=300   U2=300   U3=300\n", i);
    masses += fmt::format("   Joint={}   Mass1=3   Mass2=3   Mass3=3\n", i);
  }
  return text + springs + masses + assigned;
}

TEST(SapConstraints, ABodyIsRigid) {
  const double low = hertz(1200.0, 20.0), high = hertz(300.0, 3.0);
  expect_known_frequencies({"SAP2000", "body", "closed form", exact},
                           frequencies(import_constrained(plate_on_springs(whole_body)), 6), {low, low, low, high, high, high});
}

TEST(SapConstraints, RefusesWhatItDoesNotTie) {
  const std::vector<int> floor = {11, 12, 13, 14};
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string sound = tower(1) + diaphragm("D", across_z, floor), body = plate_on_springs(whole_body);
  struct Refused {
    std::string deck, words;
  };
  for (const Refused& c : {
           Refused{replaced(sound, "Type=Diaphragm", "Type=Equal"), "is of Type Equal, of which Body and Diaphragm are read"},
           {replaced(sound, "Type=Diaphragm", "X=1"), "has no Type"},
           {replaced(sound, "Constraint=D", "Constraint=E"), "'E' is in no row of the table CONSTRAINT DEFINITIONS"},
           {replaced(sound, "Axis=Z", "Axis=W"), "Axis is 'W', expected X, Y, Z or Auto"},
           {replaced(sound, "Axis=Z", "Axis=XY"), "Axis is 'XY'"},
           {replaced(sound, "CoordSys=GLOBAL   Axis", "CoordSys=CSYS1   Axis"), "other axes than the global ones"},
           {replaced(sound, "Joint=11   Constraint", "Joint=99   Constraint"), "joint 99 is not defined"},
           {tower(2) + diaphragm("D", "Axis=Auto   MultiLevel=No", {11, 12, 23}), "its Axis is Auto"},
           {replaced(body, "RY=Yes", "RY=No"), "does not tie RY"},
           {sound + "TABLE:  \"CONSTRAINT DEFINITIONS - ROD\"\n   Name=R   CoordSys=GLOBAL   Axis=X\n",
            "CONSTRAINT DEFINITIONS - ROD: this table is not carried"},
       }) {
    const std::string said = message_of([&] { (void)import_constrained(c.deck); });
    EXPECT_NE(said.find(c.words), std::string::npos) << c.words << "\n" << said;
    EXPECT_NE(said.find("deck.s2k:"), std::string::npos) << said;
  }
  // What the degrees of freedom say of every deck: held in part at two joints, or in two diaphragms.
  std::string held = sound;
  held.insert(held.find("   Joint=1   U1"), "   Joint=11   U1=Yes\n   Joint=13   U1=Yes\n");
  EXPECT_NE(message_of([&] { (void)frequencies(import_constrained(held), 1); }).find("is held by a support too"),
            std::string::npos);
  const std::string twice = sound + diaphragm("E", across_z, {11, 12});
  EXPECT_NE(message_of([&] { (void)frequencies(import_constrained(twice), 1); }).find("depends by two constraints"),
            std::string::npos);
}

}  // namespace
}  // namespace twindeck::model_io::test::sap2000_constraints
