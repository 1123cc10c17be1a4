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
};
[[nodiscard]] CommonRows common_rows(const ShapeRows& first, const ShapeRows& second);

/// Change of the rows as two shapes turn into each other, per radian.
struct ShapeTurn {
  Eigen::VectorXd together;  ///< (n_rows) what each shape gains of the other at its own size, where both were read
  Eigen::VectorXd alone;     ///< (n_rows) standard deviation where only one was read: as large as that shape is on average
};
/// @param values  (n_rows) of all rows
[[nodiscard]] ShapeTurn turn_of_shapes(const ShapeRows& low, const ShapeRows& high, const Eigen::VectorXd& values);

}  // namespace twindeck::diagnosis
