/// Decks with known frequencies, each with its tolerance: 1 % for beams, springs and solids, 2 % for shells, or the reason why
/// not. Oracles: NAFEMS' problems FV2, FV4, FV16 (sources in tests/verification/test_nafems_vibration.cpp), closed forms
/// (Timoshenko's cantilever, masses on springs), and frequencies that Abaqus and CalculiX printed for public decks
/// (../shared/data/fe_decks, skipped where that folder is absent). Decks of Nastran and ANSYS by others:
/// test_nastran_decks.cpp, test_ansys_decks.cpp.
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>

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

void expect_known(const fs::path& file, const std::vector<double>& known_Hz, double tolerance) {
  const std::vector<double> ours = frequencies(read_deck(file), static_cast<int>(known_Hz.size()));
  ASSERT_GE(ours.size(), known_Hz.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < known_Hz.size(); ++i) {
    const double off = ours[i] / known_Hz[i] - 1.0;
    if (std::abs(off) > std::abs(worst)) worst = off;
    EXPECT_LE(std::abs(off), tolerance) << file.filename() << " mode " << i + 1 << ": " << ours[i] << " Hz, known "
                                        << known_Hz[i];
  }
  std::cout << fmt::format("{}: {} modes, largest deviation {:+.3f} %, asked {:g} %\n", file.filename().string(),
                           known_Hz.size(), 100.0 * worst, 100.0 * tolerance);
}

fs::path own(const std::string& name) { return fs::path(TWINDECK_SOURCE_DIR) / "tests/data/decks" / name; }

const std::vector<double> fv2_Hz = {11.336, 17.709, 17.709, 17.709, 17.709, 17.709, 17.709, 17.709,
                                    45.345, 57.390, 57.390, 57.390, 57.390, 57.390, 57.390, 57.390};
const std::vector<double> fv4_Hz = {1.723, 1.727, 7.413, 9.972, 18.155, 26.957};
const std::vector<double> fv16_Hz = {0.421, 1.029, 2.582, 3.306, 3.753, 6.555};
/// Timoshenko's beam of 10 m, 0.5 m square, E 200 GPa, G 100 GPa, 8000 kg/m3, clamped and free: his differential equation
/// solved for the zeros of its determinant. Every mode in both directions.
const std::vector<double> cantilever_Hz = {4.03187, 4.03187, 25.0236, 25.0236, 69.0137, 69.0137};

TEST(KnownDecks, AbaqusDoubleCrossOfEightInstances) { expect_known(own("fv2_instances.inp"), fv2_Hz, beams); }
TEST(KnownDecks, AbaqusCantileverOfTiedBlocks) { expect_known(own("tied_blocks.inp"), cantilever_Hz, solids); }
TEST(KnownDecks, AbaqusPlateOfTiedSheets) { expect_known(own("fv16_tied_sheets.inp"), fv16_Hz, shells); }

TEST(KnownDecks, NastranCantileverWithOffCentreMasses) { expect_known(own("fv4_masses.bdf"), fv4_Hz, beams); }
TEST(KnownDecks, NastranPlateOfQuadrilateralsAndTriangles) { expect_known(own("fv16_mixed.bdf"), fv16_Hz, shells); }
TEST(KnownDecks, NastranChainByDirectMatrices) {
  // 2 sqrt(k/m) sin(i pi / 12), k = 2 MN/m, m = 3 kg.
  expect_known(own("dmig_chain.bdf"), {67.266794, 129.949467, 183.776298, 225.079079, 251.043092}, 1e-6);
}
TEST(KnownDecks, NastranBodyOnSpringsByWeightedMean) {
  // Heave 4 k / m, roll k sum y² / Ix, pitch k sum x² / Iy: the mean of four corners hangs on the springs as a rigid plate
  // does.
  expect_known(own("rbe3_body.bdf"), {9.0031632, 12.9949467, 16.9765273}, 1e-6);
}

TEST(KnownDecks, AnsysDoubleCross) { expect_known(own("fv2_beam4.dat"), fv2_Hz, beams); }
TEST(KnownDecks, AnsysPlate) { expect_known(own("fv16_shell181.cdb"), fv16_Hz, shells); }
TEST(KnownDecks, AnsysCantileverOfSolids) { expect_known(own("cantilever_solid185.dat"), cantilever_Hz, solids); }

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
  expect_known(folder_ / "abaqus/frame_b31/frame_structure.inp", {3.3778, 5.2724, 13.487, 17.036, 30.252}, beams);
}
TEST_F(PublicInpDecks, AbaqusTruss) {
  // One B31 a member, whose mass Abaqus lumps: with a consistent mass our beams have bending modes of single members from 31 Hz
  // on, which such a mesh has not there. The TOML file beside the deck asks for lumped masses.
  const TestFolder folder;
  fs::copy_file(folder_ / "abaqus/truss_b31_general/simple_truss.inp", folder.path() / "simple_truss.inp");
  folder.write("simple_truss.toml", "[formulation]\nlumped_mass = true\n");
  expect_known(folder.path() / "simple_truss.inp", {28.838, 52.841, 68.662, 103.08, 117.53}, beams);
}
TEST_F(PublicInpDecks, CalculixCantilever) {
  // The second pair of the source is Euler's, which leaves out the shear of a beam ten depths long.
  expect_known(folder_ / "calculix/cantilever_b32/09_cantilever_frequency.inp", {835.528, 835.528}, beams);
}
TEST_F(PublicInpDecks, CalculixPipe) {
  expect_known(folder_ / "calculix/pipe_b32r/simplebeampipe3.inp", {15002.37, 15002.37, 93766.50, 93766.50}, beams);
  // The third pair is 1.3 % off: CalculiX' pipe has 1.5 to 2 times the shear stiffness of a thin tube (docs/my_model.md).
  expect_known(folder_ / "calculix/pipe_b32r/simplebeampipe3.inp", {15002.37, 15002.37, 93766.50, 93766.50, 261586.8, 261586.8},
               0.02);
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
  std::cout << fmt::format("boxprofile.inp against closed forms: {:+.3f}, {:+.3f}, torsion {:+.3f} %\n",
                           100.0 * (ours[0] / bending(weak) - 1.0), 100.0 * (ours[1] / bending(strong) - 1.0),
                           100.0 * (ours[4] / twist - 1.0));
}
TEST_F(PublicInpDecks, CalculixMassesOnSprings) {
  expect_known(folder_ / "calculix/two_mass_chain/MSM.inp", {3521.966, 9220.627}, 1e-6);
}
TEST_F(PublicInpDecks, CalculixSpringOnAnEquation) {
  expect_known(folder_ / "calculix/spring_equation/spring5.inp", {63711.56}, solids);
}
TEST_F(PublicInpDecks, QuadraticElementsAreRefusedWithAHint) {
  for (const char* deck : {"abaqus/unit_cube_c3d20rh/unit_cube_modes_h20.inp", "calculix/beam_c3d20r_mass/mass2.inp"}) {
    const std::string message = message_of([&] { (void)read_inp(folder_ / deck); });
    EXPECT_NE(message.find("has nodes between its corners"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace twindeck::model_io::test::known_decks
