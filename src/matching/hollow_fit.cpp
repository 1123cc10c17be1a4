#include "matching/hollow_fit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "modal/mac.hpp"

namespace twindeck::matching {

namespace {

using Eigen::Index;

constexpr double one_shape_mac = 0.95;       ///< [-] MAC above which two measured shapes count as one
constexpr Index fewest_shared_channels = 3;  ///< at two channels a MAC of 1 is common between different modes

/// MAC over the channels that both shapes have; 0 with fewer than three.
double shared_mac(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  std::vector<Index> both;
  for (const Index row : modal::measured_rows(a))
    if (!std::isnan(b[row].real())) both.push_back(row);
  if (static_cast<Index>(both.size()) < fewest_shared_channels) return 0.0;
  const Eigen::MatrixXcd first = a(both), second = b(both);
  if (first.squaredNorm() == 0.0 || second.squaredNorm() == 0.0) return 0.0;
  return modal::mac(first, second)(0, 0);
}

}  // namespace

std::vector<std::string> worse_shapes(const std::vector<ComparisonRow>& comparison) {
  std::vector<std::string> worse;
  for (const ComparisonRow& after : comparison) {
    if (after.stage != "after" || !after.mac) continue;
    const auto before = std::ranges::find_if(
        comparison, [&](const ComparisonRow& row) { return row.stage == "before" && row.experimental == after.experimental; });
    if (before == comparison.end() || !before->mac || !(*before->mac - *after.mac > lost_mac)) continue;
    if (!(std::abs(after.error_pct()) < std::abs(before->error_pct()))) continue;
    worse.push_back(fmt::format("{}-{} (MAC {:.3f} to {:.2f}, frequency error {:.2f} to {:.2f} %)", after.experimental,
                                after.numerical, *before->mac, *after.mac, std::abs(before->error_pct()),
                                std::abs(after.error_pct())));
  }
  return worse;
}

std::vector<std::string> shared_shapes(const Measured& measured, const std::vector<ComparisonRow>& comparison) {
  std::vector<Index> used;
  for (Index i = 0; i < measured.modes.size(); ++i)
    if (std::ranges::any_of(comparison, [&](const ComparisonRow& row) {
          return row.stage == "after" && row.experimental == measured.labels[static_cast<std::size_t>(i)];
        }))
      used.push_back(i);
  std::vector<std::string> found;
  if (!measured.modes.has_shapes()) return found;
  for (std::size_t i = 0; i < used.size(); ++i)
    for (std::size_t j = i + 1; j < used.size(); ++j) {
      const double alike = shared_mac(measured.modes.shapes.col(used[i]), measured.modes.shapes.col(used[j]));
      if (alike > one_shape_mac)
        found.push_back(fmt::format("{} and {} (MAC {:.2f})", measured.labels[static_cast<std::size_t>(used[i])],
                                    measured.labels[static_cast<std::size_t>(used[j])], alike));
    }
  return found;
}

void warn_of_hollow_fit(Reporter& reporter, const Measured& measured, const std::vector<ComparisonRow>& comparison,
                        const std::vector<std::string>& on_bounds) {
  if (const auto worse = worse_shapes(comparison); !worse.empty())
    reporter.warn(
        fmt::format("shapes became worse while frequencies came nearer: {}: the parameters bend the model to the frequencies; "
                    "what is wrong is likely to be something else (s9_diagnosis)",
                    fmt::join(worse, ", ")));
  if (const auto shared = shared_shapes(measured, comparison); !shared.empty())
    reporter.warn(
        fmt::format("measured modes share one shape at the sensors: {}: one of them may be no mode, or the sensors cannot tell "
                    "them apart; leave one out, or measure at more points",
                    fmt::join(shared, ", ")));
  if (!on_bounds.empty())
    reporter.warn(
        fmt::format("on a bound: {}: the data would push the value further, so that it says where the bound was put; ask "
                    "whether the bound is right, or something else is missing in the model",
                    fmt::join(on_bounds, ", ")));
}

}  // namespace twindeck::matching
