// Oracle: what went into the file; the quirks are made by hand from a sound one.
#include "records/universal.hpp"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <sstream>

#include "core/error.hpp"
#include "records/record.hpp"
#include "records/scan_universal.hpp"
#include "records/universal_lines.hpp"
#include "records/write_universal.hpp"
#include "same_samples.hpp"
#include "scratch.hpp"
#include "universal_series.hpp"
#include "universal_writer.hpp"

namespace twindeck::records {
namespace {

Eigen::MatrixXd waves() {
  Eigen::MatrixXd data(500, 3);
  for (int t = 0; t < 500; ++t) {
    for (int c = 0; c < 3; ++c) data(t, c) = std::sin(0.1 * t + c) * (c == 1 ? 1e-7 : 3.0);
  }
  data(0, 0) = 0.0;
  return data;
}

RecordInfo info() {
  RecordInfo record;
  record.rate_Hz = 64.0;
  for (int c = 0; c < 3; ++c) {
    ChannelInfo channel;
    channel.name = fmt::format("A{}", c);
    channel.point = std::to_string(c + 1);
    channel.direction = c == 1 ? "-y" : "+z";
    channel.unit = "m/s2";
    record.channels.push_back(channel);
  }
  return record;
}

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

void expect_same(const Record& record, double tolerance) {
  const Eigen::MatrixXd data = waves();
  ASSERT_EQ(record.samples.rows(), data.rows());
  ASSERT_EQ(record.samples.cols(), data.cols());
  for (int c = 0; c < 3; ++c)
    EXPECT_LT((record.samples.col(c) - data.col(c)).cwiseAbs().maxCoeff(), tolerance * data.col(c).cwiseAbs().maxCoeff());
  EXPECT_NEAR(record.info.rate_Hz, 64.0, 1e-3);
}

TEST(Universal58, TextAndBinaryComeBack) {
  const Scratch scratch;
  for (const bool binary : {false, true}) {
    write_universal_series(info(), waves(), binary, scratch.file("a.uff"));
    const Record record = read(scratch.file("a.uff"));
    expect_same(record, binary ? 0.0 + 1e-16 : 1e-10);
    EXPECT_EQ(record.info.channels[1].name, "A1");
    EXPECT_EQ(record.info.channels[1].point, "2");
    EXPECT_EQ(record.info.channels[1].direction, "-y");
    EXPECT_EQ(record.info.channels[1].unit, "m/s2");
  }
}

TEST(Universal58, QuirksOfOtherWriters) {
  const Scratch scratch;
  write_universal_series(info(), waves(), true, scratch.file("a.uff"));
  const std::string sound = content(scratch.file("a.uff"));
  // Binary data begin after twelve lines (delimiter, set, eleven of header) of each set.
  const auto data_at = [&](const std::string& text, std::size_t set) {
    std::size_t at = 0;
    for (std::size_t k = 0; k <= set; ++k) at = text.find("    58b", at) + 1;
    for (int line = 0; line < 12; ++line) at = text.find('\n', at) + 1;
    return at;
  };
  std::string before = sound;
  before.insert(data_at(sound, 1), "\n");
  expect_same(read(scratch.write("before.uff", before)), 1e-16);
  std::string none = sound;
  none.erase(data_at(sound, 1) + 500 * 8, 1);  // the newline after the data
  expect_same(read(scratch.write("none.uff", none)), 1e-16);
  std::string wrong = sound;
  wrong.replace(wrong.find("4000"), 4, "2000");
  const Record counted = read(scratch.write("wrong.uff", wrong));
  expect_same(counted, 1e-16);
  EXPECT_TRUE(std::any_of(counted.info.notes.begin(), counted.info.notes.end(),
                          [](const auto& n) { return n.find("2000 bytes") != std::string::npos; }));

  write_universal_series(info(), waves(), false, scratch.file("t.uff"));
  std::string fortran = content(scratch.file("t.uff"));
  for (std::size_t at = 0; (at = fortran.find("E-", at)) != std::string::npos; ++at) fortran[at] = 'D';
  expect_same(read(scratch.write("fortran.uff", fortran)), 1e-10);
  std::string windows;
  for (const char c : fortran) windows += c == '\n' ? "\r\n" : std::string(1, c);
  expect_same(read(scratch.write("windows.uff", windows)), 1e-10);
}

TEST(Universal58, ATruncatedFileIsNamedWithItsLine) {
  const Scratch scratch;
  for (const bool binary : {false, true}) {
    write_universal_series(info(), waves(), binary, scratch.file("a.uff"));
    const std::string sound = content(scratch.file("a.uff"));
    try {
      static_cast<void>(read(scratch.write("cut.uff", sound.substr(0, sound.size() / 2))));
      FAIL();
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("breaks off in set 58 number 2"), std::string::npos) << error.what();
      EXPECT_GT(error.place().line, 0);
    }
  }
}

/// One channel of set 58b with its own times, of 4 or 8 bytes before each value.
std::string uneven_58b(bool wide) {
  const std::string even = universal_58(same_samples().leftCols(1), 128.0, true);
  std::string text = even.substr(0, even.size() - 8 * 400 - 8);
  for (int t = 0; t < 400; ++t) {
    const auto eight = std::bit_cast<std::array<char, 8>>(t / 128.0),
               value = std::bit_cast<std::array<char, 8>>(same_samples()(t, 0));
    const auto four = std::bit_cast<std::array<char, 4>>(static_cast<float>(t / 128.0));
    text.append(wide ? eight.data() : four.data(), wide ? 8 : 4);
    text.append(value.data(), 8);
  }
  const std::string size = fmt::format("{:12d}", 8 * 400), form = fmt::format("{:10d}{:10d}", 400, 1);
  text.replace(text.find(size), 12, fmt::format("{:12d}", (wide ? 16 : 12) * 400));
  text.replace(text.find(form), 20, fmt::format("{:10d}{:10d}", 400, 0));
  return text + "\n    -1\n";
}

TEST(Universal58, ChannelsThatBeginApartAreTold) {
  const Scratch scratch;
  std::string text = universal_58(same_samples().leftCols(2), 128.0, false);
  const auto said = [&] { return fmt::format("{}", fmt::join(read(scratch.write("a.uff", text)).info.notes, "; ")); };
  EXPECT_EQ(said().find("starts"), std::string::npos) << said();
  const std::string start = "  0.00000E+00  7.81250E-03";  // and step
  text.replace(text.rfind(start), start.size(), "  2.50000E-01  7.81250E-03");
  EXPECT_NE(said().find("channels have different starts: A2 begins 32 samples after A1"), std::string::npos) << said();
}

TEST(Universal58, UnevenTimesOfFourOrEightBytes) {
  const Scratch scratch;
  for (const bool wide : {false, true}) {
    const Record record = read(scratch.write("u.uff", uneven_58b(wide)));
    EXPECT_EQ(record.samples, same_samples().leftCols(1)) << wide;
    EXPECT_NEAR(record.info.rate_Hz, 128.0, 1e-4) << wide;
  }
}

TEST(Universal, ShapesGeometryAndUnitsComeBack) {
  const Scratch scratch;
  UniversalData data;
  data.title = "a frame";
  data.nodes = {{1, {0.0, 0.0, 0.0}}, {2, {1.0, 0.5, -2.25}}, {30, {1e-3, 4.0, 5.0}}};
  data.lines = {{1, 2, 30}, {2, 1}};
  for (const bool complex : {false, true}) {
    NodalResult result;
    result.title = "mode";
    result.analysis = complex ? 3 : 2;
    result.mode = 4;
    result.complex = complex;
    result.frequency_Hz = 2.5;
    result.damping_ratio = 0.01;
    const double omega = 2.0 * M_PI * 2.5;
    result.eigenvalue = {-0.01 * omega, omega * std::sqrt(1.0 - 1e-4)};
    for (const auto& [node, position] : data.nodes) {
      result.values[node] =
          Eigen::Vector3cd(std::complex<double>(0.25 * static_cast<double>(node), complex ? -0.5 : 0.0), 1.0, -1e-5);
    }
    data.results.push_back(result);
  }
  write_universal(data, scratch.file("a.unv"));
  RecordInfo record;
  const UniversalData back = scan_universal_sets(
      scratch.file("a.unv"), [](Eigen::Index, Eigen::Index, const Eigen::MatrixXd&) {}, record);
  EXPECT_EQ(back.title, "a frame");
  EXPECT_TRUE(back.has_header && back.has_units);
  EXPECT_EQ(back.lines, data.lines);
  ASSERT_EQ(back.nodes.size(), 3U);
  for (const auto& [node, position] : data.nodes) EXPECT_LT((back.nodes.at(node) - position).norm(), 1e-15);
  ASSERT_EQ(back.results.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(back.results[k].complex, k == 1);
    EXPECT_EQ(back.results[k].mode, 4);
    EXPECT_NEAR(back.results[k].frequency_Hz, 2.5, 1e-4);
    EXPECT_NEAR(back.results[k].damping_ratio, 0.01, 1e-6);
    for (const auto& [node, vector] : data.results[k].values)
      EXPECT_LT((back.results[k].values.at(node) - vector).norm(), 1e-5 * vector.norm());
  }
}

TEST(UniversalLines, NumbersThatTouchAndMissingSets) {
  EXPECT_EQ(numbers_in(" 1.00000E+00-2.50000D-01 3.0 -4"), (std::vector<double>{1.0, -0.25, 3.0, -4.0}));
  const Scratch scratch;
  const std::string nodes =
      "    -1\n    15\n         1         0         0        11  1.00000D+02-2.00000D+02  0.00000E+00\n    -1\n"
      "    -1\n   164\n         1mm                           2\n  1.0000000000000000D+03  1.0D+00  1.0D+00\n  2.7315D+02\n    "
      "-1\n";
  RecordInfo record;
  const UniversalData data = scan_universal_sets(
      scratch.write("n.unv", nodes), [](Eigen::Index, Eigen::Index, const Eigen::MatrixXd&) {}, record);
  EXPECT_LT((data.nodes.at(1) - Eigen::Vector3d(0.1, -0.2, 0.0)).norm(), 1e-15);
  EXPECT_FALSE(data.has_header);
}

}  // namespace
}  // namespace twindeck::records
