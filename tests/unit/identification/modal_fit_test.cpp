// Oracles: the modal model that the functions are computed from, in closed form; the scatter of the results over 20 seeds of
// noise.
#include "identification/modal_fit.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "hammer_data.hpp"

namespace twindeck::identification {
namespace {

std::complex<double> pole_of(const twindeck::test::ModalModel& model, Eigen::Index r, double damping_factor = 1.0,
                             double frequency_factor = 1.0) {
  const double zeta = damping_factor * model.damping_ratio[r];
  return 2.0 * std::numbers::pi * frequency_factor * model.frequency_Hz[r] *
         std::complex<double>(-zeta, std::sqrt(1.0 - zeta * zeta));
}

/// Starts with frequencies off by 0.05 % and damping off by 20 %, as a single order of pLSCF may be.
std::vector<FittedMode> fitted(const twindeck::test::ModalModel& model, const ResponseData& data,
                               const std::vector<Eigen::Index>& modes) {
  std::vector<std::complex<double>> start;
  for (const Eigen::Index r : modes) start.push_back(pole_of(model, r, 1.2, 1.0005));
  return fit_modes(data, start);
}

// The model of modal damping has residues proportional to i/omega_r of the shapes' products: the fit's model holds them
// exactly.
TEST(ModalFit, GivesTheModelBackWithoutNoise) {
  const twindeck::test::ModalModel model = twindeck::test::six_modes();
  const ResponseData data = twindeck::test::hammer_data(model, {0, 3}, twindeck::test::lines_of(5.0, 45.0, 641), 0.0, 1);
  const auto modes = fitted(model, data, {0, 1, 2, 3, 4, 5});
  for (Eigen::Index r = 0; r < 6; ++r) {
    const FittedMode& mode = modes[static_cast<std::size_t>(r)];
    EXPECT_LT(std::abs(mode.eigenvalue / pole_of(model, r) - 1.0), 1e-8);
    EXPECT_GT(twindeck::test::mac_with(model, r, mode.shape), 1.0 - 1e-9);
    EXPECT_LT(mode.deviation.frequency_Hz, 1e-6);
  }
}

// Displacement and velocity over force are the same model, divided by i omega.
TEST(ModalFit, TakesDisplacementsAndVelocities) {
  const twindeck::test::ModalModel model = twindeck::test::six_modes();
  ResponseData data = twindeck::test::hammer_data(model, {0}, twindeck::test::lines_of(5.0, 45.0, 641), 0.0, 1);
  for (int derivative = 1; derivative >= 0; --derivative) {
    for (Eigen::Index k = 0; k < data.frequency_Hz.size(); ++k)
      data.values.row(k) /= std::complex<double>(0.0, 2.0 * std::numbers::pi * data.frequency_Hz[k]);
    data.derivative = derivative;
    const auto modes = fitted(model, data, {0, 1, 2, 3, 4, 5});
    for (Eigen::Index r = 0; r < 6; ++r)
      EXPECT_LT(std::abs(modes[static_cast<std::size_t>(r)].eigenvalue / pole_of(model, r) - 1.0), 1e-8);
  }
}

// Modes below and above the band are left to the residual terms: 0.15 % of a frequency, 1 % of a damping ratio. The deviations
// hold the error, because they have the change that the outer residual terms bring.
TEST(ModalFit, LeavesModesOutsideTheBandToTheResidualTerms) {
  const twindeck::test::ModalModel model = twindeck::test::six_modes();
  const ResponseData data = twindeck::test::hammer_data(model, {0}, twindeck::test::lines_of(12.0, 35.0, 369), 0.0, 1);
  const auto modes = fitted(model, data, {2, 3, 4});
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const auto r = static_cast<Eigen::Index>(k) + 2;
    const double frequency = std::abs(modes[k].eigenvalue) / (2.0 * std::numbers::pi);
    EXPECT_NEAR(frequency, model.frequency_Hz[r], 1.5e-3 * model.frequency_Hz[r]);
    EXPECT_NEAR(-modes[k].eigenvalue.real() / std::abs(modes[k].eigenvalue), model.damping_ratio[r],
                0.01 * model.damping_ratio[r]);
    EXPECT_GT(twindeck::test::mac_with(model, r, modes[k].shape), 0.997);
    EXPECT_LT(std::abs(frequency - model.frequency_Hz[r]), 3.0 * modes[k].deviation.frequency_Hz);
  }
}

// Errors in units of the stated deviations have an RMS near 1: over 20 seeds and 6 modes its own deviation is 7 %.
TEST(ModalFit, StatesDeviationsThatTheScatterHas) {
  const twindeck::test::ModalModel model = twindeck::test::six_modes();
  double frequency = 0.0, damping = 0.0, shape = 0.0, shapes = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const ResponseData data = twindeck::test::hammer_data(model, {0, 3}, twindeck::test::lines_of(5.0, 45.0, 641), 0.02, seed);
    const auto modes = fitted(model, data, {0, 1, 2, 3, 4, 5});
    for (Eigen::Index r = 0; r < 6; ++r) {
      const FittedMode& mode = modes[static_cast<std::size_t>(r)];
      const double size = std::abs(mode.eigenvalue);
      frequency += std::pow((size / (2.0 * std::numbers::pi) - model.frequency_Hz[r]) / mode.deviation.frequency_Hz, 2);
      damping += std::pow((-mode.eigenvalue.real() / size - model.damping_ratio[r]) / mode.deviation.damping_ratio, 2);
      const Eigen::VectorXcd truth = model.shapes.col(r).cast<std::complex<double>>();
      const std::complex<double> along = truth.dot(mode.shape);
      const Eigen::VectorXcd off = mode.shape - truth * (along / std::abs(along));
      shape += off.squaredNorm();
      shapes += mode.deviation.shape_real.squaredNorm() + mode.deviation.shape_imag.squaredNorm();
    }
  }
  EXPECT_NEAR(std::sqrt(frequency / 120.0), 1.0, 0.25);
  EXPECT_NEAR(std::sqrt(damping / 120.0), 1.0, 0.25);
  // A phase that is free and the scale are part of the stated deviations of a shape, not of the error.
  EXPECT_LT(shape, 1.2 * shapes);
  EXPECT_GT(shape, 0.4 * shapes);
}

}  // namespace
}  // namespace twindeck::identification
