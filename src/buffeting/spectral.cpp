#include "buffeting/spectral.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "linalg/dense.hpp"

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

/// The real part of a complex matrix above its imaginary part. A real factor then multiplies both at once.
MatrixXd split_parts(const MatrixXcd& complex) {
  MatrixXd split(2 * complex.rows(), complex.cols());
  split << complex.real(), complex.imag();
  return split;
}

/// Split transfer from unit turbulence times the turbulence's size and drift at each strip.
MatrixXd scaled_transfer(const Eigen::Ref<const MatrixXd>& split, const Eigen::VectorXcd& point) {
  const Index rows = split.rows() / 2;
  const VectorXd real = point.real(), imaginary = point.imag();
  MatrixXd out(split.rows(), split.cols());
  out.topRows(rows) = split.topRows(rows) * real.asDiagonal() - split.bottomRows(rows) * imaginary.asDiagonal();
  out.bottomRows(rows) = split.topRows(rows) * imaginary.asDiagonal() + split.bottomRows(rows) * real.asDiagonal();
  return out;
}

/// The change of the impedance by one slope, between pairs of vectors. Parts that are zero are skipped.
struct ImpedanceParts {
  const SystemSlope& slope;
  bool of_stiffness, of_damping;
  explicit ImpedanceParts(const SystemSlope& of)
      : slope(of), of_stiffness(!of.stiffness.isZero(0.0) || !of.mass.isZero(0.0)), of_damping(!of.damping.isZero(0.0)) {}

  /// @param left, right  (m × n)  @return (n) real parts of left_i' dZ right_i, not conjugated
  [[nodiscard]] VectorXd between(const aero::AeroelasticSystem& system, const MatrixXcd& left, const MatrixXcd& right,
                                 double omega) const {
    MatrixXcd product = MatrixXcd::Zero(right.rows(), right.cols());
    MatrixXd split(right.rows(), 2 * right.cols());
    split << right.real(), right.imag();
    if (of_stiffness) {
      const MatrixXd real = (slope.stiffness - omega * omega * slope.mass) * split;
      product.real() += real.leftCols(right.cols());
      product.imag() += real.rightCols(right.cols());
    }
    if (of_damping) {
      const MatrixXd imaginary = omega * slope.damping * split;
      product.real() -= imaginary.rightCols(right.cols());
      product.imag() += imaginary.leftCols(right.cols());
    }
    if (slope.maxwell != 0.0) {
      for (const aero::MaxwellUnit& unit : system.structure().maxwell)  // in proportion to both constants
        product += slope.maxwell * maxwell_stiffness(unit, omega) * unit.direction.cast<std::complex<double>>() *
                   (unit.direction.transpose() * right);
    }
    return left.cwiseProduct(product).real().colwise().sum().transpose();
  }
};

/// Size and phase of a field's turbulence at each strip.
Eigen::VectorXcd turbulence_at_points(const wind::FieldDefinition& field, double f_Hz) {
  return wind::spectra(field, f_Hz).cwiseSqrt().cwiseProduct(wind::drift(field, f_Hz));
}

}  // namespace

MatrixXcd impedance(const aero::AeroelasticSystem& system, const aero::AeroelasticSystem::Block& air, double omega) {
  const aero::ReducedStructure& structure = system.structure();
  MatrixXd real = -air.stiffness, imaginary = omega * (structure.damping() - air.damping);
  real.diagonal().array() += structure.omega_rad_s.array().square() - omega * omega;
  for (const aero::MaxwellUnit& unit : structure.maxwell) {
    const std::complex<double> k = maxwell_stiffness(unit, omega);
    real += k.real() * unit.direction * unit.direction.transpose();
    imaginary += k.imag() * unit.direction * unit.direction.transpose();
  }
  MatrixXcd z(real.rows(), real.cols());
  z.real() = real;
  z.imag() = imaginary;
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
  return Eigen::Map<const VectorXd>(f.data(), std::ssize(f));
}

MatrixXd response_spectra(const aero::AeroelasticSystem& system, double speed_m_s, const Eigen::Ref<const MatrixXd>& load,
                          const std::vector<wind::FieldDefinition>& fields, const Eigen::Ref<const MatrixXd>& sensors,
                          const Eigen::Ref<const VectorXd>& f_Hz, const SpectralOptions& options) {
  const Index strips = fields.front().size();
  MatrixXd spectra = MatrixXd::Zero(f_Hz.size(), sensors.rows());
  const bool is_frozen = options.frozen_omega > 0.0;
  const aero::AeroelasticSystem::Block frozen =
      is_frozen ? system.self_excited(speed_m_s, options.frozen_omega) : aero::AeroelasticSystem::Block();
  parallel_for(f_Hz.size(), [&](Index k) {
    const double omega = 2.0 * std::numbers::pi * f_Hz[k];
    // There are fewer sensors than loads, so the transposed system is solved for the sensors.
    MatrixXcd z =
        impedance(system, is_frozen ? frozen : system.self_excited(speed_m_s, std::max(omega, options.lowest_omega)), omega)
            .transpose();
    const MatrixXcd left = linalg::solve(std::move(z), sensors.transpose().cast<std::complex<double>>());
    const double power = std::pow(omega, options.derivative);
    const MatrixXd transfer = power * linalg::product(split_parts(left.transpose()), load);
    const double chi = options.admittance ? options.admittance(f_Hz[k]) : 1.0;
    for (std::size_t c = 0; c < fields.size(); ++c) {
      const wind::FieldDefinition& field = fields[c];
      const Index first = static_cast<Index>(c) * strips;
      // Refuses a table that is not positive definite, because a variance could be negative.
      if (field.coherence_table) static_cast<void>(wind::coherence_factor(field, f_Hz[k]));
      const MatrixXd split = scaled_transfer(transfer.middleCols(first, strips), turbulence_at_points(field, f_Hz[k]));
      const VectorXd square = linalg::product(split, wind::coherence(field, f_Hz[k])).cwiseProduct(split).rowwise().sum();
      spectra.row(k) += chi * (square.head(sensors.rows()) + square.tail(sensors.rows())).transpose();
    }
  });
  return spectra;
}

std::vector<MatrixXd> response_spectra_slopes(const aero::AeroelasticSystem& system, double speed_m_s,
                                              const Eigen::Ref<const MatrixXd>& load,
                                              const std::vector<wind::FieldDefinition>& fields,
                                              const Eigen::Ref<const MatrixXd>& sensors, const Eigen::Ref<const VectorXd>& f_Hz,
                                              const std::vector<SystemSlope>& slopes, const SpectralOptions& options) {
  TWINDECK_ASSERT(options.frozen_omega > 0.0);
  const Index strips = fields.front().size(), rows = sensors.rows(), n = std::ssize(slopes);
  std::vector<MatrixXd> out(static_cast<std::size_t>(rows), MatrixXd::Zero(f_Hz.size(), n));
  const aero::AeroelasticSystem::Block frozen = system.self_excited(speed_m_s, options.frozen_omega);
  const std::vector<ImpedanceParts> parts(slopes.begin(), slopes.end());
  parallel_for(f_Hz.size(), [&](Index k) {
    const double omega = 2.0 * std::numbers::pi * f_Hz[k];
    const Eigen::PartialPivLU<MatrixXcd> factor(impedance(system, frozen, omega).transpose());
    const MatrixXcd left = factor.solve(sensors.transpose().cast<std::complex<double>>());
    // With t = left' R of a field, C its coherence and s = C t*:  d(t C t*) = 2 Re(dt s), and dt s = -left' dZ Z^-1 (R s) +
    // left' dR s. One solution a sensor serves all slopes.
    MatrixXcd weights(load.cols(), rows);
    VectorXd square = VectorXd::Zero(rows);
    for (std::size_t c = 0; c < fields.size(); ++c) {
      const wind::FieldDefinition& field = fields[c];
      const Index first = static_cast<Index>(c) * strips;
      const Eigen::VectorXcd point = turbulence_at_points(field, f_Hz[k]);
      const MatrixXcd transfer = (left.transpose() * load.middleCols(first, strips)) * point.asDiagonal();
      const MatrixXcd through = wind::coherence(field, f_Hz[k]) * transfer.adjoint();
      square += transfer.transpose().cwiseProduct(through).real().colwise().sum().transpose();
      weights.middleRows(first, strips) = point.asDiagonal() * through;
    }
    const MatrixXcd answer = factor.transpose().solve(load * weights);
    const double scale =
        2.0 * std::pow(omega, 2 * options.derivative) * (options.admittance ? options.admittance(f_Hz[k]) : 1.0);
    for (Index p = 0; p < n; ++p) {
      const SystemSlope& slope = slopes[static_cast<std::size_t>(p)];
      VectorXd change = slope.turbulence * square - parts[static_cast<std::size_t>(p)].between(system, left, answer, omega);
      if (slope.load.size() > 0) change += left.cwiseProduct(slope.load * weights).real().colwise().sum().transpose();
      for (Index row = 0; row < rows; ++row) out[static_cast<std::size_t>(row)](k, p) = scale * change[row];
    }
  });
  return out;
}

VectorXd band_rms(const Eigen::Ref<const VectorXd>& f_Hz, const Eigen::Ref<const MatrixXd>& spectra) {
  VectorXd variance = VectorXd::Zero(spectra.cols());
  for (Index k = 1; k < f_Hz.size(); ++k)
    variance += 0.5 * (f_Hz[k] - f_Hz[k - 1]) * (spectra.row(k) + spectra.row(k - 1)).transpose();
  return variance.cwiseSqrt();
}

}  // namespace twindeck::buffeting
