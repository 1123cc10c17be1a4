// Oracles: the published Storebaelt derivatives (IABSE TG 3.1) in both conventions; the files themselves; each kind of mistake
// in a derivative file is refused with the words a user needs.
#include "aero/files/aero_data.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "aero/derivative_table.hpp"
#include "aero/laws.hpp"
#include "core/error.hpp"
#include "test_places.hpp"
#include "unit/records/scratch.hpp"

namespace {

using namespace twindeck;

class AeroFiles : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path write(const std::string& text) const { return scratch_.write("aero.csv", text); }
  void expect_refused(const std::filesystem::path& file, const std::string& words) {
    try {
      const auto table = aero::read_flutter_derivatives(file);
      ADD_FAILURE() << "was read";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
  const records::Scratch scratch_;
  const std::string zasso = "h1,h2,h3,h4,h5,h6,p1,p2,p3,p4,p5,p6,a1,a2,a3,a4,a5,a6\n";
  const std::string ones = ",1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1\n";
};

TEST_F(AeroFiles, UnnamedReducedVelocityIsRefused) {
  expect_refused(write("V_red," + zasso + "2" + ones), "does not say which reduced velocity");
  expect_refused(write("V_over_fB,V_over_omegaB," + zasso + "2,1" + ones), "stands beside V_over_omegaB");
  expect_refused(write("x," + zasso + "2" + ones), "is missing, and so is V_over_omegaB");
}

TEST_F(AeroFiles, GridConventionAndSignsAreChecked) {
  expect_refused(write("V_over_fB,h1\n2,1\n"), "all eighteen");
  expect_refused(write("alpha_deg,V_over_fB," + zasso + "0,2" + ones + "0,3" + ones + "1,2" + ones), "not a full grid");
  expect_refused(write("V_over_fB," + zasso + "-2" + ones), "is not positive");
  expect_refused(write("V_over_fB," + zasso + "2" + ones + "2" + ones), "stands twice");
}

TEST_F(AeroFiles, NoExtrapolationUnlessAsked) {
  const auto file = write("V_over_fB," + zasso + "2" + ones + "4" + ones);
  const double low = 1.0 / (2 * std::numbers::pi), high = 5.0 / (2 * std::numbers::pi);
  const auto strict = aero::read_flutter_derivatives(file);
  for (const double v : {low, high}) {
    try {
      const auto block = strict.at(0.0, v);
      ADD_FAILURE() << "extrapolated to " << block.damping(0, 0);
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("V/(f B) 2 to 4"), std::string::npos) << error.what();
    }
  }
  const auto held = aero::read_flutter_derivatives(file, aero::OutOfRange::hold, aero::OutOfRange::hold);
  EXPECT_NEAR(aero::from_block(aero::Convention::zasso, held.at(0.0, high), high)[0], 1.0, 1e-14);
  EXPECT_NEAR(aero::from_block(aero::Convention::zasso, held.at(0.0, low), low)[2], 1.0, 1e-14);
}

TEST_F(AeroFiles, BothPublishedConventionsGiveTheSameBlock) {
  const std::filesystem::path folder = std::filesystem::path(TWINDECK_SOURCE_DIR) / "tests/data/wind";
  const aero::DerivativeTable first = aero::read_flutter_derivatives(folder / "storebaelt_zasso.csv");
  const aero::DerivativeTable second = aero::read_flutter_derivatives(folder / "storebaelt_scanlan.csv");
  for (const double v : {0.795775, 1.591549, 2.387324, 3.183099, 3.978874, 4.774648, 5.570423}) {
    const aero::DerivativeBlock a = first.at(0.0, v), b = second.at(0.0, v);
    // Zasso's values have three decimals, which V* or V*² multiplies; both files were rounded, so twice half a digit.
    const double allowed = 1e-3 * std::max(1.0, v * v);
    EXPECT_LT((a.damping - b.damping).cwiseAbs().maxCoeff(), allowed) << v;
    EXPECT_LT((a.stiffness - b.stiffness).cwiseAbs().maxCoeff(), allowed) << v;
  }
}

TEST_F(AeroFiles, SlopesAreDifferencedWhereTheyAreMissing) {
  // C_L = 2 alpha + 0.1 in radians: differences of a line are its slope everywhere.
  const double degree = std::numbers::pi / 180;
  std::string text = "alpha_deg,C_D,C_L,C_M\n";
  for (int a = -2; a <= 2; ++a) text += std::to_string(a) + ",0.5," + std::to_string(0.1 + 2 * a * degree) + ",0\n";
  const aero::Polar polar = aero::read_polar(write(text));
  for (const double a : {-2.0, -0.3, 0.0, 1.9}) EXPECT_NEAR(polar.at(a * degree).lift_slope, 2.0, 1e-4);
  EXPECT_THROW(static_cast<void>(polar.at(3 * degree)), InputError);
}

TEST_F(AeroFiles, TheStandInSetIsConsistent) {
  // Quasi-steady limits tie the flutter table's last row to the polar: h3 = C_L', a3 = C_M', p5 = 2 C_D, h5 = 2 C_L.
  const std::filesystem::path folder = std::filesystem::path(TWINDECK_SOURCE_DIR) / "data/ponte_del_mare/aero";
  for (const std::string deck : {"foot", "cycle"}) {
    const auto table = aero::read_flutter_derivatives(folder / (deck + "_flutter.csv"));
    const auto polar = aero::read_polar(folder / (deck + "_polar.csv"));
    const double v = 40 / (2 * std::numbers::pi);
    const auto d = aero::from_block(aero::Convention::zasso, table.at(0.0, v), v);
    const auto c = polar.at(0.0);
    EXPECT_NEAR(d[2], c.lift_slope, 1e-3 * std::abs(c.lift_slope));
    EXPECT_NEAR(d[14], c.moment_slope, 1e-6);
    EXPECT_NEAR(d[10], 2 * c.drag, 1e-6);
    EXPECT_NEAR(d[4], 2 * c.lift, 1e-6);
    EXPECT_TRUE(aero::broken_laws(polar, table, {}).empty());
  }
}

}  // namespace
