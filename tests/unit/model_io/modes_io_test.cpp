/// Oracles: identity for the round trip, the scaling rule of the contract (largest component +1, damping in per cent),
/// refusals.
#include "model_io/modes_io.hpp"

#include <cmath>

#include "test_folder.hpp"

namespace twindeck::model_io::test {
namespace {

modal::ModeSet two_modes(std::complex<double> rotation) {
  modal::ModeSet modes;
  const double unknown = std::nan("");
  modes.names = {"1", "2X"};
  modes.frequency_Hz = Eigen::Vector2d(0.681, 1.003);
  modes.frequency_std_Hz = Eigen::Vector2d(0.002, unknown);
  modes.damping_ratio = Eigen::Vector2d(0.015, unknown);
  modes.damping_ratio_std = Eigen::Vector2d(unknown, unknown);
  modes.dofs = {{"7", "x"}, {"7", "z"}, {"9", "z"}};
  modes.shapes.resize(3, 2);
  modes.shapes << 0.5, 1.0, -2.0, 0.25, 1.0, -0.5;
  modes.shapes.col(0) *= rotation;
  return modes;
}

TEST(ModesIo, RoundTripWithLargestComponentOne) {
  const TestFolder folder;
  write_modes(two_modes(1.0), folder.path());
  EXPECT_TRUE(
      folder.read("modes.csv")
          .starts_with(
              "mode,frequency_Hz,frequency_std_Hz,damping_ratio_pct,damping_ratio_std_pct\n1,0.681,0.002,1.5,\n2X,1.003,,,\n"));
  EXPECT_TRUE(
      folder.read("shapes.csv").starts_with("mode,point,direction,value\n1,7,x,-0.25\n1,7,z,1\n1,9,z,-0.5\n2X,7,x,1\n"));
  const modal::ModeSet back = read_modes(folder.path());
  const modal::ModeSet sent = two_modes(1.0);
  EXPECT_EQ(back.names, sent.names);
  EXPECT_EQ(back.dofs, sent.dofs);
  EXPECT_EQ(back.frequency_Hz, sent.frequency_Hz);
  EXPECT_TRUE(std::isnan(back.frequency_std_Hz[1]));
  EXPECT_DOUBLE_EQ(back.damping_ratio[0], 0.015);
  EXPECT_NEAR((back.shapes.col(0) * -2.0 - sent.shapes.col(0)).norm(), 0.0, 1e-11);
}

TEST(ModesIo, ComplexShapesKeepTheirPhasesButNotTheirCommonOne) {
  // Oracle: a shape turned by a common phase is the same shape; a true phase between two points stays.
  const TestFolder folder;
  modal::ModeSet sent = two_modes(std::polar(1.0, 0.7));
  sent.shapes(0, 1) = std::complex<double>(0.0, 0.3);
  sent.shapes(1, 1) = std::complex<double>(0.0, 3.0);
  write_modes(sent, folder.path());
  EXPECT_TRUE(folder.read("shapes.csv").starts_with("mode,point,direction,value,value_imag\n"));
  const modal::ModeSet back = read_modes(folder.path());
  EXPECT_NEAR(std::abs(back.shapes(0, 0) - std::complex<double>(-0.25, 0.0)), 0.0, 1e-12);
  EXPECT_NEAR(std::abs(back.shapes(2, 1) - std::complex<double>(0.0, 0.5 / 3.0)), 0.0, 1e-12);
}

TEST(ModesIo, ShapesMayBeMissing) {
  const TestFolder folder;
  folder.write("modes.csv", "mode,frequency_Hz,comment\n1,0.681,first\n");
  const modal::ModeSet modes = read_modes(folder.path());
  EXPECT_FALSE(modes.has_shapes());
  EXPECT_EQ(modes.size(), 1);
}

TEST(ModesIo, RefusesWhatDoesNotFitTogether) {
  const TestFolder folder;
  const auto refused = [&](const std::string& file, const std::string& from, const std::string& to) {
    write_modes(two_modes(1.0), folder.path());
    folder.edit(file, from, to);
    return message_of([&] { (void)read_modes(folder.path()); });
  };
  EXPECT_NE(refused("modes.csv", "2X,", "1,").find("modes.csv:3: mode: mode '1' appears twice"), std::string::npos);
  EXPECT_NE(refused("modes.csv", "0.681", "-0.681").find("modes.csv:2: frequency_Hz"), std::string::npos);
  EXPECT_NE(refused("shapes.csv", "2X,7,x,", "3X,7,x,").find("shapes.csv:5: mode: mode '3X' is not in modes.csv"),
            std::string::npos);
  EXPECT_NE(refused("shapes.csv", "2X,7,x,", "2X,7,z,").find("twice"), std::string::npos);
  EXPECT_NE(refused("shapes.csv", "2X,7,x,1\n", "").find("has no value at point 7 direction x"), std::string::npos);
  EXPECT_NE(refused("shapes.csv", "2X,7,x,1\n", "2X,7,x,\n").find("shapes.csv:5"), std::string::npos);
}

TEST(ModesIo, ModesOfAMatrixModelKeepItsDofs) {
  fe::ParametricSystem system;
  system.dofs = {{"left", 0, Eigen::Vector3d::Zero()}, {"right", 4, Eigen::Vector3d::Zero()}};
  dynamics::EigenModes modes;
  modes.frequency_Hz = Eigen::VectorXd::Constant(1, 2.5);
  modes.shapes = Eigen::Vector2d(0.25, 1.0);
  const modal::ModeSet set = to_mode_set(nullptr, system, modes);
  EXPECT_EQ(set.dofs[1], (modal::ShapeDof{"right", "ry"}));
  EXPECT_EQ(set.shapes(0, 0), std::complex<double>(0.25));
  EXPECT_TRUE(std::isnan(set.damping_ratio[0]));
}

}  // namespace
}  // namespace twindeck::model_io::test
