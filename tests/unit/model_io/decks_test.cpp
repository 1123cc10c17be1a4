/// Decks with known frequencies, each with its tolerance: 1 % for beams, springs and solids, 2 % for shells, or the reason why
/// not. Oracles: NAFEMS' problems FV2, FV4, FV16 (sources in tests/verification/nafems_vibration_test.cpp), closed forms
/// (Timoshenko's cantilever, masses on springs), and frequencies that Abaqus and CalculiX printed for public decks
/// (../shared/data/fe_decks, skipped where that folder is absent). Decks of Nastran and ANSYS by others:
/// nastran_decks_test.cpp, ansys_decks_test.cpp.
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "deck_table.hpp"
#include "model_io/ansys.hpp"
#include "model_io/inp.hpp"
#include "nastran_deck.hpp"
#include "test_places.hpp"

namespace twindeck::model_io::test::known_decks {
namespace {

namespace fs = std::filesystem;

constexpr double beams = 0.01, solids = 0.01, shells = 0.02;  // [-] asked of the import

fe::Model read_deck(const fs::path& file) {
  if (is_nastran_file(file)) return read_nastran(file).model;
  return is_ansys_deck(file) ? read_ansys(file).model : read_inp(file).model;
}

const char* const nafems = "NAFEMS";
const char* const timoshenko = "Timoshenko's beam";
const char* const closed_form = "closed form";
const char* const calculix = "printed by CalculiX";
const char* const abaqus = "printed by Abaqus";

/// `program` is who writes such decks.
void expect_known(const std::string& program, const fs::path& file, const std::vector<double>& known_Hz, double tolerance,
                  const char* from, const std::string& remark = "") {
  const std::vector<double> ours = frequencies(read_deck(file), static_cast<int>(known_Hz.size()));
  expect_known_frequencies({program, file.filename().string(), from, tolerance, remark}, ours, known_Hz);
}

fs::path own(const std::string& name) { return fs::path(TWINDECK_SOURCE_DIR) / "tests/data/decks" / name; }

const std::vector<double> fv2_Hz = {11.336, 17.709, 17.709, 17.709, 17.709, 17.709, 17.709, 17.709,
                                    45.345, 57.390, 57.390, 57.390, 57.390, 57.390, 57.390, 57.390};
const std::vector<double> fv4_Hz = {1.723, 1.727, 7.413, 9.972, 18.155, 26.957};
const std::vector<double> fv16_Hz = {0.421, 1.029, 2.582, 3.306, 3.753, 6.555};
/// Timoshenko's beam of 10 m, 0.5 m square, E 200 GPa, G 100 GPa, 8000 kg/m3, clamped and free: his differential equation
/// solved for the zeros of its determinant. Every mode in both directions.
const std::vector<double> cantilever_Hz = {4.03187, 4.03187, 25.0236, 25.0236, 69.0137, 69.0137};

/// Heave 4 k / m, roll 4 k y² / Ix, pitch 4 k x² / Iy: the mean of four corners hangs on the springs as a rigid plate does.
const std::vector<double> body_Hz = {9.0031632, 12.9949467, 16.9765273};
/// (2 n - 1) / (4 L) sqrt(M / rho), M = E (1 - nu) / ((1 + nu)(1 - 2 nu)): a rod of 10 m that is held across.
const std::vector<double> confined_rod_Hz = {145.02984, 435.08951, 725.14919};
constexpr double no_mesh = 1e-6;  // springs, masses and equations: nothing is discretised

TEST(KnownDecks, AbaqusDoubleCrossOfEightInstances) { expect_known("Abaqus", own("fv2_instances.inp"), fv2_Hz, beams, nafems); }
TEST(KnownDecks, AbaqusCantileverOfTiedBlocks) {
  expect_known("Abaqus", own("tied_blocks.inp"), cantilever_Hz, solids, timoshenko);
}
TEST(KnownDecks, AbaqusPlateOfTiedSheets) { expect_known("Abaqus", own("fv16_tied_sheets.inp"), fv16_Hz, shells, nafems); }
TEST(KnownDecks, AbaqusMassesOnAKinematicCoupling) { expect_known("Abaqus", own("fv4_coupling.inp"), fv4_Hz, beams, nafems); }
TEST(KnownDecks, AbaqusBodyOnADistributingCoupling) {
  expect_known("Abaqus", own("distributing_body.inp"), body_Hz, no_mesh, closed_form);
}
TEST(KnownDecks, AbaqusRodOfTetrahedra) { expect_known("Abaqus", own("rod_c3d4.inp"), confined_rod_Hz, solids, closed_form); }

TEST(KnownDecks, NastranCantileverWithOffCentreMasses) {
  expect_known("Nastran", own("fv4_masses.bdf"), fv4_Hz, beams, nafems);
}
TEST(KnownDecks, NastranPlateOfQuadrilateralsAndTriangles) {
  expect_known("Nastran", own("fv16_mixed.bdf"), fv16_Hz, shells, nafems);
}
TEST(KnownDecks, NastranDoubleCross) { expect_known("Nastran", own("fv2_cbeam.bdf"), fv2_Hz, beams, nafems); }
TEST(KnownDecks, NastranRodOfTetrahedra) {
  expect_known("Nastran", own("rod_ctetra.bdf"), confined_rod_Hz, solids, closed_form);
}
TEST(KnownDecks, NastranChainByDirectMatrices) {
  // 2 sqrt(k/m) sin(i pi / 12), k = 2 MN/m, m = 3 kg.
  expect_known("Nastran", own("dmig_chain.bdf"), {67.266794, 129.949467, 183.776298, 225.079079, 251.043092}, no_mesh,
               closed_form);
}
TEST(KnownDecks, NastranBodyOnSpringsByWeightedMean) {
  expect_known("Nastran", own("rbe3_body.bdf"), body_Hz, no_mesh, closed_form);
}

TEST(KnownDecks, AnsysDoubleCross) { expect_known("ANSYS", own("fv2_beam4.dat"), fv2_Hz, beams, nafems); }
TEST(KnownDecks, AnsysPlate) { expect_known("ANSYS", own("fv16_shell181.cdb"), fv16_Hz, shells, nafems); }
TEST(KnownDecks, AnsysPlateOfQuadrilateralsAndTriangles) {
  expect_known("ANSYS", own("fv16_mixed_shell63.dat"), fv16_Hz, shells, nafems);
}
TEST(KnownDecks, AnsysCantileverOfSolids) {
  expect_known("ANSYS", own("cantilever_solid185.dat"), cantilever_Hz, solids, timoshenko);
}
TEST(KnownDecks, AnsysMassesOnRigidRegions) { expect_known("ANSYS", own("fv4_cerig.dat"), fv4_Hz, beams, nafems); }
TEST(KnownDecks, AnsysBodyOnSpringsByEquations) { expect_known("ANSYS", own("body_by_ce.dat"), body_Hz, no_mesh, closed_form); }

/// Decks of others, beside the repository.
class PublicInpDecks : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("TWINDECK_DATA");
    folder_ = (data != nullptr ? fs::path(data) : fs::path(TWINDECK_SOURCE_DIR) / "../shared/data") / "fe_decks";
    if (!fs::is_directory(folder_)) GTEST_SKIP() << folder_ << " is not there";
  }
  fs::path folder_;
};

TEST_F(PublicInpDecks, AbaqusFrame) {
  expect_known("Abaqus", folder_ / "abaqus/frame_b31/frame_structure.inp", {3.3778, 5.2724, 13.487, 17.036, 30.252}, beams,
               abaqus);
}
TEST_F(PublicInpDecks, AbaqusTruss) {
  // One B31 a member, whose mass Abaqus lumps: with a consistent mass our beams have bending modes of single members from 31 Hz
  // on, which such a mesh has not there. The TOML file beside the deck asks for lumped masses.
  const TestFolder folder;
  fs::copy_file(folder_ / "abaqus/truss_b31_general/simple_truss.inp", folder.path() / "simple_truss.inp");
  folder.write("simple_truss.toml", "[formulation]\nlumped_mass = true\n");
  expect_known("Abaqus", folder.path() / "simple_truss.inp", {28.838, 52.841, 68.662, 103.08, 117.53}, beams, abaqus,
               "with lumped masses as Abaqus has them for B31");
}
TEST_F(PublicInpDecks, AbaqusTrussOnJointSprings) {
  // Its chords are of one B31 a member too.
  const TestFolder folder;
  fs::copy_file(folder_ / "abaqus/truss_joint_springs/simple_trussjointc.inp", folder.path() / "simple_trussjointc.inp");
  folder.write("simple_trussjointc.toml", "[formulation]\nlumped_mass = true\n");
  expect_known("Abaqus", folder.path() / "simple_trussjointc.inp", {16.009, 23.811, 27.750, 30.071, 31.071}, beams, abaqus,
               "with lumped masses as Abaqus has them for B31");
}
TEST_F(PublicInpDecks, CalculixCantilever) {
  // The second pair of the source is Euler's, which leaves out the shear of a beam ten depths long.
  expect_known("CalculiX", folder_ / "calculix/cantilever_b32/09_cantilever_frequency.inp", {835.528, 835.528}, beams,
               "Euler's beam");
}
TEST_F(PublicInpDecks, CalculixPipe) {
  const fs::path deck = folder_ / "calculix/pipe_b32r/simplebeampipe3.inp";
  const std::vector<double> printed = {15002.37, 15002.37, 93766.50, 93766.50, 261586.8, 261586.8};
  const std::vector<double> ours = frequencies(read_deck(deck), 6);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(ours.at(i) / printed[i], 1.0, beams);
  expect_known("CalculiX", deck, printed, 0.02, calculix,
               "third pair: CalculiX' pipe has 1.5 to 2 times the shear stiffness of a thin tube");
}
TEST_F(PublicInpDecks, CalculixBox) {
  // What CalculiX prints (33.934, 44.017 Hz, torsion 445.91 Hz) lies 1.3, 0.7 and 15 % above Euler's beam without shear and
  // Bredt's box, which no such box can exceed: it turns the beams into few solids. Those closed forms are the oracle here.
  const double a = 70e-3, b = 50e-3, t = 3e-3, length = 1.0, modulus = 7e10, density = 7850.0;
  const double area = a * b - (a - 2 * t) * (b - 2 * t);
  const double weak = (a * b * b * b - (a - 2 * t) * std::pow(b - 2 * t, 3)) / 12.0,
               strong = (b * a * a * a - (b - 2 * t) * std::pow(a - 2 * t, 3)) / 12.0;
  const double bredt = 2.0 * t * std::pow((a - t) * (b - t), 2) / (a + b - 2 * t);
  const auto bending = [&](double inertia) {
    return std::pow(1.8751040687 / length, 2) / (2.0 * std::numbers::pi) * std::sqrt(modulus * inertia / (density * area));
  };
  const double twist = std::sqrt(modulus / 2.6 * bredt / (density * (weak + strong))) / (4.0 * length);
  const std::vector<double> ours = frequencies(read_deck(folder_ / "calculix/box_b32r/boxprofile.inp"), 5);
  EXPECT_NEAR(ours[0] / bending(weak), 1.0, beams);
  EXPECT_NEAR(ours[1] / bending(strong), 1.0, beams);
  EXPECT_NEAR(ours[4] / twist, 1.0, beams);
  enter_in_deck_table({"CalculiX", "boxprofile.inp", "Euler's and Bredt's closed forms", beams,
                       "CalculiX prints 33.934, 44.017 and (torsion) 445.91 Hz: above what such a box can have"},
                      {ours[0], ours[1], ours[4]}, {bending(weak), bending(strong), twist});
}
TEST_F(PublicInpDecks, CalculixMassesOnSprings) {
  expect_known("CalculiX", folder_ / "calculix/two_mass_chain/MSM.inp", {3521.966, 9220.627}, no_mesh, closed_form);
}
TEST_F(PublicInpDecks, CalculixSpringOnAnEquation) {
  expect_known("CalculiX", folder_ / "calculix/spring_equation/spring5.inp", {63711.56}, solids, calculix);
}
TEST_F(PublicInpDecks, CalculixPlateOfTriangles) {
  // 45 x 25 x 1 m in 10 x 6 rectangles of two triangles each. Two per cent is what two shell elements differ by on so coarse a
  // mesh; the higher modes differ by more.
  expect_known("CalculiX", folder_ / "calculix/plate_tri_us3/freq_test.inp", {0.3971608, 1.575568, 2.516759}, shells, calculix,
               "without the fourth, 5.191 Hz here and 5.304 Hz in CalculiX: 5.055 Hz on 80 x 48 shells of four nodes");
}
TEST_F(PublicInpDecks, CalculixQuadraticSolidsWithAMass) {
  constexpr double quadratic_solids = 0.01;
  expect_known("CalculiX", folder_ / "calculix/beam_c3d20r_mass/mass2.inp", {197.6396, 293.4710}, quadratic_solids, calculix,
               "without the third, along the beam, 5.3 % higher: a mass thirty times the beam's hangs on one node, whose local "
               "softness is that of the points of integration, eight there and fourteen here");
}

}  // namespace
}  // namespace twindeck::model_io::test::known_decks
