#include "reliability/varied_structure.hpp"

#include <Eigen/Eigenvalues>
#include <utility>

#include "core/error.hpp"

namespace twindeck::reliability {

using Eigen::Index;
using Eigen::MatrixXd;

VariedStructure::VariedStructure(const dynamics::LoadedModel& loaded, aero::ReducedStructure structure,
                                 std::vector<aero::StripMotion> motions, const MatrixXd& vectors,
                                 const std::vector<int>& parameters)
    : structure_(std::move(structure)), motions_(std::move(motions)) {
  TWINDECK_ASSERT(vectors.cols() == structure_.size());
  for (const int p : parameters) {
    stiffness_.emplace_back(vectors.transpose() * loaded.system.stiffness_derivative_times(loaded.theta, p, vectors));
    mass_.emplace_back(vectors.transpose() * loaded.system.mass_derivative_times(loaded.theta, p, vectors));
  }
}

VariedStructure::Varied VariedStructure::at(const WindVariation& variation) const {
  TWINDECK_ASSERT(variation.parameter_change.size() == static_cast<Index>(stiffness_.size()));
  const Index m = structure_.size();
  Varied out{structure_, motions_, MatrixXd::Identity(m, m)};
  out.structure.damping_ratio.setConstant(variation.damping_ratio);
  if (!variation.parameter_change.isZero(0.0)) {
    MatrixXd k = structure_.omega_rad_s.cwiseAbs2().asDiagonal(), mass = MatrixXd::Identity(m, m);
    for (std::size_t p = 0; p < stiffness_.size(); ++p) {
      k += variation.parameter_change[static_cast<Index>(p)] * stiffness_[p];
      mass += variation.parameter_change[static_cast<Index>(p)] * mass_[p];
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solved(k, mass);
    out.turn = solved.eigenvectors();
    out.structure.omega_rad_s = solved.eigenvalues().cwiseMax(0.0).cwiseSqrt();
    for (aero::StripMotion& motion : out.motions) motion = motion * out.turn;
  }
  if (out.structure.viscous.size() > 0)
    out.structure.viscous = variation.damper_factor * out.turn.transpose() * structure_.viscous * out.turn;
  for (aero::MaxwellUnit& unit : out.structure.maxwell) {
    unit.direction = out.turn.transpose() * unit.direction;
    unit.stiffness_N_m *= variation.damper_factor;
    unit.damping_N_s_m *= variation.damper_factor;
  }
  return out;
}

VariedStructure::Slope VariedStructure::slope(const Varied& at, const Eigen::VectorXd& parameter_change,
                                              double log_damping) const {
  const Index m = structure_.size();
  const Eigen::VectorXd &omega = at.structure.omega_rad_s, &ratio = at.structure.damping_ratio;
  Slope out{MatrixXd::Zero(m, m), MatrixXd::Zero(m, m), MatrixXd::Zero(m, m)};
  if (!parameter_change.isZero(0.0)) {
    MatrixXd mass = out.mass, stiffness = out.mass;
    for (std::size_t p = 0; p < stiffness_.size(); ++p) {
      mass += parameter_change[static_cast<Index>(p)] * mass_[p];
      stiffness += parameter_change[static_cast<Index>(p)] * stiffness_[p];
    }
    out.mass = at.turn.transpose() * mass * at.turn;
    out.stiffness = at.turn.transpose() * stiffness * at.turn;
    // With S² = A = M^-1/2 K M^-1/2:  dS_ij (omega_i + omega_j) = dA_ij, where M = 1 and K is diagonal.
    for (Index i = 0; i < m; ++i) {
      for (Index j = 0; j < m; ++j) {
        const double sum = omega[i] + omega[j];
        if (sum == 0.0) continue;
        const double square = out.stiffness(i, j) - 0.5 * out.mass(i, j) * (omega[i] * omega[i] + omega[j] * omega[j]);
        out.damping(i, j) = 2.0 * ratio[i] * (square / sum + 0.5 * out.mass(i, j) * sum);
      }
    }
  }
  out.damping.diagonal() += log_damping * 2.0 * ratio.cwiseProduct(omega);
  return out;
}

}  // namespace twindeck::reliability
