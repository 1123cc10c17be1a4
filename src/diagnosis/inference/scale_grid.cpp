#include "diagnosis/inference/scale_grid.hpp"

#include <cmath>
#include <numbers>

namespace twindeck::diagnosis {

namespace {

constexpr double kFormScale = 0.01;           // of the half-t priors: a carefully fitted model is off by about one per cent
constexpr double kStated = 0.7, kWide = 2.5;  // weight of scatter as stated; how much larger it else is

/// P(t <= x) - P(t <= -x) of Student's law with three degrees of freedom.
double half_t_below(double x) {
  const double z = x / std::sqrt(3.0);
  return 2.0 / std::numbers::pi * (z / (1.0 + z * z) + std::atan(z));
}

}  // namespace

Eigen::VectorXd half_t_weights(const Eigen::VectorXd& points, double scale) {
  Eigen::VectorXd weight(points.size());
  double below = 0.0;
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    const bool last = i + 1 == points.size();
    const double next = last ? 1.0 : half_t_below(std::sqrt(points[i] * points[i + 1]) / scale);
    weight[i] = next - below;
    below = next;
  }
  return weight;
}

ScaleGrid scale_grid() {
  ScaleGrid grid;
  grid.frequency.resize(6);
  grid.frequency << 0.0005, 0.002, 0.005, 0.012, 0.03, 0.08;
  grid.shape.resize(5);
  grid.shape << 0.002, 0.008, 0.03, 0.1, 0.3;
  grid.change.resize(6);
  grid.change << 0.0005, 0.002, 0.007, 0.025, 0.08, 0.2;
  const Eigen::VectorXd f = half_t_weights(grid.frequency, kFormScale), s = half_t_weights(grid.shape, kFormScale);
  for (const double scatter : {1.0, kWide})
    for (int i = 0; i < grid.frequency.size(); ++i)
      for (int j = 0; j < grid.shape.size(); ++j)
        grid.points.push_back({scatter, i, j, std::log((scatter == 1.0 ? kStated : 1.0 - kStated) * f[i] * s[j])});
  return grid;
}

Part leftover_part() { return {0, 5}; }
Part something_else_part() { return {1, 5}; }

}  // namespace twindeck::diagnosis
