#include "buffeting/loads.hpp"

namespace twindeck::buffeting {

using Eigen::Index;

LoadFactor buffeting_factor(const aero::SectionAero& section, const aero::Strip& strip, const aero::YawRule& rule,
                            double density_kg_m3, double speed_m_s, aero::Equations equations) {
  const aero::StaticCoefficients c = section.polar.at(strip.alpha_rad);
  const double lift_of_w = equations == aero::Equations::as_printed ? c.lift_slope - c.drag : c.lift_slope + c.drag;
  LoadFactor factor;
  factor << 2.0 * c.drag, c.drag_slope - c.lift,  //
      2.0 * c.lift, lift_of_w,                    //
      2.0 * c.moment * section.chord_m, c.moment_slope * section.chord_m;
  const aero::StaticFactor rule_factor = aero::static_factor(rule, strip.yaw_rad);
  factor.topRows<2>() *= rule_factor.force;
  factor.row(2) *= rule_factor.moment;
  if (rule.statics == aero::StaticRule::cosine && equations == aero::Equations::consistent) {
    factor.col(1) /= aero::yaw_cosine(strip.yaw_rad);
  }
  return 0.5 * density_kg_m3 * speed_m_s * section.chord_m * strip.length_m * factor;
}

Eigen::MatrixXd load_matrix(const aero::AeroelasticSystem& system, double speed_m_s, aero::Equations equations) {
  const auto n = static_cast<Index>(system.strips().size());
  Eigen::MatrixXd load(system.structure().size(), 2 * n);
  for (Index i = 0; i < n; ++i) {
    const aero::Strip& strip = system.strips()[static_cast<std::size_t>(i)];
    const aero::YawRule& rule = system.rule(strip);
    const LoadFactor factor = buffeting_factor(system.sections()[static_cast<std::size_t>(strip.section)], strip, rule,
                                               system.wind().density_kg_m3, speed_m_s, equations);
    const Eigen::MatrixXd motion =
        aero::kinematics(strip, rule.axes, system.wind()) * system.motions()[static_cast<std::size_t>(i)];
    load.col(i) = motion.transpose() * factor.col(0);
    load.col(n + i) = motion.transpose() * factor.col(1);
  }
  return load;
}

}  // namespace twindeck::buffeting
