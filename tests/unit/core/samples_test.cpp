/// Oracles: Eigen's own matrix of the same values; the folder, in which no file may be left; a folder that is not there.
#include "core/samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace twindeck {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;

/// TMPDIR for the length of a test.
class Folder {
 public:
  explicit Folder(const fs::path& folder) {
    const char* had = std::getenv("TMPDIR");
    if (had != nullptr) before_ = had;
    setenv("TMPDIR", folder.c_str(), 1);
  }
  ~Folder() { before_.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", before_.c_str(), 1); }

 private:
  std::string before_;
};

Eigen::MatrixXd values(Index rows, Index cols) {
  return Eigen::MatrixXd::NullaryExpr(
      rows, cols, [](Index t, Index c) { return std::sin(0.37 * static_cast<double>(t * t)) + static_cast<double>(c); });
}

TEST(Samples, OfAFileAreThoseOfTheMemory) {
  const fs::path folder = fs::temp_directory_path() / "twindeck_samples_test";
  fs::create_directories(folder);
  const Folder temporary(folder);
  const Eigen::MatrixXd matrix = values(1001, 5);
  Samples here(matrix.rows(), matrix.cols()), there(matrix.rows(), matrix.cols(), 1000);
  EXPECT_FALSE(here.in_file());
  ASSERT_TRUE(there.in_file());
  EXPECT_TRUE(fs::is_empty(folder));  // the file has no name
  fs::remove(folder);
  for (Samples* samples : {&here, &there}) {
    samples->col(0) = matrix.col(0);
    samples->rightCols(4) = matrix.rightCols(4);
    EXPECT_EQ(Eigen::MatrixXd(*samples), matrix);
    // The same bytes, so that sums round alike.
    EXPECT_EQ(samples->colwise().squaredNorm(), matrix.colwise().squaredNorm());
    EXPECT_EQ(Eigen::MatrixXd(samples->transpose() * *samples), Eigen::MatrixXd(matrix.transpose() * matrix));
  }
}

TEST(Samples, CopiesAreOfTheirOwnAndAMoveTakesAll) {
  const Eigen::MatrixXd matrix = values(30, 3);
  Samples first = matrix;
  std::vector<Samples> list = {first};
  first(4, 1) = 99.0;
  EXPECT_EQ(Eigen::MatrixXd(list.front()), matrix);
  const double* place = first.data();
  Samples second = std::move(first);
  EXPECT_EQ(second.data(), place);
  EXPECT_EQ(second(4, 1), 99.0);
  list.front() = std::move(second);
  EXPECT_EQ(list.front().data(), place);
  EXPECT_EQ(list.front().rows(), 30);
  list.front() = matrix.topRows(7);
  EXPECT_EQ(Eigen::MatrixXd(list.front()), matrix.topRows(7));
  EXPECT_EQ(Samples().size(), 0);
}

TEST(Samples, ChannelsAreScaledEachByItsFactor) {
  const Eigen::MatrixXd matrix = values(50, 3);
  const Eigen::Vector3d factor(2.0, -0.1, 1e3);
  EXPECT_EQ(Eigen::MatrixXd(scaled_channels(matrix, factor)), Eigen::MatrixXd(matrix * factor.asDiagonal()));
}

TEST(Samples, WithoutRoomTheFolderIsNamed) {
  const Folder temporary("/nowhere/at/all");
  try {
    const Samples samples(1000, 3, 0);
    FAIL() << "a file in a folder that is not there";
  } catch (const InputError& problem) {
    EXPECT_NE(std::string(problem.what()).find("/nowhere/at/all: has no room for"), std::string::npos) << problem.what();
    EXPECT_NE(std::string(problem.what()).find("TMPDIR"), std::string::npos);
  }
}

}  // namespace
}  // namespace twindeck
