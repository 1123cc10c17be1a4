#include "aero/forces.hpp"

#include "core/error.hpp"

namespace twindeck::aero {

StripBlock self_excited(const SectionAero& section, const Strip& strip, const YawRule& rule, double density_kg_m3,
                        double speed_m_s, double omega_rad_s) {
  TWINDECK_ASSERT(speed_m_s > 0.0 && omega_rad_s > 0.0 && section.derivatives);
  const double B = section.chord_m, w = omega_rad_s;
  const double v = speed_m_s * lookup_factor(rule, strip.yaw_rad) / (w * B);
  const DerivativeBlock d = section.derivatives->at(strip.alpha_rad, v);
  // One B more for each of: moment as force, rotation as motion.
  const Eigen::Vector3d arm(1.0, 1.0, B);
  const Eigen::Matrix3d size = (0.5 * density_kg_m3 * B * B * strip.length_m) * (arm * arm.transpose());
  const Eigen::Matrix3d scale = size.cwiseProduct(block_factor(rule, strip.yaw_rad));
  return {w * d.damping.cwiseProduct(scale), w * w * d.stiffness.cwiseProduct(scale)};
}

Eigen::Vector3d static_force(const SectionAero& section, const Strip& strip, const YawRule& rule, double density_kg_m3,
                             double speed_m_s, Equations equations) {
  const StaticCoefficients c = section.polar.at(strip.alpha_rad);
  const StaticFactor factor = static_factor(rule, strip.yaw_rad);
  const double q_area = 0.5 * density_kg_m3 * speed_m_s * speed_m_s * section.chord_m * strip.length_m;
  const double arm = equations == Equations::as_printed ? 1.0 : section.chord_m;
  return {q_area * factor.force * c.drag, q_area * factor.force * c.lift, q_area * factor.moment * arm * c.moment};
}

Eigen::Vector3d static_slope(const SectionAero& section, const Strip& strip, const YawRule& rule, double density_kg_m3,
                             double speed_m_s) {
  const StaticCoefficients c = section.polar.at(strip.alpha_rad);
  const StaticFactor factor = static_factor(rule, strip.yaw_rad);
  const double q_area = 0.5 * density_kg_m3 * speed_m_s * speed_m_s * section.chord_m * strip.length_m;
  return {q_area * factor.force * c.drag_slope, q_area * factor.force * c.lift_slope,
          q_area * factor.moment * section.chord_m * c.moment_slope};
}

const std::vector<EquationDifference>& equation_differences() {
  static const std::vector<EquationDifference> list = {
      {"Eq. (7), M_s", "½ρV²BL C_M", "½ρV²B²L C_M", "the printed moment has the unit of a force", true},
      {"Eq. (9), a2", "-a2* = A2*/V*²", "-a2* = A2*/V*", "a2* multiplies a velocity, as h2* and p2* do", false},
      {"Eq. (9), drag rows", "p1 with P1, p4 with P4, p5 with P5, p6 with P6", "p1 with P5, p4 with P6, p5 with P1, p6 with P4",
       "in Eq. (8) p1 multiplies the vertical motion; Scanlan's P1 and P4 are lateral", false},
      {"Eq. (10), L_b", "(C_L' - C_D) w'/V", "(C_L' + C_D) w'/V",
       "with (C_D' - C_L) in the drag, lift is positive up, and then the sign is plus", true},
      {"Eq. (10), M_b", "the drag's bracket and the moment's after ½ρV²B²", "½ρV²B² (2C_M v'/V + C_M' w'/V)",
       "of the two brackets printed the second has the moment's coefficients", false},
      {"Eq. (10)", "force per unit length", "times the influence length L", "it is applied at nodes", false},
  };
  return list;
}

}  // namespace twindeck::aero
