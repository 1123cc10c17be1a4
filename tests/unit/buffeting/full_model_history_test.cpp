/// Oracles: the forced oscillator from rest in closed form, and the order of the method; Rayleigh's damping at two frequencies;
/// the same equations, dense and with the inner points of Maxwell units, by Newmark's method of transient.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "aero/wind_model.hpp"
#include "buffeting/time_checks.hpp"
#include "transient/newmark.hpp"
#include "unit/aero/beam_deck.hpp"

namespace twindeck::buffeting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using tests::BeamDeck;

MatrixXd dense(const linalg::SparseMatrix& lower) { return MatrixXd(lower).selfadjointView<Eigen::Lower>(); }

/// ξ = a/(2ω) + bω/2
TEST(RayleighDamping, HasItsRatioAtBothFrequencies) {
  const RayleighDamping found = RayleighDamping::with_ratio(0.02, 3.0, 11.0);
  for (const double omega : {3.0, 11.0})
    EXPECT_NEAR(found.mass_part / (2 * omega) + found.stiffness_part * omega / 2, 0.02, 1e-16);
  EXPECT_GT(found.mass_part, 0.0);
  EXPECT_GT(found.stiffness_part, 0.0);
}

/// q̈ + 2ξωq̇ + ω²q = sin Ωt from rest: the steady motion, and the free one that makes it start from rest.
double forced_acceleration(double omega, double ratio, double drive, double t) {
  const double real = omega * omega - drive * drive, imaginary = 2 * ratio * omega * drive;
  const double size = real * real + imaginary * imaginary;
  const double s = real / size, c = -imaginary / size;  // q = s sin + c cos
  const double damped = omega * std::sqrt(1 - ratio * ratio), decay = ratio * omega;
  const double a = -c, b = (-s * drive + decay * a) / damped;  // free: e^(-decay t) (a cos + b sin)
  const std::complex<double> root(-decay, damped), amplitude(a, -b);
  return -drive * drive * (s * std::sin(drive * t) + c * std::cos(drive * t)) +
         (amplitude * root * root * std::exp(root * t)).real();
}

/// Loads M phi of the first mode move that mode alone, with Rayleigh's damping too. The largest error over 4 s, over the
/// largest acceleration.
double error_of_first_mode(double step_s) {
  const BeamDeck deck;
  const dynamics::LoadedModel loaded = dynamics::from_model(deck.model());
  const dynamics::EigenModes modes = dynamics::available_modes(loaded.system, loaded.theta, 1);
  const VectorXd pattern = dense(loaded.system.mass(loaded.theta)) * modes.shapes.col(0);
  const double omega = std::sqrt(modes.eigenvalue[0]), drive = 0.7 * omega;
  const auto steps = static_cast<Index>(std::llround(4.0 / step_s)) + 1;
  MatrixXd amplitude(1, steps);
  VectorXd exact(steps);
  for (Index i = 0; i < steps; ++i) {
    const double t = step_s * static_cast<double>(i);
    amplitude(0, i) = std::sin(drive * t);
    exact[i] = forced_acceleration(omega, 0.03, drive, t);
  }
  const MatrixXd found = full_model_history(loaded, {}, RayleighDamping::with_ratio(0.03, omega, 5 * omega), pattern, amplitude,
                                            pattern.transpose(), step_s);
  return (found.row(0).transpose() - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff();
}

// The period errs by (ω dt)²/12 = 1e-3 at 1/64 s, over 4.5 periods a phase of 3 %; half the step, a quarter of the error.
TEST(FullModelHistory, ConvergesToTheForcedOscillatorWithSecondOrder) {
  const double coarse = error_of_first_mode(1.0 / 64), fine = error_of_first_mode(1.0 / 128);
  EXPECT_LT(coarse, 0.04);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1);
}

// A dashpot alone, a dashpot beside a spring, and a Maxwell unit between two nodes: eliminated step by step, they act as in the
// whole system. Both follow the trapezoidal rule, so they agree to rounding.
TEST(FullModelHistory, DampersActAsInTheWholeSystem) {
  const BeamDeck deck;
  fe::Model model = deck.model();
  BeamDeck::add_damper(model, 5, 2e4);
  BeamDeck::add_damper(model, deck.middle(), 6e4, 4e5);
  model.springs.back().node2 = 3;
  BeamDeck::add_damper(model, 7, 1e4);  // Kelvin: its spring is in the model's stiffness
  model.springs.back().stiffness = 3e5;
  BeamDeck::add_damper(model, 9, 1e4);  // another, which is not active, so that its spring is not
  model.springs.back().stiffness = 2e5;
  model.springs.back().active = false;
  const dynamics::LoadedModel loaded = dynamics::from_model(model);
  const auto dampers = aero::dampers_of(*loaded.model);
  const MatrixXd direction = aero::damper_patterns(loaded, dampers);
  const RayleighDamping rayleigh = RayleighDamping::with_ratio(0.01, 7.0, 35.0);
  const Index n = loaded.system.size(), steps = 200;
  const double step = 1.0 / 64;
  MatrixXd patterns(n, 2), amplitude(2, steps);
  for (Index i = 0; i < n; ++i)
    patterns.row(i) << std::sin(1.0 + static_cast<double>(i)), std::cos(2.0 * static_cast<double>(i));
  for (Index i = 0; i < steps; ++i) {
    const double t = step * static_cast<double>(i);
    amplitude.col(i) << std::sin(9.0 * t), std::sin(5.0 * t) * t;
  }
  transient::LinearSystem whole;
  whole.mass = dense(loaded.system.mass(loaded.theta));
  whole.stiffness = dense(loaded.system.stiffness(loaded.theta));
  whole.stiffness += 2e5 * direction.col(3) * direction.col(3).transpose();
  whole.damping = rayleigh.mass_part * whole.mass + rayleigh.stiffness_part * whole.stiffness +
                  2e4 * direction.col(0) * direction.col(0).transpose() +
                  1e4 * direction.rightCols(2) * direction.rightCols(2).transpose();
  transient::add_maxwell(whole, direction.col(1), 4e5, 6e4);
  const MatrixXd expected = transient::Newmark(whole, step).run(patterns * amplitude).acceleration.topRows(n);
  const MatrixXd found = full_model_history(loaded, dampers, rayleigh, patterns, amplitude, MatrixXd::Identity(n, n), step);
  EXPECT_LT((found - expected).rightCols(steps - 1).norm(), 1e-7 * expected.norm());
  // The dampers count: without them the motion is another.
  const MatrixXd free = full_model_history(loaded, {}, rayleigh, patterns, amplitude, MatrixXd::Identity(n, n), step);
  EXPECT_GT((free - expected).norm(), 0.05 * expected.norm());
}

}  // namespace
}  // namespace twindeck::buffeting
