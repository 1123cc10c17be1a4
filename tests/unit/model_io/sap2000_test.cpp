/// Text tables of SAP2000, written from the description of the format. Oracle: closed forms (Euler's beams, masses on springs,
/// a mass on a column, Kirchhoff's and Mindlin's plates), 1 % for beams, 2 % for shells; refusals name file, line and table.
#include "model_io/sap2000.hpp"

#include <cmath>
#include <numbers>

#include "deck_table.hpp"
#include "nastran_deck.hpp"

namespace twindeck::model_io::test::sap2000 {
namespace {

constexpr double beams = 0.01, shells = 0.02, no_mesh = 1e-6;  // [-] asked of the import
constexpr double pi = std::numbers::pi;
const std::string metres =
    "File C:\\a.s2k was saved on m/d/yy at h:mm:ss\nTABLE:  \"PROGRAM CONTROL\"\n   ProgramName=SAP2000   "
    "Version=20.2.0   CurrUnits=\"KN, m, C\"\n\n";
const std::string steel =
    "TABLE:  \"MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES\"\n   Material=Steel   UnitWeight=76.97 "
    "  UnitMass=7.85   E1=210000000   G12=80769230.77   U12=0.3   A1=1.2E-05\n\n";
/// A rectangle of 0.2 m along local 2 and 0.1 m along local 3, without shear.
const double i33 = 0.1 * 0.2 * 0.2 * 0.2 / 12.0, i22 = 0.2 * 0.1 * 0.1 * 0.1 / 12.0, area = 0.02;
const std::string section = fmt::format(
    "TABLE:  \"FRAME SECTION PROPERTIES 01 - GENERAL\"\n   SectionName=S   Material=Steel   Shape=Rectangular   t3=0.2   "
    "t2=0.1   "
    "Area=0.02   TorsConst=4.58E-05   I33={:.12g}   I22={:.12g}   I23=0   AS2=0   AS3=0 _\n        AMod=1   A2Mod=1   JMod=1   "
    "MMod=1\n\n",
    i33, i22);

/// Joints 1 to n + 1 from the origin along `step`, joined by frames 1 to n of section S.
std::string line_of_frames(int n, double x, double z) {
  std::string joints = "TABLE:  \"JOINT COORDINATES\"\n", frames = "TABLE:  \"CONNECTIVITY - FRAME\"\n",
              assigned = "TABLE:  \"FRAME SECTION ASSIGNMENTS\"\n";
  for (int i = 0; i <= n; ++i)
    joints +=
        fmt::format("   Joint={}   CoordSys=GLOBAL   CoordType=Cartesian   XorR={:.12g}   Y=0   Z={:.12g}   SpecialJt=No\n",
                    i + 1, i * x, i * z);
  for (int i = 1; i <= n; ++i) {
    frames += fmt::format("   Frame={}   JointI={}   JointJ={}   IsCurved=No\n", i, i, i + 1);
    assigned += fmt::format("   Frame={}   AutoSelect=N.A.   AnalSect=S   DesignSect=S   MatProp=Default\n", i);
  }
  return joints + "\n" + frames + "\n" + assigned + "\n";
}

std::string restraint(int joint, const std::string& flags) {
  static const char* const names[] = {"U1", "U2", "U3", "R1", "R2", "R3"};
  std::string row = fmt::format("   Joint={}", joint);
  for (std::size_t i = 0; i < 6; ++i) row += fmt::format("   {}={}", names[i], flags[i] == '1' ? "Yes" : "No");
  return row + "\n";
}
const std::string restraints = "TABLE:  \"JOINT RESTRAINT ASSIGNMENTS\"\n";

ImportedModel import_tables(const std::string& text) {
  const TestFolder folder;
  folder.write("deck.s2k", text + "END TABLE DATA\n");
  return read_sap2000(folder.path() / "deck.s2k");
}

void expect_known(const std::string& deck, const std::string& text, const std::vector<double>& known_Hz, double tolerance) {
  expect_known_frequencies({"SAP2000", deck, "closed form", tolerance},
                           frequencies(import_tables(text).model, static_cast<int>(known_Hz.size())), known_Hz);
}

double euler_Hz(double beta_l, double inertia, double length) {
  return beta_l * beta_l / (2.0 * pi * length * length) * std::sqrt(210e9 * inertia / (7850.0 * area));
}

TEST(Sap2000, ACantileverBendsInBothOfItsPlanes) {
  expect_known("cantilever", metres + steel + section + line_of_frames(40, 0.1, 0.0) + restraints + restraint(1, "111111"),
               {euler_Hz(1.87510407, i22, 4.0), euler_Hz(1.87510407, i33, 4.0), euler_Hz(4.69409113, i22, 4.0)}, beams);
}

TEST(Sap2000, TheAngleTurnsTheSectionAndUnitsAreThoseOfTheFile) {
  // The same beam in kip and inches, on two supports that hold it in the vertical plane; local 2 lies level at 90 degrees.
  const double inch = 0.0254, kip = 4448.2216152605, per_length = 1.0 / inch;
  std::string text = metres;
  text.replace(text.find("KN, m, C"), 8, "Kip, in, F");
  text += fmt::format(
      "TABLE:  \"MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES\"\n   Material=Steel   UnitMass={:.14g}   E1={:.14g}   "
      "G12={:.14g}   U12=0.3\n\n",
      7850.0 * std::pow(inch, 4) / kip, 210e9 * inch * inch / kip, 210e9 / 2.6 * inch * inch / kip);
  text += fmt::format(
      "TABLE:  \"FRAME SECTION PROPERTIES 01 - GENERAL\"\n   SectionName=S   Material=Steel   Area={:.14g}   TorsConst={:.14g} "
      "  "
      "I33={:.14g}   I22={:.14g}\n\n",
      area * std::pow(per_length, 2), 4.58e-5 * std::pow(per_length, 4), i33 * std::pow(per_length, 4),
      i22 * std::pow(per_length, 4));
  text += line_of_frames(40, 0.1 * per_length, 0.0) + "TABLE:  \"FRAME LOCAL AXES ASSIGNMENTS 1 - TYPICAL\"\n";
  for (int i = 1; i <= 40; ++i) text += fmt::format("   Frame={}   Angle=90   AdvanceAxes=No\n", i);
  text += "\nTABLE:  \"ACTIVE DEGREES OF FREEDOM\"\n   UX=Yes   UY=No   UZ=Yes   RX=No   RY=Yes   RZ=No\n\n";
  expect_known("beam_in_inches", text + restraints + restraint(1, "101000") + restraint(41, "001000"),
               {euler_Hz(pi, i22, 4.0), euler_Hz(2.0 * pi, i22, 4.0)}, beams);
}

TEST(Sap2000, MassesOnJointSprings) {
  const std::string joints =
      "TABLE:  \"JOINT COORDINATES\"\n   Joint=A1   XorR=0   Y=0   Z=3\n   Joint=7   XorR=4   Y=0   Z=3\n\n";
  const std::string springs =
      "TABLE:  \"JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED\"\n   Joint=A1   CoordSys=Local   U1=100   U2=200   U3=400   R1=0   "
      "R2=0   "
      "R3=0\n   Joint=7   CoordSys=Local   U1=900   U2=1600   U3=2500   R1=0   R2=0   R3=0\n\n";
  const std::string masses =
      "TABLE:  \"JOINT ADDED MASS ASSIGNMENTS\"\n   Joint=A1   CoordSys=Global   Mass1=2   Mass2=2   Mass3=2   MMI1=0   MMI2=0 "
      "  "
      "MMI3=0\n   Joint=7   CoordSys=Global   Mass1=3   Mass2=3   Mass3=1   MMI1=0   MMI2=0   MMI3=0\n\n";
  const auto f = [](double k, double m) { return std::sqrt(k / m) / (2.0 * pi); };
  expect_known("masses_on_springs", metres + joints + springs + masses + restraints + restraint(7, "000111"),
               {f(100, 2), f(200, 2), f(400, 2), f(900, 3), f(1600, 3), f(2500, 1)}, no_mesh);
}

TEST(Sap2000, AColumnHasItsLocal2AlongGlobalX) {
  std::string text = metres + steel + section + line_of_frames(1, 0.0, 3.0) + restraints + restraint(1, "111111");
  text.replace(text.find("UnitMass=7.85"), 13, "UnitMass=0");
  text += "\nTABLE:  \"JOINT ADDED MASS ASSIGNMENTS\"\n   Joint=2   CoordSys=Global   Mass1=5   Mass2=1   Mass3=0\n\n";
  const auto f = [](double inertia, double mass) { return std::sqrt(3.0 * 210e9 * inertia / (27.0 * mass)) / (2.0 * pi); };
  expect_known("column", text, {f(i33, 5000.0), f(i22, 1000.0)}, no_mesh);
}

TEST(Sap2000, AReleaseIsAHinge) {
  std::string text =
      metres + steel + section + line_of_frames(40, 0.1, 0.0) + restraints + restraint(1, "111111") + restraint(41, "111111");
  text +=
      "\nTABLE:  \"FRAME RELEASE ASSIGNMENTS 1 - GENERAL\"\n   Frame=40   PI=No   V2I=No   V3I=No   TI=No   M2I=No   M3I=No   "
      "PJ=No   V2J=No   V3J=No   TJ=No   M2J=Yes   M3J=Yes   PartialFix=No\n\n";
  expect_known("propped_beam", text, {euler_Hz(3.92660231, i22, 4.0), euler_Hz(3.92660231, i33, 4.0)}, beams);
}

TEST(Sap2000, AFrameIsDividedAtTheJointsThatLieOnIt) {
  // One frame from end to end with 39 joints on it is forty frames; a release is at its own end.
  std::string text =
      metres + steel + section + line_of_frames(40, 0.1, 0.0) + restraints + restraint(1, "111111") + restraint(41, "111111");
  const std::size_t from = text.find("   Frame=1   JointI=1"), to = text.find("TABLE:  \"FRAME SECTION ASS");
  text.replace(from, to - from, "   Frame=1   JointI=1   JointJ=41   IsCurved=No\n\n");
  text +=
      "\nTABLE:  \"FRAME RELEASE ASSIGNMENTS 1 - GENERAL\"\n   Frame=1   PI=No   V2I=No   V3I=No   TI=No   M2I=No   M3I=No   "
      "PJ=No   V2J=No   V3J=No   TJ=No   M2J=Yes   M3J=Yes   PartialFix=No\n\n";
  expect_known("one frame over 41 joints", text, {euler_Hz(3.92660231, i22, 4.0), euler_Hz(3.92660231, i33, 4.0)}, beams);
  const std::string whole = text + "TABLE:  \"FRAME AUTO MESH ASSIGNMENTS\"\n   Frame=1   AutoMesh=No   AtJoints=No\n\n";
  EXPECT_EQ(import_tables(whole).model.elements.size(), 1U);
}

/// A plate of 2 m on its edges, which do not turn along themselves, in 16 × 16 areas, held in its plane.
std::string plate(const std::string& type, double thickness) {
  constexpr int n = 16;
  std::string joints = "TABLE:  \"JOINT COORDINATES\"\n", areas = "TABLE:  \"CONNECTIVITY - AREA\"\n",
              assigned = "TABLE:  \"AREA SECTION ASSIGNMENTS\"\n", held = restraints;
  const auto number = [](int i, int j) { return 1 + i + (n + 1) * j; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      joints += fmt::format("   Joint={}   XorR={}   Y={}   Z=0\n", number(i, j), 2.0 * i / n, 2.0 * j / n);
      const bool edge = i == 0 || j == 0 || i == n || j == n;
      std::string flags = edge ? "111001" : "110001";
      if (i == 0 || i == n) flags[3] = '1';
      if (j == 0 || j == n) flags[4] = '1';
      held += restraint(number(i, j), flags);
      if (i == n || j == n) continue;
      areas += fmt::format("   Area={}   NumJoints=4   Joint1={}   Joint2={}   Joint3={}   Joint4={}\n", number(i, j),
                           number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1));
      assigned += fmt::format("   Area={}   Section=P   MatProp=Default\n", number(i, j));
    }
  const std::string properties = fmt::format(
      "TABLE:  \"AREA SECTION PROPERTIES\"\n   Section=P   Material=Steel   MatAngle=0   AreaType=Shell   Type={}   "
      "DrillDOF=Yes   Thickness={}   BendThick={}\n\n",
      type, thickness, thickness);
  return metres + steel + properties + joints + areas + assigned + held;
}

// Kirchhoff's plate and, a tenth as thick as wide, Mindlin's without rotary inertia: ω² less by the factor 1 + D k² / (κ G t).
TEST(Sap2000, APlateOnItsEdges) {
  const auto known = [](double t, bool shear) {
    std::vector<double> f;
    for (const double waves : {2.0, 5.0, 5.0}) {
      const double k2 = waves * pi * pi / 4.0, softer = shear ? k2 * t * t / 12.0 / 0.91 * 2.6 * 1.2 : 0.0;
      f.push_back(k2 * std::sqrt(210e9 * t * t / (12.0 * 0.91 * 7850.0) / (1.0 + softer)) / (2.0 * pi));
    }
    return f;
  };
  expect_known("plate", plate("Shell-Thin", 0.02), known(0.02, false), shells);
  expect_known("thick plate, Shell-Thin", plate("Shell-Thin", 0.2), known(0.2, false), shells);
  expect_known("thick plate, Shell-Thick", plate("Shell-Thick", 0.2), known(0.2, true), shells);
}

// Cracked frames: a quarter of the bending stiffness is half of the frequency. An assignment of the centroid changes nothing.
TEST(Sap2000, ModifiersOfFrames) {
  std::string assigned = "TABLE:  \"FRAME PROPERTY MODIFIERS\"\n";
  for (int i = 1; i <= 40; ++i)
    assigned += fmt::format(
        "   Frame={}   AMod=1   AS2Mod=1   AS3Mod=1   JMod=1   I22Mod=0.25   I33Mod=0.25   MassMod=1   WeightMod=1\n", i);
  const std::string cantilever =
      metres + steel + section + line_of_frames(40, 0.1, 0.0) + restraints + restraint(1, "111111") + "\n";
  const std::string neutral =
      "TABLE:  \"FRAME INSERTION POINT ASSIGNMENTS\"\n   Frame=1   CardinalPt=\"10 (centroid)\"   StiffTransform=Yes   "
      "JtOffsetZI=0\n\n";
  expect_known("cracked", cantilever + neutral + assigned,
               {0.5 * euler_Hz(1.87510407, i22, 4.0), 0.5 * euler_Hz(1.87510407, i33, 4.0)}, beams);
  const auto refused = [&](std::string table, const std::string& from, const std::string& to) {
    table.replace(table.find(from), from.size(), to);
    return message_of([&] { (void)import_tables(cantilever + table); });
  };
  EXPECT_NE(refused(assigned, "MassMod=1", "MassMod=0").find("MassMod is 0"), std::string::npos);
  EXPECT_NE(refused(neutral, "10 (centroid)", "8 (top center)").find("FRAME INSERTION POINT"), std::string::npos);
  EXPECT_NE(refused(neutral, "ZI=0", "ZI=-0.2").find("FRAME INSERTION POINT"), std::string::npos);
}

TEST(Sap2000, RefusesWhatItDoesNotCarryByItsTable) {
  const std::string sound = metres + steel + section + line_of_frames(2, 1.0, 0.0) + restraints + restraint(1, "111111");
  EXPECT_EQ(message_of([&] { (void)import_tables(sound); }), "");
  EXPECT_EQ(message_of([&] { (void)import_tables(sound + "TABLE:  \"FRAME LOADS - DISTRIBUTED\"\n   Frame=1   LoadPat=L\n"); }),
            "");
  struct Case {
    std::string from, to, words;
  };
  for (const Case& c : {
           Case{"", "TABLE:  \"CONNECTIVITY - LINK\"\n   Link=1   JointI=1\n",
                "CONNECTIVITY - LINK: this table is not carried"},
           {"", "TABLE:  \"CONSTRAINT DEFINITIONS - EQUAL\"\n   Name=E   UX=Yes\n", "DEFINITIONS - EQUAL: this table"},
           {"", "TABLE:  \"FRAME PROPERTY MODIFIERS\"\n   Frame=1   AMod=2\n", "AMod is 2"},
           {"", "TABLE:  \"MASS SOURCE\"\n   MassSource=M   Elements=Yes   Masses=Yes   Loads=Yes\n",
            "takes masses from loads"},
           {"", "TABLE:  \"LOAD CASE DEFINITIONS\"\n   Case=MODAL   Type=LinModal   InitialCond=DEAD\n",
            "state of another case"},
           {"KN, m, C", "stone, m, C", "'stone' is unknown, expected one of"},
           {"CurrUnits=\"KN, m, C\"", "X=1", "PROGRAM CONTROL: is missing"},
           {"Material=Steel   Shape", "Material=Iron   Shape", "'Iron' is in no row of the table"},
           {"MMod=1", "MMod=2", "MMod is 2"},
           {"JointJ=3", "JointJ=9", "joint 9 is not defined"},
           {"IsCurved=No", "IsCurved=Yes", "is curved"},
           {"Area=0.02", "Area=x", "is 'x', expected a number"},
           {"Shape=Rectangular   t3=0.2   t2=0.1   Area=0.02", "Shape=Nonprismatic", "its Shape Nonprismatic is not read"},
           {"U12=0.3", "U12=0.6", "Poisson's ratio is 0.6"},
       }) {
    std::string text = sound;
    if (c.from.empty())
      text += c.to;
    else
      text.replace(text.find(c.from), c.from.size(), c.to);
    const std::string said = message_of([&] { (void)import_tables(text); });
    EXPECT_NE(said.find(c.words), std::string::npos) << c.words << "\n" << said;
    EXPECT_NE(said.find("deck.s2k:"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace twindeck::model_io::test::sap2000
