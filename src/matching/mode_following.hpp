#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/eigenmodes.hpp"
#include "linalg/sparse.hpp"

namespace twindeck::matching {

/// Positions of the reference modes at other parameter values.
struct FollowedModes {
  std::vector<int> position;  ///< (n_reference) position among the new modes, -1 without a partner
  Eigen::VectorXd mac;        ///< (n_reference) mass-weighted MAC of each pair [-], 0 without a partner
};

/// The same for shapes that are already normalised, both given in the same coordinates.
/// @param mass_reference (r × n_reference)  @param shapes (r × n_new)
[[nodiscard]] FollowedModes follow_normalised(const Eigen::MatrixXd& mass_reference, const Eigen::MatrixXd& shapes);

/// Mode tracking: identifies the modes of the start model after a change of parameters, by shape and not by order. Modes whose
/// frequencies cross during the updating then keep their measured partners.
///
///   MAC_ij = (phi_i' M phi_j)² / ((phi_i' M phi_i)(phi_j' M phi_j)),  M = mass of the start model,
///
/// assigned one-to-one so that the sum of MAC is largest. The new shapes are normalised with the mass of their own parameters.
/// They are therefore scaled to M first; otherwise a density that falls by 30 % would look like a change of shape.
class ModeFollower {
 public:
  /// @param mass_lower  lower triangle of the start model's mass (n × n)
  /// @param reference   its modes, mass-normalised
  ModeFollower(const linalg::SparseMatrix& mass_lower, const dynamics::EigenModes& reference);

  /// @param shapes (n × n_new)
  [[nodiscard]] FollowedModes follow(const Eigen::Ref<const Eigen::MatrixXd>& shapes) const;
  /// M phi (n × n_reference).
  [[nodiscard]] const Eigen::MatrixXd& mass_reference() const { return mass_reference_; }
  /// The start model's mass (lower triangle).
  [[nodiscard]] const linalg::SparseMatrix& mass() const { return mass_; }

 private:
  linalg::SparseMatrix mass_;
  Eigen::MatrixXd mass_reference_;  // M phi (n × n_reference)
};

}  // namespace twindeck::matching
