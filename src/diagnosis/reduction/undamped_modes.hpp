#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <vector>

/// Private to src/diagnosis: all modes of a pair (K, M), and the roots of the damped problem in their coordinates.
namespace twindeck::diagnosis {

/// Every mode of K psi = lambda M psi, scaled to psi' K psi = 1, psi' M psi = mu = 1/lambda, so that motions without mass (mu =
/// 0) are included and the modes span all motions. `shift` M holds a structure that is free to move as a rigid body.
struct UndampedModes {
  Eigen::MatrixXd stiffness, mass;  ///< (n × n) the matrices of these modes
  double shift = 0.0;               ///< psi' (K + shift M) psi = 1
  double highest = 0.0;             ///< omega² up to which the modes were computed, infinite for all
  Eigen::VectorXd mu;               ///< (n_modes) descending
  Eigen::MatrixXd shapes;           ///< (n × n_modes)

  UndampedModes(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass, double highest);
  [[nodiscard]] Eigen::Index size() const { return mu.size(); }
  /// omega² of mode i; infinite for motion without mass.
  [[nodiscard]] double eigenvalue(Eigen::Index i) const;
  [[nodiscard]] bool belongs_to(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m) const;
};

/// Modes stored by their matrices, so that states that differ only in dampers share them.
class UndampedStore {
 public:
  /// @param shared  searched first, never changed; may be null
  explicit UndampedStore(const UndampedStore* shared = nullptr) : shared_(shared) {}
  /// @param highest  omega² below which all modes are needed; by default all modes, as for damped states
  const UndampedModes& of(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                          double highest = std::numeric_limits<double>::infinity());

 private:
  const UndampedStore* shared_;
  std::vector<std::shared_ptr<const UndampedModes>> known_;
};

}  // namespace twindeck::diagnosis
