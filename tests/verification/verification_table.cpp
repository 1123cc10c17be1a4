#include "verification_table.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <vector>

#include "io/csv.hpp"
#include "test_places.hpp"

namespace twindeck::verification {

namespace {

struct Row {
  std::string problem;
  double target, ours;
};

/// Rows by test, in the order of the tests' names.
std::map<std::string, std::vector<Row>>& rows() {
  static std::map<std::string, std::vector<Row>> all;
  return all;
}

std::filesystem::path folder() { return std::filesystem::path(TWINDECK_BINARY_DIR) / "verification"; }

void write(const std::filesystem::path& file, const std::vector<Row>& table) {
  io::CsvWriter csv({"case", "target", "ours", "digits_of_agreement"});
  for (const Row& row : table)
    csv.row({row.problem, row.target, row.ours, std::round(100.0 * digits_of_agreement(row.target, row.ours)) / 100.0});
  csv.save(file);
}

/// Prints and writes when all tests have run.
class Printer : public ::testing::Environment {
 public:
  void TearDown() override {
    std::vector<Row> table;
    std::filesystem::create_directories(folder());
    for (const auto& [test, part] : rows()) {
      write(folder() / (test + ".csv"), part);
      table.insert(table.end(), part.begin(), part.end());
    }
    if (table.empty()) return;
    fmt::print("\n{:<72} {:>14} {:>14} {:>7}\n", "case", "target", "ours", "digits");
    for (const Row& row : table)
      fmt::print("{:<72} {:>14.6g} {:>14.6g} {:>7.1f}\n", row.problem, row.target, row.ours,
                 digits_of_agreement(row.target, row.ours));
    if (rows().size() > 1) write(folder() / "table.csv", table);
  }
};

const ::testing::Environment* const kPrinter = ::testing::AddGlobalTestEnvironment(new Printer);

}  // namespace

double digits_of_agreement(double target, double ours) {
  const double error = target == 0.0 ? std::abs(ours) : std::abs(ours / target - 1.0);
  return -std::log10(std::max(error, 1e-16));
}

void record(const std::string& problem, double target, double ours) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(info->test_suite_name()) + "." + info->name();
  for (char& c : name)
    if (c == '/') c = '_';
  rows()[name].push_back({problem, target, ours});
}

void check(const std::string& problem, double target, double ours, double tolerance) {
  record(problem, target, ours);
  if (tolerance <= 0.0) return;
  const double scale = target == 0.0 ? 1.0 : std::abs(target);
  EXPECT_LE(std::abs(ours - target) / scale, tolerance) << problem << ": target " << target << ", ours " << ours;
}

}  // namespace twindeck::verification
