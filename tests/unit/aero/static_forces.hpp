#pragma once

#include "aero/aeroelastic_system.hpp"

namespace twindeck::aero {

/// Static wind forces (Eq. 7) of all strips on the coordinates of a system. (m)
inline Eigen::VectorXd static_forces(const AeroelasticSystem& system, double speed_m_s) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(system.structure().size());
  for (std::size_t i = 0; i < system.strips().size(); ++i) {
    const Strip& strip = system.strips()[i];
    const SectionAero& section = system.sections()[static_cast<std::size_t>(strip.section)];
    const YawRule& rule = system.rule(strip);
    sum += (kinematics(strip, rule.axes, system.wind()) * system.motions()[i]).transpose() *
           static_force(section, strip, rule, system.wind().density_kg_m3, speed_m_s);
  }
  return sum;
}

}  // namespace twindeck::aero
