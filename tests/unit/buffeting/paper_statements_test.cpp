// What the paper says about its Table 13, on made-up errors. Oracle: errors that are set by hand.
#include "buffeting/paper_statements.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

namespace twindeck::buffeting {
namespace {

/// Statements where the errors of all runs are those of a function of run, event and channel 1 to 8 [%].
std::vector<PaperStatement> statements_of(const std::function<double(const std::string&, const std::string&, int)>& error_pct) {
  Sensors sensors;
  MeasuredRms measured;
  for (int m = 1; m <= 8; ++m) sensors.points.push_back(fmt::format("M{}", m));
  std::vector<RunResult> results;
  for (const char* run : {"NS1", "NS2", "NS3"})
    for (const char* event : {"August", "April"}) {
      RunResult result;
      result.run = run;
      result.event = event;
      result.rms = Eigen::MatrixXd::Constant(24, 2, 99.0);  // lateral directions count for nothing
      result.status.converged = true;
      for (std::size_t p = 0; p < 8; ++p) {
        measured[{event, sensors.points[p]}] = 0.01;
        const double mean = 0.01 * (1.0 + error_pct(run, event, static_cast<int>(p) + 1) / 100.0);
        result.rms.row(sensors.vertical(p)) << 0.5 * mean, 1.5 * mean;  // the mean over seeds counts
      }
      results.push_back(result);
    }
  return paper_statements(results, sensors, measured);
}

const PaperStatement& named(const std::vector<PaperStatement>& all, const std::string& text) {
  for (const PaperStatement& one : all)
    if (one.statement.find(text) != std::string::npos) return one;
  throw std::runtime_error(text);
}

TEST(PaperStatements, HoldWhereTheErrorsAreAsThePaperSays) {
  const auto all = statements_of([](const std::string& run, const std::string& event, int m) {
    const double size = (event == "August") == (run == "NS1") && (m > 1 && m < 8) ? 10.0 : 20.0;
    if (run == "NS2" && (event == "April" || m == 1 || m == 8)) return 5.0;
    return event == "April" || m == 1 || m == 8 ? size : -size;
  });
  ASSERT_EQ(all.size(), 9u);
  for (const PaperStatement& one : all) EXPECT_TRUE(one.holds) << one.statement << ": " << one.found;
  EXPECT_EQ(named(all, "April is overestimated").found, "24 of 24 cells");
  EXPECT_EQ(named(all, "below 26 %").found, "largest 20.0 %");
}

TEST(PaperStatements, MissWhereTheyAreOtherwise) {
  const auto all = statements_of([](const std::string&, const std::string& event, int m) {
    return event == "April" && m == 3 ? -1.0 : (event == "April" ? 30.0 : -30.0);
  });
  EXPECT_FALSE(named(all, "April is overestimated").holds);
  EXPECT_EQ(named(all, "April is overestimated").found, "21 of 24 cells");
  EXPECT_FALSE(named(all, "M1 and M8, near the ramps, are overestimated").holds);
  EXPECT_FALSE(named(all, "below 26 %").holds);
}

TEST(PaperStatements, AreNoneWhereARunOrAChannelIsMissing) { EXPECT_TRUE(paper_statements({}, {}, {}).empty()); }

}  // namespace
}  // namespace twindeck::buffeting
