#pragma once

#include <Eigen/Core>
#include <deque>
#include <memory>
#include <vector>

#include "dynamics/eigenmodes.hpp"
#include "fe/parametric_system.hpp"
#include "matching/mode_following.hpp"
#include "updating/updating.hpp"

namespace twindeck::updating {

/// Definition of the updating problem, the same for every start and every prestress: targets, parameters, reference modes.
struct ResidualDefinition {
  std::vector<FrequencyTarget> targets;
  std::vector<int> active;  ///< positions of the updated parameters
  Eigen::VectorXd initial;  ///< (n_parameters) values of the parameters that are not updated
  Eigen::VectorXd scale;    ///< (n_active) parameter = scale · x: the initial value's size, or the range where it is 0
  int n_modes = 0;          ///< modes solved for
  std::shared_ptr<const matching::ModeFollower> follower;

  /// All parameters at normalised values of the active ones.
  [[nodiscard]] Eigen::VectorXd theta(const Eigen::VectorXd& x) const;
};

/// Residuals at one point.
struct Evaluation {
  bool valid = false;            ///< false: modes not found here (mechanism, lost mode); the step must be refused
  Eigen::VectorXd x;             ///< (n_active)
  Eigen::VectorXd residual;      ///< (n_targets) (f_N - f_X)/f_X [-]; 0 for a target that is not fitted
  Eigen::MatrixXd jacobian;      ///< (n_targets × n_active) per normalised parameter; empty until asked for
  Eigen::VectorXd frequency_Hz;  ///< (n_targets) of the followed modes
  std::vector<int> mode;         ///< (n_targets) positions of the followed modes
  Eigen::VectorXd mac;           ///< (n_targets) with the reference modes
  [[nodiscard]] double cost() const { return 0.5 * residual.squaredNorm(); }
  [[nodiscard]] Eigen::VectorXd gradient() const { return jacobian.transpose() * residual; }
};

/// Relative frequency residuals, paper Eq. (5), of one frozen system as a function of normalised parameters x = p/p0:
///   r_i(x) = (f_i(x) - f_X,i)/f_X,i,   dr_i/dx_j = (p0_j/f_X,i) df_i/dp_j.
/// Residual and Jacobian at one point share one eigen-solve. The last points are kept, because a refused step returns to an
/// earlier point. Each thread needs its own object, which holds a solver.
class FrequencyResiduals {
 public:
  FrequencyResiduals(std::shared_ptr<const fe::ParametricSystem> system, const ResidualDefinition& definition);

  /// @param x (n_active) @param with_jacobian  fills `jacobian`. The reference holds until the next call.
  const Evaluation& at(const Eigen::VectorXd& x, bool with_jacobian);
  [[nodiscard]] int solves() const { return solves_; }

 private:
  void solve(Evaluation& evaluation);
  void differentiate(Evaluation& evaluation);

  std::shared_ptr<const fe::ParametricSystem> system_;
  const ResidualDefinition& definition_;
  dynamics::ModalSolver solver_;
  std::deque<Evaluation> cache_;  // newest first
  Eigen::VectorXd modes_x_;       // point that modes_ belongs to
  dynamics::EigenModes modes_;
  int solves_ = 0;
};

}  // namespace twindeck::updating
