#pragma once

#include <string>

/// The table of published problems: case, target, ours, digits of agreement.
namespace twindeck::verification {

/// Adds a row and, for `tolerance` > 0, expects |ours/target - 1| <= tolerance. Rows are printed when the program ends, and
/// written to <build>/verification/: <Suite>.<Test>.csv by each test, table.csv by a run of all.
void check(const std::string& problem, double target, double ours, double tolerance);
/// A row alone, of a weakness that is known, or whose test has an expectation of its own.
void record(const std::string& problem, double target, double ours);

/// -log10 |ours/target - 1|, at most 16; with target 0 of |ours|.
[[nodiscard]] double digits_of_agreement(double target, double ours);

}  // namespace twindeck::verification
