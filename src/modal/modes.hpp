#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace twindeck::modal {

/// A degree of freedom at which a shape is known: a point (node or sensor position) and a direction x|y|z|rx|ry|rz or a channel
/// name.
struct ShapeDof {
  std::string point;
  std::string direction;
  bool operator==(const ShapeDof&) const = default;
};

/// Modes of a model or of a measurement. Both use this struct, so that they can be compared directly.
struct ModeSet {
  std::vector<std::string> names;     ///< "1", "2", … or "1X"
  Eigen::VectorXd frequency_Hz;       ///< (n_modes)
  Eigen::VectorXd frequency_std_Hz;   ///< (n_modes), NaN where unknown
  Eigen::VectorXd damping_ratio;      ///< (n_modes) [-], NaN where unknown
  Eigen::VectorXd damping_ratio_std;  ///< (n_modes) [-], NaN where unknown
  std::vector<ShapeDof> dofs;         ///< rows of `shapes`; empty where no shape is known
  Eigen::MatrixXcd shapes;            ///< (n_dofs × n_modes)
  [[nodiscard]] Eigen::Index size() const { return frequency_Hz.size(); }
  [[nodiscard]] bool has_shapes() const { return !dofs.empty(); }
};

}  // namespace twindeck::modal
