#include "aero/aeroelastic_system.hpp"

#include <utility>

#include "core/error.hpp"

namespace twindeck::aero {

StripBlock self_excited(const SectionAero& section, const Strip& strip, const YawRule& rule, double density_kg_m3,
                        double speed_m_s, double omega_rad_s) {
  TWINDECK_ASSERT(speed_m_s > 0.0 && omega_rad_s > 0.0 && section.derivatives);
  const double B = section.chord_m, w = omega_rad_s;
  const double v = speed_m_s * lookup_factor(rule, strip.yaw_rad) / (w * B);
  const DerivativeBlock d = section.derivatives->at(strip.alpha_rad, v);
  // The row of the moment and the column of the rotation have one factor B more each.
  const Eigen::Vector3d arm(1.0, 1.0, B);
  const Eigen::Matrix3d size = (0.5 * density_kg_m3 * B * B * strip.length_m) * (arm * arm.transpose());
  const Eigen::Matrix3d scale = size.cwiseProduct(block_factor(rule, strip.yaw_rad));
  return {w * d.damping.cwiseProduct(scale), w * w * d.stiffness.cwiseProduct(scale)};
}

namespace {

/// Factors of the rule times the wind's pressure on the strip's chord area [N].
StaticFactor static_scale(const SectionAero& section, const Strip& strip, const YawRule& rule, double density_kg_m3,
                          double speed_m_s) {
  const StaticFactor factor = static_factor(rule, strip.yaw_rad);
  const double q_area = 0.5 * density_kg_m3 * speed_m_s * speed_m_s * section.chord_m * strip.length_m;
  return {q_area * factor.force, q_area * factor.moment};
}

}  // namespace

Eigen::Vector3d static_force(const SectionAero& section, const Strip& strip, const YawRule& rule, double density_kg_m3,
                             double speed_m_s, Equations equations) {
  const StaticCoefficients c = section.polar.at(strip.alpha_rad);
  const StaticFactor scale = static_scale(section, strip, rule, density_kg_m3, speed_m_s);
  const double arm = equations == Equations::as_printed ? 1.0 : section.chord_m;
  return {scale.force * c.drag, scale.force * c.lift, scale.moment * arm * c.moment};
}

Eigen::Vector3d static_slope(const SectionAero& section, const Strip& strip, const YawRule& rule, double density_kg_m3,
                             double speed_m_s) {
  const StaticCoefficients c = section.polar.at(strip.alpha_rad);
  const StaticFactor scale = static_scale(section, strip, rule, density_kg_m3, speed_m_s);
  return {scale.force * c.drag_slope, scale.force * c.lift_slope, scale.moment * section.chord_m * c.moment_slope};
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

Eigen::MatrixXd ReducedStructure::damping() const {
  Eigen::MatrixXd c = viscous.size() > 0 ? viscous : Eigen::MatrixXd::Zero(size(), size());
  c.diagonal() += 2.0 * damping_ratio.cwiseProduct(omega_rad_s);
  return c;
}

ReducedStructure ReducedStructure::restricted(const std::vector<Eigen::Index>& coordinates) const {
  ReducedStructure out;
  out.omega_rad_s = omega_rad_s(coordinates);
  out.damping_ratio = damping_ratio(coordinates);
  if (viscous.size() > 0) out.viscous = viscous(coordinates, coordinates);
  for (const MaxwellUnit& unit : maxwell)
    out.maxwell.push_back({unit.stiffness_N_m, unit.damping_N_s_m, unit.direction(coordinates)});
  return out;
}

AeroelasticSystem::AeroelasticSystem(ReducedStructure structure, std::vector<SectionAero> sections, std::vector<Strip> strips,
                                     std::vector<StripMotion> motions, Wind wind, Deployment deployment)
    : structure_(std::move(structure)),
      sections_(std::move(sections)),
      strips_(std::move(strips)),
      motions_(std::move(motions)),
      wind_(std::move(wind)),
      deployment_(std::move(deployment)) {
  TWINDECK_ASSERT(strips_.size() == motions_.size());
  along_rule_.resize(3 * std::ssize(strips_), structure_.size());
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    TWINDECK_ASSERT(motions_[i].cols() == structure_.size());
    TWINDECK_ASSERT(strips_[i].section >= 0 && static_cast<std::size_t>(strips_[i].section) < sections_.size());
    along_rule_.middleRows<3>(3 * static_cast<Eigen::Index>(i)) =
        kinematics(strips_[i], rule(strips_[i]).axes, wind_) * motions_[i];
  }
}

AeroelasticSystem::Block AeroelasticSystem::self_excited(double speed_m_s, double omega_rad_s) const {
  const Eigen::Index m = structure_.size();
  if (speed_m_s == 0.0) return {Eigen::MatrixXd::Zero(m, m), Eigen::MatrixXd::Zero(m, m)};
  Eigen::MatrixXd damped(along_rule_.rows(), m), stiff(along_rule_.rows(), m);
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    const Strip& strip = strips_[i];
    const SectionAero& section = sections_[static_cast<std::size_t>(strip.section)];
    const StripBlock block = aero::self_excited(section, strip, rule(strip), wind_.density_kg_m3, speed_m_s, omega_rad_s);
    const Eigen::Index row = 3 * static_cast<Eigen::Index>(i);
    damped.middleRows<3>(row).noalias() = block.damping * along_rule_.middleRows<3>(row);
    stiff.middleRows<3>(row).noalias() = block.stiffness * along_rule_.middleRows<3>(row);
  }
  return {along_rule_.transpose() * damped, along_rule_.transpose() * stiff};
}

Eigen::MatrixXd AeroelasticSystem::static_stiffness() const {
  Eigen::MatrixXd turned(along_rule_.rows(), structure_.size());
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    const Strip& strip = strips_[i];
    const Eigen::Index row = 3 * static_cast<Eigen::Index>(i);
    const Eigen::Vector3d slope =
        static_slope(sections_[static_cast<std::size_t>(strip.section)], strip, rule(strip), wind_.density_kg_m3, 1.0);
    turned.middleRows<3>(row) = slope * along_rule_.row(row + 2);
  }
  return along_rule_.transpose() * turned;
}

AeroelasticSystem AeroelasticSystem::restricted(const std::vector<Eigen::Index>& coordinates) const {
  std::vector<StripMotion> motions;
  for (const StripMotion& motion : motions_) motions.push_back(motion(Eigen::all, coordinates));
  return {structure_.restricted(coordinates), sections_, strips_, std::move(motions), wind_, deployment_};
}

Eigen::MatrixXd state_matrix(const ReducedStructure& s, const AeroelasticSystem::Block& air) {
  const Eigen::Index m = s.size(), n = std::ssize(s.maxwell);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * m + n, 2 * m + n);
  a.block(0, m, m, m).setIdentity();
  a.block(m, 0, m, m).diagonal() -= s.omega_rad_s.cwiseAbs2();
  a.block(m, m, m, m) -= s.damping();
  if (air.damping.size() > 0) {
    a.block(m, 0, m, m) += air.stiffness;
    a.block(m, m, m, m) += air.damping;
  }
  for (Eigen::Index j = 0; j < n; ++j) {
    const MaxwellUnit& unit = s.maxwell[static_cast<std::size_t>(j)];
    const double k = unit.stiffness_N_m;
    a.block(m, 0, m, m) -= k * unit.direction * unit.direction.transpose();
    a.block(m, 2 * m + j, m, 1) = k * unit.direction;
    a.block(2 * m + j, 0, 1, m) = k / unit.damping_N_s_m * unit.direction.transpose();
    a(2 * m + j, 2 * m + j) = -k / unit.damping_N_s_m;
  }
  return a;
}

}  // namespace twindeck::aero
