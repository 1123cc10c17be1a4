#pragma once

#include <Eigen/Core>
#include <vector>

namespace twindeck::diagnosis {

/// Rows of a measured shape and the channels that they were read at, in any order.
struct ShapeRows {
  const std::vector<int>&rows, &channels;
};

/// Rows of two shapes that were read at the same channels, in the order of the first.
struct CommonRows {
  std::vector<int> first, second;
  bool most = false;  ///< three quarters of the rows of either shape at least. With fewer, shapes are alike by chance
};
[[nodiscard]] CommonRows common_rows(const ShapeRows& first, const ShapeRows& second);

/// Change of the rows as two shapes turn into each other, per radian. Zero where few rows are common: what the turn does to the
/// others is then unknown for most of the shape, and an error of their size would leave nothing of it.
struct ShapeTurn {
  Eigen::VectorXd together;  ///< (n_rows) what each shape gains of the other at its own size, where both were read
  Eigen::VectorXd alone;     ///< (n_rows) standard deviation where only one was read: as large as that shape is on average
};
/// @param values  (n_rows) of all rows
[[nodiscard]] ShapeTurn turn_of_shapes(const ShapeRows& low, const ShapeRows& high, const Eigen::VectorXd& values);

}  // namespace twindeck::diagnosis
