#pragma once

#include <Eigen/Core>

#include "aero/aeroelastic_system.hpp"

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

/// Buffeting forces on the coordinates of a reduced structure, per unit of turbulence at each strip.
/// @return [N s/m] (m × 2 n_strips): columns v' of every strip, then w' of every strip
[[nodiscard]] Eigen::MatrixXd load_matrix(const aero::AeroelasticSystem& system, double speed_m_s, aero::Equations equations);

}  // namespace twindeck::buffeting
