#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "aero/strip.hpp"

namespace twindeck::aero {

/// Self-excited forces of a strip on its own motions q = (y, z, alpha), harmonic at omega: F = damping q̇ + stiffness q, rows
/// (D, L, M) [N, N, N m]. Both are unsymmetric and must be stored full.
struct StripBlock {
  Eigen::Matrix3d damping = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
};

/// Paper Eq. (8) in the dimensional form of Scanlan's derivatives with a rule of Table 11:
///   damping   = ½ρωB²L  ∘ H*(alpha, K') ∘ factor,   stiffness = ½ρω²B²L ∘ H*(alpha, K') ∘ factor,
/// one more B for the column of alpha and for the row of the moment; K' by the rule's reduced velocity.
/// @param speed_m_s  > 0;  @param omega_rad_s > 0
/// @throws InputError  from the derivatives, outside their range
[[nodiscard]] StripBlock self_excited(const SectionAero& section, const Strip& strip, const YawRule& rule, double density_kg_m3,
                                      double speed_m_s, double omega_rad_s);

/// Whether to use the paper's equations as printed where the print cannot be right.
enum class Equations { consistent, as_printed };

/// Static drag, lift and moment of a strip, paper Eq. (7), q = ½ρV²:  D = qBL C_D, L = qBL C_L, M = qB²L C_M (as printed: qBL),
/// at the strip's mean angle of attack, with the rule's factors. @return (D, L, M) along the rule's axes [N, N, N m]
[[nodiscard]] Eigen::Vector3d static_force(const SectionAero& section, const Strip& strip, const YawRule& rule,
                                           double density_kg_m3, double speed_m_s, Equations equations = Equations::consistent);

/// Forces per radian of a slow rotation: (C_D', C_L', C_M') with the same prefactors. For divergence.
[[nodiscard]] Eigen::Vector3d static_slope(const SectionAero& section, const Strip& strip, const YawRule& rule,
                                           double density_kg_m3, double speed_m_s);

/// Lists where the paper's equations (7) to (10) cannot hold as printed, what is used instead, and whether `as_printed`
/// restores the print.
struct EquationDifference {
  std::string equation, printed, taken, reason;
  bool selectable;
};
[[nodiscard]] const std::vector<EquationDifference>& equation_differences();

}  // namespace twindeck::aero
