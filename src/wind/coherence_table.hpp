#pragma once

#include <Eigen/Core>

namespace twindeck::wind {

/// A measured coherence of one component, the root of the squared one with its sign, over the reduced separation
/// x = f sqrt(sum_a (C_a d_a)²) / V. With decays C_a of 1, x is f d / V. The exponential law is exp(-x). Values between two
/// points are linear in x, and beyond the last point they are 0.
class CoherenceTable {
 public:
  /// @param x  (k) ascending from 0  @param gamma  (k) from 1 at x = 0, within [-1, 1]; at least two points
  CoherenceTable(Eigen::VectorXd x, Eigen::VectorXd gamma);
  [[nodiscard]] double at(double x) const;

 private:
  Eigen::VectorXd x_, gamma_;
};

}  // namespace twindeck::wind
