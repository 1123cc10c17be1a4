#include "buffeting/response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "linalg/dense.hpp"

namespace twindeck::buffeting {

using Eigen::Index;
using Eigen::MatrixXd;

transient::LinearSystem equations_of_motion(const aero::AeroelasticSystem& system, double speed_m_s,
                                            double frozen_omega_rad_s) {
  const aero::ReducedStructure& structure = system.structure();
  const aero::AeroelasticSystem::Block wind = system.self_excited(speed_m_s, frozen_omega_rad_s);
  transient::LinearSystem out{.mass = MatrixXd::Identity(structure.size(), structure.size()),
                              .damping = structure.damping() - wind.damping,
                              .stiffness = -wind.stiffness};
  out.stiffness.diagonal() += structure.omega_rad_s.cwiseAbs2();
  for (const aero::MaxwellUnit& unit : structure.maxwell)
    transient::add_maxwell(out, unit.direction, unit.stiffness_N_m, unit.damping_N_s_m);
  return out;
}

Response respond(const transient::Newmark& newmark, const Eigen::Ref<const MatrixXd>& load,
                 const Eigen::Ref<const MatrixXd>& wind_m_s, double step_s, const Eigen::Ref<const MatrixXd>& sensors,
                 const ResponseOptions& options) {
  const auto lead = static_cast<Index>(std::llround(options.lead_in_s / step_s));
  const Index given = wind_m_s.rows(), n = options.repeats ? given : given - lead;
  // The motion starts from rest. The load grows over the first half of the lead-in, so that no jump leaves vibrations.
  const Index ramp = lead / 2;
  const MatrixXd forces = newmark.within_a_step(load).transpose();
  const MatrixXd seen = sensors.transpose();
  constexpr Index piece = 512;  ///< [steps] at a time: a piece of gusts, accelerations and sensors stays in the cache
  Response out;
  out.acceleration_m_s2.resize(n, sensors.rows());
  transient::Motion motion;
  for (Index i = -lead, count = 0; i < n; i += count) {
    // The run-up of a periodic sample is its end, and for a longer run-up the sample repeats.
    const Index from = options.repeats ? (i % n + n) % n : i + lead;
    count = std::min({piece, i < 0 ? -i : n - i, given - from});
    MatrixXd step = linalg::product(wind_m_s.middleRows(from, count), forces).transpose();
    for (Index k = 0; k < count && i + lead + k < ramp; ++k)
      step.col(k) *= 0.5 - 0.5 * std::cos(std::numbers::pi * static_cast<double>(i + lead + k) / static_cast<double>(ramp));
    if (i == -lead) {  // at rest, whatever the first force is
      step.col(0).setZero();
      newmark.advance(motion, step.rightCols(count - 1));
    } else {
      newmark.advance(motion, step);
    }
    if (i >= 0) out.acceleration_m_s2.middleRows(i, count) = linalg::product(step.topRows(sensors.cols()), seen, true);
  }
  return out;
}

Eigen::VectorXd root_mean_squares(const Eigen::Ref<const MatrixXd>& history) {
  const MatrixXd centred = history.rowwise() - history.colwise().mean();
  return (centred.colwise().squaredNorm() / static_cast<double>(history.rows())).cwiseSqrt().transpose();
}

}  // namespace twindeck::buffeting
