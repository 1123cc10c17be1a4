#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

/// Room diagnosis/features: load tests as vectors over the coordinates of a structure, whether all of them or a reduced basis.
/// Each support is a spring to the ground. A settlement s is therefore a force K_s z s on the structure, and the reaction is
/// the force of that spring.
namespace twindeck::diagnosis {

/// The translational springs of a support, K_s.
struct Ground {
  std::string support;     ///< location, "support:pier"
  int parameter = -1;      ///< parameter that scales its springs, -1 for none
  Eigen::VectorXd settle;  ///< (n) [N/m] K_s z: forces on the held structure if the ground rises by one metre
  Eigen::MatrixXd moved;   ///< (n × n_cases) [N] forces on the held structure by the movement of the ground in each load case
};

/// A channel that measures the force of a support on the structure along a direction d.
struct ForceGauge {
  int ground = -1;        ///< position in LoadTests::grounds; -1: the channel measures something else
  Eigen::VectorXd pull;   ///< (n) [N/m] K_s d
  double settle = 0.0;    ///< [N/m] d' K_s z
  Eigen::VectorXd moved;  ///< (n_cases) [N] force on a held structure by the movement of the ground in each load case
};

struct LoadTests {
  std::vector<std::string> cases;  ///< names, as in loads.csv
  Eigen::MatrixXd force;           ///< (n × n_cases) [N, N m]
  std::vector<Ground> grounds;
  Eigen::MatrixXd rotation, strain;  ///< (n_channels × n) [rad, -] per unit of each coordinate; rows of other channels are zero
  std::vector<ForceGauge> forces;    ///< (n_channels)
  [[nodiscard]] bool empty() const { return cases.empty(); }
};

/// How a support differs from the model in one condition.
struct GroundState {
  double factor = 1.0;     ///< of its stiffness
  double settled_m = 0.0;  ///< upwards
};

/// The same load tests in coordinates q of u = V q.  @param v  (n × r)
[[nodiscard]] LoadTests projected(const LoadTests& tests, const Eigen::MatrixXd& v);

/// Every load whose response a reduced basis has to hold: forces and movements of the cases, settlements of all supports, and
/// the vector `pull` of each force gauge, with which the gauge's force is exact to second order. (n × m)
[[nodiscard]] Eigen::MatrixXd loads_to_answer(const LoadTests& tests);

/// Forces of a load case, including those of the ground.  @param states  (n_grounds)  @return (n)
[[nodiscard]] Eigen::VectorXd load_of(const LoadTests& tests, Eigen::Index load_case, const std::vector<GroundState>& states);

/// Force of a support on the structure along the channel's direction [N].  @param q  (n) response to `load_of`
[[nodiscard]] double force_of(const LoadTests& tests, Eigen::Index channel, Eigen::Index load_case,
                              const std::vector<GroundState>& states, const Eigen::VectorXd& q);

}  // namespace twindeck::diagnosis
