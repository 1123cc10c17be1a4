#include "buffeting/loads.hpp"

#include <cmath>
#include <utility>

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
  if (rule.statics == aero::StaticRule::cosine && equations == aero::Equations::consistent)
    factor.col(1) /= aero::yaw_cosine(strip.yaw_rad);
  return 0.5 * density_kg_m3 * speed_m_s * section.chord_m * strip.length_m * factor;
}

Eigen::Matrix<double, 6, 1> across_load(const aero::SectionAero& section, const aero::Strip& strip, const aero::YawRule& rule,
                                        const aero::Wind& wind, double speed_m_s) {
  const aero::StaticCoefficients c = section.polar.at(strip.alpha_rad);
  const Eigen::Vector3d static_part(c.drag, c.lift, c.moment * section.chord_m);
  const aero::StaticFactor factor = aero::static_factor(rule, strip.yaw_rad), slope = aero::static_slope(rule, strip.yaw_rad);
  const auto scaled = [&static_part](const aero::StaticFactor& by) {
    return static_part.cwiseProduct(Eigen::Vector3d(by.force, by.force, by.moment)).eval();
  };
  Eigen::Matrix<double, 6, 1> load = aero::kinematics(strip, rule.axes, wind).transpose() * scaled(slope);
  if (rule.axes == aero::ForceAxes::wind) {  // drag and the moment's axis turn with the wind, lift stays
    const aero::Wind turned{wind.density_kg_m3, Eigen::Vector3d::UnitZ().cross(wind.direction)};
    aero::Kinematics change = aero::kinematics(strip, rule.axes, turned);
    change.row(1).setZero();
    load += change.transpose() * scaled(factor);
  }
  return 0.5 * wind.density_kg_m3 * speed_m_s * section.chord_m * strip.length_m * load;
}

Eigen::MatrixXd strip_load(const aero::SectionAero& section, const aero::Strip& strip, const aero::YawRule& rule,
                           const aero::Wind& wind, double speed_m_s, aero::Equations equations,
                           const std::vector<wind::Component>& components, const aero::StripMotion& at_strip) {
  const LoadFactor factor = buffeting_factor(section, strip, rule, wind.density_kg_m3, speed_m_s, equations);
  const Eigen::MatrixXd motion = aero::kinematics(strip, rule.axes, wind) * at_strip;
  Eigen::MatrixXd load(at_strip.cols(), std::ssize(components));
  for (Index k = 0; k < load.cols(); ++k) {
    if (const wind::Component component = components[static_cast<std::size_t>(k)]; component == wind::Component::across)
      load.col(k) = at_strip.transpose() * across_load(section, strip, rule, wind, speed_m_s);
    else
      load.col(k) = motion.transpose() * factor.col(component == wind::Component::along ? 0 : 1);
  }
  return load;
}

Eigen::MatrixXd load_matrix(const aero::AeroelasticSystem& system, double speed_m_s, aero::Equations equations,
                            const std::vector<wind::Component>& components) {
  const Index n = std::ssize(system.strips()), kinds = std::ssize(components);
  Eigen::MatrixXd load(system.structure().size(), kinds * n);
  for (Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const aero::Strip& strip = system.strips()[at];
    const Eigen::MatrixXd own =
        strip_load(system.sections()[static_cast<std::size_t>(strip.section)], strip, system.rule(strip), system.wind(),
                   speed_m_s, equations, components, system.motions()[at]);
    for (Index k = 0; k < kinds; ++k) load.col(k * n + i) = own.col(k);
  }
  return load;
}

using Eigen::Index;

Gusts::Gusts(const BridgeInWind& bridge, const wind::TurbulenceSet& set, const WindEventSettings& config, double speed_m_s,
             double step_s)
    : before_(config.repeats() ? 0 : static_cast<Index>(std::llround(config.lead_in_s / step_s))) {
  wind::SimulationOptions options;
  options.duration_s = config.duration_s;
  options.rate_Hz = 1.0 / step_s;
  options.cutoff_Hz = config.cutoff_Hz;
  options.anchors = static_cast<int>(config.anchors);
  options.frequencies = config.repeats() ? wind::Frequencies::single : wind::Frequencies::double_indexed;
  for (wind::FieldDefinition& field : fields_at_nodes(bridge, set, config, speed_m_s))
    simulators_.emplace_back(std::move(field), options);
}

Eigen::MatrixXd Gusts::sample(std::uint64_t seed) const {
  const Index strips = simulators_.front().field().size();
  Eigen::MatrixXd gusts(before_ + simulators_.front().n_samples(), std::ssize(simulators_) * strips);
  for (Index k = 0; k < std::ssize(simulators_); ++k)
    gusts.middleCols(k * strips, strips) = simulators_[static_cast<std::size_t>(k)].sample(seed, before_);
  return gusts;
}

}  // namespace twindeck::buffeting
