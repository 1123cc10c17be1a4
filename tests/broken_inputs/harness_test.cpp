// Oracle: the language of changes as change.hpp states it, and judgements that must find each kind of fault: a table of cases
// is worth as much as its judge.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "broken_inputs/case_table.hpp"
#include "broken_inputs/change.hpp"
#include "broken_inputs/judgement.hpp"
#include "broken_inputs/made_record.hpp"
#include "broken_inputs/worker.hpp"

namespace twindeck::broken {
namespace {

namespace fs = std::filesystem;

class Changes : public testing::Test {
 protected:
  Changes() : folder_(fs::temp_directory_path() / ("twindeck_changes_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    write("a.csv", "node,x_m\n1,0\n2,5\n");
  }
  ~Changes() override { fs::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  [[nodiscard]] std::string text(const std::string& name = "a.csv") const {
    std::ifstream in(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  [[nodiscard]] std::string after(const std::string& change) const {
    apply_change(folder_, change);
    return text();
  }
  fs::path folder_;
};

TEST_F(Changes, CellsColumnsAndLines) {
  EXPECT_EQ(after("set a.csv 2 x_m far"), "node,x_m\n1,0\n2,far\n");
  EXPECT_EQ(after("set a.csv * x_m \"\""), "node,x_m\n1,\n2,\n");
  EXPECT_EQ(after("add a.csv y_m 7"), "node,x_m,y_m\n1,,7\n2,,7\n");
  EXPECT_EQ(after("drop a.csv x_m"), "node,y_m\n1,7\n2,7\n");
  EXPECT_EQ(after("rename a.csv y_m z_m"), "node,z_m\n1,7\n2,7\n");
  EXPECT_EQ(after("insert a.csv 2 \"0,1\""), "node,z_m\n0,1\n1,7\n2,7\n");
  EXPECT_EQ(after("line a.csv 3 \"1,8\""), "node,z_m\n0,1\n1,8\n2,7\n");
  EXPECT_EQ(after("remove a.csv 1"), "0,1\n1,8\n2,7\n");
}

TEST_F(Changes, Bytes) {
  EXPECT_EQ(after("cut a.csv -4"), "node,x_m\n1,0\n");
  EXPECT_EQ(after("append a.csv \"\\x1b\\n\""), "node,x_m\n1,0\n\x1b\n");
  EXPECT_EQ(after("bytes a.csv -2 \"\\x00\""), std::string("node,x_m\n1,0\n\0\n", 15));
  EXPECT_EQ(after("replace a.csv x_m y_m"), std::string("node,y_m\n1,0\n\0\n", 15));
  EXPECT_EQ(after("cut a.csv 4"), "node");
  EXPECT_EQ(after("repeat a.csv 3 ab"), "nodeababab");
  EXPECT_EQ(after("replace_all a.csv ab c"), "nodeccc");
}

TEST_F(Changes, AChangeThatDoesNothingIsRefused) {
  for (const char* change :
       {"replace a.csv nowhere x", "set a.csv 1 x_m 0", "set a.csv 1 y_m 0", "set a.csv 9 x_m 0", "delete b.csv", "cut b.csv 3",
        "turn a.csv", "cut a.csv", "append a.csv \"\\q\"", "append a.csv \"open"}) {
    EXPECT_THROW(apply_change(folder_, change), std::runtime_error) << change;
  }
}

TEST(SoundRecord, ChannelsDifferByTheirMeans) {
  const Eigen::MatrixXd record = sound_record();
  for (Eigen::Index c = 0; c < 3; ++c) EXPECT_NEAR(record.col(c).mean(), 11.5 * static_cast<double>(c + 1), 1e-12);
}

/// A case that is met, with what it left.
struct Met {
  Case c;
  Evidence evidence;
  Met() {
    c.name = "x";
    c.step = "s1_model";
    c.words = {"nodes.csv:3"};
    evidence.outcome.exit = 2;
    evidence.outcome.stderr_text = "s1_model: model/nodes.csv:3: x_m: is empty\n";
    evidence.out = "work/out";
    evidence.before = evidence.after = {{"work/out", "folder"}, {"work/out/modes.csv", "1"}, {"work/model/nodes.csv", "2"}};
  }
  [[nodiscard]] bool found() const { return !faults(c, evidence).empty(); }
};

TEST(Judgement, AMetCaseHasNoFault) { EXPECT_FALSE(Met().found()); }

TEST(Judgement, FindsWhatIsWrongWithTheMessage) {
  for (const char* text :
       {"", "s1_model: model/nodes.csv:3: x_m", "s1_model: model/nodes.csv:3\nmore\n", "model/nodes.csv:3\n",
        "s1_model: model/nodes.csv:4\n", "s1_model: model/nodes.csv:3 \x1b[31m\n", "s1_model: model/nodes.csv:3 \xff\n"}) {
    Met met;
    met.evidence.outcome.stderr_text = text;
    EXPECT_TRUE(met.found()) << text;
  }
  Met long_message;
  long_message.evidence.outcome.stderr_text = "s1_model: model/nodes.csv:3 " + std::string(5000, 'x') + "\n";
  EXPECT_TRUE(long_message.found());
  Met on_stdout;
  on_stdout.evidence.outcome.stdout_text = "half a table";
  EXPECT_TRUE(on_stdout.found());
}

TEST(Judgement, FindsWrongExitCodesAndCrashes) {
  for (const int exit : {0, 1, 3, 139}) {
    Met met;
    met.evidence.outcome.exit = exit;
    EXPECT_TRUE(met.found()) << exit;
  }
  Met crashed;
  crashed.evidence.outcome.crash = "ended by signal Segmentation fault";
  EXPECT_TRUE(crashed.found());
}

TEST(Judgement, FindsFilesThatChangedAppearedOrWent) {
  Met changed, appeared, gone, partial;
  changed.evidence.after["work/out/modes.csv"] = "3";
  appeared.evidence.after["elsewhere"] = "3";
  gone.evidence.after.erase("work/out/modes.csv");
  partial.evidence.after["work/out.partial-7"] = "folder";
  EXPECT_TRUE(changed.found() && appeared.found() && gone.found() && partial.found());
}

TEST(Judgement, ASuccessMayChangeItsOwnResultsAlone) {
  Met met;
  met.c.exit = met.evidence.outcome.exit = 0;
  met.evidence.outcome.stderr_text = "";
  met.c.words = {"1.49"};
  met.evidence.after["work/out/modes.csv"] = "mode 1: 1.49";
  EXPECT_FALSE(met.found());
  met.evidence.after["work/model/nodes.csv"] = "3";
  EXPECT_TRUE(met.found());
}

TEST(Worker, OutlivesCrashesAndHangs) {
  Worker worker(0.5);
  const fs::path here = fs::temp_directory_path();
  const Job help{"s1_model", {"--help"}, here};
  EXPECT_EQ(worker.run(help).exit, 0);
  // A folder that cannot be entered is told by an exit code of its own; the worker goes on.
  EXPECT_EQ(worker.run({"s1_model", {"--help"}, "/nowhere"}).exit, 121);
  const fs::path pipe = here / ("twindeck_pipe_" + std::to_string(::getpid()));
  apply_change(here, "pipe " + pipe.filename().string());
  const Outcome waiting = worker.run({"s3_identification", {"--inspect", pipe.string()}, here});
  EXPECT_TRUE(waiting.exit == 2 || waiting.crash.find("did not end") != std::string::npos) << waiting.crash;
  fs::remove(pipe);
  const Outcome after = worker.run(help);
  EXPECT_EQ(after.exit, 0);
  EXPECT_NE(after.stdout_text.find("--model"), std::string::npos);
}

}  // namespace
}  // namespace twindeck::broken
