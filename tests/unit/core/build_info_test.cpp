#include "core/build_info.hpp"

#include <gtest/gtest.h>

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

// Oracle: a git object name has 40 hexadecimal digits; a tree without git has none.
TEST(BuildInfo, CommitIsAnObjectNameOrNothing) {
  const std::string commit = source_commit();
  EXPECT_TRUE(commit.empty() || commit.size() == 40);
  EXPECT_EQ(commit.find_first_not_of("0123456789abcdef"), std::string::npos);
}

// Oracle: Eigen is always there, in the version that CMakeLists.txt asks for at least.
TEST(BuildInfo, NamesLibraries) { EXPECT_TRUE(library_versions().at("Eigen").starts_with("3.")); }

}  // namespace
}  // namespace twindeck
