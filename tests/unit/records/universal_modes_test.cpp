// Oracle: sets 15, 2411, 2412, 82 and 55 as the format's description has them, written here by hand; and the library's own
// writer, read back.
#include "records/universal_modes.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "io/csv.hpp"
#include "records/scan_universal.hpp"
#include "records/write_universal.hpp"
#include "scratch.hpp"

namespace twindeck::records {
namespace {

std::string whole_set(const std::string& body) { return "    -1\n" + body + "    -1\n"; }

/// Three nodes on a line, in set 15 (`old`) or 2411; the axes of the last one's motion may be others.
std::string nodes_text(bool old, int last_axes = 0) {
  std::string text = old ? "    15\n" : "  2411\n";
  for (int node = 1; node <= 3; ++node) {
    const int axes = node == 3 ? last_axes : 0;
    text +=
        old ? fmt::format("{:10d}{:10d}{:10d}{:10d}{:13.5E}{:13.5E}{:13.5E}\n", node, 0, axes, 11, 1.5 * node, 0.0, 2.0)
            : fmt::format("{:10d}{:10d}{:10d}{:10d}\n{:25.16E}{:25.16E}{:25.16E}\n", node, 0, axes, 11, 1.5 * node, 0.0, 2.0);
  }
  return whole_set(text);
}

/// Vertical motion at the three nodes; the second moves along x too.
std::string mode_text(int number, double frequency_Hz, double damping, const std::array<double, 3>& vertical, int nodes = 3) {
  std::string text = "    55\nshape\nNONE\nNONE\nNONE\nNONE\n";
  text += fmt::format("{:10d}{:10d}{:10d}{:10d}{:10d}{:10d}\n", 1, 2, 2, 8, 2, 3);
  text += fmt::format("{:10d}{:10d}{:10d}{:10d}\n", 2, 4, 0, number);
  text += fmt::format("{:13.5E}{:13.5E}{:13.5E}{:13.5E}\n", frequency_Hz, 1.0, damping, 0.0);
  for (int node = 1; node <= nodes; ++node)
    text += fmt::format("{:10d}\n{:13.5E}{:13.5E}{:13.5E}\n", node, node == 2 ? 0.25 : 0.0, 0.0,
                        vertical[static_cast<std::size_t>(node) - 1]);
  return whole_set(text);
}

TEST(UniversalModes, RealModesAtNodesOfEitherSet) {
  const Scratch scratch;
  for (const bool old : {true, false}) {
    const auto file =
        scratch.write("m.unv", nodes_text(old) + mode_text(2, 5.5, 0.02, {1, 0, -1}) + mode_text(1, 2.25, 0.01, {1, 2, 1}));
    const UniversalModes read = read_universal_modes(file, 0.5);
    ASSERT_EQ(read.modes.size(), 2);
    EXPECT_EQ(read.modes.names, (std::vector<std::string>{"1", "2"}));
    EXPECT_TRUE(read.modes.frequency_Hz.isApprox(Eigen::Vector2d(2.25, 5.5), 1e-12));
    EXPECT_TRUE(read.modes.frequency_std_Hz.isApprox(0.005 * read.modes.frequency_Hz, 1e-12));
    EXPECT_TRUE(read.modes.damping_ratio.isApprox(Eigen::Vector2d(0.01, 0.02), 1e-12));
    // Node 2 moves along x too; nothing moves along y.
    ASSERT_EQ(read.channels.size(), 4);
    EXPECT_EQ(read.channels[1].name, "2_x");
    EXPECT_EQ(read.channels[3].direction, Eigen::Vector3d::UnitZ());
    EXPECT_EQ(*read.channels[3].x_m, Eigen::Vector3d(4.5, 0.0, 2.0));
    EXPECT_TRUE(read.modes.shapes.real().isApprox((Eigen::MatrixXd(4, 2) << 1, 1, 0.25, 0.25, 2, 0, 1, -1).finished(), 1e-12));
  }
}

/// The least that counts is a millionth of the largest component of the same mode, not of another's.
TEST(UniversalModes, StillnessIsOfItsOwnMode) {
  const Scratch scratch;
  const auto file = scratch.write("m.unv", nodes_text(false) + mode_text(1, 2.0, 0.01, {1e6, 0.5, 0}) +
                                               mode_text(2, 3.0, 0.01, {1e6, 0, 1e-8}) + mode_text(3, 4.0, 0.01, {0, 0, 1e-8}));
  const UniversalModes read = read_universal_modes(file, 0.0);
  std::vector<std::string> names;
  for (const matching::Channel& channel : read.channels) names.push_back(channel.name);
  // Node 2 moves along x by 0.25 in the third mode, of which 1e-8 at node 3 is too little; its 0.5 in the first is too.
  EXPECT_EQ(names, (std::vector<std::string>{"1_z", "2_x"}));
  EXPECT_TRUE(read.modes.shapes.real().isApprox((Eigen::MatrixXd(2, 3) << 1e6, 1e6, 0, 0.25, 0.25, 0.25).finished(), 1e-12));
}

TEST(UniversalModes, WhatIsWrittenIsReadBack) {
  const Scratch scratch;
  UniversalData data;
  data.nodes = {{7, {0.0, 1.0, 2.0}}, {9, {3.0, 1.0, 2.0}}, {12, {6.0, 1.0, 2.0}}};
  data.elements = {{1, 21, {7, 9}}, {2, 94, {7, 9, 12, 7}}, {3, 116, std::vector<long>(20, 9)}};
  data.lines = {{7, 9, 12}};
  NodalResult shape;
  shape.analysis = 3;
  shape.mode = 4;
  shape.complex = true;
  shape.eigenvalue = std::complex<double>(-0.2, 10.0);
  for (const auto& [node, x] : data.nodes)
    shape.values[node] = Eigen::Vector3cd(0.0, {0.1, 0.02}, 1.0 / static_cast<double>(node));
  data.results = {shape};
  const auto file = scratch.file("w.unv");
  write_universal(data, file);
  RecordInfo info;
  const UniversalData back = scan_universal_sets(
      file, [](Eigen::Index, Eigen::Index, const Eigen::MatrixXd&) {}, info);
  EXPECT_TRUE(back.others.empty());
  EXPECT_EQ(back.lines, data.lines);
  ASSERT_EQ(back.elements.size(), 3U);
  for (std::size_t e = 0; e < 3; ++e) {
    EXPECT_EQ(back.elements[e].label, data.elements[e].label);
    EXPECT_EQ(back.elements[e].descriptor, data.elements[e].descriptor);
    EXPECT_EQ(back.elements[e].nodes, data.elements[e].nodes);
  }
  const UniversalModes read = read_universal_modes(file, 0.0);
  EXPECT_TRUE(std::isnan(read.modes.frequency_std_Hz[0]));
  EXPECT_EQ(read.modes.names.front(), "4");
  EXPECT_NEAR(read.modes.frequency_Hz[0], std::abs(shape.eigenvalue) / (2.0 * std::numbers::pi), 1e-5);
  EXPECT_NEAR(read.modes.damping_ratio[0], 0.2 / std::abs(shape.eigenvalue), 1e-7);
  EXPECT_EQ(read.channels.size(), 6U);
  EXPECT_NEAR(std::abs(read.modes.shapes(0, 0) - std::complex<double>(0.1, 0.02)), 0.0, 1e-6);
  write_channels(read.channels, scratch.file("channels.csv"));
  EXPECT_EQ(io::CsvTable::read(scratch.file("channels.csv"), {"channel", "dz"}, {}, true).number(1, "dz"), 1.0);
}

TEST(UniversalModes, RefusesWhatIsNoMeasuredShape) {
  const Scratch scratch;
  const std::string nodes = nodes_text(false), mode = mode_text(1, 2.0, 0.01, {1, 2, 1});
  const auto refusal = [&](const std::string& text) {
    const auto file = scratch.write("r.unv", text);
    try {
      static_cast<void>(read_universal_modes(file, 0.5));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal(nodes).find("holds no modes among its 0 sets 55"), std::string::npos);
  EXPECT_NE(refusal(nodes + mode_text(1, 0.0, 0.0, {1, 2, 1})).find("holds no modes among its 1 sets 55"), std::string::npos);
  EXPECT_NE(refusal(mode).find("node 1, whose coordinates no set 15 or 2411 gives"), std::string::npos);
  EXPECT_NE(refusal(nodes_text(true, 5) + mode).find("nodes 1 and 3 in different coordinate systems"), std::string::npos);
  EXPECT_NE(refusal(nodes + mode + mode_text(2, 3.0, 0.01, {1, 0, 1}, 2)).find("mode 2 at 3 Hz at other nodes"),
            std::string::npos);
  EXPECT_NE(refusal(nodes + mode_text(1, 2.0, 0.01, {0, 0, 0}).substr(0, 300)).find("breaks off"), std::string::npos);
  // The remedies: modes at the same nodes, in one system of axes.
  EXPECT_EQ(refusal(nodes + mode), "");
}

}  // namespace
}  // namespace twindeck::records
