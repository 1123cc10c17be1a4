#include "wind/field.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace twindeck::wind {

using Eigen::Index;

void check(const FieldDefinition& field) {
  const Index n = field.size();
  if (n == 0 || field.speed_m_s.size() != n || field.sigma_m_s.size() != n || field.length_m.size() != n)
    throw InputError(
        {"", 0, "wind field"},
        fmt::format("has {} points, {} speeds, {} standard deviations and {} length scales, expected as many of each", n,
                    field.speed_m_s.size(), field.sigma_m_s.size(), field.length_m.size()));
  for (Index j = 0; j < n; ++j)
    if (!(field.speed_m_s[j] > 0.0) || !(field.length_m[j] > 0.0) || !(field.sigma_m_s[j] >= 0.0))
      throw InputError(
          {"", 0, "wind field"},
          fmt::format("has a mean speed of {} m/s, a length scale of {} m and a standard deviation of {} m/s at point "
                      "{}, expected positive numbers",
                      field.speed_m_s[j], field.length_m[j], field.sigma_m_s[j], j + 1));
}

double FieldDefinition::spectrum(Index j, double f_Hz) const {
  return law.at(component, f_Hz, sigma_m_s[j], length_m[j], speed_m_s[j]);
}

bool FieldDefinition::same_turbulence(Index j, Index k) const {
  return sigma_m_s[j] == sigma_m_s[k] && length_m[j] == length_m[k] && speed_m_s[j] == speed_m_s[k];
}

Eigen::VectorXd spectra(const FieldDefinition& field, double f_Hz) {
  Eigen::VectorXd s(field.size());
  for (Index j = 0; j < s.size(); ++j) s[j] = j > 0 && field.same_turbulence(j, j - 1) ? s[j - 1] : field.spectrum(j, f_Hz);
  return s;
}

Eigen::MatrixXd coherence(const FieldDefinition& field, double f_Hz) {
  const Index n = field.size();
  const Eigen::RowVector3d decay(field.decay[0], field.decay[1], field.decay[2]);
  Eigen::MatrixXd gamma(n, n);
  for (Index k = 0; k < n; ++k) {
    gamma(k, k) = 1.0;
    for (Index j = k + 1; j < n; ++j) {
      const double scaled = (field.position_m.row(j) - field.position_m.row(k)).cwiseProduct(decay).norm();
      const double speed = 0.5 * (field.speed_m_s[j] + field.speed_m_s[k]);
      const double x = f_Hz * scaled / speed;
      gamma(j, k) = gamma(k, j) = field.coherence_table ? field.coherence_table->at(x) : std::exp(-x);
    }
  }
  return gamma;
}

Eigen::VectorXcd drift(const FieldDefinition& field, double f_Hz) {
  if (!field.frozen) return Eigen::VectorXcd::Ones(field.size());
  const double wave_number = 2.0 * std::numbers::pi * f_Hz / field.speed_m_s.mean();
  Eigen::VectorXcd phase(field.size());
  for (Index j = 0; j < phase.size(); ++j) phase[j] = std::polar(1.0, -wave_number * field.position_m(j, 0));
  return phase;
}

Eigen::MatrixXd coherence_factor(const FieldDefinition& field, double f_Hz) {
  constexpr double least = 1e-13;  // of a pivot; rounding of the sums is of the order 1e-15
  const Eigen::MatrixXd gamma = coherence(field, f_Hz);
  const Eigen::LLT<Eigen::MatrixXd> cholesky(gamma);
  if (cholesky.info() == Eigen::Success && cholesky.matrixLLT().diagonal().array().square().minCoeff() > least)
    return cholesky.matrixL();
  // The first point whose unit variance is all explained by the points before it.
  Index j = 1;
  while (j + 1 < gamma.rows()) {
    const Eigen::LLT<Eigen::MatrixXd> leading(gamma.topLeftCorner(j + 1, j + 1));
    if (leading.info() != Eigen::Success || !(leading.matrixLLT().diagonal().array().square().minCoeff() > least)) break;
    ++j;
  }
  throw InputError(
      {"", 0, "wind field"},
      fmt::format("has a coherence that is not positive definite at {} Hz (found at point {} of {})", f_Hz, j + 1,
                  gamma.rows()),
      field.coherence_table
          ? "take away points that coincide; let the coherence end at 0 and fall ever more slowly with the separation, as "
            "exp(-x) does"
          : "take away points that coincide, or give neighbouring points more alike mean speeds");
}

}  // namespace twindeck::wind
