#include "fe/motion_words.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace twindeck::fe {

MotionWords words_of(const Eigen::VectorXd& motion, const std::vector<DofLabel>& dofs) {
  constexpr std::array<const char*, 6> direction_names = {"x", "y", "z", "rx", "ry", "rz"};
  Eigen::Index largest = 0;
  motion.cwiseAbs().maxCoeff(&largest);
  const DofLabel& worst = dofs[static_cast<std::size_t>(largest)];
  MotionWords words;
  words.node = "node " + worst.node;
  if (worst.x_m.allFinite()) words.place = fmt::format(" at ({:g}, {:g}, {:g}) m", worst.x_m.x(), worst.x_m.y(), worst.x_m.z());
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const double part = std::abs(motion[static_cast<Eigen::Index>(i)] / motion[largest]);
    if (dofs[i].node != worst.node || part < 0.1) continue;
    words.directions +=
        (words.directions.empty() ? "" : ", ") + std::string(direction_names[static_cast<std::size_t>(dofs[i].direction)]);
  }
  return words;
}

Eigen::VectorXd softest_motion(const linalg::Cholesky& factor, const Eigen::VectorXd& diagonal, int iterations) {
  Eigen::VectorXd x(diagonal.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = 1.0 + 0.5 * std::sin(1.7 * static_cast<double>(i));
  for (int i = 0; i < iterations; ++i) {
    x = factor.solve(diagonal.cwiseProduct(x));
    x /= x.cwiseAbs().maxCoeff();
  }
  return x;
}

}  // namespace twindeck::fe
