#include "buffeting/paper_statements.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace twindeck::buffeting {

namespace {

/// Errors of Eq. (18) by run, event and channel [%].
class Errors {
 public:
  Errors(const std::vector<RunResult>& results, const Sensors& sensors, const MeasuredRms& measured) {
    for (const RunResult& result : results) {
      if (!result.status.converged) continue;
      for (std::size_t p = 0; p < sensors.points.size(); ++p) {
        const auto found = measured.find({result.event, sensors.points[p]});
        if (found == measured.end()) continue;
        const double mean = result.rms.row(sensors.vertical(p)).mean();
        value_[result.run + "|" + result.event + "|" + sensors.points[p]] = 100.0 * (mean / found->second - 1.0);
      }
    }
  }
  [[nodiscard]] bool complete() const {
    for (const char* run : {"NS1", "NS2", "NS3"})
      for (const char* event : {"August", "April"})
        for (int m = 1; m <= 8; ++m)
          if (!value_.contains(fmt::format("{}|{}|M{}", run, event, m))) return false;
    return true;
  }
  [[nodiscard]] double at(const std::string& run, const std::string& event, int m) const {
    return value_.at(fmt::format("{}|{}|M{}", run, event, m));
  }
  [[nodiscard]] double mean_size(const std::string& run, const std::string& event, const std::vector<int>& channels) const {
    double sum = 0.0;
    for (const int m : channels) sum += std::abs(at(run, event, m)) / static_cast<double>(channels.size());
    return sum;
  }

 private:
  std::map<std::string, double> value_;
};

}  // namespace

std::vector<PaperStatement> paper_statements(const std::vector<RunResult>& results, const Sensors& sensors,
                                             const MeasuredRms& measured) {
  std::vector<PaperStatement> out;
  const Errors errors(results, sensors, measured);
  if (errors.complete()) {
    const std::vector<std::string> runs = {"NS1", "NS2", "NS3"};
    const std::vector<int> inner = {2, 3, 4, 5, 6, 7}, all = {1, 2, 3, 4, 5, 6, 7, 8}, ends = {1, 8};
    const auto put = [&](const std::string& statement, const std::string& found, bool holds) {
      out.push_back({statement, found, holds});
    };
    const auto counted = [&](const std::string& statement, const std::string& event, const std::vector<int>& channels,
                             bool over) {
      int holding = 0, cells = 0;
      for (const std::string& run : runs) {
        for (const int m : channels) {
          ++cells;
          if ((errors.at(run, event, m) > 0.0) == over) ++holding;
        }
      }
      put(statement, fmt::format("{} of {} cells", holding, cells), holding == cells);
    };
    const auto best = [&](const std::string& statement, const std::string& event, const std::vector<int>& channels,
                          const std::string& wanted) {
      std::vector<std::string> found;
      std::string least = runs.front();
      for (const std::string& run : runs) {
        found.push_back(fmt::format("{} {:.1f} %", run, errors.mean_size(run, event, channels)));
        if (errors.mean_size(run, event, channels) < errors.mean_size(least, event, channels)) least = run;
      }
      put(statement, fmt::format("mean |error| {}", fmt::join(found, ", ")), least == wanted);
    };
    counted("August is underestimated but for M1 and M8", "August", inner, false);
    counted("April is overestimated", "April", all, true);
    counted("M1 and M8, near the ramps, are overestimated in August", "August", ends, true);
    counted("M5, near one end, is overestimated in April", "April", {5}, true);
    best("NS 2 has the smallest error at M1 and M8 in August", "August", ends, "NS2");
    best("NS 2 overestimates M1 and M8 least in April", "April", ends, "NS2");
    best("NS 1 is closest in August", "August", inner, "NS1");
    best("NS 2 is the best approximation in April", "April", all, "NS2");
    double largest = 0.0;
    for (const std::string& run : runs)
      for (const int m : inner)
        if (!(run == "NS2" && m == 7)) largest = std::max(largest, std::abs(errors.at(run, "August", m)));
    put("Errors in August are below 26 % but for M7 in NS 2 (M1 and M8 aside)", fmt::format("largest {:.1f} %", largest),
        largest < 26.0);
  }
  return out;
}

}  // namespace twindeck::buffeting
