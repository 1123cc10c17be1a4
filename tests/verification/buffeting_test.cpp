/// Oracles: the joint acceptance of a simply supported beam in closed form; the IABSE Task Group 3.1 flat plate, power spectra
/// and RMS (Diana et al. 2020, Struct. Eng. Int. 30, 151-166, numbers as carried in public code).
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "buffeting/field_statistics.hpp"
#include "buffeting/loads.hpp"
#include "buffeting/response.hpp"
#include "buffeting/spectral.hpp"
#include "known_derivatives.hpp"
#include "linear_polar.hpp"
#include "verification_table.hpp"
#include "wind/spectrum.hpp"

namespace twindeck::buffeting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A simply supported beam that moves in its first mode, sin(pi x / L), under vertical gusts.
struct Beam {
  double length = 150.0, mass = 1500.0, frequency = 0.7244, chord = 4.5, speed = 19.1, slope = 3.0;
  double sigma = 1.012, scale = 10.3, decay = 6.5, ratio = 0.01;

  [[nodiscard]] aero::AeroelasticSystem system(Index points) const {
    aero::ReducedStructure structure;
    structure.omega_rad_s = VectorXd::Constant(1, 2.0 * std::numbers::pi * frequency);
    structure.damping_ratio = VectorXd::Constant(1, ratio);
    aero::StaticCoefficients c;
    c.lift_slope = slope;
    std::vector<aero::SectionAero> sections = {
        {"beam", chord, aero::linear_polar(c), std::make_shared<aero::ConstantZasso>(aero::Derivatives18{})}};
    const aero::Wind wind;
    std::vector<aero::Strip> strips;
    std::vector<aero::StripMotion> motions;
    for (Index i = 0; i < points; ++i) {
      const double x = length * (static_cast<double>(i) + 0.5) / static_cast<double>(points);
      strips.push_back(
          aero::make_strip("beam", 0, x, length / static_cast<double>(points), {x, 0.0, 0.0}, Eigen::Vector3d::UnitX(), wind));
      aero::StripMotion motion = aero::StripMotion::Zero(6, 1);
      motion(2, 0) = std::sin(std::numbers::pi * x / length) * std::sqrt(2.0 / (mass * length));
      motions.push_back(motion);
    }
    return {structure, sections, strips, motions, wind, aero::everywhere(aero::published_yaw_rule("A"))};
  }
  [[nodiscard]] wind::FieldDefinition field(Index points, wind::Component component) const {
    wind::FieldDefinition out;
    out.component = component;
    out.position_m = MatrixXd::Zero(points, 3);
    for (Index i = 0; i < points; ++i)
      out.position_m(i, 1) = length * (static_cast<double>(i) + 0.5) / static_cast<double>(points);
    out.speed_m_s = VectorXd::Constant(points, speed);
    out.sigma_m_s = VectorXd::Constant(points, component == wind::Component::vertical ? sigma : 0.0);
    out.length_m = VectorXd::Constant(points, scale);
    out.decay = {decay, decay, decay};
    return out;
  }
  /// Mid-span [m/√kg].
  [[nodiscard]] MatrixXd sensor() const { return MatrixXd::Constant(1, 1, std::sqrt(2.0 / (mass * length))); }

  /// J² = ∫∫ sin sin exp(-c |x - x'| / L) dx dx' / L² = c/(c² + pi²) + 2 pi² (1 + e^-c)/(c² + pi²)², times the square of the
  /// mode.
  [[nodiscard]] double rms(int derivative, double to_Hz) const {
    const double pi = std::numbers::pi, omega0 = 2.0 * pi * frequency;
    double variance = 0.0;
    const Index n = 200000;
    for (Index i = 1; i <= n; ++i) {
      const double f = to_Hz * static_cast<double>(i) / static_cast<double>(n), omega = 2.0 * pi * f;
      const double c = decay * f * length / speed, sum = c * c + pi * pi;
      const double j2 = c / sum + 2.0 * pi * pi * (1.0 + std::exp(-c)) / (sum * sum);
      const double force = 0.5 * 1.25 * speed * chord * slope;
      const double modal = force * force * wind::von_karman_spectrum(wind::Component::vertical, f, sigma, scale, speed) *
                           length * length * j2 * 2.0 / (mass * length);
      const double h2 = 1.0 / (std::pow(omega0 * omega0 - omega * omega, 2) + std::pow(2.0 * ratio * omega0 * omega, 2));
      variance += modal * h2 * std::pow(omega, 2 * derivative) * to_Hz / static_cast<double>(n);
    }
    return std::sqrt(variance * 2.0 / (mass * length));
  }
};

VectorXd frequencies(double from, double to, Index n) {
  VectorXd f(n);
  for (Index i = 0; i < n; ++i) f[i] = from * std::pow(to / from, static_cast<double>(i) / static_cast<double>(n - 1));
  return f;
}

VectorXd around(double f0, double to) {
  std::vector<double> f;
  for (double x = 1e-3; x < to; x += std::min(0.01, std::max(2e-4, 0.05 * std::abs(x - f0)))) f.push_back(x);
  f.push_back(to);
  return Eigen::Map<VectorXd>(f.data(), static_cast<Index>(f.size()));
}

TEST(BuffetingBeam, ClosedFormIsThePrototypes) {
  Beam beam;
  EXPECT_NEAR(beam.rms(0, 8.0), 0.00722, 1e-5);
  EXPECT_NEAR(beam.rms(2, 8.0), 0.1316, 2e-4);
  beam.ratio = 0.03;
  EXPECT_NEAR(beam.rms(0, 8.0), 0.00500, 2e-5);
  EXPECT_NEAR(beam.rms(2, 8.0), 0.0755, 2e-4);
}

TEST(BuffetingBeam, SpectralResponseMeetsJointAcceptance) {
  // Points stand for stretches: a midpoint rule for J², which over-estimates it where gusts are as short as the stretches. The
  // error falls with their square.
  const Beam beam;
  SpectralOptions displacements;
  displacements.derivative = 0;
  const VectorXd f = around(beam.frequency, 8.0);
  std::vector<double> excess;
  for (const Index points : {30, 60, 120}) {
    const aero::AeroelasticSystem system = beam.system(points);
    const MatrixXd load = load_matrix(system, beam.speed, aero::Equations::consistent);
    const MatrixXd s = response_spectra(
        system, beam.speed, load, {beam.field(points, wind::Component::along), beam.field(points, wind::Component::vertical)},
        beam.sensor(), f, displacements);
    excess.push_back(band_rms(f, s)[0] / beam.rms(0, 8.0) - 1.0);
    verification::record("Buffeting of a beam, " + std::to_string(points) + " points, displacement RMS [m]", beam.rms(0, 8.0),
                         (1.0 + excess.back()) * beam.rms(0, 8.0));
  }
  EXPECT_LT(excess[2], 0.004);
  EXPECT_NEAR(excess[0] / excess[1], 4.0, 1.0);
  EXPECT_NEAR(excess[1] / excess[2], 4.0, 1.0);
}

TEST(BuffetingBeam, TimeHistoriesMeetJointAcceptance) {
  // 20 seeds of 600 s at 1/64 s. The closed form lies within the interval of the mean (99 %) widened by the lumping of 60
  // points (1 %).
  Beam beam;
  beam.ratio = 0.03;
  const Index points = 60;
  const double step = 1.0 / 64;
  const aero::AeroelasticSystem system = beam.system(points);
  const MatrixXd load = load_matrix(system, beam.speed, aero::Equations::consistent).rightCols(points);
  const wind::Simulator simulator(beam.field(points, wind::Component::vertical), {.rate_Hz = 64.0, .cutoff_Hz = 8.0});
  const transient::Newmark newmark(equations_of_motion(system, beam.speed, 1.0), step);
  VectorXd rms(20);
  for (Index s = 0; s < 20; ++s) {
    const Response response = respond(newmark, load, simulator.sample(static_cast<std::uint64_t>(s)), step, beam.sensor());
    rms[s] = root_mean_squares(response.acceleration_m_s2)[0];
  }
  const Interval found = confidence_interval(rms, 0.99);
  const double exact = beam.rms(2, 8.0);
  verification::record("Buffeting of a beam, 20 seeds in time, acceleration RMS [m/s2]", exact, found.mean);
  std::printf("  mean of 20 seeds over closed form %.4f, interval %.4f to %.4f, one seed %.1f %%\n", found.mean / exact,
              found.low / exact, found.high / exact, 100.0 * found.deviation / found.mean);
  EXPECT_LT(found.low, exact * 1.01);
  EXPECT_GT(found.high, exact);
  EXPECT_LT((found.high - found.low) / exact, 0.10);  // an interval that wide could not miss: 5.8 % a seed gives 7.4 %
}

/// Flat plate without the apparent rotary inertia (pi/64 B⁴ a unit of A3*), as the benchmark has it.
class BenchmarkPlate : public aero::FlutterDerivatives {
 public:
  [[nodiscard]] aero::DerivativeBlock at(double alpha_rad, double v_over_omegaB) const override {
    aero::DerivativeBlock block = aero::FlatPlate().at(alpha_rad, v_over_omegaB);
    block.stiffness(2, 2) -= std::numbers::pi / 64.0;
    return block;
  }
};

struct PlateTargets {
  double speed;
  double heave_rms, torsion_rms;         ///< [m], torsion at the deck's edge
  std::array<double, 9> heave, torsion;  ///< PSD at the benchmark's nine frequencies; torsion times (B/2)²
};

constexpr double kPlateChord_m = 31.0, kPlateMass = 22740.0, kPlateInertia = 2.47e6;  // a metre of the deck
constexpr std::array<double, 9> kPlateFrequencies_Hz = {0.001, 0.01, 0.052, 0.1, 0.2, 0.234, 0.278, 0.3, 0.35};

const std::vector<PlateTargets>& plate_targets() {
  static const std::vector<PlateTargets> targets = {
      {15,
       0.2603,
       0.0419,
       {0.124, 0.119, 0.137, 4.09, 5.66e-4, 1.75e-4, 2.15e-4, 2.18e-5, 7.02e-6},
       {0.00253, 0.00239, 0.00156, 1.85e-4, 4.94e-4, 9.05e-4, 0.0707, 0.00102, 5.71e-5}},
      {30,
       0.778,
       0.2027,
       {1.19, 1.15, 1.75, 20.6, 0.0302, 0.0127, 0.00461, 9.67e-4, 3.75e-4},
       {0.0243, 0.0231, 0.0198, 9.3e-4, 0.0259, 0.0616, 0.423, 0.0346, 0.00294}},
      {45,
       1.3404,
       0.4792,
       {5.6, 5.4, 7.45, 34.3, 0.341, 0.25, 0.0167, 0.00585, 0.00278},
       {0.115, 0.108, 0.0846, 0.00155, 0.285, 1.11, 0.706, 0.152, 0.0207}},
      {60,
       2.1601,
       0.9306,
       {23.9, 22.5, 23.6, 44.5, 3.44, 6.03, 0.0341, 0.0162, 0.00921},
       {0.489, 0.451, 0.267, 0.002, 2.77, 23.8, 0.828, 0.306, 0.0637}},
      {75,
       4.4848,
       2.8414,
       {147, 124, 61.7, 53.2, 948, 1.79, 0.0534, 0.0304, 0.0198},
       {3.02, 2.5, 0.699, 0.00238, 729, 6.17, 0.839, 0.426, 0.126}}};
  return targets;
}

/// One strip of one metre; coordinates heave and rotation, scaled to unit mass.
aero::AeroelasticSystem plate() {
  aero::ReducedStructure structure;
  structure.omega_rad_s =
      Eigen::Vector2d(std::sqrt(8977.39216323088 / kPlateMass), std::sqrt(7536093.564553846 / kPlateInertia));
  structure.damping_ratio = Eigen::Vector2d::Constant(0.003);
  aero::StaticCoefficients c;
  c.lift_slope = 2.0 * std::numbers::pi;
  c.moment_slope = 0.5 * std::numbers::pi;
  aero::Wind air;
  air.density_kg_m3 = 1.22;
  const aero::Strip strip = aero::make_strip("deck", 0, 0.0, 1.0, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), air);
  aero::StripMotion motion = aero::StripMotion::Zero(6, 2);
  motion(2, 0) = 1.0 / std::sqrt(kPlateMass);
  // nose-up about the deck's axis, whatever its sense
  const Eigen::Vector3d axis(aero::nose_up(strip, Eigen::Vector3d::UnitX()), 0.0, 0.0);
  motion.block<3, 1>(3, 1) = axis / std::sqrt(kPlateInertia);
  return aero::AeroelasticSystem(structure,
                                 {{"deck", kPlateChord_m, aero::linear_polar(c), std::make_shared<BenchmarkPlate>()}}, {strip},
                                 {motion}, air, aero::everywhere(aero::published_yaw_rule("A")));
}

/// The benchmark's vertical turbulence at one point.
wind::FieldDefinition plate_gusts(double v) {
  wind::FieldDefinition gusts;
  gusts.component = wind::Component::vertical;
  gusts.position_m = MatrixXd::Zero(1, 3);
  gusts.speed_m_s = VectorXd::Constant(1, v);
  gusts.sigma_m_s = VectorXd::Constant(1, 0.05 * v);
  gusts.length_m = VectorXd::Constant(1, 20.0);
  return gusts;
}

TEST(BuffetingIabse, FlatPlateHasThePublishedSpectra) {
  const aero::AeroelasticSystem system = plate();
  MatrixXd sensors(2, 2);
  sensors << 1.0 / std::sqrt(kPlateMass), 0.0, 0.0, 1.0 / std::sqrt(kPlateInertia);
  const VectorXd nine = Eigen::Map<const VectorXd>(kPlateFrequencies_Hz.data(), 9);
  for (const PlateTargets& target : plate_targets()) {
    const double v = target.speed;
    const wind::FieldDefinition gusts = plate_gusts(v);
    wind::FieldDefinition none = gusts;
    none.component = wind::Component::along;
    none.sigma_m_s.setZero();
    SpectralOptions options;
    options.derivative = 0;
    // Davenport's admittance on the force, squared on its spectrum, with 7 f B / V.
    options.admittance = [&](double f) {
      const double k = 7.0 * f * kPlateChord_m / v, chi = 2.0 * (k - 1.0 + std::exp(-k)) / (k * k);
      return chi * chi;
    };
    const MatrixXd load = load_matrix(system, v, aero::Equations::consistent);
    const MatrixXd s = response_spectra(system, v, load, {none, gusts}, sensors, nine, options);
    for (Index i = 0; i < 9; ++i) {
      // Three printed digits, and the last two at 75 m/s, 3 % below flutter, where a frequency off by 0.1 % moves a flank by
      // more.
      const double limit = v == 75.0 ? 0.02 : 0.008;
      EXPECT_NEAR(s(i, 0) / target.heave[static_cast<std::size_t>(i)], 1.0, limit) << v << " m/s, heave at " << nine[i];
      EXPECT_NEAR(s(i, 1) * 0.25 * kPlateChord_m * kPlateChord_m / target.torsion[static_cast<std::size_t>(i)], 1.0, limit)
          << v << " m/s, torsion at " << nine[i];
    }
    const VectorXd f = frequencies(1e-3, 2.0, 6000);  // from the lowest published frequency
    const VectorXd rms_all = band_rms(f, response_spectra(system, v, load, {none, gusts}, sensors, f, options));
    const double rms = rms_all[0];
    const std::string where = " at " + std::to_string(static_cast<int>(v)) + " m/s [m]";
    verification::record("IABSE flat plate, heave RMS" + where, target.heave_rms, rms);
    verification::record("IABSE flat plate, torsion RMS of the edge" + where, target.torsion_rms,
                         0.5 * kPlateChord_m * rms_all[1]);
    // The published RMS are means over the task group's participants, who scattered by 5 to 10 % in heave and 10 to 25 % in
    // torsion, and not the integrals of the spectra published beside them, which ours meet above: at 15 m/s the spectrum's
    // integral over any sensible band and grid is 3.6 % less in heave and 18 % in torsion. Torsion is therefore shown, not
    // judged.
    EXPECT_NEAR(rms / target.heave_rms, 1.0, v == 15.0 ? 0.04 : 0.03) << v;
  }
}

}  // namespace
}  // namespace twindeck::buffeting
