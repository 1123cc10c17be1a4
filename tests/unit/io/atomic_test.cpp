#include "io/atomic.hpp"

#include "temporary_folder.hpp"

namespace twindeck::io {
namespace {

namespace fs = std::filesystem;
using AtomicTest = test::TemporaryFolder;

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

// Oracle: the content is the last one written and nothing temporary is left.
TEST_F(AtomicTest, FileIsReplacedWhole) {
  write_file_atomically(folder_ / "sub" / "a.txt", "one");
  write_file_atomically(folder_ / "sub" / "a.txt", "two");
  EXPECT_EQ(content(folder_ / "sub" / "a.txt"), "two");
  EXPECT_EQ(entries(folder_ / "sub"), 1u);
}

// Oracle: a file where a folder is needed cannot be written below; the message names the path.
TEST_F(AtomicTest, FailureNamesThePath) {
  write("file", "x");
  EXPECT_NE(refusal([&] { write_file_atomically(folder_ / "file" / "a.txt", "x"); }).find("cannot be written"),
            std::string::npos);
}

// Oracle: earlier results stay whole until publish, and are gone wholly after it (no mixture of both).
TEST_F(AtomicTest, FolderIsReplacedAtOnce) {
  write("out/old.csv", "old");
  {
    FolderReplacement replacement(folder_ / "out/");
    std::ofstream(replacement.partial() / "new.csv") << "new";
    EXPECT_TRUE(fs::exists(folder_ / "out" / "old.csv"));
    EXPECT_FALSE(fs::exists(folder_ / "out" / "new.csv"));
    replacement.publish();
  }
  EXPECT_FALSE(fs::exists(folder_ / "out" / "old.csv"));
  EXPECT_EQ(content(folder_ / "out" / "new.csv"), "new");
  EXPECT_EQ(entries(folder_), 1u);
}

// Oracle: without publish (a failure) nothing is changed and nothing is left.
TEST_F(AtomicTest, AbandonedFolderLeavesNoTrace) {
  write("out/old.csv", "old");
  { const FolderReplacement replacement(folder_ / "out"); }
  EXPECT_EQ(content(folder_ / "out" / "old.csv"), "old");
  EXPECT_EQ(entries(folder_), 1u);
}

// Oracle: published elsewhere, the earlier results stay.
TEST_F(AtomicTest, PublishElsewhereKeepsEarlierResults) {
  write("out/old.csv", "old");
  FolderReplacement replacement(folder_ / "out");
  std::ofstream(replacement.partial() / "new.csv") << "new";
  replacement.publish(folder_ / "out.unconverged");
  EXPECT_EQ(content(folder_ / "out" / "old.csv"), "old");
  EXPECT_EQ(content(folder_ / "out.unconverged" / "new.csv"), "new");
}

}  // namespace
}  // namespace twindeck::io
