#include "diagnosis/residual_test.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <map>
#include <set>

namespace twindeck::diagnosis {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Blocks = std::map<std::vector<int>, std::string>;  // positions among the training rows: equal blocks are one

bool of_shape(const Row& row) { return row.type == RowType::shape || row.type == RowType::shape_imag; }

Blocks blocks_of(const Inference& inference) {
  const FeatureSet& features = inference.map().features();
  std::map<std::string, std::vector<int>> by_name;
  for (std::size_t i = 0; i < inference.training().size(); ++i) {
    const Row& row = features.rows[static_cast<std::size_t>(inference.training()[i])];
    const auto at = static_cast<int>(i);
    const std::string condition = features.conditions[static_cast<std::size_t>(row.condition)].name;
    by_name["all rows in " + condition].push_back(at);
    by_name[name_of(row.type) + " in " + condition].push_back(at);
    by_name["every " + name_of(row.type)].push_back(at);
    const bool of_mode = of_shape(row) || row.type == RowType::frequency || row.type == RowType::damping;
    if (of_mode) by_name[name_of(row.type) + " of mode " + row.mode].push_back(at);
    if (row.channel >= 0 && of_shape(row))
      by_name["channel " + features.channels[static_cast<std::size_t>(row.channel)]].push_back(at);
  }
  Blocks blocks;
  const std::size_t most = inference.training().size() * 2 / 3;  // more than that is the test of all rows again
  for (const auto& [name, rows] : by_name)
    if (rows.size() >= 2 && rows.size() <= most) blocks.emplace(rows, name);
  return blocks;
}

/// Free scales of shapes whose every row is in the block: nothing outside says what they are.
int free_scales(const Inference& inference, const std::vector<int>& block) {
  std::set<int> rows;
  for (const int i : block) rows.insert(inference.training()[static_cast<std::size_t>(i)]);
  const auto inside = [&](const std::vector<int>& of) {
    return !of.empty() && std::all_of(of.begin(), of.end(), [&](int r) { return rows.contains(r); });
  };
  int count = 0;
  for (const MeasuredMode& mode : inference.map().measured_modes())
    if (inside(mode.real_rows) && (mode.imag_rows.empty() || inside(mode.imag_rows))) count += mode.imag_rows.empty() ? 1 : 2;
  return count;
}

}  // namespace

ResidualTest residual_test(const Inference& inference, const Fit& fit) {
  ResidualTest test;
  test.statistic = fit.chi_squared;
  test.dof = inference.dof();
  test.p_value = chi_squared_tail(test.statistic, test.dof);
  if (fit.total_factor.size() == 0) return test;  // a model that predicts none of the rows
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
  std::sort(test.blocks.begin(), test.blocks.end(), [](const BlockMisfit& a, const BlockMisfit& b) {
    return std::tie(a.p_value, a.name) < std::tie(b.p_value, b.name);
  });
  if (!test.blocks.empty())
    test.block_p_value = std::min(1.0, static_cast<double>(test.blocks.size()) * test.blocks.front().p_value);
  return test;
}

}  // namespace twindeck::diagnosis
