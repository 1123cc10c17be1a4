#include "runner/run_step.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>

#include "core/parallel.hpp"

namespace twindeck::runner {
namespace {

namespace fs = std::filesystem;

/// A step that does what the test says, in a folder of its own; a study with a configuration lies beside it.
class RunStep : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("twindeck-run-step-" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "study");
    std::ofstream(folder_ / "study" / "s4_refinement.toml") << "# a comment\nlength = 3.0\n\n[search]\nstarts = 4\n";
    set_thread_count(4);
  }
  void TearDown() override {
    fs::remove_all(folder_);
    set_thread_count(processor_count());
  }

  /// Exit code, and what was said on stderr.
  std::pair<int, std::string> run(const std::function<void()>& work, std::vector<std::string> more = {}) const {
    double length = 1.0;
    long starts = 1;
    std::string name;
    Step step;
    step.token = "s4_refinement";
    step.summary = "Does what the test says.";
    step.examples = {"a", "b"};
    step.fields.number("length", length, "m", io::positive(), "of the span")
        .integer("search.starts", starts, {1, 100}, "searches")
        .text("name", name, "of it");
    step.read = [&](StepContext&) -> Computation {
      return [&]() -> Status {
        work();
        return {};
      };
    };
    std::vector<std::string> words = {"s4_refinement", "--out", (folder_ / "out").string(), "--quiet", "--threads", "4"};
    if (more.empty()) more = {"--study", (folder_ / "study").string()};
    words.insert(words.end(), more.begin(), more.end());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    testing::internal::CaptureStderr();
    const int code = run_step(static_cast<int>(arguments.size()), arguments.data(), std::move(step));
    std::string said = testing::internal::GetCapturedStderr();
    if (const auto at = said.find(folder_.string() + "/"); at != std::string::npos) said.erase(at, folder_.string().size() + 1);
    return {code, said};
  }

  fs::path folder_;
};

using Answer = std::pair<int, std::string>;

// Oracle: the contract of exit codes; what only an input can ask for, a size that no machine has, is bad input.
TEST_F(RunStep, SizesThatNoMachineHasAreBadInput) {
  const Answer too_large = {
      2,
      "s4_refinement: study: asks for more memory than there is; look for a size, a duration or a number of "
      "modes that is too large\n"};
  EXPECT_EQ(run([] { throw std::bad_alloc(); }), too_large);
  EXPECT_EQ(run([] { std::vector<double>().resize(std::vector<double>().max_size() + 1); }), too_large);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

// Oracle: the same exit codes and lines as without threads: parallel_for carries what was thrown to run_step.
TEST_F(RunStep, WhatIsThrownInParallelLoopsHasItsExitCode) {
  const auto in_loop = [](const auto& thrown) {
    return [thrown] {
      parallel_for(64, [&](int) {
        parallel_for(3, [&](int j) {
          if (j == 2) throw thrown;
        });
      });
    };
  };
  EXPECT_EQ(run(in_loop(InputError({"a.csv", 3, "x"}, "is bad"))), Answer(2, "s4_refinement: a.csv:3: x: is bad\n"));
  EXPECT_EQ(run(in_loop(std::bad_alloc())).first, 2);
  EXPECT_EQ(run(in_loop(InternalError("ours"))), Answer(3, "s4_refinement: internal error: ours\n"));
  EXPECT_EQ(run(in_loop(std::runtime_error("two\nlines"))), Answer(3, "s4_refinement: internal error: two lines\n"));
  EXPECT_EQ(run([] { throw 5; }).first, 3);
}

// Oracle: lines of the configuration counted by hand; a message names a file, or the study, or says that it was the command
// line.
TEST_F(RunStep, AMessageWithoutFileGetsTheOneOfItsKey) {
  const auto said = [&](const std::string& key, std::vector<std::string> more = {}) {
    return run([&] { throw InputError({"", 0, key}, "is bad", "mend it"); }, std::move(more)).second;
  };
  EXPECT_EQ(said("length"), "s4_refinement: study/s4_refinement.toml:2: length: is bad; mend it\n");
  EXPECT_EQ(said("search.starts"), "s4_refinement: study/s4_refinement.toml:5: search.starts: is bad; mend it\n");
  EXPECT_EQ(said("starts"), "s4_refinement: study/s4_refinement.toml:5: starts: is bad; mend it\n");
  EXPECT_EQ(said("name"), "s4_refinement: study: name: is bad; mend it\n");  // not given: its default
  EXPECT_EQ(said("stay NE8"), "s4_refinement: study: stay NE8: is bad; mend it\n");
  EXPECT_EQ(said("length", {"--set", "length=2"}), "s4_refinement: --set: length: is bad; mend it\n");
  EXPECT_EQ(said("stay NE8", {"--set", "length=2"}), "s4_refinement: command line: stay NE8: is bad; mend it\n");
}

}  // namespace
}  // namespace twindeck::runner
