/// Decks of others. Oracle: the frequencies printed with them (verification manual VM45, VM48, VM52: closed forms; a Workbench
/// model of a wing: the program's own), within 1 % for beams and springs and 2 % for shells.
#include <cstdlib>

#include "deck_table.hpp"
#include "dynamics/eigenmodes.hpp"
#include "fe/assembly.hpp"
#include "model_io/ansys.hpp"
#include "test_folder.hpp"
#include "test_places.hpp"

namespace twindeck::model_io::test::ansys_decks {
namespace {

class AnsysDecks : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("TWINDECK_DATA");
    folder_ = (data != nullptr ? std::filesystem::path(data) : std::filesystem::path(TWINDECK_SOURCE_DIR) / "../shared/data") /
              "fe_decks/ansys";
    if (!std::filesystem::is_directory(folder_)) GTEST_SKIP() << folder_ << " is not there";
  }

  void expect_frequencies(const std::string& file, const std::vector<double>& printed_Hz, double part,
                          const char* from = "ANSYS' verification manual", const std::string& remark = "") const {
    EXPECT_TRUE(is_ansys_deck(folder_ / file));
    const fe::Model model = read_ansys(folder_ / file).model;
    const fe::ParametricSystem system = fe::assemble(model, {});
    if (printed_Hz.front() > 0.0) fe::check_no_mechanism(system, {}, file);
    dynamics::ModalSolver solver(system);
    const dynamics::EigenModes modes = solver.solve_available({}, static_cast<int>(printed_Hz.size()));
    EXPECT_TRUE(modes.status.converged) << modes.status.message;
    const std::string name = std::filesystem::path(file).filename().string();
    expect_known_frequencies({"ANSYS", name, from, part, remark}, {modes.frequency_Hz.begin(), modes.frequency_Hz.end()},
                             printed_Hz);
  }

  std::filesystem::path folder_;
};

TEST_F(AnsysDecks, VerificationManual) {
  constexpr double as_printed = 1e-4;     // of five digits
  constexpr double rigid_by_hand = 5e-4;  // VM52's target takes its beams as rigid, which leaves out 0.02 %
  expect_frequencies("vm45/vm45.dat", {13.701}, as_printed);
  expect_frequencies("vm48/vm48.dat", {48.781}, as_printed);
  expect_frequencies("vm52/vm52.dat", {1.0981, 1.4406}, rigid_by_hand);
}

TEST_F(AnsysDecks, WingOfWorkbench) {
  expect_frequencies("wing_shell181_workbench/ds.dat",
                     {4.831841565, 25.32126036, 32.16734316, 38.08112367, 48.30384267, 53.52915597}, 0.02, "printed by ANSYS");
  const fe::Model model = read_ansys(folder_ / "wing_shell181_workbench/ds.dat").model;
  EXPECT_EQ(model.nodes.size(), 2100u);
  EXPECT_EQ(model.elements.size(), 2000u);
  EXPECT_EQ(model.supports.size(), 100u);
  EXPECT_EQ(model.supports.at(0).name, "_FIXEDSU");
}

TEST_F(AnsysDecks, HyperMeshArchiveIsReadWhole) {
  const fe::Model model = read_ansys(folder_ / "hypermesh_shell181/hypermesh.cdb").model;
  EXPECT_EQ(model.nodes.size(), 105u);
  EXPECT_EQ(model.elements.size(), 80u);
  EXPECT_EQ(model.elements.at(0).group, "PSHELL_1");
  EXPECT_TRUE(model.supports.empty());
  EXPECT_DOUBLE_EQ(model.materials.at(0).density_kg_m3, 2.57e-9);
}

constexpr double quadratic_solids = 0.01;

// Free at both ends. The values are those of the deck's own material, by another program's quadratic elements.
TEST_F(AnsysDecks, QuadraticSolidsOfAFreeBeam) {
  expect_frequencies("hexbeam_solid186/HexBeam.cdb", {0, 0, 0, 0, 0, 0, 185.4596, 185.4596, 285.6393, 434.3151, 434.3151},
                     quadratic_solids, "recomputed from the archive");
}

}  // namespace
}  // namespace twindeck::model_io::test::ansys_decks
