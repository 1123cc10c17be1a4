#include "reliability/varied_structure.hpp"

#include <Eigen/Eigenvalues>
#include <utility>

#include "aero/wind_model.hpp"
#include "core/error.hpp"
#include "fe/assembly_terms.hpp"
#include "fe/cable.hpp"
#include "fe/model.hpp"

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
  TWINDECK_ASSERT(variation.parameter_change.size() == std::ssize(stiffness_));
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

using Eigen::Index;

MemberRows stay_forces(const dynamics::LoadedModel& loaded, const Eigen::MatrixXd& vectors) {
  const fe::Model& model = *loaded.model;
  const Eigen::MatrixXd full = loaded.system.expand(vectors);
  std::vector<Index> stays;
  for (std::size_t e = 0; e < model.elements.size(); ++e)
    if (model.elements[e].type == fe::ElementType::stay) stays.push_back(static_cast<Index>(e));
  const Index n = std::ssize(stays);
  MemberRows out{{}, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, vectors.cols())};
  for (Index k = 0; k < n; ++k) {
    const Index e = stays[static_cast<std::size_t>(k)];
    const fe::Element& stay = model.elements[static_cast<std::size_t>(e)];
    const Eigen::Vector3d chord = model.nodes[fe::slot(stay.nodes[1])].x_m - model.nodes[fe::slot(stay.nodes[0])].x_m;
    const double length = chord.norm();
    out.names.push_back(fe::stay_name(stay));
    out.area_m2[k] = model.sections[fe::slot(stay.section)].area_m2;
    if (loaded.state.stay_pull_N.size() > 0) out.pull_N[k] = loaded.state.stay_pull_N[e];
    const double young = model.materials[fe::slot(stay.material)].youngs_modulus_Pa, pull = out.pull_N[k];
    const double stiffness =
        (pull > 0.0 ? fe::stay_modulus(model, stay, pull).law.modulus(young) : young) * out.area_m2[k] / length;
    out.rows.row(k) = stiffness / length * chord.transpose() *
                      (full.middleRows<3>(6 * stay.nodes[1]) - full.middleRows<3>(6 * stay.nodes[0]));
  }
  return out;
}

MemberRows damper_strokes(const dynamics::LoadedModel& loaded, const Eigen::MatrixXd& vectors) {
  MemberRows out;
  const std::vector<const fe::Spring*> dampers = aero::dampers_of(*loaded.model);
  for (const fe::Spring* damper : dampers) out.names.push_back(damper->name);
  out.rows = aero::damper_patterns(loaded, dampers).transpose() * vectors;
  return out;
}

}  // namespace twindeck::reliability
