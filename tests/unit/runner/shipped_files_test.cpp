#include "runner/shipped_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace twindeck::runner {
namespace {

namespace fs = std::filesystem;

/// Oracle: two trees made here, one laid out as a source tree and one as an installed prefix.
class ShippedFiles : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() / ("twindeck-shipped-" + std::to_string(::getpid()));
    fs::remove_all(root_);
    place(root_ / "tree/src/layers.toml");
    place(root_ / "tree" / file_);
    place(root_ / "prefix/share/twindeck" / file_);
  }
  void TearDown() override { fs::remove_all(root_); }

  static void place(const fs::path& file) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "set\n";
  }

  const fs::path file_ = "data/wind/made_up_sets.csv";
  fs::path root_;
};

TEST_F(ShippedFiles, AreFoundInTheSourceTreeOfTheProgram) {
  EXPECT_EQ(shipped(file_, root_ / "tree/build/bin/s8_validation"), root_ / "tree" / file_);
}

TEST_F(ShippedFiles, AreFoundInThePrefixOfTheProgram) {
  EXPECT_EQ(shipped(file_, root_ / "prefix/bin/s8_validation"), root_ / "prefix/share/twindeck" / file_);
  EXPECT_EQ(shipped("data/wind", root_ / "prefix/bin/s8_validation"), "data/wind") << "the folder itself is no shipped file";
}

TEST_F(ShippedFiles, ATreeWithoutTheProductsSourcesDoesNotCount) {
  fs::remove(root_ / "tree/src/layers.toml");
  EXPECT_EQ(shipped(file_, root_ / "tree/build/bin/s8_validation"), file_);
}

TEST_F(ShippedFiles, WhatExistsAsGivenIsTaken) {
  const fs::path own = root_ / "own.csv";
  place(own);
  EXPECT_EQ(shipped(own, root_ / "prefix/bin/s8_validation"), own);
}

TEST_F(ShippedFiles, AStudysOwnFileIsNeverReplaced) {
  const fs::path of_a_study = "data/made_up_study/model/nodes.csv";
  place(root_ / "tree" / of_a_study);
  place(root_ / "prefix/share/twindeck" / of_a_study);
  EXPECT_EQ(shipped(of_a_study, root_ / "tree/build/bin/s1_model"), of_a_study);
  EXPECT_EQ(shipped(of_a_study, root_ / "prefix/bin/s1_model"), of_a_study);
}

}  // namespace
}  // namespace twindeck::runner
