#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "aero/aeroelastic_system.hpp"
#include "buffeting/bridge_in_wind.hpp"
#include "wind/component.hpp"
#include "wind/simulation.hpp"

namespace twindeck::buffeting {

/// Drag, lift and moment of a strip per unit of turbulence, quasi-steady, paper Eq. (10):
///
///     D_b = ½ρV²BL  (2 C_D v'/V + (C_D' - C_L) w'/V)
///     L_b = ½ρV²BL  (2 C_L v'/V + (C_L' + C_D) w'/V)
///     M_b = ½ρV²B²L (2 C_M v'/V +  C_M'        w'/V)
///
/// at the strip's mean angle of attack, with the static factors of its rule (Table 11) and along its axes. The paper prints
/// C_L' - C_D in the lift. No frame has both signs as printed: with lift upwards it is a plus. `consistent` uses the plus,
/// `as_printed` the printed sign. Under the cosine rule the velocity across the deck is (V + v') cos theta, so v' has the
/// factor cos² theta and w' the factor cos theta. `as_printed` gives both cos² theta, the factor of the coefficients.
/// @return [N s/m, N s] (3 × 2) rows D, L, M; columns v', w'
using LoadFactor = Eigen::Matrix<double, 3, 2>;
[[nodiscard]] LoadFactor buffeting_factor(const aero::SectionAero& section, const aero::Strip& strip, const aero::YawRule& rule,
                                          double density_kg_m3, double speed_m_s, aero::Equations equations);

/// Force and moment of a strip per unit of u', the gust across the wind in plan, which the paper leaves out. To first order u'
/// turns the wind by u'/V and keeps its speed, so this is the change of the static force of Eq. (7) with the wind's direction,
/// over V: of its factor at the turned yaw (under the cosine rule, the speed along the normal changes by -u' sin theta), and of
/// its axes, where these are the wind's.
/// @return [N s/m, N s] (6) global force and moment
[[nodiscard]] Eigen::Matrix<double, 6, 1> across_load(const aero::SectionAero& section, const aero::Strip& strip,
                                                      const aero::YawRule& rule, const aero::Wind& wind, double speed_m_s);

/// Load of a strip on some coordinates, per unit of each component.
/// @param at_strip  (6 × m) the strip's motion in each coordinate; left out: its own global motions
/// @return [N s/m, N s] (m × n_components)
[[nodiscard]] Eigen::MatrixXd strip_load(const aero::SectionAero& section, const aero::Strip& strip, const aero::YawRule& rule,
                                         const aero::Wind& wind, double speed_m_s, aero::Equations equations,
                                         const std::vector<wind::Component>& components,
                                         const aero::StripMotion& at_strip = aero::StripMotion::Identity(6, 6));

/// Buffeting forces on the coordinates of a reduced structure, per unit of turbulence at each strip.
/// @return [N s/m] (m × n_components n_strips): columns of every strip by the first component, then by the next
[[nodiscard]] Eigen::MatrixXd load_matrix(const aero::AeroelasticSystem& system, double speed_m_s, aero::Equations equations,
                                          const std::vector<wind::Component>& components = {wind::Component::along,
                                                                                            wind::Component::vertical});

/// Samples of the gusts at the aerodynamic nodes in a mean wind.
class Gusts {
 public:
  /// @param step_s  of the samples @throws InputError  as wind::Simulator
  Gusts(const BridgeInWind& bridge, const wind::TurbulenceSet& set, const WindEventSettings& config, double speed_m_s,
        double step_s);
  /// @return [m/s] (n_steps × n_components n_strips) in the order of the load's columns. With double-indexed frequencies a
  /// sample does not repeat after the record: the steps of the run-up come first
  [[nodiscard]] Eigen::MatrixXd sample(std::uint64_t seed) const;
  /// One simulator for each component, with the same samples as `sample`.
  [[nodiscard]] const std::vector<wind::Simulator>& simulators() const { return simulators_; }
  [[nodiscard]] Eigen::Index before() const { return before_; }

 private:
  std::vector<wind::Simulator> simulators_;
  Eigen::Index before_;
};

}  // namespace twindeck::buffeting
