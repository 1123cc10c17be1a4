#include "diagnosis/residual_test.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/distributions.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Blocks = std::map<std::vector<int>, std::string>;  // positions among the training rows; equal blocks are merged

bool of_shape(const Row& row) { return row.type == RowType::shape || row.type == RowType::shape_imag; }

Blocks blocks_of(const Inference& inference) {
  const FeatureSet& features = inference.map().features();
  std::map<std::string, std::vector<int>> by_name;
  for (std::size_t i = 0; i < inference.training().size(); ++i) {
    const Row& row = features.rows[static_cast<std::size_t>(inference.training()[i])];
    const auto at = static_cast<int>(i);
    const std::string condition = features.condition_of(row).name;
    by_name["all rows in " + condition].push_back(at);
    by_name[name_of(row.type) + " in " + condition].push_back(at);
    by_name["every " + name_of(row.type)].push_back(at);
    const bool of_mode = of_shape(row) || row.type == RowType::frequency || row.type == RowType::damping;
    if (of_mode) by_name[name_of(row.type) + " of mode " + row.mode].push_back(at);
    if (row.channel >= 0 && of_shape(row))
      by_name["channel " + features.channels[static_cast<std::size_t>(row.channel)]].push_back(at);
  }
  Blocks blocks;
  const std::size_t most = inference.training().size() * 2 / 3;  // a larger block would repeat the test of all rows
  for (const auto& [name, rows] : by_name)
    if (rows.size() >= 2 && rows.size() <= most) blocks.emplace(rows, name);
  return blocks;
}

/// Number of free shape scales with all their rows in the block, so that other rows do not determine them.
int free_scales(const Inference& inference, const std::vector<int>& block) {
  std::set<int> rows;
  for (const int i : block) rows.insert(inference.training()[static_cast<std::size_t>(i)]);
  const auto inside = [&](const std::vector<int>& of) {
    return !of.empty() && std::ranges::all_of(of, [&](int r) { return rows.contains(r); });
  };
  int count = 0;
  for (const MeasuredMode& mode : inference.map().measured_modes())
    if (inside(mode.real_rows) && (mode.imag_rows.empty() || inside(mode.imag_rows))) count += mode.imag_rows.empty() ? 1 : 2;
  return count;
}

/// Slopes against a variable that differs between conditions: one direction for each mode in each state of the dampers.
struct Trends {
  std::string name;  ///< "frequency_Hz against temperature"
  int rows = 0;
  MatrixXd directions;  ///< (n_training × n_slopes) value of the variable minus its mean over the mode's rows
};

/// Value of a variable in a condition, on the scale in which effects are nearly linear.
using Variable = std::optional<double> (*)(const Condition&);
const std::vector<std::pair<std::string, Variable>>& variables() {
  static const std::vector<std::pair<std::string, Variable>> all = {
      {"temperature", [](const Condition& c) { return c.temperature_C; }},
      {"amplitude",
       [](const Condition& c) -> std::optional<double> {
         if (!c.amplitude_m || *c.amplitude_m <= 0.0) return std::nullopt;
         return std::log(*c.amplitude_m);
       }},
      {"wind", [](const Condition& c) { return c.wind_m_s; }},
      {"people", [](const Condition& c) { return c.people; }}};
  return all;
}

std::vector<Trends> trends_of(const Inference& inference) {
  const FeatureSet& features = inference.map().features();
  const auto row_of = [&](std::size_t i) -> const Row& {
    return features.rows[static_cast<std::size_t>(inference.training()[i])];
  };
  std::vector<Trends> all;
  for (const RowType type : {RowType::frequency, RowType::damping}) {
    for (const auto& [name, variable] : variables()) {
      std::map<std::pair<std::string, bool>, std::vector<std::pair<Eigen::Index, double>>> series;  // by mode and dampers
      for (std::size_t i = 0; i < inference.training().size(); ++i) {
        const Row& row = row_of(i);
        if (row.type != type) continue;
        const Condition& condition = features.condition_of(row);
        if (const auto v = variable(condition))
          series[{row.mode, condition.dampers_on.value_or(false)}].emplace_back(static_cast<Eigen::Index>(i), *v);
      }
      Trends trends{name_of(type) + " against " + name, 0, {}};
      std::vector<VectorXd> slopes;
      for (const auto& [of, points] : series) {
        double weights = 0.0, mean = 0.0;
        for (const auto& [at, v] : points) {
          const double std = row_of(static_cast<std::size_t>(at)).std, weight = std > 0.0 ? 1.0 / (std * std) : 1.0;
          weights += weight;
          mean += weight * v;
        }
        mean /= weights;
        VectorXd slope = VectorXd::Zero(static_cast<Eigen::Index>(inference.training().size()));
        for (const auto& [at, v] : points) slope[at] = v - mean;
        if (slope.norm() <= 1e-9 * (1.0 + std::abs(mean))) continue;  // all values are equal
        slopes.push_back(slope);
        trends.rows += static_cast<int>(points.size());
      }
      if (slopes.empty()) continue;
      trends.directions.resize(slopes.front().size(), static_cast<Eigen::Index>(slopes.size()));
      for (std::size_t k = 0; k < slopes.size(); ++k) trends.directions.col(static_cast<Eigen::Index>(k)) = slopes[k];
      all.push_back(std::move(trends));
    }
  }
  return all;
}

}  // namespace

ResidualTest residual_test(const Inference& inference, const Fit& fit) {
  ResidualTest test;
  test.statistic = fit.chi_squared;
  test.dof = inference.dof();
  test.p_value = chi_squared_tail(test.statistic, test.dof);
  if (fit.total_factor.size() == 0) return test;  // the model predicts none of the rows
  const auto lower = fit.total_factor.triangularView<Eigen::Lower>();
  const MatrixXd inverse_factor = lower.solve(MatrixXd::Identity(fit.whitened.size(), fit.whitened.size()));
  const VectorXd u = inverse_factor.transpose() * fit.whitened;
  const MatrixXd precision = inverse_factor.transpose() * inverse_factor;
  for (const auto& [rows, name] : blocks_of(inference)) {
    BlockMisfit block;
    block.name = name;
    block.rows = static_cast<int>(rows.size());
    block.dof = block.rows - free_scales(inference, rows);
    if (block.dof < 1) continue;
    const VectorXd of_block = u(rows);
    block.statistic = of_block.dot(precision(rows, rows).llt().solve(of_block));
    block.p_value = chi_squared_tail(block.statistic, block.dof);
    test.blocks.push_back(block);
  }
  for (const Trends& trends : trends_of(inference)) {
    const VectorXd along = trends.directions.transpose() * u;
    const MatrixXd variance = trends.directions.transpose() * precision * trends.directions;
    BlockMisfit block{trends.name, trends.rows, along.dot(variance.llt().solve(along)), static_cast<int>(along.size()), 1.0};
    block.p_value = chi_squared_tail(block.statistic, block.dof);
    test.blocks.push_back(block);
  }
  std::ranges::sort(test.blocks, [](const BlockMisfit& a, const BlockMisfit& b) {
    return std::tie(a.p_value, a.name) < std::tie(b.p_value, b.name);
  });
  if (!test.blocks.empty())
    test.block_p_value = std::min(1.0, static_cast<double>(test.blocks.size()) * test.blocks.front().p_value);
  return test;
}

void ResidualTest::take_total(double chi_squared, long degrees) {
  statistic = chi_squared;
  dof = static_cast<int>(degrees);
  p_value = chi_squared_tail(statistic, dof);
}

}  // namespace twindeck::diagnosis
