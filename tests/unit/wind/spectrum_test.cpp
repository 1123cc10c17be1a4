/// Oracles: integrals of the spectra (the variance), their slope at high frequency, printed code
/// values.
#include "wind/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "wind/turbulence.hpp"

namespace twindeck::wind {
namespace {

double integral(Component component, double from_Hz, double to_Hz) {
  // trapezoid in ln f: the integrand f S is smooth over decades
  const int steps = 20000;
  const double step = std::log(to_Hz / from_Hz) / steps;
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double f = from_Hz * std::exp(step * i);
    sum += (i == 0 || i == steps ? 0.5 : 1.0) * f * von_karman_spectrum(component, f, 2.0, 80.0, 19.1) * step;
  }
  return sum;
}

TEST(Spectrum, IntegratesToTheVariance) {
  // 70.8, 283.2 and 755.2 are rounded constants: the exact integral of the printed forms is sigma² to 2e-3.
  for (const Component c : components) EXPECT_NEAR(integral(c, 1e-7, 1e5) / 4.0, 1.0, 3e-3) << paper_letter(c);
}

TEST(Spectrum, FallsByMinusFiveThirdsAndVerticalTendsToFourThirdsOfAlong) {
  // Kolmogorov's inertial range; local isotropy makes the across spectra 4/3 of the along one at equal sigma and length.
  for (const Component c : components) {
    const double ratio = von_karman_spectrum(c, 2e4, 1.0, 80.0, 20.0) / von_karman_spectrum(c, 1e4, 1.0, 80.0, 20.0);
    EXPECT_NEAR(std::log2(ratio), -5.0 / 3.0, 1e-5);
  }
  // Isotropic: sigma equal, and the vertical length scale (along the wind) half of the along one.
  const double along = von_karman_spectrum(Component::along, 1e4, 1.0, 80.0, 20.0);
  EXPECT_NEAR(von_karman_spectrum(Component::vertical, 1e4, 1.0, 40.0, 20.0) / along, 4.0 / 3.0, 2e-3);
}

TEST(Spectrum, HasAFiniteValueAtZero) {
  EXPECT_NEAR(von_karman_spectrum(Component::along, 0.0, 2.0, 80.0, 20.0), 4.0 * 4.0 * 80.0 / 20.0, 1e-12);
}

TEST(Turbulence, ReproducesTheCodesFormulas) {
  // Category I of CNR-DT 207 at 14.5 m: I = 0.137, L = 94.6 m (worked by hand from the formulas).
  const TurbulenceSet set = {"CNR I", 0.01, 2.0, 0.44, {1.0, 0.75, 0.5}, {1.0, 0.25, 0.1}, {}};
  EXPECT_NEAR(standard_deviation(set, Component::along, 14.5, 1.0), 0.1374, 1e-4);
  EXPECT_NEAR(length_scale(set, Component::along, 14.5), 94.6, 0.1);
  EXPECT_NEAR(standard_deviation(set, Component::vertical, 14.5, 20.0), 0.5 * 0.1374 * 20.0, 2e-3);
  // constant below z_min
  EXPECT_EQ(standard_deviation(set, Component::along, 0.5, 1.0), standard_deviation(set, Component::along, 2.0, 1.0));
}

}  // namespace
}  // namespace twindeck::wind
