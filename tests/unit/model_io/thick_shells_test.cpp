/// Shells that are flexible in transverse shear in the program of the deck, and such that are not. Oracle: Mindlin's and
/// Kirchhoff's frequencies, within 2 %, of a simply supported square plate of 1 m, 0.1 m thick, whose edges do not turn along
/// themselves.
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "deck_table.hpp"
#include "model_io/any_model_folder.hpp"
#include "model_io/inp.hpp"
#include "model_io/write_model.hpp"
#include "nastran_deck.hpp"

namespace twindeck::model_io::test::thick_shells {
namespace {

constexpr double allowed = 0.02;  // [-]
constexpr int n = 16;             // spaces between corners along a side; half as many elements with nodes on their edges

/// Lowest frequency of p and q half waves: ω² of the pencil of w and the rotation along the wave (Mindlin 1951). Without shear
/// strains the rotation is dw/dx: Kirchhoff's plate with rotary inertia.
double plate_Hz(int p, int q, bool shear_flexible, double rotary = 1.0) {
  const double t = 0.1, k2 = std::pow(std::numbers::pi, 2) * (p * p + q * q), d = 200e9 * t * t * t / 12.0 / 0.91;
  const double mass = 8000.0 * t, inertia = rotary * mass * t * t / 12.0, s = 5.0 / 6.0 * 200e9 / 2.6 * t;
  if (!shear_flexible) return k2 * std::sqrt(d / (mass + k2 * inertia)) / (2.0 * std::numbers::pi);
  if (rotary == 0.0) return k2 * std::sqrt(d / mass / (1.0 + d * k2 / s)) / (2.0 * std::numbers::pi);
  const double a = mass * inertia, b = mass * (d * k2 + s) + inertia * s * k2, c = s * d * k2 * k2;
  return std::sqrt((b - std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a)) / (2.0 * std::numbers::pi);
}

std::vector<double> first_three_Hz(bool shear_flexible, double rotary = 1.0) {
  return {plate_Hz(1, 1, shear_flexible, rotary), plate_Hz(1, 2, shear_flexible, rotary),
          plate_Hz(1, 2, shear_flexible, rotary)};
}

using Elements = std::vector<std::vector<int>>;

/// Nodes 1 … of a grid of 2 n + 1 lines each way (all of them for elements with nodes on edges), and elements of so many nodes.
Elements elements_of(int nodes) {
  Elements elements;
  const bool quadratic = nodes > 4;
  const int step = quadratic ? 2 : 1;
  for (int j = 0; j < n; j += step)
    for (int i = 0; i < n; i += step) {
      const auto at = [&](int a, int b) { return 1 + i + a + (n + 1) * (j + b); };
      const int s = step, m = 1;
      if (nodes == 4) elements.push_back({at(0, 0), at(s, 0), at(s, s), at(0, s)});
      if (nodes == 3) elements.push_back({at(0, 0), at(s, 0), at(s, s)}), elements.push_back({at(0, 0), at(s, s), at(0, s)});
      if (nodes == 8) elements.push_back({at(0, 0), at(s, 0), at(s, s), at(0, s), at(m, 0), at(s, m), at(m, s), at(0, m)});
      if (nodes == 6) {
        elements.push_back({at(0, 0), at(s, 0), at(s, s), at(m, 0), at(s, m), at(m, m)});
        elements.push_back({at(0, 0), at(s, s), at(0, s), at(m, m), at(m, s), at(0, m)});
      }
    }
  return elements;
}

/// Calls f(number, x, y, at an edge across x, at one across y) for the nodes that the elements have.
template <typename F>
void for_each_node(const Elements& elements, F f) {
  std::set<int> used;
  for (const auto& e : elements)
    for (const int node : e) used.insert(node);
  for (const int node : used) {
    const int i = (node - 1) % (n + 1), j = (node - 1) / (n + 1);
    f(node, i / double(n), j / double(n), i == 0 || i == n, j == 0 || j == n);
  }
}

fe::Model of_inp(const std::string& type, int nodes) {
  const Elements elements = elements_of(nodes);
  std::string deck = "*NODE\n", held = "*BOUNDARY\n";
  for_each_node(elements, [&](int node, double x, double y, bool at_x, bool at_y) {
    deck += fmt::format("{}, {}, {}, 0.\n", node, x, y);
    held += fmt::format("{0}, 1, 2\n{0}, 6\n", node);
    if (at_x || at_y) held += fmt::format("{}, 3\n", node);
    if (at_x) held += fmt::format("{}, 4\n", node);
    if (at_y) held += fmt::format("{}, 5\n", node);
  });
  if (type == "US3") deck += "*USER ELEMENT, TYPE=US3, NODES=3, INTEGRATION POINTS=3, MAXDOF=6\n";
  deck += fmt::format("*ELEMENT, TYPE={}, ELSET=ALL\n", type);
  int number = 0;
  for (const auto& e : elements) deck += fmt::format("{}, {}\n", ++number, fmt::join(e, ", "));
  deck += type == "US3" ? "*USER SECTION, ELSET=ALL, MATERIAL=M, CONSTANTS=1\n" : "*SHELL SECTION, ELSET=ALL, MATERIAL=M\n";
  deck += "0.1\n*MATERIAL, NAME=M\n*ELASTIC\n2.E11, 0.3\n*DENSITY\n8000.\n" + held + "*STEP\n*FREQUENCY\n6\n*END STEP\n";
  const TestFolder folder;
  folder.write("deck.inp", deck);
  return read_inp(folder.path() / "deck.inp").model;
}

TEST(ThickShells, OfAbaqusAndCalculix) {
  for (const auto& [type, nodes] : {std::pair("S4", 4), {"S4R", 4}, {"S3", 3}, {"US3", 3}, {"S8R", 8}, {"S6", 6}})
    expect_known_frequencies({"Abaqus, CalculiX", fmt::format("thick plate, {}", type), "Mindlin's plate", allowed},
                             frequencies(of_inp(type, nodes), 3), first_three_Hz(true));
  for (const auto& [type, nodes] : {std::pair("STRI3", 3), {"S4R5", 4}, {"S8R5", 8}, {"STRI65", 6}})
    expect_known_frequencies({"Abaqus", fmt::format("thick plate, {}", type), "Kirchhoff's plate", allowed},
                             frequencies(of_inp(type, nodes), 3), first_three_Hz(false));
}

// A set of both kinds has a section for each.
TEST(ThickShells, OneSetOfThickAndThin) {
  const TestFolder folder;
  folder.write("deck.inp",
               "*NODE\n1, 0., 0.\n2, 1., 0.\n3, 1., 1.\n4, 0., 1.\n5, 2., 0.\n*ELEMENT, TYPE=S4R, ELSET=ALL\n1, 1, 2, 3, 4\n"
               "*ELEMENT, TYPE=STRI3, ELSET=ALL\n2, 2, 5, 3\n*SHELL SECTION, ELSET=ALL, MATERIAL=M\n0.1\n"
               "*MATERIAL, NAME=M\n*ELASTIC\n2.E11, 0.3\n*DENSITY\n8000.\n*STEP\n*FREQUENCY\n6\n*END STEP\n");
  const fe::Model model = read_inp(folder.path() / "deck.inp").model;
  const auto ratio = [&](std::size_t e) {
    return model.sections.at(fe::slot(model.elements.at(e).section)).shear_thickness_ratio;
  };
  EXPECT_EQ(ratio(0), fe::homogeneous_shear_ratio);
  EXPECT_EQ(ratio(1), 0.0);
}

/// @param shear  fields 6 and 7 of PSHELL: MID3 and TS/T
fe::Model of_nastran(const std::string& card, int nodes, const std::string& shear) {
  const Elements elements = elements_of(nodes);
  std::string deck = "SOL 103\nCEND\nSPC = 1\nBEGIN BULK\nPARAM,COUPMASS,1\n";
  for_each_node(elements, [&](int node, double x, double y, bool at_x, bool at_y) {
    deck += fmt::format("GRID,{},,{:.6f},{:.6f},0.\nSPC1,1,126,{}\n", node, x, y, node);
    if (at_x || at_y) deck += fmt::format("SPC1,1,3{}{},{}\n", at_x ? "4" : "", at_y ? "5" : "", node);
  });
  int number = 0;
  for (const auto& e : elements) deck += fmt::format("{},{},1,{}\n", card, ++number, fmt::join(e, ","));
  const TestFolder folder;
  return import_deck(folder, deck + "PSHELL,1,1,0.1,1,," + shear + "\nMAT1,1,2.+11,,0.3,8000.\nMAT1,3,1.+11,,0.3,1.\nENDDATA\n")
      .model;
}

// Nastran's shells have no rotary inertia. MID3 blank is rigid in shear. A material of half the modulus with twice the
// thickness is the same shear stiffness.
TEST(ThickShells, OfNastranWhereMid3IsGiven) {
  for (const auto& [card, nodes] : {std::pair("CQUAD4", 4), {"CTRIA3", 3}}) {
    for (const char* shear : {"1", "3,1.6666667"})
      expect_known_frequencies({"Nastran", fmt::format("thick plate, {}, MID3 {}", card, shear), "Mindlin's plate", allowed},
                               frequencies(of_nastran(card, nodes, shear), 3), first_three_Hz(true, 0.0));
    expect_known_frequencies({"Nastran", fmt::format("thick plate, {}, no MID3", card), "Kirchhoff's plate", allowed},
                             frequencies(of_nastran(card, nodes, ""), 3), first_three_Hz(false, 0.0));
  }
  EXPECT_NEAR(of_nastran("CQUAD4", 4, "1").sections.at(0).shear_thickness_ratio, 0.8333333, 1e-6);
  EXPECT_EQ(of_nastran("CQUAD4", 4, "3").materials.size(), 1U);  // that of MID3 is not a material of the model
  EXPECT_THROW((void)of_nastran("CQUAD4", 4, "1,-1."), InputError);
}

// The folder that a deck is written to says what its shells are; formulation.shear_flexible = false makes all of them thin.
TEST(ThickShells, TheModelFolderCarriesIt) {
  const fe::Model model = of_inp("S4", 4);
  const TestFolder folder;
  write_model(model, folder.path() / "model");
  fe::Model again = read_model(folder.path() / "model");
  EXPECT_NEAR(again.sections.at(0).shear_thickness_ratio, 5.0 / 6.0, 1e-12);
  EXPECT_NEAR(frequencies(again, 1)[0] / frequencies(model, 1)[0], 1.0, 1e-9);
  again.formulation.shear_flexible = false;
  EXPECT_NEAR(frequencies(again, 1)[0] / first_three_Hz(false)[0], 1.0, allowed);
}

}  // namespace
}  // namespace twindeck::model_io::test::thick_shells
