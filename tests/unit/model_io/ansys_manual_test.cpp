/// Problems of ANSYS' verification manual as decks of our own, by the elements and commands that its decks use. Oracle: the
/// targets that the manual prints, closed forms of Thomson, Timoshenko, Blevins and NAFEMS, within 1 % for beams, springs and
/// solids and 2 % for shells.
#include <functional>
#include <numbers>

#include "deck_table.hpp"
#include "model_io/ansys.hpp"
#include "nastran_deck.hpp"

namespace twindeck::model_io::test::ansys_manual {
namespace {

constexpr double beams = 0.01, shells = 0.02;  ///< [-] allowed
const std::string modal = "FINISH\n/SOLU\nANTYPE,MODAL\nMODOPT,LANB,4\nSOLVE\n";
const std::string under_load =
    "FINISH\n/SOLU\nANTYPE,STATIC\nPSTRES,ON\nSOLVE\nFINISH\n/SOLU\nANTYPE,MODAL\nMODOPT,LANB,4\nPSTRES,ON\nSOLVE\n";

/// The lowest frequencies [Hz] that are no rigid motion's, and those; a frequency that comes twice counts once.
void expect_of_manual(const std::string& name, const std::string& deck, const std::vector<double>& target_Hz, double part,
                      const std::string& remark = "") {
  SCOPED_TRACE(name);
  const TestFolder folder;
  folder.write("deck.dat", "/PREP7\n" + deck);
  ASSERT_TRUE(is_ansys_deck(folder.path() / "deck.dat"));
  std::vector<double> found;
  for (const double f : frequencies(read_ansys(folder.path() / "deck.dat").model, static_cast<int>(2 * target_Hz.size() + 2)))
    if (found.empty() || f > (1.0 + 1e-6) * found.back()) found.push_back(f);
  expect_known_frequencies({"ANSYS", name, "ANSYS' verification manual", part, remark}, found, target_Hz);
}

/// Nodes 1 to n + 1 along `axis` (0 x, 2 z) and a line of elements between them; with middle nodes where `quadratic`.
std::string line_of(int n, double length, int axis, bool quadratic = false) {
  const std::string end = axis == 0 ? fmt::format("{}", length) : fmt::format(",,{}", length);
  if (!quadratic) return fmt::format("N,1\nN,{},{}\nFILL\nE,1,2\nEGEN,{},1,1\n", n + 1, end, n);
  return fmt::format("N,1\nN,{},{}\nFILL\nE,1,3,2\nEGEN,{},2,1\n", 2 * n + 1, end, n);
}

TEST(AnsysManual, SpringsAndMasses) {
  expect_of_manual(
      "vm45, own deck",
      "ET,1,COMBIN14,,,2\nET,2,MASS21,,,4\nR,1,48\nR,2,.006477\nN,1\nN,2,,1\nE,1,2\nTYPE,2\nREAL,2\nE,2\nD,1,ALL\nD,2,UX\n" +
          modal,
      {13.701}, beams);
  expect_of_manual(
      "vm47, own deck",
      "ET,1,COMBIN14,,,1\nET,2,MASS21,,,3\nR,1,4.8\nR,2,1,.30312\nN,1\nN,2,,,-1\nE,1,2\nTYPE,2\nREAL,2\nE,2\nD,1,ALL\n"
      "D,2,UX,,,,,UY\n" +
          modal,
      {0.63333}, beams);
  expect_of_manual(
      "vm68 by COMBIN14",
      "ET,1,COMBIN14,,1\nET,2,MASS21,,,4\nR,1,42832\nR,2,32416\nR,3,0.5\nR,4,1\nN,1\nN,2,1\nN,3,2\nE,1,2\nREAL,2\nE,2,3\n"
      "TYPE,2\nREAL,3\nE,2\nREAL,4\nE,3\nD,1,ALL\nD,2,UY,,,3\n" +
          modal,
      {20.57, 64.88}, beams);
  expect_of_manual(
      "vm69 by COMBIN14",
      "ET,1,COMBIN14,,1\nET,2,MASS21,,,4\nR,1,9.8696\nR,2,1\nN,1\nN,2,1\nE,1,2\nTYPE,2\nREAL,2\nE,2\nD,1,ALL\nD,2,UY\n" + modal,
      {0.5}, beams);
  expect_of_manual("vm89, own deck",
                   "ET,1,COMBIN14,,,2\nET,2,MASS21,,,4\nR,1,200\nR,2,800\nR,3,.5\nR,4,1\nN,1\nN,4,1\nFILL\nE,1,2\nREAL,2\nE,2,"
                   "3\nREAL,1\nE,3,4\n"
                   "TYPE,2\nREAL,3\nE,2\nREAL,4\nE,3\nD,1,UY,,,4\nD,1,UX,,,4,3\n" +
                       modal,
                   {2.5814, 8.3263}, beams);
  expect_of_manual(
      "vm212 by COMBIN14",
      "ET,1,COMBIN14,,3\nET,2,BEAM188\nKEYOPT,2,3,2\nET,3,MASS21,,,2\nR,1,1.3E6\nR,2,3.9E6\nR,3,10E3/"
      "386.\nMP,EX,1,1\nMP,PRXY,1,.3\n"
      "SECTYPE,1,BEAM,ASEC\nSECDATA,100,833,,833,,1\nN,1\nN,2,144\nN,10,0,0,20\nN,20,54,0,20\nN,30,114,0,20\nN,40,144,0,20\n"
      "E,1,10\nREAL,2\nE,2,40\nTYPE,2\nSECNUM,1\nE,10,20\nE,20,30\nE,30,40\nTYPE,3\nREAL,3\nE,20\nE,30\n"
      "D,1,ALL,,,2\nD,20,UX,,,,,UY,ROTX,ROTZ\nCERIG,20,10,ALL\nCERIG,20,30,ALL\nCERIG,20,40,ALL\n" +
          modal,
      {46.30, 114.0}, beams);
}

TEST(AnsysManual, SpringsWithTheirMasses) {
  const std::string spectrum = "FINISH\n/SOLU\nANTYPE,SPECTR\nD,1,UX,1\nSOLVE\n";
  expect_of_manual(
      "vm68 by COMBIN40",
      "ET,1,COMBIN40\nR,1,42832,,.5\nR,2,32416,,1\nN,1\nN,2,1\nN,3,2\nE,2,1\nREAL,2\nE,3,2\nD,1,UX\n" + modal + spectrum,
      {20.57, 64.88}, beams);
  expect_of_manual("vm69 by COMBIN40", "ET,1,COMBIN40,,,,,,2\nR,1,9.8696,,1\nN,1\nN,2\nE,1,2\nD,1,UX\n" + modal + spectrum,
                   {0.5}, beams);
  expect_of_manual("vm72 by COMBIN40", "ET,1,COMBIN40,,,2\nR,1,30,.12,.02590673\nN,1\nN,2\nE,1,2\nD,2,UY\n" + modal,
                   {1.0 / 0.18507}, beams, "the manual's is the damped period, which is 0.2 % longer");
  for (const auto& [dof, words] : {std::pair(1, "along x"), {3, "along z"}, {6, "about z"}})  // half of its mass is held
    expect_of_manual(fmt::format("vm69 by COMBIN40 {}, its mass in halves", words),
                     fmt::format("ET,1,COMBIN40,,,{},,,1\nR,1,9.8696,,2\nN,1\nN,2\nE,1,2\nD,1,ALL\n", dof) + modal, {0.5},
                     beams);
  // The beam's nodes are tied in a row, in which the middle ones follow and lead.
  expect_of_manual("vm212 by COMBIN40",
                   "N,1\nN,2,144\nN,10,0,0,20\nN,20,54,0,20\nN,30,114,0,20\nN,40,144,0,20\nET,1,COMBIN40,,,3\nR,1,1.3E6\nE,1,"
                   "10\nR,2,3.9E6\nREAL,2\nE,2,40\nET,3,MASS21,,,2\nR,3,10E3/386.\nTYPE,3\nREAL,3\nE,20\nE,30\nD,1,ALL,,,2\n"
                   "D,10,UX,,,,,UY,ROTX,ROTZ\nCERIG,10,20,ALL\nCERIG,30,20,ALL\nCERIG,30,40,ALL\n" +
                       modal,
                   {46.30, 114.0}, beams);
}

TEST(AnsysManual, ShaftAndSuspension) {
  const std::string masses = "TYPE,2\nREAL,2\nE,2\n", plane = "D,1,UX,,,2,,UY,UZ,ROTY,ROTZ\nD,1,ROTX\n";
  expect_of_manual("vm48, own deck",
                   "ET,1,PIPE16\nET,2,MASS21\nR,1,.375,.1875\nR,2,,,,31E-3\nMP,EX,1,31.2E6\nMP,PRXY,1,.3\nN,1\nN,2,8\nE,1,2\n" +
                       masses + plane + modal,
                   {48.781}, beams);
  expect_of_manual("vm52, own deck",
                   "ET,1,BEAM4\nET,2,COMBIN14,,,2\nET,3,MASS21,,,3\nR,1,2400\nR,2,100,1600\nR,3,2600\nR,4,1,1/12,1/"
                   "12,1,1\nMP,EX,1,4E9\nMP,PRXY,1,.3\n"
                   "N,1\nN,2,,1\nN,3,4.5,1\nN,4,10,1\nN,5,10\nTYPE,2\nE,1,2\nREAL,3\nE,4,5\nTYPE,1\nREAL,4\nE,2,3\nE,3,4\nTYPE,"
                   "3\nREAL,2\nE,3\n"
                   "D,1,UX,,,5,4,UY\nD,3,UX\nNSEL,S,NODE,,2,4\nD,ALL,UZ,,,,,ROTY,ROTX\nNSEL,ALL\n" +
                       modal,
                   {1.0981, 1.4406}, beams);
}

TEST(AnsysManual, SimplySupportedBeams) {
  const std::string material = "MP,EX,1,30E6\nMP,DENS,1,728E-6\nMP,PRXY,1,.3\n",
                    plane = "D,ALL,UZ,,,,,ROTX,ROTY\nD,1,UX,,,,,UY\n";
  const std::string section = "SECTYPE,1,BEAM,ASEC\nSECDATA,4,4/3,,4/3,,1\n";
  expect_of_manual("vm50, beam188",
                   "ET,1,BEAM188\nKEYOPT,1,3,3\n" + material + section + line_of(8, 80, 0) + plane + "D,9,UY\n" + modal,
                   {28.766}, beams);
  expect_of_manual("vm50, beam189",
                   "ET,1,BEAM189\n" + material + section + line_of(4, 80, 0, true) + plane + "D,9,UY\n" + modal, {28.766},
                   beams);
  expect_of_manual("vm50, beam4", "ET,1,BEAM4\nR,1,4,4/3,4/3,2,2\n" + material + line_of(8, 80, 0) + plane + "D,9,UY\n" + modal,
                   {28.766}, beams);
  expect_of_manual("vm50, beam3",
                   "ET,1,BEAM3\nR,1,4,4/3,2\n" + material + line_of(8, 80, 0) + "D,1,UX,,,,,UY\nD,9,UY\n" + modal, {28.766},
                   beams);
  // NAFEMS 5, a deep beam: shear and rotary inertia.
  expect_of_manual(
      "vm19, own deck",
      "ET,1,BEAM188\nKEYOPT,1,3,3\nMP,EX,1,200E9\nMP,NUXY,1,.3\nMP,DENS,1,8000\nSECTYPE,1,BEAM,RECT\nSECDATA,2,2\n" +
          line_of(10, 10, 0) + "D,1,UX,,,,,UY,UZ,ROTX\nD,11,UY,,,,,UZ\n" + modal,
      {42.65}, beams);
}

TEST(AnsysManual, DrillPipe) {
  const std::string material = "MP,EX,1,4.4928E9\nMP,DENS,1,15.2174\nMP,NUXY,1,.3\nET,2,MASS21\nR,2,,,,,,29.3\n";
  const auto pipe = [&](const std::string& type, const std::string& section, bool quadratic) {
    const int last = quadratic ? 25 : 13;
    expect_of_manual("vm57, " + type,
                     material + "ET,1," + type + "\n" + section + line_of(12, -5000, 2, quadratic) +
                         fmt::format("TYPE,2\nREAL,2\nE,{0}\nD,1,UX,,,{0},,UY,UZ,ROTX,ROTY\nD,1,ROTZ\n", last) + modal,
                     {0.3833, 1.260}, beams);
  };
  const std::string of_pipe = "SECTYPE,1,PIPE\nSECDATA,4.5/12,.335/12\n",
                    of_tube = "SECTYPE,1,BEAM,CTUBE\nSECDATA,3.83/24,4.5/24\n";
  pipe("PIPE16", "R,1,4.5/12,.335/12\n", false);
  pipe("PIPE288", of_pipe, false);
  pipe("PIPE289", of_pipe, true);
  pipe("BEAM188", of_tube, false);
  pipe("BEAM189", of_tube, true);
}

TEST(AnsysManual, FreeRodAndStrings) {
  const std::string material = "MP,EX,1,3E7\nMP,DENS,1,73E-5\nMP,PRXY,1,.3\n";
  expect_of_manual("vm61, beam188",
                   "ET,1,BEAM188\nSECTYPE,1,BEAM,ASEC\nSECDATA,1,1,,1,,1\n" + material + line_of(30, 800, 0) +
                       "D,ALL,UY,,,,,UZ,ROTX,ROTY,ROTZ\n" + modal,
                   {0.0, 126.70, 253.40}, beams);
  expect_of_manual("vm61, link8", "ET,1,LINK8\nR,1,1\n" + material + line_of(30, 800, 0) + "D,ALL,UY,,,,,UZ\n" + modal,
                   {0.0, 126.70, 253.40}, beams);
  // A string of 100 in under 500 lbf, by its initial strain and by a force at its end.
  expect_of_manual(
      "vm53, link8",
      "ET,1,LINK8\nR,1,.00306796,.543248E-2\n" + material + line_of(26, 100, 0) + "D,1,ALL\nD,27,ALL\nD,ALL,UZ\n" + under_load,
      {74.708, 149.42, 224.12}, beams);
  expect_of_manual("vm76, own deck",
                   "ET,1,LINK8\nR,1,50671E-12,84/(50671E-12*190E9)\nMP,EX,1,190E9\nMP,DENS,1,7920\n" + line_of(30, .71, 0) +
                       "D,1,ALL\nD,31,ALL\nD,ALL,UZ\n" + under_load,
                   {322.2}, beams);
}

TEST(AnsysManual, BarUnderCompression) {
  const std::string material = "MP,EX,1,30E6\nMP,DENS,1,727.973E-6\nMP,PRXY,1,.3\n";
  const std::string held = "D,1,UX,,,,,UY\nD,14,UY\nD,ALL,UZ,,,,,ROTX,ROTY\nF,14,FX,-40000\n";
  const std::vector<double> target = {17.055, 105.32, 249.39};
  expect_of_manual("vm59, beam4", "ET,1,BEAM4\nR,1,4,4/3,4/3,2,2\n" + material + line_of(13, 80, 0) + held + under_load, target,
                   beams);
  expect_of_manual("vm59, beam188",
                   "ET,1,BEAM188\nKEYOPT,1,3,3\nSECTYPE,1,BEAM,ASEC\nSECDATA,4,4/3,,4/3,,2.25\n" + material +
                       line_of(13, 80, 0) + held + under_load,
                   target, beams);
}

TEST(AnsysManual, TheSameBarInTurnedAxesOfItsNodes) {
  // vm59's bar at 30 degrees in the X-Y plane, held and pushed along its own axes.
  std::string deck = "ET,1,BEAM4\nR,1,4,4/3,4/3,2,2\nMP,EX,1,30E6\nMP,DENS,1,727.973E-6\nMP,PRXY,1,.3\n";
  for (int i = 0; i <= 13; ++i)
    deck +=
        fmt::format("N,{},{:.12g},{:.12g},0,30\n", i + 1, 80.0 / 13 * i * std::cos(std::numbers::pi / 6), 80.0 / 13 * i * 0.5);
  expect_of_manual("vm59 in turned axes",
                   deck + "E,1,2\nEGEN,13,1,1\nD,1,UX,,,,,UY\nD,14,UY\nD,ALL,UZ,,,,,ROTX,ROTY\nF,14,FX,-40000\n" + under_load,
                   {17.055, 105.32, 249.39}, beams);
}

TEST(AnsysManual, BeamPulledByItsActuator) {
  // By the force of its transducer, in micrometres. Held out of its plane, which is one of symmetry.
  expect_of_manual("vm219, own deck",
                   "ET,1,BEAM188\nKEYOPT,1,3,3\nSECTYPE,1,BEAM,ASEC\nSECDATA,8,8/3,,8/3,,1\nMP,EX,1,169E3\nMP,PRXY,1,.3\n"
                   "MP,DENS,1,2332E-18\n" +
                       line_of(20, 150, 0) + "DSYM,SYMM,Z\nD,21,UX,,,,,UY\nD,1,UY\nF,1,FX,-10\n" + under_load,
                   {351699.332, 1381162.303, 3096816.034}, beams);
}

const std::string nafems = "MP,EX,1,200E9\nMP,PRXY,1,.3\nMP,DENS,1,8000\n";

TEST(AnsysManual, PinnedDoubleCross) {
  const auto cross = [](const std::string& type, bool quadratic) {
    std::string deck = type + "SECTYPE,1,BEAM,RECT\nSECDATA,.125,.125\n" + nafems + "N,1\n", held;
    constexpr int pieces = 8;  // of an arm, half of them the elements of BEAM189
    for (int arm = 0; arm < 8; ++arm) {
      const double angle = arm * std::numbers::pi / 4;
      const auto label = [&](int i) { return i == 0 ? 1 : 1 + arm * pieces + i; };
      for (int i = 1; i <= pieces; ++i)
        deck += fmt::format("N,{},{:.12g},{:.12g}\n", label(i), 5.0 * i / pieces * std::cos(angle),
                            5.0 * i / pieces * std::sin(angle));
      for (int i = 0; i < pieces; i += quadratic ? 2 : 1)
        deck += quadratic ? fmt::format("E,{},{},{}\n", label(i), label(i + 2), label(i + 1))
                          : fmt::format("E,{},{}\n", label(i), label(i + 1));
      held += fmt::format("D,{},UX,,,,,UY\n", label(pieces));
    }
    return deck + held + "DSYM,SYMM,Z\n" + modal;
  };
  const std::vector<double> target = {11.336, 17.709, 17.709, 45.345};
  const std::string remark = "the closed form leaves shear out, which takes 1.2 % off the next, at 57.39 Hz";
  expect_of_manual("vmp09-t2, beam188", cross("ET,1,BEAM188\nKEYOPT,1,3,3\n", false), target, beams, remark);
  expect_of_manual("vmp09-t2, beam189", cross("ET,1,BEAM189\n", true), target, beams, remark);
}

TEST(AnsysManual, MassesBesideACantilever) {
  const std::string masses =
      "ET,2,MASS21,,,2\nR,2,1E4\nR,3,1E3\nN,50,10,2\nN,60,10,-2\nTYPE,2\nREAL,2\nE,50\nREAL,3\nE,60\n"
      "CERIG,11,50,ALL\nCERIG,11,60,ALL\nD,1,ALL\n";
  const std::vector<double> target = {1.723, 1.727, 7.413, 9.972, 18.155, 26.957};
  const std::string section = "SECTYPE,1,BEAM,CSOLID\nSECDATA,.25\n" + nafems;
  expect_of_manual("vmp09-t4, beam188", "ET,1,BEAM188\nKEYOPT,1,3,3\n" + section + line_of(10, 10, 0) + masses + modal, target,
                   beams);
  expect_of_manual("vmp09-t4, beam189", "ET,1,BEAM189\n" + section + line_of(5, 10, 0, true) + masses + modal, target, beams);
}

/// A sheet of n × m shells of four nodes, or of eight, whose corners `place` gives from shares along and across.
std::string sheet(int n, int m, bool quadratic, const std::function<std::array<double, 2>(double, double)>& place) {
  std::string deck;
  const int step = quadratic ? 1 : 2;  // nodes on a grid of twice as many lines
  const auto label = [&](int i, int j) { return (2 * m + 1) * i + j + 1; };
  for (int i = 0; i <= 2 * n; i += step)
    for (int j = 0; j <= 2 * m; j += step) {
      if (i % 2 == 1 && j % 2 == 1) continue;
      const auto [x, y] = place(i / (2.0 * n), j / (2.0 * m));
      deck += fmt::format("N,{},{},{}\n", label(i, j), x, y);
    }
  for (int i = 0; i < 2 * n; i += 2)
    for (int j = 0; j < 2 * m; j += 2) {
      deck += fmt::format("E,{},{},{},{}", label(i, j), label(i + 2, j), label(i + 2, j + 2), label(i, j + 2));
      if (quadratic)
        deck += fmt::format(",{},{},{},{}", label(i + 1, j), label(i + 2, j + 1), label(i + 1, j + 2), label(i, j + 1));
      deck += "\n";
    }
  return deck;
}

TEST(AnsysManual, Plates) {
  const std::string material = "MP,EX,1,30E6\nMP,DENS,1,728E-6\nMP,NUXY,1,0\n", of_shell = "SECTYPE,1,SHELL\nSECDATA,1,1,0,3\n";
  const auto plate = [](double along, double across) { return std::array<double, 2>{16.0 * along, 4.0 * across - 2.0}; };
  // The wedge ends 0.02 in wide, because a shell of four nodes has four of them.
  const auto wedge = [](double along, double across) {
    return std::array<double, 2>{16.0 * along, (2.0 * across - 1.0) * std::max(2.0 * along, 0.01)};
  };
  const std::string clamped = "NSEL,S,LOC,X,16\nD,ALL,ALL\nNSEL,ALL\n";
  struct Type {
    std::string name, section;
    bool quadratic;
  };
  for (const Type& type : {Type{"SHELL63", "R,1,1\n", false},
                           {"SHELL181", of_shell, false},
                           {"SHELL93", "R,1,1\n", true},
                           {"SHELL281", of_shell, true}}) {
    const std::string head = "ET,1," + type.name + "\n" + type.section + material;
    expect_of_manual("vm66, " + type.name, head + sheet(8, 2, type.quadratic, plate) + clamped + modal, {128.09}, shells);
    expect_of_manual("vm62, " + type.name, head + sheet(8, 2, type.quadratic, wedge) + clamped + "D,ALL,UX,,,,,UY\n" + modal,
                     {259.16}, shells);
  }
}

// NAFEMS' thick plate, a tenth as thick as wide: transverse shear takes 2.8 % of the frequency.
TEST(AnsysManual, AThickPlate) {
  const auto square = [](double along, double across) { return std::array<double, 2>{10.0 * along, 10.0 * across}; };
  const std::string material = "MP,EX,1,200E9\nMP,PRXY,1,.3\nMP,DENS,1,8000\n", of_shell = "SECTYPE,1,SHELL\nSECDATA,1,1\n";
  const std::string held =
      "NSEL,S,LOC,X,0\nNSEL,A,LOC,X,10\nD,ALL,UZ,,,,,ROTX\nNSEL,S,LOC,Y,0\nNSEL,A,LOC,Y,10\nD,ALL,UZ,,,,,ROTY\nNSEL,ALL\n"
      "D,ALL,UX,,,,,UY,ROTZ\n";
  for (const auto& [type, section, n] :
       {std::tuple("SHELL281", of_shell, 4), {"SHELL93", "R,1,1\n", 4}, {"SHELL181", of_shell, 8}})
    expect_of_manual(fmt::format("vm203, {}", type),
                     fmt::format("ET,1,{}\n", type) + section + material + sheet(n, n, n == 4, square) + held + modal, {45.90},
                     shells);
}

TEST(AnsysManual, PlatesOfNafems) {
  const auto square = [](double along, double across) { return std::array<double, 2>{10.0 * along, 10.0 * across}; };
  const auto rhombus = [](double along, double across) {
    return std::array<double, 2>{10.0 * along + std::sqrt(50.0) * across, std::sqrt(50.0) * across};
  };
  const auto clamped = [](int n, int step) {  // the four edges of sheet()
    const int row = 2 * n + 1, last = row * row;
    return fmt::format("D,1,ALL,,,{0},{4}\nD,{1},ALL,,,{2},{4}\nD,1,ALL,,,{1},{3}\nD,{0},ALL,,,{2},{3}\n", row, last - row + 1,
                       last, step * row, step);
  };
  for (const auto& [type, quadratic] : {std::pair("SHELL181", false), {"SHELL281", true}}) {
    const std::string head = fmt::format("ET,1,{}\nSECTYPE,1,SHELL\nSECDATA,.05\n", type) + nafems,
                      in_plane = "D,ALL,UX,,,,,UY,ROTZ\n";
    const int few = quadratic ? 8 : 16, many = quadratic ? 20 : 40;
    expect_of_manual(fmt::format("vmp09-t12 by {}", type), head + sheet(few, few, quadratic, square) + in_plane + modal,
                     {0.0, 1.622, 2.360, 2.922, 4.233, 7.416}, shells);
    expect_of_manual(fmt::format("vmp09-t15 by {}", type),
                     head + sheet(many, many, quadratic, rhombus) + in_plane + clamped(many, quadratic ? 1 : 2) + modal,
                     {7.938, 12.835, 17.941, 19.133, 24.009, 27.922}, shells);
  }
}

/// A disc of n rings and m sectors about node 1, triangles at the centre; the nodes of its edge are the last m.
std::string disc(int n, int m, double radius, const char* held = "ALL") {
  std::string deck = "N,1\n";
  const auto label = [&](int i, int j) { return i == 0 ? 1 : 2 + (i - 1) * m + j % m; };
  for (int i = 1; i <= n; ++i)
    for (int j = 0; j < m; ++j) {
      const double r = radius * i / n, angle = 2.0 * std::numbers::pi * j / m;
      deck += fmt::format("N,{},{:.12g},{:.12g}\n", label(i, j), r * std::cos(angle), r * std::sin(angle));
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j)
      deck += i == 0 ? fmt::format("E,1,{0},{1},{1}\n", label(1, j), label(1, j + 1))
                     : fmt::format("E,{},{},{},{}\n", label(i, j), label(i + 1, j), label(i + 1, j + 1), label(i, j + 1));
  return deck + fmt::format("D,{},{},,,{}\nD,ALL,UX,,,,,UY,ROTZ\n", label(n, 0), held, label(n, m - 1));
}

TEST(AnsysManual, DiscsHeldClampedAndStretched) {
  for (const auto& [type, section] : {std::pair("SHELL63", "R,1,.05\n"), {"SHELL181", "SECTYPE,1,SHELL\nSECDATA,.05,1\n"}})
    expect_of_manual(
        fmt::format("vm151 by {}", type),
        fmt::format("ET,1,{}\n{}MP,EX,1,30E6\nMP,DENS,1,.00073\nMP,NUXY,1,.3\n", type, section) + disc(16, 32, 3, "UZ") + modal,
        {269.96, 756.13, 1391.3}, shells);
  for (const auto& [type, section] : {std::pair("SHELL63", "R,1,.5\n"), {"SHELL181", "SECTYPE,1,SHELL\nSECDATA,.5,1\n"}})
    expect_of_manual(
        fmt::format("vm181 by {}", type),
        fmt::format("ET,1,{}\n{}MP,EX,1,30E6\nMP,DENS,1,.00073\nMP,NUXY,1,.3\n", type, section) + disc(12, 24, 17) + modal,
        {172.64, 359.28}, shells);
  for (const auto& [type, section] : {std::pair("SHELL63", "R,1,5E-5\n"), {"SHELL181", "SECTYPE,1,SHELL\nSECDATA,5E-5,1\n"}})
    expect_of_manual(fmt::format("vm55, vm153 by {}", type),
                     fmt::format("ET,1,{}\n{}MP,EX,1,30E6\nMP,ALPX,1,1E-5\nMP,DENS,1,.00073\nMP,NUXY,1,0\n", type, section) +
                         disc(12, 24, 3) + "TREF,0\nBFUNIF,TEMP,-6.66666\n" + under_load,
                     {211.1, 336.5, 450.9, 484.7}, shells, "the third is the closed form's, which the manual leaves out");
}

TEST(AnsysManual, ABeamUnderSeismicLoad) {
  expect_of_manual(
      "vm70, beam188",
      "ET,1,BEAM188\nKEYOPT,1,3,3\nSECTYPE,1,BEAM,ASEC\nSECDATA,273.9726,333.333,,333.333,,1\nMP,EX,1,30E6\nMP,PRXY,1,.3\n"
      "MP,DENS,1,73E-5\n" +
          line_of(8, 240, 0) + "D,ALL,UZ,,,,,ROTX,ROTY\nD,1,UX,,,9,8,UY\n" + modal,
      {6.0979}, beams);
}

TEST(AnsysManual, PlateOfSolids) {
  std::string deck = "MP,EX,1,30E6\nMP,DENS,1,728E-6\nMP,NUXY,1,0\n";
  for (int k = 0; k <= 2; ++k)
    for (int j = 0; j <= 2; ++j)
      for (int i = 0; i <= 16; ++i) deck += fmt::format("N,{},{},{},{}\n", 51 * k + 17 * j + i + 1, i, 2 * j - 2, 0.5 * k);
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j) {
      const int a = 51 * k + 17 * j + 1;
      deck +=
          fmt::format("E,{},{},{},{},{},{},{},{}\nEGEN,16,1,-1\n", a, a + 1, a + 18, a + 17, a + 51, a + 52, a + 69, a + 68);
    }
  const std::string clamped = "NSEL,S,LOC,X,16\nD,ALL,ALL\nNSEL,ALL\n";
  for (const char* type : {"SOLID45", "SOLID185"})
    expect_of_manual(fmt::format("vm66, {}", type), fmt::format("ET,1,{}\n", type) + deck + clamped + modal, {128.09}, beams);
}

}  // namespace
}  // namespace twindeck::model_io::test::ansys_manual
