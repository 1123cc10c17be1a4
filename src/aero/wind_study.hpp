#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "aero/follow_mode.hpp"
#include "aero/wind_model.hpp"
#include "linalg/cholesky.hpp"

/// A model in mean wind: instabilities, damping over the wind speed, static response (paper section 5.1, Tables 11, 12, Fig.
/// 20).
namespace twindeck::aero {

/// A set of aerodynamic data at its fitted level.
struct FittedSet {
  std::string name;
  double level;
  std::vector<SectionAero> sections;
};

/// The lowest instability of the first modes, and the modes that could not be followed so far: a later mode only matters below
/// the speed that was found.
struct Instability {
  std::optional<CriticalPoint> point;
  std::string lost;
};
[[nodiscard]] Instability first_instability(const WindSettings& config, const AeroelasticSystem& system);

/// One row of critical.csv: a set, a rule, a structure.
struct CriticalRow {
  std::string set, model, group, description;
  bool dampers = false;
  double structural_damping = 0.0;
  std::optional<CriticalPoint> point;
  std::string lost;                       ///< of modes that could not be followed to the highest speed, or to `point`
  GallopingCharacter character;           ///< of `point`
  std::optional<double> single_mode_m_s;  ///< mode 1 alone, without coupling to the others
  std::optional<double> den_hartog_m_s;   ///< mode 1 by quasi-steady galloping of the polars
  std::optional<double> divergence_m_s;
};

struct DampingCurves {
  std::string set, model;
  bool dampers = false;
  double structural_damping = 0.0;
  std::vector<Branch> branches;
};

/// Static response to the mean wind (Eq. 7) at the aerodynamic nodes.
struct StaticResponse {
  std::string set, model;
  std::vector<Eigen::Vector3d> force;         ///< (D, L, M) of each strip along its rule's axes [N, N, N m]
  std::vector<Eigen::Vector3d> displacement;  ///< [m]
  std::vector<double> rotation_rad;           ///< nose-up
};

/// Largest differences between two rules' static responses: what the paper states of NS #1 and NS #2 (Eq. 7).
struct StaticDifference {
  double displacement_m = 0.0, rotation_rad = 0.0;
};

/// Critical speeds and damping curves of all sets.
struct Instabilities {
  std::vector<CriticalRow> critical;
  std::vector<DampingCurves> damping;
};
/// Critical speeds of every set and rule; of the fitted rule also damping over the wind speed, with the identified damping, and
/// with dampers where there are any.
[[nodiscard]] Instabilities find_instabilities(const WindSettings& config, const std::vector<FittedSet>& sets,
                                               const WindModel& model, const DampedModel& damped);

/// Eq. (7) at the design speed. @param factor  of the model's stiffness
[[nodiscard]] StaticResponse static_response(const WindSettings& config, const FittedSet& set, const Deployment& deployment,
                                             const WindModel& model, const dynamics::LoadedModel& loaded,
                                             const linalg::Cholesky& factor);

/// @param a, b  names of the rules @return empty where one of them has no response
[[nodiscard]] std::optional<StaticDifference> static_difference(const std::vector<StaticResponse>& responses,
                                                                const std::string& a, const std::string& b);

/// Least damping ratio [-] of any followed mode up to a speed.
[[nodiscard]] double least_damping(const DampingCurves& curves, double up_to_m_s);

}  // namespace twindeck::aero
