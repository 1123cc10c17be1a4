#include "core/build_info.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "test_places.hpp"

namespace twindeck {
namespace {

// Oracle: the version in CITATION.cff, the one place where it is written.
TEST(BuildInfo, VersionIsTheCitations) {
  std::ifstream in(std::string(TWINDECK_SOURCE_DIR) + "/CITATION.cff");
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  EXPECT_NE(text.find("\nversion: " + version() + "\n"), std::string::npos);
}

/// What git itself says of the source tree; empty where there is no git or no repository.
std::string head_by_git() {
  const std::string command = "git -C '" + std::string(TWINDECK_SOURCE_DIR) + "' rev-parse HEAD 2>/dev/null";
  std::string hash(40, ' ');
  FILE* pipe = popen(command.c_str(), "r");
  const std::size_t read = pipe == nullptr ? 0 : std::fread(hash.data(), 1, hash.size(), pipe);
  if (pipe != nullptr) pclose(pipe);
  return read == hash.size() ? hash : "";
}

// Oracle: git. The folder that the program is started in does not matter: it may be another repository.
TEST(BuildInfo, CommitIsTheSourceTreesWhereverTheProgramStarts) {
  if (!std::filesystem::exists(std::string(TWINDECK_SOURCE_DIR) + "/.git/HEAD")) GTEST_SKIP() << "the source tree is no clone";
  const std::string by_git = head_by_git();
  if (by_git.empty()) GTEST_SKIP() << "git is not here";
  EXPECT_EQ(source_commit(), by_git);
  const auto here = std::filesystem::current_path();
  std::filesystem::current_path("/");
  const std::string elsewhere = source_commit();
  std::filesystem::current_path(here);
  EXPECT_EQ(elsewhere, by_git);
}

// Oracle: Eigen is always there, in the version that CMakeLists.txt asks for at least.
TEST(BuildInfo, NamesLibraries) { EXPECT_TRUE(library_versions().at("Eigen").starts_with("3.")); }

}  // namespace
}  // namespace twindeck
