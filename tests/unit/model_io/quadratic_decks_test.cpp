/// Elements with nodes in the middles of their edges, archives of ANSYS of 2023 and later, generated meshes and pipes. Oracle:
/// a square plate on four simple supports (Kirchhoff), Timoshenko's cantilever (as decks_test.cpp), Euler's cantilever; 1 % for
/// beams and solids, 2 % for shells.
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "deck_table.hpp"
#include "model_io/ansys.hpp"
#include "model_io/any_model_folder.hpp"
#include "model_io/inp.hpp"
#include "model_io/write_model.hpp"
#include "nastran_deck.hpp"

namespace twindeck::model_io::test::quadratic_decks {
namespace {

constexpr double solids = 0.01, beams = 0.01, shells = 0.02;  // [-] asked of the import
const std::string modes = "*STEP\n*FREQUENCY\n6\n*END STEP\n";

/// Nodes and elements of a mesh, numbers from 1.
struct Mesh {
  std::vector<std::array<double, 3>> nodes;
  std::vector<std::vector<int>> elements;

  int node_at(double x, double y, double z) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (std::abs(nodes[i][0] - x) + std::abs(nodes[i][1] - y) + std::abs(nodes[i][2] - z) < 1e-9)
        return static_cast<int>(i) + 1;
    nodes.push_back({x, y, z});
    return static_cast<int>(nodes.size());
  }
};

/// n × n shells of eight nodes (or twice as many of six) over the unit square.
Mesh plate(int n, bool triangles) {
  Mesh mesh;
  const double h = 1.0 / n;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto at = [&](double a, double b) { return mesh.node_at(h * (i + a), h * (j + b), 0.0); };
      if (!triangles) {
        mesh.elements.push_back({at(0, 0), at(1, 0), at(1, 1), at(0, 1), at(.5, 0), at(1, .5), at(.5, 1), at(0, .5)});
      } else {
        mesh.elements.push_back({at(0, 0), at(1, 0), at(1, 1), at(.5, 0), at(1, .5), at(.5, .5)});
        mesh.elements.push_back({at(0, 0), at(1, 1), at(0, 1), at(.5, .5), at(.5, 1), at(0, .5)});
      }
    }
  return mesh;
}

/// A beam of 10 m, 0.5 m square, in ten hexahedra of twenty nodes, in the order of Abaqus and ANSYS.
Mesh solid_beam() {
  constexpr std::array<std::array<double, 3>, 20> place = {
      {{0, 0, 0},  {1, 0, 0},  {1, 1, 0},  {0, 1, 0},  {0, 0, 1},  {1, 0, 1},  {1, 1, 1},  {0, 1, 1},  {.5, 0, 0}, {1, .5, 0},
       {.5, 1, 0}, {0, .5, 0}, {.5, 0, 1}, {1, .5, 1}, {.5, 1, 1}, {0, .5, 1}, {0, 0, .5}, {1, 0, .5}, {1, 1, .5}, {0, 1, .5}}};
  Mesh mesh;
  for (int i = 0; i < 10; ++i) {
    std::vector<int> nodes;
    for (const auto& p : place) nodes.push_back(mesh.node_at(i + p[0], 0.5 * p[1], 0.5 * p[2]));
    mesh.elements.push_back(nodes);
  }
  return mesh;
}

/// Six tetrahedra of ten nodes about the diagonal of each hexahedron of such a mesh.
Mesh tetrahedra_of(const Mesh& hexahedra) {
  constexpr std::array<std::array<std::size_t, 2>, 6> between = {{{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}}},
                                                      edges = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  Mesh mesh;
  for (const std::vector<int>& h : hexahedra.elements)
    for (const auto& [b, c] : between) {
      std::array<std::array<double, 3>, 4> x{};
      for (std::size_t i = 0; i < 4; ++i)
        x[i] = hexahedra.nodes[static_cast<std::size_t>(h[std::array{std::size_t{0}, b, c, std::size_t{6}}[i]]) - 1];
      std::vector<int> nodes;
      for (const auto& corner : x) nodes.push_back(mesh.node_at(corner[0], corner[1], corner[2]));
      for (const auto& [i, j] : edges)
        nodes.push_back(mesh.node_at(0.5 * (x[i][0] + x[j][0]), 0.5 * (x[i][1] + x[j][1]), 0.5 * (x[i][2] + x[j][2])));
      mesh.elements.push_back(nodes);
    }
  return mesh;
}

/// The mesh pushed out of shape, so that no two edges are alike; four digits behind the point, as the cards have them.
Mesh crooked(Mesh mesh) {
  for (auto& x : mesh.nodes) {
    const auto [a, b, c] = x;
    x = {a * (1.0 + 0.1 * b - 0.15 * c), b * (1.0 + 0.03 * a) + 0.05 * c, c * (1.0 - 0.02 * a) + 0.1 * b * b};
    for (double& at : x) at = std::round(1e4 * at) / 1e4;
  }
  return mesh;
}

const double plate_Hz = std::numbers::pi * std::sqrt(200e9 * 1e-6 / (12.0 * (1.0 - 0.09)) / (8000.0 * 0.01));
/// Timoshenko's cantilever, as in decks_test.cpp: 0.5 m square, E 200 GPa, G 100 GPa.
const std::vector<double> cantilever_Hz = {4.03187, 4.03187, 25.0236, 25.0236};

bool on_edge(const std::array<double, 3>& x) { return x[0] < 1e-9 || x[1] < 1e-9 || x[0] > 1 - 1e-9 || x[1] > 1 - 1e-9; }

std::string inp_deck(const Mesh& mesh, const std::string& type, bool shell) {
  std::string deck = "*NODE\n";
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    deck += fmt::format("{}, {}, {}, {}\n", i + 1, mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2]);
  deck += fmt::format("*ELEMENT, TYPE={}, ELSET=ALL\n", type);
  for (std::size_t i = 0; i < mesh.elements.size(); ++i) {
    deck += fmt::format("{}", i + 1);
    for (std::size_t k = 0; k < mesh.elements[i].size(); ++k)
      deck += fmt::format("{}{}", k == 12 ? ",\n" : ", ", mesh.elements[i][k]);
    deck += "\n";
  }
  deck += shell ? "*SHELL SECTION, ELSET=ALL, MATERIAL=M\n0.01\n" : "*SOLID SECTION, ELSET=ALL, MATERIAL=M\n";
  deck += fmt::format("*MATERIAL, NAME=M\n*ELASTIC\n2.E11, {}\n*DENSITY\n8000.\n*BOUNDARY\n", shell ? 0.3 : 0.0);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    if (shell && on_edge(mesh.nodes[i])) deck += fmt::format("{}, 3\n", i + 1);
    if (!shell && mesh.nodes[i][0] == 0.0) deck += fmt::format("{}, 1, 3\n", i + 1);
  }
  return deck + (shell ? "1, 1, 2\n2, 2\n" : "") + modes;
}

std::vector<double> of_inp(const std::string& deck, int n) {
  const TestFolder folder;
  folder.write("deck.inp", deck);
  return frequencies(read_inp(folder.path() / "deck.inp").model, n);
}

std::vector<double> of_ansys(const std::string& deck, int n) {
  const TestFolder folder;
  folder.write("deck.dat", deck);
  return frequencies(read_ansys(folder.path() / "deck.dat").model, n);
}

TEST(QuadraticDecks, AbaqusAndCalculixPlatesAndSolids) {
  expect_known_frequencies({"Abaqus, CalculiX", "plate_s8r", "closed form", shells},
                           of_inp(inp_deck(plate(4, false), "S8R", true), 1), {plate_Hz});
  expect_known_frequencies({"Abaqus, CalculiX", "plate_stri65", "closed form", shells},
                           of_inp(inp_deck(plate(4, true), "STRI65", true), 1), {plate_Hz});
  expect_known_frequencies({"Abaqus, CalculiX", "cantilever_c3d20r", "Timoshenko's beam", solids},
                           of_inp(inp_deck(solid_beam(), "C3D20R", false), 4), cantilever_Hz);
}

// C3D10 of six a box about its diagonal.
TEST(QuadraticDecks, AbaqusAndCalculixTetrahedra) {
  expect_known_frequencies({"Abaqus, CalculiX", "cantilever_c3d10", "Timoshenko's beam", solids},
                           of_inp(inp_deck(tetrahedra_of(solid_beam()), "C3D10", false), 4), cantilever_Hz);
}

TEST(QuadraticDecks, SolidsStayAsTheyAre) {
  const TestFolder folder;
  folder.write("deck.inp", inp_deck(solid_beam(), "C3D20", false));
  const fe::Model model = read_inp(folder.path() / "deck.inp").model;
  EXPECT_EQ(model.elements.size(), 10u);
  EXPECT_EQ(model.nodes.size(), solid_beam().nodes.size());
}

std::string nastran_deck(const Mesh& mesh, bool shell) {
  std::string deck = "SOL 103\nCEND\nSPC = 1\nBEGIN BULK\nEIGRL,1,,,6\nPARAM,COUPMASS,1\n";
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    deck += fmt::format("GRID,{},,{:.4f},{:.4f},{:.4f}\n", i + 1, mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2]);
  for (std::size_t i = 0; i < mesh.elements.size(); ++i) {
    std::vector<int> nodes = mesh.elements[i];
    // Nastran has the edges between bottom and top before those of the top.
    if (nodes.size() == 20) std::rotate(nodes.begin() + 12, nodes.begin() + 16, nodes.end());
    const std::map<std::size_t, const char*> names = {{20, "CHEXA"}, {10, "CTETRA"}, {8, "CQUAD8"}, {6, "CTRIA6"}};
    deck += fmt::format("{},{},1", names.at(nodes.size()), i + 1);
    for (std::size_t k = 0; k < nodes.size(); ++k) deck += fmt::format("{},{}", k == 6 || k == 14 ? "\n" : "", nodes[k]);
    deck += "\n";
  }
  deck += shell ? "PSHELL,1,1,0.01,1\nMAT1,1,2.+11,,0.3,8000.\n" : "PSOLID,1,1\nMAT1,1,2.+11,,0.,8000.\n";
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    if (shell && on_edge(mesh.nodes[i])) deck += fmt::format("SPC1,1,3,{}\n", i + 1);
    if (!shell && mesh.nodes[i][0] == 0.0) deck += fmt::format("SPC1,1,123,{}\n", i + 1);
  }
  return deck + (shell ? "SPC1,1,12,1\nSPC1,1,2,2\n" : "") + "ENDDATA\n";
}

TEST(QuadraticDecks, NastranPlatesAndSolids) {
  const TestFolder folder;
  const auto of = [&](const Mesh& mesh, bool shell, int n) {
    return frequencies(import_deck(folder, nastran_deck(mesh, shell)).model, n);
  };
  expect_known_frequencies({"Nastran", "plate_cquad8", "closed form", shells}, of(plate(4, false), true, 1), {plate_Hz});
  expect_known_frequencies({"Nastran", "plate_ctria6", "closed form", shells}, of(plate(4, true), true, 1), {plate_Hz});
  expect_known_frequencies({"Nastran", "cantilever_chexa20", "Timoshenko's beam", solids}, of(solid_beam(), false, 4),
                           cantilever_Hz);
}

std::string ansys_deck(const Mesh& mesh, bool shell) {
  std::string deck = shell ? "/PREP7\nET,1,SHELL281\nSECTYPE,1,SHELL\nSECDATA,0.01\nMP,PRXY,1,0.3\n"
                           : fmt::format("/PREP7\nET,1,SOLID{}\nMP,PRXY,1,0\n", mesh.elements.front().size() == 10 ? 187 : 186);
  deck += "MP,EX,1,2E11\nMP,DENS,1,8000\n";
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    deck += fmt::format("N,{},{},{},{}\n", i + 1, mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2]);
  for (const std::vector<int>& nodes : mesh.elements) {
    for (std::size_t k = 0; k < nodes.size(); ++k)
      deck += fmt::format("{},{}", k == 0 ? "E" : k % 8 == 0 ? "\nEMORE" : "", nodes[k]);
    deck += "\n";
  }
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    if (shell && on_edge(mesh.nodes[i])) deck += fmt::format("D,{},UZ\n", i + 1);
    if (!shell && mesh.nodes[i][0] == 0.0) deck += fmt::format("D,{},ALL\n", i + 1);
  }
  return deck + (shell ? "D,1,UX,,,,,UY\nD,2,UY\n" : "") + "FINISH\n/SOLU\nANTYPE,MODAL\nSOLVE\n";
}

TEST(QuadraticDecks, NastranAndAnsysTetrahedra) {
  const TestFolder folder;
  const Mesh mesh = tetrahedra_of(solid_beam());
  expect_known_frequencies({"Nastran", "cantilever_ctetra10", "Timoshenko's beam", solids},
                           frequencies(import_deck(folder, nastran_deck(mesh, false)).model, 4), cantilever_Hz);
  expect_known_frequencies({"ANSYS", "cantilever_solid187", "Timoshenko's beam", solids}, of_ansys(ansys_deck(mesh, false), 4),
                           cantilever_Hz);
}

TEST(QuadraticDecks, AnsysPlatesAndSolids) {
  expect_known_frequencies({"ANSYS", "plate_shell281", "closed form", shells}, of_ansys(ansys_deck(plate(4, false), true), 1),
                           {plate_Hz});
  expect_known_frequencies({"ANSYS", "cantilever_solid186", "Timoshenko's beam", solids},
                           of_ansys(ansys_deck(solid_beam(), false), 4), cantilever_Hz);
}

/// The tetrahedron that SOLID186 writes as a hexahedron of repeated nodes.
std::vector<int> as_hexahedron(const std::vector<int>& t) {
  return {t[0], t[1], t[2], t[2], t[3], t[3], t[3], t[3], t[4], t[5],
          t[2], t[6], t[3], t[3], t[3], t[3], t[7], t[8], t[9], t[9]};
}

// One crooked brick of two elements: whichever dialect writes it, and from a model folder, it is one model to the last digits.
TEST(QuadraticDecks, OneBrickInEveryDialect) {
  Mesh beam = solid_beam();
  beam.elements.resize(2);
  beam.nodes.resize(32);  // of the first two elements
  for (const bool tetrahedra : {false, true}) {
    const Mesh brick = crooked(tetrahedra ? tetrahedra_of(beam) : beam);
    const TestFolder folder;
    folder.write("deck.inp", inp_deck(brick, tetrahedra ? "C3D10" : "C3D20", false));
    const fe::Model model = read_inp(folder.path() / "deck.inp").model;
    std::filesystem::create_directories(folder.path() / "model");
    write_model(model, folder.path() / "model");
    (void)write_inp(model, {}, InpFlavour::calculix, 6, folder.path() / "again.inp");
    const std::vector<double> known = frequencies(model, 6);
    // The decks of ANSYS come last: they are read in this test's folder too, which is empty then.
    std::vector<std::vector<double>> others = {
        frequencies(read_model(folder.path() / "model"), 6), frequencies(read_inp(folder.path() / "again.inp").model, 6),
        frequencies(import_deck(folder, nastran_deck(brick, false)).model, 6), of_ansys(ansys_deck(brick, false), 6)};
    if (tetrahedra) {
      Mesh written = brick;
      for (std::vector<int>& nodes : written.elements) nodes = as_hexahedron(nodes);
      others.push_back(of_ansys(ansys_deck(written, false), 6));
    }
    for (const std::vector<double>& found : others)
      for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(found.at(i), known.at(i), 1e-8 * known.at(i)) << tetrahedra << i;
  }
}

// A pressure of 12 on the unit square of eight nodes: -1/12 of it at each corner, 1/3 at each middle of an edge. On a triangle
// of six nodes: nothing at the corners, a third at each middle.
TEST(QuadraticDecks, PressureOnAFaceGoesToItsNodes) {
  Mesh beam = solid_beam();
  beam.elements.resize(1);
  beam.nodes.resize(20);
  const auto loads = [](const Mesh& mesh, const std::string& type, const std::string& face) {
    std::string deck = inp_deck(mesh, type, false);
    deck = deck.substr(0, deck.find("*STEP")) + "*STEP, NLGEOM\n*STATIC\n*DLOAD\n1, " + face + ", 12.\n*END STEP\n" + modes;
    const TestFolder folder;
    folder.write("deck.inp", deck);
    std::map<int, double> z;  // by node, times the area of 0.5 m2
    for (const fe::Prestress::Load& load : read_inp(folder.path() / "deck.inp").model.prestress.loads)
      if (load.direction == 2) z[load.node] = load.value / 0.5;
    return z;
  };
  const auto of_square = loads(beam, "C3D20R", "P2");  // the top, of nodes 5 to 8 and 13 to 16
  ASSERT_EQ(of_square.size(), 8u);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(of_square.at(4 + i), 1.0, 1e-12);
    EXPECT_NEAR(of_square.at(12 + i), -4.0, 1e-12);
  }
  Mesh one = tetrahedra_of(beam);
  one.elements = {one.elements[0]};  // 1-2-3 is half of the bottom
  double sum = 0.0;
  for (const auto& [node, value] : loads(one, "C3D10", "P1")) {
    EXPECT_TRUE(std::abs(value) < 1e-12 || std::abs(value - 2.0) < 1e-12) << node << " " << value;
    sum += value;
  }
  EXPECT_NEAR(sum, 6.0, 1e-12);
}

/// Euler's cantilever [Hz], first two modes.
std::vector<double> euler(double stiffness, double mass_per_m, double length) {
  std::vector<double> f;
  for (const double beta : {1.87510407, 4.69409113})
    f.push_back(beta * beta / (2.0 * std::numbers::pi * length * length) * std::sqrt(stiffness / mass_per_m));
  return f;
}

TEST(QuadraticDecks, AnsysBeamsWithAMiddleNodePipesAndGeneratedMeshes) {
  // 2 m, 20 × 10 mm.
  const std::string material = "MP,EX,1,2.1E11\nMP,PRXY,1,0.3\nMP,DENS,1,7850\n",
                    end = "D,1,ALL\nD,ALL,UZ\nFINISH\n/SOLU\nSOLVE\n";
  const std::string beam189 = "/PREP7\nET,1,BEAM189\nSECTYPE,1,BEAM,RECT\nSECDATA,0.01,0.02\n" + material +
                              "N,1\nN,11,2\nFILL,1,11\nE,1,3,2\nEGEN,5,2,1\n" + end;
  const double area = 2e-4;
  expect_known_frequencies({"ANSYS", "beam189_fill_egen", "Euler's beam", beams}, of_ansys(beam189, 2),
                           euler(2.1e11 * 0.02 * 1e-6 / 12.0, 7850.0 * area, 2.0));
  const double outer = 0.06, inner = 0.05, pi = std::numbers::pi;
  const double pipe_area = pi / 4.0 * (outer * outer - inner * inner),
               inertia = pi / 64.0 * (std::pow(outer, 4) - std::pow(inner, 4));
  const std::string pipe288 = "/PREP7\nET,1,PIPE288\nKEYOPT,1,3,3\nSECTYPE,1,PIPE\nSECDATA,0.06,0.005\n" + material +
                              "N,1\nNGEN,21,1,1,,,0.2\nE,1,2\nEGEN,20,1,-1\n" + end;
  expect_known_frequencies({"ANSYS", "pipe288_ngen_egen", "Euler's beam", beams}, of_ansys(pipe288, 2),
                           euler(2.1e11 * inertia, 7850.0 * pipe_area, 4.0));
  const std::string pipe16 =
      "/PREP7\nET,1,PIPE16\nR,1,0.06,0.005\n" + material + "N,1\nNGEN,21,1,1,,,0.2\nE,1,2\nEGEN,20,1,-1\n" + end;
  expect_known_frequencies({"ANSYS", "pipe16_ngen_egen", "Euler's beam", beams}, of_ansys(pipe16, 2),
                           euler(2.1e11 * inertia, 7850.0 * pipe_area, 4.0));
}

/// The archive of a cantilever of ten BEAM188, 1 m, 20 × 10 mm, in the words of several versions.
std::string archive(const std::string& types, const std::string& end_of_nodes, const std::string& more) {
  std::string deck = "/COM,ANSYS RELEASE 2023 R1\n/PREP7\n" + types + "NBLOCK,6,SOLID,12,12\n(3i9,6e21.13e3)\n";
  for (int i = 0; i <= 10; ++i)
    deck += fmt::format("{:9}{:9}{:9}{:21.13E}{:21.13E}{:21.13E}\n", i + 1, 0, 0, 0.1 * i, 0.0, 0.0);
  deck += fmt::format("{:9}{:9}{:9}{:21.13E}{:21.13E}{:21.13E}\n", 12, 0, 0, 0.5, 0.0, 1.0) + end_of_nodes;
  deck += "EBLOCK,19,SOLID,10,10\n(19i9)\n";
  for (int i = 1; i <= 10; ++i)
    deck += fmt::format("{:9}{:9}{:9}{:9}{:9}{:9}{:9}{:9}{:9}{:9}{:9}{:9}{:9}{:9}\n", 1, 1, 1, 1, 0, 0, 0, 0, 3, 0, i, i, i + 1,
                        12);
  return deck + "       -1\n" + more +
         "MPDATA,R5.0, 1,EX  ,1, 1,2.1E11\nMPDATA,R5.0, 1,NUXY,1, 1,0.3\nMPDATA,R5.0, 1,DENS,1, 1,7850.\n"
         "SECTYPE,1,BEAM,RECT\nSECDATA,0.02,0.01\nD,1,ALL\n/GO\nFINISH\n";
}

TEST(QuadraticDecks, AnsysArchivesOf2023AndCommandsWithoutMeaningForModes) {
  const std::string old_types = "ET,1,188\nKEYOP,1,3,3\n",
                    block =
                        "ETBLOCK,        1,        1\n(2i9,19a9)\n        1      188        0        0        3\n       -1\n";
  const std::string end = "N,R5.3,LOC,       -1,\n";
  const std::vector<double> known = {8.355, 16.71, 52.36};
  const auto expect = [&](const std::string& name, const std::string& deck) {
    expect_known_frequencies({"ANSYS", name, "Timoshenko's beam", beams}, of_ansys(deck, 3), known);
  };
  expect("archive_et", archive(old_types, end, ""));
  expect("archive_etblock", archive(block, end, ""));
  expect("archive_unbl", archive(block, "N,UNBL,LOC,       -1,\n", ""));
  expect("archive_crplim_jpgprf", archive(block, end, "CRPLIM, 0.100000000    ,   0\nJPGPRF,500,100,1\nPNGR,COMP,1,-1\n"));
  const TestFolder folder;
  folder.write("deck.cdb", archive(block, end, "CRPLIM,0.1,0\n"));
  const auto notes = read_ansys(folder.path() / "deck.cdb").notes;
  EXPECT_TRUE(
      std::any_of(notes.begin(), notes.end(), [](const std::string& n) { return n.find("CRPLIM") != std::string::npos; }));
}

}  // namespace
}  // namespace twindeck::model_io::test::quadratic_decks
