#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "aero/aeroelastic_system.hpp"
#include "dynamics/loaded_model.hpp"

namespace twindeck::reliability {

/// Changes of a bridge in wind by its random inputs.
struct WindVariation {
  Eigen::VectorXd parameter_change;  ///< (n_parameters) from the model's values, in the parameters' units
  double damping_ratio = 0.0;        ///< [-] structural, of every mode
  double aerodynamic_factor = 1.0;   ///< [-] of the aerodynamic set's level
  double damper_factor = 1.0;        ///< [-] of each damper's stiffness and damping
  double turbulence_factor = 1.0;    ///< [-] of the standard deviations of v' and w'
  double corrosion_factor = 1.0;     ///< [-] of the rate of corrosion; the model already has its loss at 1
};

/// A reduced structure whose parameters change within its own basis V:
///   K(p) = Lambda + sum p_i V' (dK/dtheta_i) V,   M(p) = I + sum p_i V' (dM/dtheta_i) V,
/// made diagonal again. Modes may change their shape within the span of V; the static shape under dead load stays.
class VariedStructure {
 public:
  /// @param structure   of the coordinates V, @param motions  of its strips
  /// @param vectors     (n × m) V over the free degrees of freedom, M-orthonormal
  /// @param parameters  positions of the parameters that vary
  VariedStructure(const dynamics::LoadedModel& loaded, aero::ReducedStructure structure, std::vector<aero::StripMotion> motions,
                  const Eigen::MatrixXd& vectors, const std::vector<int>& parameters);

  struct Varied {
    aero::ReducedStructure structure;
    std::vector<aero::StripMotion> motions;
    Eigen::MatrixXd turn;  ///< (m × m) old coordinates = turn · new ones; rows of sensors are multiplied by it
  };
  [[nodiscard]] Varied at(const WindVariation& variation) const;

  /// First-order change of M, C and K in the coordinates of a `Varied`: structural damping stays the same share of critical
  /// damping in every mode, C = 2 xi M^1/2 (M^-1/2 K M^-1/2)^1/2 M^1/2.
  struct Slope {
    Eigen::MatrixXd mass, damping, stiffness;  ///< (m × m)
  };
  /// @param parameter_change  in the parameters' units  @param log_damping  relative change of the damping ratio
  [[nodiscard]] Slope slope(const Varied& at, const Eigen::VectorXd& parameter_change, double log_damping) const;

 private:
  aero::ReducedStructure structure_;
  std::vector<aero::StripMotion> motions_;
  std::vector<Eigen::MatrixXd> stiffness_, mass_;  ///< (m × m) per unit of each parameter
};

/// Forces or strokes of members, as rows of sensors.
struct MemberRows {
  std::vector<std::string> names;
  Eigen::VectorXd area_m2, pull_N;  ///< of stays: section and static force (dead load and cable forces, no wind)
  Eigen::MatrixXd rows;             ///< (n_members × m) force [N] or elongation [m] per unit of each coordinate
};
/// Axial forces of the stays, E A/L times the elongation of the chord, with Dischinger's modulus at the static force.
/// @param vectors  (n × m) coordinates over the free degrees of freedom
[[nodiscard]] MemberRows stay_forces(const dynamics::LoadedModel& loaded, const Eigen::MatrixXd& vectors);
/// Elongations of the dampers between their ends; of one in series with a spring, of both together.
[[nodiscard]] MemberRows damper_strokes(const dynamics::LoadedModel& loaded, const Eigen::MatrixXd& vectors);

}  // namespace twindeck::reliability
