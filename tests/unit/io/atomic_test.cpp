#include "io/atomic.hpp"

#include <sys/wait.h>

#include <chrono>
#include <thread>

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

// Oracle: whenever another thread removes the partial folder, the results have all their files, earlier or new.
TEST_F(AtomicTest, ASignalWhileResultsTakeTheirPlaceLeavesThemWhole) {
  // The swap comes a little later in every round: in some it falls into the middle of the removal.
  constexpr int files = 40, rounds = 150;
  const auto fill = [](const fs::path& folder) {
    for (int i = 0; i < files; ++i) std::ofstream(folder / std::to_string(i)) << i;
  };
  fs::create_directories(folder_ / "out");
  fill(folder_ / "out");
  for (int round = 0; round < rounds; ++round) {
    FolderReplacement replacement(folder_ / "out");
    fill(replacement.partial());
    std::thread signalled([&] { static_cast<void>(abandon_partial(replacement.partial())); });
    std::this_thread::sleep_for(std::chrono::microseconds(4 * round));
    try {
      replacement.publish();
    } catch (const InputError&) {  // abandoned before
    }
    signalled.join();
    ASSERT_EQ(entries(folder_ / "out"), static_cast<std::size_t>(files)) << "round " << round;
  }
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

// Oracle: the link is still a link, to the folder that holds the new results; nothing is left beside either.
TEST_F(AtomicTest, AReplacedLinkStaysALink) {
  write("disk/results/old.csv", "old");
  fs::create_directory_symlink("disk/results", folder_ / "hop");
  fs::create_directory_symlink(folder_ / "hop", folder_ / "out");
  {
    FolderReplacement replacement(folder_ / "out/");
    EXPECT_EQ(replacement.partial(), FolderReplacement::partial_place(folder_ / "out"));
    std::ofstream(replacement.partial() / "new.csv") << "new";
    replacement.publish();
  }
  EXPECT_TRUE(fs::is_symlink(folder_ / "out"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "hop"));
  EXPECT_EQ(content(folder_ / "disk" / "results" / "new.csv"), "new");
  EXPECT_FALSE(fs::exists(folder_ / "disk" / "results" / "old.csv"));
  EXPECT_EQ(entries(folder_ / "disk"), 1u);
  EXPECT_EQ(entries(folder_), 3u);
  fs::create_symlink("disk/a.txt", folder_ / "a.txt");
  write_file_atomically(folder_ / "a.txt", "one");
  EXPECT_TRUE(fs::is_symlink(folder_ / "a.txt"));
  EXPECT_EQ(content(folder_ / "disk" / "a.txt"), "one");
}

/// The number of a process that has ended.
long ended_process() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  return child;
}

// Oracle: of six leftovers the next run removes the two that are a dead process's and made here; it keeps a living process's,
// another machine's, another step's and what has no process number. A folder that a dead process had moved aside comes back.
TEST_F(AtomicTest, LeftoversOfDeadProcessesAreRemoved) {
  const std::string dead = std::to_string(ended_process());
  const auto leave = [&](const std::string& name, const char* owner) {
    fs::create_directories(folder_ / name);
    if (owner != nullptr) fs::create_symlink(owner, folder_ / name / ".owner");
  };
  leave("out.partial-" + dead, nullptr);
  leave("out.partial-" + std::to_string(::getppid()), nullptr);
  leave("out2.partial-" + dead, nullptr);
  leave("out.partial-x" + dead, nullptr);
  { const FolderReplacement replacement(folder_ / "out"); }
  EXPECT_FALSE(fs::exists(folder_ / ("out.partial-" + dead)));
  leave("out.partial-" + dead, "another-machine pid:[1]");
  write("out.old-" + dead + "/old.csv", "old");
  { const FolderReplacement replacement(folder_ / "out"); }
  EXPECT_EQ(entries(folder_), 5u);
  EXPECT_TRUE(fs::exists(folder_ / ("out.partial-" + dead)));
  EXPECT_EQ(content(folder_ / "out" / "old.csv"), "old");
  write("out.old-" + dead + "/older.csv", "older");
  { const FolderReplacement replacement(folder_ / "out"); }
  EXPECT_EQ(entries(folder_), 5u);
  EXPECT_EQ(content(folder_ / "out" / "old.csv"), "old");
}

// Oracle: a process that is killed in the middle leaves its folder, as the name in the manual says; the next one removes it.
TEST_F(AtomicTest, AKilledProcessIsCleanedUpAfter) {
  const pid_t child = ::fork();
  if (child == 0) {
    const FolderReplacement replacement(folder_ / "out");
    ::_exit(1);  // no destructor runs
  }
  ::waitpid(child, nullptr, 0);
  const fs::path left = folder_ / ("out.partial-" + std::to_string(child));
  EXPECT_TRUE(fs::exists(left));
  {
    FolderReplacement replacement(folder_ / "out");
    EXPECT_FALSE(fs::exists(left));
    replacement.publish();
  }
  EXPECT_EQ(entries(folder_ / "out"), 0u) << "the mark of the owner is no result";
  EXPECT_EQ(entries(folder_), 1u);
}

}  // namespace
}  // namespace twindeck::io
