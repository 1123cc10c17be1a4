#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <vector>

/// Private to src/diagnosis: all modes of a pair (K, M), and the roots of the damped problem in their coordinates.
namespace twindeck::diagnosis {

/// Every mode of K psi = lambda M psi, scaled to psi' K psi = 1, psi' M psi = mu = 1/lambda, so that motion without mass (mu =
/// 0) is one of them and the modes span everything. A structure that is free as a rigid body is held by `shift` M.
struct UndampedModes {
  Eigen::MatrixXd stiffness, mass;  ///< (n × n) what they belong to
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

/// Modes by the matrices that they belong to: states that differ in their dampers alone share one.
class UndampedStore {
 public:
  /// @param shared  looked into first, never changed; may be null
  explicit UndampedStore(const UndampedStore* shared = nullptr) : shared_(shared) {}
  /// @param highest  omega² below which all modes are wanted; by default every mode, as damped ones need
  const UndampedModes& of(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                          double highest = std::numeric_limits<double>::infinity());

 private:
  const UndampedStore* shared_;
  std::vector<std::shared_ptr<const UndampedModes>> known_;
};

}  // namespace twindeck::diagnosis
