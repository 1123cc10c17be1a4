#pragma once

#include <Eigen/Core>
#include <vector>

namespace twindeck::diagnosis {

/// Rows of a measured shape with their channels, in any order.
struct ShapeRows {
  const std::vector<int>&rows, &channels;
};

/// Rows of two shapes at the same channels, in the order of the first.
struct CommonRows {
  std::vector<int> first, second;
  bool most = false;  ///< at least three quarters of either shape's rows are common
};
[[nodiscard]] CommonRows common_rows(const ShapeRows& first, const ShapeRows& second);

/// Change of the rows if two shapes rotate into each other, per radian. Zero if few rows are common: the change is then unknown
/// for most of the shape, and its deviation would make the shape useless.
struct ShapeTurn {
  Eigen::VectorXd together;  ///< (n_rows) part of the other shape, scaled to the same size, where both were read
  Eigen::VectorXd alone;     ///< (n_rows) standard deviation where only one was read: the mean size of that shape
};
/// @param values  (n_rows) of all rows
[[nodiscard]] ShapeTurn turn_of_shapes(const ShapeRows& low, const ShapeRows& high, const Eigen::VectorXd& values);

}  // namespace twindeck::diagnosis
