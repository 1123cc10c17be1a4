#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

/// Private to src/diagnosis: all modes of a pair (K, M), and the roots of the damped problem in their coordinates.
namespace twindeck::diagnosis {

/// Every mode of K psi = lambda M psi, scaled to psi' K psi = 1, psi' M psi = mu = 1/lambda, so that motion without mass (mu =
/// 0) is one of them and the modes span everything. A structure that is free as a rigid body is held by `shift` M.
struct UndampedModes {
  Eigen::MatrixXd stiffness, mass;  ///< (n × n) what they belong to
  double shift = 0.0;               ///< psi' (K + shift M) psi = 1
  Eigen::VectorXd mu;               ///< (n) descending
  Eigen::MatrixXd shapes;           ///< (n × n)

  UndampedModes(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);
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
  const UndampedModes& of(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);

 private:
  const UndampedStore* shared_;
  std::vector<std::shared_ptr<const UndampedModes>> known_;
};

}  // namespace twindeck::diagnosis
