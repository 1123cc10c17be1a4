#include "buffeting/response.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace twindeck::buffeting {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

transient::LinearSystem equations_of_motion(const aero::AeroelasticSystem& system, double speed_m_s,
                                            double frozen_omega_rad_s) {
  const aero::ReducedStructure& structure = system.structure();
  const aero::AeroelasticSystem::Block wind = system.self_excited(speed_m_s, frozen_omega_rad_s);
  transient::LinearSystem out;
  out.mass = MatrixXd::Identity(structure.size(), structure.size());
  out.damping = structure.damping() - wind.damping;
  out.stiffness = -wind.stiffness;
  out.stiffness.diagonal() += structure.omega_rad_s.cwiseAbs2();
  for (const aero::MaxwellUnit& unit : structure.maxwell) {
    transient::add_maxwell(out, unit.direction, unit.stiffness_N_m, unit.damping_N_s_m);
  }
  return out;
}

Response respond(const transient::Newmark& newmark, const Eigen::Ref<const MatrixXd>& load,
                 const Eigen::Ref<const MatrixXd>& wind_m_s, double step_s, const Eigen::Ref<const MatrixXd>& sensors,
                 const ResponseOptions& options) {
  const auto lead = static_cast<Index>(std::llround(options.lead_in_s / step_s));
  const Index given = wind_m_s.rows(), n = options.repeats ? given : given - lead;
  const MatrixXd prepared = newmark.within_a_step(load);
  MatrixXd alone(prepared.rows(), lead + n);
  alone.rightCols(given).noalias() = prepared * wind_m_s.transpose();
  for (Index i = lead + n - given - 1; i >= 0; --i) alone.col(i) = alone.col(i + n);  // the sample is periodic, however often
  // From rest: the load comes up over the first half of the lead-in, so that no jump rings on.
  const Index ramp = lead / 2;
  for (Index i = 0; i < ramp; ++i) {
    alone.col(i) *= 0.5 - 0.5 * std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(ramp));
  }
  const transient::History history = newmark.run_prepared(std::move(alone));
  return {(sensors * history.acceleration.topRightCorner(sensors.cols(), n)).transpose(), history.status};
}

VectorXd root_mean_squares(const Eigen::Ref<const MatrixXd>& history) {
  const MatrixXd centred = history.rowwise() - history.colwise().mean();
  return (centred.colwise().squaredNorm() / static_cast<double>(history.rows())).cwiseSqrt().transpose();
}

}  // namespace twindeck::buffeting
