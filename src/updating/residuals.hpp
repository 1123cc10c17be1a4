#pragma once

#include <Eigen/Core>
#include <deque>
#include <memory>
#include <vector>

#include "dynamics/eigenmodes.hpp"
#include "fe/parametric_system.hpp"
#include "matching/mode_following.hpp"
#include "updating/prior.hpp"
#include "updating/updating.hpp"
#include "updating/weighted_rows.hpp"

namespace twindeck::updating {

/// Modes of the start model, which each search begins with or compares with.
struct StartModes {
  std::shared_ptr<const fe::ParametricSystem> system;  ///< prestress of the initial values
  Eigen::VectorXd theta;                               ///< (n_parameters) initial values
  dynamics::EigenModes modes;
};

/// Definition of the updating problem, the same for every start and every prestress: targets, parameters, reference modes.
struct ResidualDefinition {
  std::vector<FrequencyTarget> targets;
  std::vector<int> active;  ///< positions of the updated parameters
  Eigen::VectorXd initial;  ///< (n_parameters) values of the parameters that are not updated
  Eigen::VectorXd scale;    ///< (n_active) parameter = scale · x: the initial value's size, or the range where it is 0
  int n_modes = 0;          ///< modes solved for
  std::shared_ptr<const matching::ModeFollower> follower;
  std::shared_ptr<const StartModes> start;       ///< null: the modes are computed where needed
  std::shared_ptr<const WeightedRows> weighted;  ///< null: relative frequencies, Eq. (5)
  Prior prior;                                   ///< of the parameters, whose rows come behind the others; none by default

  /// All parameters at normalised values of the active ones.
  [[nodiscard]] Eigen::VectorXd theta(const Eigen::VectorXd& x) const;
  /// Those of the start model where they are known, else solved for. @param solves  counts the solutions
  [[nodiscard]] dynamics::EigenModes modes_at(const Eigen::VectorXd& x, dynamics::ModalSolver& solver, int& solves) const;
  [[nodiscard]] int n_residuals() const {
    return (weighted ? weighted->size() : static_cast<int>(targets.size())) + static_cast<int>(prior.mean.size());
  }
  /// Residuals below this size have no meaning. For relative frequencies it is far below any measurement error; for weighed
  /// rows it is one standard deviation of all rows together.
  [[nodiscard]] double negligible_residual() const { return weighted ? 1.0 : 1e-4; }
  /// Unit of the residuals in a search that begins with this Jacobian. Relative frequencies have the unit 1. Weighed rows grow
  /// as their standard deviations shrink, so their unit is the norm of the Jacobian: a common factor on all deviations then
  /// does not change the search.
  [[nodiscard]] double residual_unit(const Eigen::MatrixXd& jacobian) const;
};

/// Residuals at one point: (f_N - f_X)/f_X [-] of each target, 0 for one that is not fitted, or those of the weighed rows. The
/// rows of the prior come last.
struct Evaluation : Linearised {
  bool valid = false;                  ///< false: modes not found here (mechanism, lost mode); the step must be refused
  Eigen::VectorXd x;                   ///< (n_active)
  Eigen::VectorXd frequency_Hz;        ///< (n_targets) of the followed modes
  std::vector<int> mode;               ///< (n_targets) positions of the followed modes
  Eigen::VectorXd mac;                 ///< (n_targets) with the reference modes
  std::vector<std::vector<int>> span;  ///< (n_targets) positions of the modes that span each shape; empty without shapes
  [[nodiscard]] double cost() const { return 0.5 * residual.squaredNorm(); }
  [[nodiscard]] Eigen::VectorXd gradient() const { return jacobian.transpose() * residual; }
};

/// Residuals of one frozen system as a function of normalised parameters x = p/p0: relative frequencies, paper Eq. (5),
///   r_i(x) = (f_i(x) - f_X,i)/f_X,i,   dr_i/dx_j = (p0_j/f_X,i) df_i/dp_j,
/// or, where the definition weighs rows, frequencies and shapes in standard deviations (weighted_rows.hpp). Residual and
/// Jacobian at one point share one eigen-solve. The last points are kept, because a refused step returns to an earlier point.
/// Each thread needs its own object, which holds a solver.
class ModalResiduals {
 public:
  ModalResiduals(std::shared_ptr<const fe::ParametricSystem> system, const ResidualDefinition& definition);

  /// @param x (n_active) @param with_jacobian  fills `jacobian`. The reference holds until the next call.
  const Evaluation& at(const Eigen::VectorXd& x, bool with_jacobian);
  [[nodiscard]] int solves() const { return solves_; }

 private:
  void find_modes(const Eigen::VectorXd& x);
  void solve(Evaluation& evaluation);
  void differentiate(Evaluation& evaluation);
  /// Replaces the residuals by those of the weighed rows. @return false if a mode of a span is lost
  bool weigh(Evaluation& evaluation, const std::vector<int>& position);
  void differentiate_weighted(Evaluation& evaluation, const Eigen::MatrixXd& frequency_jacobian);

  std::shared_ptr<const fe::ParametricSystem> system_;
  const ResidualDefinition& definition_;
  dynamics::ModalSolver solver_;
  std::deque<Evaluation> cache_;  // newest first
  Eigen::VectorXd modes_x_;       // point that modes_ belongs to
  dynamics::EigenModes modes_;
  int solves_ = 0;
};

}  // namespace twindeck::updating
