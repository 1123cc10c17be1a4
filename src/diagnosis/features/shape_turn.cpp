#include "diagnosis/features/shape_turn.hpp"

#include <algorithm>
#include <cmath>

namespace twindeck::diagnosis {

namespace {

using Eigen::VectorXd;

constexpr double kMost = 0.75;  // [-] least share of the longer shape's rows that must be common

double squares(const std::vector<int>& rows, const VectorXd& values) {
  double sum = 0.0;
  for (const int r : rows) sum += values[r] * values[r];
  return sum;
}

/// Sets the deviation of rows that only one shape has. The other shape's values are unknown there; its size is taken as equal
/// to that of the shape that was read.
void set_alone(const std::vector<int>& rows, const std::vector<int>& common, const VectorXd& values, VectorXd& alone) {
  if (rows.size() == common.size()) return;
  const double size = std::sqrt(squares(rows, values) / static_cast<double>(rows.size()));
  for (const int r : rows)
    if (std::ranges::find(common, r) == common.end()) alone[r] = size;
}

}  // namespace

CommonRows common_rows(const ShapeRows& first, const ShapeRows& second) {
  CommonRows out;
  for (std::size_t k = 0; k < first.rows.size(); ++k) {
    const auto at = std::ranges::find(second.channels, first.channels[k]);
    if (at == second.channels.end()) continue;
    out.first.push_back(first.rows[k]);
    out.second.push_back(second.rows[static_cast<std::size_t>(at - second.channels.begin())]);
  }
  const std::size_t longer = std::max(first.rows.size(), second.rows.size());
  out.most = longer > 0 && static_cast<double>(out.first.size()) >= kMost * static_cast<double>(longer);
  return out;
}

ShapeTurn turn_of_shapes(const ShapeRows& low, const ShapeRows& high, const VectorXd& values) {
  ShapeTurn out{VectorXd::Zero(values.size()), VectorXd::Zero(values.size())};
  const CommonRows common = common_rows(low, high);
  if (!common.most) return out;
  const double of_low = squares(common.first, values), of_high = squares(common.second, values);
  if (of_low > 0.0 && of_high > 0.0) {
    const double ratio = std::sqrt(of_low / of_high);
    for (std::size_t k = 0; k < common.first.size(); ++k) {
      out.together[common.first[k]] = values[common.second[k]] * ratio;
      out.together[common.second[k]] = -values[common.first[k]] / ratio;
    }
  }
  set_alone(low.rows, common.first, values, out.alone);
  set_alone(high.rows, common.second, values, out.alone);
  return out;
}

}  // namespace twindeck::diagnosis
