/// *TRANSFORM and *AMPLITUDE. Oracle: a deck that is turned as a whole, with everything along the turned axes, has the
/// frequencies of the deck that is not; closed forms of masses on springs and of a hinged bar at half its Euler load; the size
/// of the load at the end of its step.
#include <cmath>
#include <numbers>

#include "deck_table.hpp"
#include "model_io/inp.hpp"
#include "nastran_deck.hpp"

namespace twindeck::model_io::test::inp_axes {
namespace {

using std::numbers::pi;

fe::Model read_text(const std::string& text) {
  const TestFolder folder;
  folder.write("deck.inp", text);
  return read_inp(folder.path() / "deck.inp").model;
}

/// Bar of 10 m in ten B33 along (cos a, sin a, 0), 0.2 m × 0.4 m, hinged, its end guided along the bar; `load` at its end.
std::string bar(double a, const std::string& transform, const std::string& step_options, const std::string& load,
                const std::string& amplitude = "", const std::string& time = "") {
  std::string deck = "*NODE\n";
  for (int i = 0; i <= 10; ++i) deck += fmt::format("{}, {:.15g}, {:.15g}, 0.\n", i + 1, i * std::cos(a), i * std::sin(a));
  deck += "*ELEMENT, TYPE=B33, ELSET=BEAMS\n";
  for (int i = 1; i <= 10; ++i) deck += fmt::format("{}, {}, {}\n", i, i, i + 1);
  return deck +
         fmt::format(
             "*NSET, NSET=ENDS\n1, 11\n*BEAM SECTION, ELSET=BEAMS, MATERIAL=STEEL, SECTION=RECT\n0.2, 0.4\n{:.15g}, {:.15g}, "
             "0.\n",
             -std::sin(a), std::cos(a)) +
         "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1E11, 0.3\n*DENSITY\n7850.\n" + transform + amplitude +
         "*BOUNDARY\n1, 1, 4\n11, 2, 3\n*STEP" + step_options + "\n*STATIC\n" + time + load +
         "*END STEP\n*STEP, PERTURBATION\n*FREQUENCY\n4\n*END STEP\n";
}

constexpr double half_euler = 0.5 * pi * pi * 2.1e11 * (0.4 * 0.008 / 12.0) / 100.0;
/// Half its Euler load about the weak axis.
const std::vector<double> half_loaded_Hz = {3.319, 8.776};

void expect_half_loaded(const std::string& name, const std::string& deck) {
  expect_known_frequencies({"Abaqus, CalculiX", name, "closed form", 0.01}, frequencies(read_text(deck), 2), half_loaded_Hz);
}

TEST(InpAxes, ABarOnTurnedSupports) {
  const double a = pi / 6.0;
  const std::string turn = fmt::format("*TRANSFORM, NSET=ENDS\n{:.15g}, {:.15g}, 0., {:.15g}, {:.15g}, 0.\n", std::cos(a),
                                       std::sin(a), -std::sin(a), std::cos(a)),
                    push = fmt::format("*CLOAD\n11, 1, {:.8E}\n", -half_euler);
  expect_half_loaded("bar_on_turned_supports", bar(a, turn, "", push));
  // Cylinders about an axis beside the first node: radial is along the bar.
  expect_half_loaded("bar_in_cylindrical_axes",
                     bar(a,
                         fmt::format("*TRANSFORM, NSET=ENDS, TYPE=C\n{0:.15g}, {1:.15g}, 0., {0:.15g}, {1:.15g}, 1.\n",
                                     -std::cos(a), -std::sin(a)),
                         "", push));
  // Along the axes of the deck it changes names alone: x' is y, y' is -x.
  expect_half_loaded("bar_on_swapped_axes", bar(pi / 2.0, "*TRANSFORM, NSET=ENDS\n0., 1., 0., -1., 0., 0.\n", "", push));
  EXPECT_TRUE(read_text(bar(pi / 2.0, "*TRANSFORM, NSET=ENDS\n0., 1., 0., -1., 0., 0.\n", "", push)).constraints.empty());
}

TEST(InpAxes, AnAdditionalNodeOfABeamTurnsItsSection) {
  // n1 points from the first node to the additional one, whatever the section says; a normal at a node would turn it too.
  const auto deck = [](const std::string& third, const std::string& normal, const std::string& n1) {
    return read_text("*NODE\n1, 0., 0., 0." + normal + "\n2, 4., 0., 0.\n3, 0., 3., 0.\n*ELEMENT, TYPE=B31, ELSET=B\n1, 1, 2" +
                     third +
                     "\n*MATERIAL, NAME=S\n*ELASTIC\n2.1E11, 0.3\n*DENSITY\n7850.\n*BEAM SECTION, ELSET=B, MATERIAL=S, " +
                     "SECTION=RECT\n0.1, 0.2\n" + n1 + "*BOUNDARY\n1, 1, 6\n");
  };
  const Eigen::Vector3d by_section = deck("", "", "0., 1., 0.\n").elements.at(0).orientation;
  EXPECT_TRUE(deck(", 3", "", "0., 0., 1.\n").elements.at(0).orientation.isApprox(by_section, 1e-12));
  EXPECT_NE(
      message_of([&] { (void)deck("", ", 0., 0., 1.", "0., 1., 0.\n"); }).find("node 1 has a normal behind its coordinates"),
      std::string::npos);
}

TEST(InpAxes, SpringsAndEquationsAlongTurnedAxes) {
  // 2 kg on 800 N/m along (0.6, 0.8) and held across; a second one of 3 kg moves half as far along its own x'.
  const std::string deck =
      "*NODE, NSET=ALL\n1, 0., 0., 0.\n2, 5., 0., 0.\n*NSET, NSET=FIRST\n1\n*TRANSFORM, NSET=FIRST\n0.6, 0.8, 0., -0.8, 0.6, "
      "0.\n"
      "*NSET, NSET=SECOND\n2\n*TRANSFORM, NSET=SECOND\n0.8, -0.6, 0., 0.6, 0.8, 0.\n"
      "*ELEMENT, TYPE=MASS, ELSET=M1\n1, 1\n*MASS, ELSET=M1\n2.\n*ELEMENT, TYPE=MASS, ELSET=M2\n2, 2\n*MASS, ELSET=M2\n3.\n"
      "*ELEMENT, TYPE=SPRING1, ELSET=K\n3, 1\n*SPRING, ELSET=K\n1\n800.\n"
      "*EQUATION\n2\n2, 1, 1., 1, 1, -0.5\n"
      "*BOUNDARY\n1, 2, 6\n2, 2, 6\n*STEP\n*FREQUENCY\n1\n*END STEP\n";
  EXPECT_NEAR(frequencies(read_text(deck), 1).at(0), std::sqrt(800.0 / (2.0 + 3.0 / 4.0)) / (2.0 * pi), 1e-9);
}

TEST(InpAxes, ALoadHasTheFactorOfTheEndOfItsStep) {
  const std::string push = fmt::format("*CLOAD, AMPLITUDE=Grow\n11, 1, {:.8E}\n", -2.0 * half_euler);
  const auto expect = [&](const std::string& name, const std::string& amplitude, const std::string& time = "") {
    expect_half_loaded(name, bar(0.0, "", "", push, "*AMPLITUDE, NAME=GROW" + amplitude, time));
  };
  expect("amplitude_in_step_time", "\n0., 0., 1., 0.5, 2., 1.\n");
  expect("amplitude_between_points", "\n0., 0., 4., 1.\n", "0.1, 2.\n");
  expect("amplitude_of_total_time", ", TIME=TOTAL TIME\n0., 0., 4., 1.\n", "0.1, 2.\n");
  expect("amplitude_of_smooth_steps", ", DEFINITION=SMOOTH STEP\n0., 0., 4., 1.\n", "0.1, 2.\n");
  expect("amplitude_that_has_ended", "\n0., 0., 0.5, 0.5\n");
}

TEST(InpAxes, WhatIsNotCarriedIsRefusedByName) {
  const auto message = [](const std::string& deck) { return message_of([&] { (void)read_text(deck); }); };
  const std::string push = "*CLOAD, AMPLITUDE=Grow\n11, 1, -1.\n";
  EXPECT_NE(message(bar(0.0, "", "", push)).find("amplitude 'Grow' is not defined"), std::string::npos);
  EXPECT_NE(message(bar(0.0, "", "", push, "*AMPLITUDE, NAME=GROW, DEFINITION=PERIODIC\n1, 1., 0., 1.\n0., 1.\n"))
                .find("DEFINITION=PERIODIC"),
            std::string::npos);
  EXPECT_NE(message(bar(0.0, "*TRANSFORM, NSET=ENDS, TYPE=C\n0., 0., 0., 0., 0., 1.\n", "", push, ""))
                .find("node 1 lies on the axis"),
            std::string::npos);
  const std::string moved = "*BOUNDARY\n11, 2, 2, 0.01\n";
  EXPECT_NE(
      message(bar(0.0, "*TRANSFORM, NSET=ENDS\n0.6, 0.8, 0., -0.8, 0.6, 0.\n", "", moved)).find("skew to the global ones"),
      std::string::npos);
}

TEST(InpAxes, OpenSectionBeamsAreReadWithANote) {
  const TestFolder folder;
  folder.write("deck.inp",
               "*NODE\n1, 0., 0., 0.\n2, 0.5, 0., 0.\n3, 1., 0., 0.\n*ELEMENT, TYPE=B32OS, ELSET=BEAM\n1, 1, 2, 3\n"
               "*MATERIAL, NAME=M\n*ELASTIC\n2.E11, 0.3\n*DENSITY\n7850.\n*BEAM SECTION, ELSET=BEAM, MATERIAL=M, SECTION=I\n"
               "0.05, 0.1, 0.06, 0.06, 0.005, 0.005, 0.004\n0., 1., 0.\n*BOUNDARY\n1, ENCASTRE\n");
  const ImportedModel imported = read_inp(folder.path() / "deck.inp");
  EXPECT_EQ(imported.model.elements.size(), 2U);
  EXPECT_TRUE(std::any_of(imported.notes.begin(), imported.notes.end(),
                          [](const std::string& note) { return note.find("warping") != std::string::npos; }));
}

}  // namespace
}  // namespace twindeck::model_io::test::inp_axes
