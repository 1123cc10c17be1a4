#include "buffeting/spectral.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace twindeck::buffeting {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Spacing of frequencies where the bridge has its modes, and above them.
constexpr double kFine_Hz = 4e-3, kFineUpTo_Hz = 3.0, kCoarse_Hz = 4e-2;

/// Stiffness of a Maxwell unit in harmonic motion, i omega k c / (k + i omega c).
std::complex<double> maxwell_stiffness(const aero::MaxwellUnit& unit, double omega) {
  const std::complex<double> dashpot(0.0, omega * unit.damping_N_s_m);
  return unit.stiffness_N_m * dashpot / (unit.stiffness_N_m + dashpot);
}

/// Real and imaginary parts of the transfer from unit turbulence of this size and drift, one below the other: both go through
/// the real coherence by themselves.
MatrixXd split_transfer(const MatrixXcd& transfer, const Eigen::VectorXcd& point) {
  const MatrixXcd part = transfer * point.asDiagonal();
  MatrixXd split(2 * part.rows(), part.cols());
  split << part.real(), part.imag();
  return split;
}

/// Size and phase of a field's turbulence at each strip.
Eigen::VectorXcd turbulence_at_points(const wind::FieldDefinition& field, double f_Hz) {
  return wind::spectra(field, f_Hz).cwiseSqrt().cwiseProduct(wind::drift(field, f_Hz));
}

}  // namespace

MatrixXcd impedance(const aero::AeroelasticSystem& system, const aero::AeroelasticSystem::Block& air, double omega) {
  const std::complex<double> i(0.0, 1.0);
  const aero::ReducedStructure& structure = system.structure();
  MatrixXcd z = i * omega * (structure.damping() - air.damping) - air.stiffness.cast<std::complex<double>>();
  z.diagonal().array() += structure.omega_rad_s.array().square() - omega * omega;
  for (const aero::MaxwellUnit& unit : structure.maxwell)
    z += maxwell_stiffness(unit, omega) * (unit.direction * unit.direction.transpose()).cast<std::complex<double>>();
  return z;
}

MatrixXcd impedance_slope(const aero::AeroelasticSystem& system, const SystemSlope& slope, double omega) {
  const MatrixXd real = slope.stiffness - omega * omega * slope.mass, imaginary = omega * slope.damping;
  MatrixXcd z = real.cast<std::complex<double>>();
  z.imag() = imaginary;
  if (slope.maxwell == 0.0) return z;
  for (const aero::MaxwellUnit& unit : system.structure().maxwell)  // in proportion to both constants
    z += slope.maxwell * maxwell_stiffness(unit, omega) *
         (unit.direction * unit.direction.transpose()).cast<std::complex<double>>();
  return z;
}

VectorXd spectral_frequencies(double cutoff_Hz) {
  std::vector<double> f;
  for (double x = kFine_Hz; x < cutoff_Hz; x += x < kFineUpTo_Hz ? kFine_Hz : kCoarse_Hz) f.push_back(x);
  return Eigen::Map<const VectorXd>(f.data(), static_cast<Index>(f.size()));
}

MatrixXd response_spectra(const aero::AeroelasticSystem& system, double speed_m_s, const Eigen::Ref<const MatrixXd>& load,
                          const wind::FieldDefinition& along, const wind::FieldDefinition& vertical,
                          const Eigen::Ref<const MatrixXd>& sensors, const Eigen::Ref<const VectorXd>& f_Hz,
                          const SpectralOptions& options) {
  const Index strips = along.size();
  MatrixXd spectra = MatrixXd::Zero(f_Hz.size(), sensors.rows());
  const bool is_frozen = options.frozen_omega > 0.0;
  const aero::AeroelasticSystem::Block frozen =
      is_frozen ? system.self_excited(speed_m_s, options.frozen_omega) : aero::AeroelasticSystem::Block();
  parallel_for(f_Hz.size(), [&](Index k) {
    const double omega = 2.0 * std::numbers::pi * f_Hz[k];
    // Few sensors and many loads: solved for the sensors, with the transpose.
    const MatrixXcd z =
        impedance(system, is_frozen ? frozen : system.self_excited(speed_m_s, std::max(omega, options.lowest_omega)), omega)
            .transpose();
    const MatrixXcd left = z.partialPivLu().solve(sensors.transpose().cast<std::complex<double>>());
    const MatrixXcd transfer = std::pow(omega, options.derivative) * (left.transpose() * load);
    const double chi = options.admittance ? options.admittance(f_Hz[k]) : 1.0;
    for (const auto& [field, first] : {std::pair{&along, Index{0}}, std::pair{&vertical, strips}}) {
      const MatrixXd split = split_transfer(transfer.middleCols(first, strips), turbulence_at_points(*field, f_Hz[k]));
      const VectorXd square = (split * wind::coherence(*field, f_Hz[k])).cwiseProduct(split).rowwise().sum();
      spectra.row(k) += chi * (square.head(sensors.rows()) + square.tail(sensors.rows())).transpose();
    }
  });
  return spectra;
}

std::vector<MatrixXd> response_spectra_slopes(const aero::AeroelasticSystem& system, double speed_m_s,
                                              const Eigen::Ref<const MatrixXd>& load, const wind::FieldDefinition& along,
                                              const wind::FieldDefinition& vertical, const Eigen::Ref<const MatrixXd>& sensors,
                                              const Eigen::Ref<const VectorXd>& f_Hz, const std::vector<SystemSlope>& slopes,
                                              const SpectralOptions& options) {
  TWINDECK_ASSERT(options.frozen_omega > 0.0);
  const Index strips = along.size(), rows = sensors.rows(), n = std::ssize(slopes);
  std::vector<MatrixXd> out(static_cast<std::size_t>(rows), MatrixXd::Zero(f_Hz.size(), n));
  const aero::AeroelasticSystem::Block frozen = system.self_excited(speed_m_s, options.frozen_omega);
  parallel_for(f_Hz.size(), [&](Index k) {
    const double omega = 2.0 * std::numbers::pi * f_Hz[k];
    const Eigen::PartialPivLU<MatrixXcd> factor(impedance(system, frozen, omega).transpose());
    const MatrixXcd left = factor.solve(sensors.transpose().cast<std::complex<double>>());
    MatrixXcd right(left.rows(), rows * n);
    for (Index p = 0; p < n; ++p)
      right.middleCols(rows * p, rows) = impedance_slope(system, slopes[static_cast<std::size_t>(p)], omega).transpose() * left;
    const MatrixXcd changed = factor.solve(right);
    const double scale = std::pow(omega, 2 * options.derivative) * (options.admittance ? options.admittance(f_Hz[k]) : 1.0);
    for (const auto& [field, first] : {std::pair{&along, Index{0}}, std::pair{&vertical, strips}}) {
      const Eigen::VectorXcd point = turbulence_at_points(*field, f_Hz[k]);
      const MatrixXd split = split_transfer(left.transpose() * load.middleCols(first, strips), point);
      const MatrixXd through = split * wind::coherence(*field, f_Hz[k]);
      for (Index p = 0; p < n; ++p) {
        const SystemSlope& slope = slopes[static_cast<std::size_t>(p)];
        MatrixXcd transfer = -changed.middleCols(rows * p, rows).transpose() * load.middleCols(first, strips);
        if (slope.load.size() > 0) transfer += left.transpose() * slope.load.middleCols(first, strips);
        const MatrixXd change = split_transfer(transfer, point) + slope.turbulence * split;
        const VectorXd product = 2.0 * scale * through.cwiseProduct(change).rowwise().sum();
        for (Index row = 0; row < rows; ++row) out[static_cast<std::size_t>(row)](k, p) += product[row] + product[rows + row];
      }
    }
  });
  return out;
}

VectorXd band_rms(const Eigen::Ref<const VectorXd>& f_Hz, const Eigen::Ref<const MatrixXd>& spectra) {
  VectorXd variance = VectorXd::Zero(spectra.cols());
  for (Index k = 1; k < f_Hz.size(); ++k) {
    variance += 0.5 * (f_Hz[k] - f_Hz[k - 1]) * (spectra.row(k) + spectra.row(k - 1)).transpose();
  }
  return variance.cwiseSqrt();
}

}  // namespace twindeck::buffeting
