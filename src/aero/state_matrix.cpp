#include "aero/state_matrix.hpp"

namespace twindeck::aero {

Eigen::MatrixXd state_matrix(const ReducedStructure& s, const AeroelasticSystem::Block& air) {
  const Eigen::Index m = s.size(), n = static_cast<Eigen::Index>(s.maxwell.size());
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
