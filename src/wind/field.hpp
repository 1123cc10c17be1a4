#pragma once

#include <Eigen/Core>
#include <memory>

#include "wind/component.hpp"
#include "wind/spectrum.hpp"
#include "wind/turbulence.hpp"

namespace twindeck::wind {

/// One component of the turbulence at n points: a stationary Gaussian process with the cross-spectra of the paper's
/// section 5.2,
///
///     S_jk(f) = sqrt(S_j(f) S_k(f)) gamma_jk(f),   gamma_jk = exp(-f sqrt(sum_a (C_a d_a)²) / V_jk),   Eq. (13) and (17),
///
/// with the separations d_a of two points along, across and vertical and V_jk the mean of their two speeds. On curved
/// decks some points lie behind others in the wind. With `frozen` the gusts move with the mean wind (Taylor's hypothesis) and
/// gamma has the factor exp(-2 pi i f (x_j - x_k) / V), x along the wind, V the mean of all speeds.
struct FieldDefinition {
  Component component = Component::along;
  Eigen::MatrixX3d position_m;  ///< (n × 3) along, across, vertical
  Eigen::VectorXd speed_m_s;    ///< (n) mean speeds
  Eigen::VectorXd sigma_m_s;    ///< (n) standard deviations
  Eigen::VectorXd length_m;     ///< (n) along-wind length scales
  PerComponent decay{};         ///< C_a: along, across, vertical
  bool frozen = true;
  Spectrum law;                                           ///< S_j(f)
  std::shared_ptr<const CoherenceTable> coherence_table;  ///< in place of the exponential law of gamma; none: that law

  [[nodiscard]] Eigen::Index size() const { return position_m.rows(); }
  /// S_j(f) of one point [(m/s)²/Hz].
  [[nodiscard]] double spectrum(Eigen::Index j, double f_Hz) const;
  /// Whether two points have the same spectrum.
  [[nodiscard]] bool same_turbulence(Eigen::Index j, Eigen::Index k) const;
};

/// @throws InputError  for lists of different lengths, a speed or length that is not positive
void check(const FieldDefinition& field);

/// S_j(f) of every point. @return [(m/s)²/Hz] (n)
[[nodiscard]] Eigen::VectorXd spectra(const FieldDefinition& field, double f_Hz);
/// |gamma_jk(f)|, real. @return [-] (n × n), ones on the diagonal
[[nodiscard]] Eigen::MatrixXd coherence(const FieldDefinition& field, double f_Hz);
/// Phase factor of each point, exp(-2 pi i f x_j / V); ones if the field is not frozen. @return (n)
[[nodiscard]] Eigen::VectorXcd drift(const FieldDefinition& field, double f_Hz);

/// Cholesky factor of the coherence, gamma = L L'. The drift is a separate phase of each point, so H of Eq. (14) is
/// diag(sqrt(S_j) drift_j) L with a real L.
/// @return (n × n) lower triangular, rows of unit length
/// @throws InputError  with the point and the frequency at which the coherence is not positive definite (two points that
///                     coincide, speeds that differ too much for the mean of two to give a coherence, or a table that is none)
[[nodiscard]] Eigen::MatrixXd coherence_factor(const FieldDefinition& field, double f_Hz);

}  // namespace twindeck::wind
