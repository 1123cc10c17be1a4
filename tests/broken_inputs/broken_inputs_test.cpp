// Oracle: the table cases/*.toml, which says for each broken input what the step has to answer; README.md tells how to read it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "broken_inputs/case_table.hpp"
#include "broken_inputs/change.hpp"
#include "broken_inputs/judgement.hpp"
#include "broken_inputs/worker.hpp"
#include "io/manifest.hpp"
#include "test_places.hpp"

namespace twindeck::broken {

/// For GoogleTest's messages, which would print the bytes.
void PrintTo(const Case& c, std::ostream* out);
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

namespace {

namespace fs = std::filesystem;

const fs::path kHere = fs::path(TWINDECK_SOURCE_DIR) / "tests/broken_inputs";
constexpr double kMostSeconds = 20.0;  // [s] of one case; the slowest takes one or two on an idle machine

const std::vector<Case>& cases() {
  static const std::vector<Case> all = read_cases(kHere / "cases");
  return all;
}

/// Names of cases in a file, one a line.
std::set<std::string> listed(const char* file) {
  std::set<std::string> names;
  std::ifstream in(kHere / file);
  for (std::string line; std::getline(in, line);)
    if (!line.empty() && line[0] != '#') names.insert(line);
  return names;
}

/// Cases that the product does not answer rightly yet. They run like the others, and one that has become right fails here until
/// its line is taken out, so that the list only shrinks.
const std::set<std::string>& open_cases() {
  static const std::set<std::string> all = listed("open.txt");
  return all;
}

/// Cases that --check takes, since only computing shows what is wrong. One that it refuses fails here until its line is taken
/// out.
const std::set<std::string>& computed_cases() {
  static const std::set<std::string> all = listed("computed.txt");
  return all;
}

/// One process for all cases of this run.
Worker& worker() {
  static Worker one(kMostSeconds);
  return one;
}

/// {root} is the folder that nothing may be written to, {source} the repository.
std::string filled_in(std::string text, const fs::path& root) {
  for (const auto& [mark, value] :
       {std::pair<std::string, std::string>{"{root}", root.string()}, {"{source}", TWINDECK_SOURCE_DIR}}) {
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size()))
      text.replace(at, mark.size(), value);
  }
  return text;
}

/// Results of an earlier run of the step, which must outlive every failure.
void write_earlier_results(const std::string& step, const fs::path& out) {
  fs::create_directories(out);
  std::ofstream(out / "result.csv") << "quantity,value\nearlier,1\n";
  io::Manifest manifest;
  manifest.step = step;
  manifest.status = "converged";
  manifest.outputs["result.csv"] = io::sha256(out / "result.csv");
  io::write_manifest(manifest, out);
}

class BrokenInput : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "twindeck_broken_XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    root_ = name;
    const Case& c = GetParam();
    work_ = root_ / "outer/inner";  // two folders below, so that a name such as ../../x stays below `root_`
    fs::create_directories(work_.parent_path());
    fs::copy(kHere / "bases" / c.base, work_, fs::copy_options::recursive);
    if (!c.own_out) write_earlier_results(c.step, work_ / "out" / c.step);
    for (const std::string& change : c.changes) apply_change(work_, filled_in(change, root_));
  }
  void TearDown() override { fs::remove_all(root_); }

  /// The step of the case, as the table says it.
  Outcome run(const std::vector<std::string>& more, bool loud = false) const {
    const Case& c = GetParam();
    Job job{c.step, more, work_};
    for (const std::string& word : c.arguments) job.arguments.push_back(filled_in(word, root_));
    if (!c.own_out) job.arguments.insert(job.arguments.end(), {"--out", "out/" + c.step});
    if (c.quiet && !loud) job.arguments.emplace_back("--quiet");
    return c.program ? run_program(fs::path(TWINDECK_BINARY_DIR) / "bin", job, kMostSeconds) : worker().run(job);
  }

  fs::path root_, work_;
};

TEST_P(BrokenInput, EndsAsTheTableSays) {
  const Case& c = GetParam();
  Evidence evidence;
  evidence.out = "outer/inner/out/" + c.step;
  evidence.before = snapshot(root_);
  const Outcome checked = run({"--check"});
  EXPECT_TRUE(snapshot(root_) == evidence.before) << c.name << ": --check has changed a file";
  evidence.outcome = run({});
  evidence.after = snapshot(root_);
  const std::string check_fault = fault_of_check(checked, evidence.outcome, computed_cases().contains(c.name));
  if (!check_fault.empty()) ADD_FAILURE() << c.name << ": " << check_fault;
  const auto manifest = evidence.after.find(evidence.out + "/manifest.json");
  if (c.exit == 0 && evidence.outcome.exit == 0 && manifest != evidence.after.end()) {
    for (const std::string& line : unrecorded(c.step, run({"--check"}, true).stderr_text, manifest->second))
      ADD_FAILURE() << c.name << ": is said of the input, but manifest.json does not hold it: " << line;
  }
  const std::vector<std::string> found = faults(c, evidence);
  if (open_cases().contains(c.name)) {
    if (found.empty()) ADD_FAILURE() << c.name << ": is answered rightly now; take it out of open.txt";
    GTEST_SKIP() << c.name << " is open: " << (found.empty() ? "" : found.front());
  }
  for (const std::string& fault : found) ADD_FAILURE() << c.name << ": " << fault;
}

std::string label(const testing::TestParamInfo<Case>& info) {
  std::string name = info.param.name;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Table, BrokenInput, testing::ValuesIn(cases()), label);

TEST(Table, IsAsLargeAsPromised) {
  EXPECT_GE(cases().size(), 400U);
  EXPECT_EQ(std::count_if(cases().begin(), cases().end(), [](const Case& c) { return c.program; }), 20);
  std::set<std::string> steps, said;
  for (const Case& c : cases()) {
    steps.insert(c.step);
    std::string all = c.step + "|" + c.base;
    for (const auto& list : {c.changes, c.arguments}) {
      for (const std::string& word : list) all += "|" + word;
    }
    const bool first = said.insert(all + (c.program ? "|program" : "") + (c.own_out ? "|own_out" : "")).second;
    EXPECT_TRUE(first) << c.name << " is the same as another case";
  }
  EXPECT_EQ(steps.size(), 11U);
  for (const auto& names : {open_cases(), computed_cases()})
    for (const std::string& name : names)
      EXPECT_TRUE(std::any_of(cases().begin(), cases().end(), [&](const Case& c) { return c.name == name; }))
          << "open.txt or computed.txt: no case " << name;
}

}  // namespace
}  // namespace twindeck::broken
