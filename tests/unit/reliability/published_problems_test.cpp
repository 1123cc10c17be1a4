/// Oracle: the table of docs/reliability.md, written by tests/bench/reliability.py. Its column of our values and calls is what
/// FORM and subset simulation give.
#include "published_problems.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace twindeck::reliability {
namespace {

/// Cells of the guide's table by "problem method".
std::map<std::string, std::vector<std::string>> guide_rows() {
  std::map<std::string, std::vector<std::string>> out;
  std::ifstream file(std::filesystem::path(TWINDECK_SOURCE_DIR) / "docs/reliability.md");
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line == "<!-- peers -->") inside = true;
    if (line == "<!-- end of peers -->") inside = false;
    if (!inside || line.rfind("| ", 0) != 0) continue;
    std::vector<std::string> cells;
    std::istringstream words(line.substr(2));
    for (std::string cell; std::getline(words, cell, '|');) {
      const std::size_t first = cell.find_first_not_of(' '), last = cell.find_last_not_of(' ');
      cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
    }
    if (cells.size() > 1) out[cells[0] + " " + cells[1]] = cells;
  }
  return out;
}

TEST(PublishedProblems, TheGuideTellsOurValuesAndCalls) {
  const auto rows = guide_rows();
  for (const published::Problem& problem : published::all()) {
    const FormResult nearest = form(problem.g, problem.n, published::design_point_alone());
    const published::MeanSubset subset = published::mean_subset(problem);
    for (const auto& [method, converged, probability, calls] :
         {std::tuple{"form", nearest.status.converged, nearest.probability, nearest.calls},
          {"subset", true, subset.probability, subset.calls}}) {
      const auto row = rows.find(problem.name + " " + method);
      ASSERT_NE(row, rows.end()) << problem.name << " " << method;
      EXPECT_EQ(row->second[3], converged ? fmt::format("{:.4e}", probability) : "does not converge") << row->first;
      EXPECT_EQ(row->second[5], converged ? std::to_string(calls) : "") << row->first;
    }
  }
}

}  // namespace
}  // namespace twindeck::reliability
