/// Oracles: the transfer function of one degree of freedom in closed form; two points in full and in no coherence, and half a
/// wave apart along the wind; the integral of a line by hand.
#include "buffeting/spectral.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "known_derivatives.hpp"
#include "verification/wind_sections.hpp"
#include "wind/spectrum.hpp"

namespace twindeck::buffeting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

constexpr double kSpectralSpeed = 20.0, kSpectralOmega = 2 * std::numbers::pi * 0.7, kSpectralRatio = 0.02;

/// Lift per heave velocity that hangs on the velocity: h1 = V*.
class LinearHeave : public aero::FlutterDerivatives {
 public:
  [[nodiscard]] aero::DerivativeBlock at(double, double v) const override {
    aero::Derivatives18 zasso{};
    zasso[0] = v;
    return aero::to_block(aero::Convention::zasso, zasso, v);
  }
};

aero::AeroelasticSystem one_heave(const aero::DerivativesPtr& derivatives, const std::vector<aero::MaxwellUnit>& maxwell = {}) {
  aero::ReducedStructure s = wind_test::structure({0.7}, kSpectralRatio);
  s.maxwell = maxwell;
  return wind_test::section_model(s, 4.5, 1.25, derivatives, {{0, 1 / std::sqrt(1500.0), 0}});
}

aero::AeroelasticSystem no_self_excitation() { return one_heave(std::make_shared<aero::ConstantZasso>(aero::Derivatives18{})); }

/// Gusts at points along (x) and across (y) the wind.
wind::FieldDefinition gusts_at(const std::vector<Eigen::Vector2d>& points, wind::Component component, double sigma,
                               double decay) {
  wind::FieldDefinition out;
  const auto n = static_cast<Index>(points.size());
  out.component = component;
  out.position_m = MatrixXd::Zero(n, 3);
  for (Index i = 0; i < n; ++i) out.position_m.row(i).head<2>() = points[static_cast<std::size_t>(i)].transpose();
  out.speed_m_s = VectorXd::Constant(n, kSpectralSpeed);
  out.sigma_m_s = VectorXd::Constant(n, sigma);
  out.length_m = VectorXd::Constant(n, 50.0);
  out.decay = {decay, decay, decay};
  return out;
}

double gust_spectrum(wind::Component component, double f, double sigma) {
  return wind::von_karman_spectrum(component, f, sigma, 50.0, kSpectralSpeed);
}

/// |1/(ω0² - ω² + 2iξω0ω + more)|²
double transfer_square(double f, Complex more = 0.0) {
  const double omega = 2 * std::numbers::pi * f;
  return 1.0 / std::norm(Complex(kSpectralOmega * kSpectralOmega - omega * omega, 2 * kSpectralRatio * kSpectralOmega * omega) +
                         more);
}

const VectorXd kThreeFrequencies = Eigen::Vector3d(0.2, 0.7, 1.9);

// S = ω^2p |H|² (R_v² S_v + R_w² S_w) times the square of the sensor's factor.
TEST(ResponseSpectra, OneDegreeOfFreedomHasItsClosedForm) {
  const auto along = gusts_at({{0, 0}}, wind::Component::along, 2.0, 0.0),
             vertical = gusts_at({{0, 0}}, wind::Component::vertical, 1.2, 0.0);
  const MatrixXd load = Eigen::RowVector2d(3.0, -5.0), sensors = Eigen::Vector2d(1.0, 0.1);
  for (const int derivative : {0, 1, 2}) {
    SpectralOptions options;
    options.derivative = derivative;
    const MatrixXd found =
        response_spectra(no_self_excitation(), kSpectralSpeed, load, {along, vertical}, sensors, kThreeFrequencies, options);
    ASSERT_EQ(found.rows(), 3);
    for (Index k = 0; k < 3; ++k) {
      const double f = kThreeFrequencies[k], omega = 2 * std::numbers::pi * f;
      const double expected =
          std::pow(omega, 2 * derivative) * transfer_square(f) *
          (9.0 * gust_spectrum(wind::Component::along, f, 2.0) + 25.0 * gust_spectrum(wind::Component::vertical, f, 1.2));
      EXPECT_NEAR(found(k, 0) / expected, 1.0, 1e-12);
      EXPECT_NEAR(found(k, 1) / expected, 0.01, 1e-14);
    }
  }
}

// Two points: (R1 + R2)² in full coherence, R1² + R2² in none, (R1 - R2)² where a frozen gust reaches the second half a wave
// later.
TEST(ResponseSpectra, TwoPointsInTheLimitsOfCoherence) {
  const double f = 0.5, half_wave = 0.5 * kSpectralSpeed / f;
  const MatrixXd load = (MatrixXd(1, 4) << 0.0, 0.0, 3.0, 2.0).finished(), sensor = MatrixXd::Ones(1, 1);
  const VectorXd at = VectorXd::Constant(1, f);
  SpectralOptions displacement;
  displacement.derivative = 0;
  const auto of = [&](const Eigen::Vector2d& second, double decay, bool frozen) {
    auto along = gusts_at({{0, 0}, second}, wind::Component::along, 2.0, decay),
         vertical = gusts_at({{0, 0}, second}, wind::Component::vertical, 1.2, decay);
    along.frozen = vertical.frozen = frozen;
    return response_spectra(no_self_excitation(), kSpectralSpeed, load, {along, vertical}, sensor, at, displacement)(0, 0);
  };
  const double unit = transfer_square(f) * gust_spectrum(wind::Component::vertical, f, 1.2);
  EXPECT_NEAR(of({0, 30}, 0.0, true) / unit, 25.0, 1e-11);
  EXPECT_NEAR(of({0, 30}, 1e3, true) / unit, 13.0, 1e-11);  // exp(-750)
  EXPECT_NEAR(of({half_wave, 0}, 0.0, true) / unit, 1.0, 1e-10);
  EXPECT_NEAR(of({half_wave, 0}, 0.0, false) / unit, 25.0, 1e-11);
  // Between: gamma = exp(-f C d/V) = exp(-1), R1² + R2² + 2 gamma R1 R2.
  EXPECT_NEAR(of({0, 10}, 4.0, true) / unit, 13.0 + 12.0 * std::exp(-1.0), 1e-11);
  // A quarter of a wave leaves no in-phase part.
  EXPECT_NEAR(of({0.5 * half_wave, 0}, 0.0, true) / unit, 13.0, 1e-10);
}

// The admittance multiplies the spectrum of the force.
TEST(ResponseSpectra, AdmittanceMultipliesTheSpectrum) {
  const auto along = gusts_at({{0, 0}}, wind::Component::along, 2.0, 0.0),
             vertical = gusts_at({{0, 0}}, wind::Component::vertical, 1.2, 0.0);
  const MatrixXd load = Eigen::RowVector2d(3.0, -5.0), sensor = MatrixXd::Ones(1, 1);
  SpectralOptions options;
  const MatrixXd whole =
      response_spectra(no_self_excitation(), kSpectralSpeed, load, {along, vertical}, sensor, kThreeFrequencies, options);
  options.admittance = [](double f) { return 1.0 / (1.0 + f); };
  const MatrixXd less =
      response_spectra(no_self_excitation(), kSpectralSpeed, load, {along, vertical}, sensor, kThreeFrequencies, options);
  for (Index k = 0; k < 3; ++k) EXPECT_NEAR(less(k, 0) / whole(k, 0), 1.0 / (1.0 + kThreeFrequencies[k]), 1e-13);
}

// Damping by the wind ρVB h1/(2m) with h1 = V* = V/(ωB): of each frequency's own, of the frozen one, or of the lowest.
TEST(ResponseSpectra, DerivativesAreThoseOfTheFrequencyAskedFor) {
  const auto along = gusts_at({{0, 0}}, wind::Component::along, 2.0, 0.0),
             vertical = gusts_at({{0, 0}}, wind::Component::vertical, 1.2, 0.0);
  const MatrixXd load = Eigen::RowVector2d(0.0, 1.0), sensor = MatrixXd::Ones(1, 1);
  const auto system = one_heave(std::make_shared<LinearHeave>());
  const auto expect = [&](const SpectralOptions& options, const std::function<double(double)>& omega_of) {
    const MatrixXd found =
        response_spectra(system, kSpectralSpeed, load, {along, vertical}, sensor, kThreeFrequencies, options);
    for (Index k = 0; k < 3; ++k) {
      const double f = kThreeFrequencies[k], omega = 2 * std::numbers::pi * f, h1 = kSpectralSpeed / (omega_of(omega) * 4.5);
      const Complex wind(0.0, omega * 0.5 * 1.25 * kSpectralSpeed * 4.5 * h1 / 1500.0);
      const double expected = transfer_square(f, wind) * gust_spectrum(wind::Component::vertical, f, 1.2);
      EXPECT_NEAR(found(k, 0) / expected, 1.0, 1e-12) << k;
    }
  };
  SpectralOptions options;
  options.derivative = 0;
  expect(options, [](double omega) { return omega; });
  options.lowest_omega = 3.0;
  expect(options, [](double omega) { return std::max(omega, 3.0); });
  options.frozen_omega = 5.0;
  expect(options, [](double) { return 5.0; });
}

// A Maxwell unit is the complex stiffness iωkc/(k + iωc).
TEST(ResponseSpectra, MaxwellUnitsAreAComplexStiffness) {
  const auto along = gusts_at({{0, 0}}, wind::Component::along, 2.0, 0.0),
             vertical = gusts_at({{0, 0}}, wind::Component::vertical, 1.2, 0.0);
  const auto system =
      one_heave(std::make_shared<aero::ConstantZasso>(aero::Derivatives18{}), {{7.0, 3.0, VectorXd::Constant(1, 2.0)}});
  SpectralOptions options;
  options.derivative = 0;
  const MatrixXd found = response_spectra(system, kSpectralSpeed, Eigen::RowVector2d(1.0, 0.0), {along, vertical},
                                          MatrixXd::Ones(1, 1), kThreeFrequencies, options);
  for (Index k = 0; k < 3; ++k) {
    const double f = kThreeFrequencies[k];
    const Complex dashpot(0.0, 2 * std::numbers::pi * f * 3.0);
    const double expected =
        transfer_square(f, 4.0 * 7.0 * dashpot / (7.0 + dashpot)) * gust_spectrum(wind::Component::along, f, 2.0);
    EXPECT_NEAR(found(k, 0) / expected, 1.0, 1e-12);
  }
}

// By hand: the trapezoid rule is exact for a line between its points. 2 f from 0.5 to 3: 9 - 0.25.
TEST(BandRms, IsTheRootOfTheIntegral) {
  const VectorXd f = Eigen::Vector3d(0.5, 1.0, 3.0);
  MatrixXd spectra(3, 2);
  spectra << 1.0, 4.0, 2.0, 4.0, 6.0, 4.0;
  const VectorXd found = band_rms(f, spectra);
  EXPECT_NEAR(found[0], std::sqrt(8.75), 1e-14);
  EXPECT_NEAR(found[1], std::sqrt(10.0), 1e-14);
  EXPECT_EQ(band_rms(f.head(1), spectra.topRows(1)).norm(), 0.0);
}

}  // namespace
}  // namespace twindeck::buffeting
