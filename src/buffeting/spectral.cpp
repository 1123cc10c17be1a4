#include "buffeting/spectral.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "core/parallel.hpp"

namespace twindeck::buffeting {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// -omega² + i omega C + K, Maxwell units as their complex stiffness i omega k c / (k + i omega c).
MatrixXcd impedance(const aero::AeroelasticSystem& system, const aero::AeroelasticSystem::Block& wind, double omega) {
  const std::complex<double> i(0.0, 1.0);
  const aero::ReducedStructure& structure = system.structure();
  MatrixXcd z = i * omega * (structure.damping() - wind.damping) - wind.stiffness.cast<std::complex<double>>();
  z.diagonal().array() += structure.omega_rad_s.array().square() - omega * omega;
  for (const aero::MaxwellUnit& unit : structure.maxwell) {
    const std::complex<double> dashpot = i * omega * unit.damping_N_s_m;
    z += (unit.stiffness_N_m * dashpot / (unit.stiffness_N_m + dashpot)) *
         (unit.direction * unit.direction.transpose()).cast<std::complex<double>>();
  }
  return z;
}

/// Spacing of frequencies where the bridge has its modes, and above them.
constexpr double kFine_Hz = 4e-3, kFineUpTo_Hz = 3.0, kCoarse_Hz = 4e-2;

}  // namespace

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
      // The drift is a phase of each point and the coherence real: real and imaginary parts go through it by themselves.
      const Eigen::VectorXcd point = wind::spectra(*field, f_Hz[k]).cwiseSqrt().cwiseProduct(wind::drift(*field, f_Hz[k]));
      const MatrixXcd part = transfer.middleCols(first, strips) * point.asDiagonal();
      MatrixXd split(2 * sensors.rows(), strips);
      split << part.real(), part.imag();
      const VectorXd square = (split * wind::coherence(*field, f_Hz[k])).cwiseProduct(split).rowwise().sum();
      spectra.row(k) += chi * (square.head(sensors.rows()) + square.tail(sensors.rows())).transpose();
    }
  });
  return spectra;
}

VectorXd band_rms(const Eigen::Ref<const VectorXd>& f_Hz, const Eigen::Ref<const MatrixXd>& spectra) {
  VectorXd variance = VectorXd::Zero(spectra.cols());
  for (Index k = 1; k < f_Hz.size(); ++k) {
    variance += 0.5 * (f_Hz[k] - f_Hz[k - 1]) * (spectra.row(k) + spectra.row(k - 1)).transpose();
  }
  return variance.cwiseSqrt();
}

}  // namespace twindeck::buffeting
