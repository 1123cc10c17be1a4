/// Oracles: integrals of the spectra (the variance), their slope at high frequency, printed code
/// values.
#include "wind/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>

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

/// Kaimal's or the code's, f S / sigma² at n.
double shape(SpectrumLaw law, double n) {
  return n / 5.0 * Spectrum{law, nullptr}.at(Component::vertical, n / 5.0, 2.0, 100.0, 20.0) / 4.0;
}

TEST(Spectrum, KaimalAndTheCodeHaveTheirFormulas) {
  // 0.4 / 1.6^(5/3), 0.68 / 2.02^(5/3) and 6.8 / 11.2^(5/3), by hand
  EXPECT_NEAR(shape(SpectrumLaw::kaimal, 0.1), 0.18275, 1e-5);
  EXPECT_NEAR(shape(SpectrumLaw::en_1991_1_4, 0.1), 0.21067, 1e-5);
  EXPECT_NEAR(shape(SpectrumLaw::en_1991_1_4, 1.0), 0.12129, 1e-5);
  // The primitive of a / (1 + 1.5 a n)^(5/3) is 1 - (1 + 1.5 a n)^(-2/3): the band below n holds that much of the variance.
  for (const auto& [law, a] : {std::pair{SpectrumLaw::kaimal, 4.0}, std::pair{SpectrumLaw::en_1991_1_4, 6.8}}) {
    double sum = 0.0;
    const int steps = 20000;
    for (int i = 0; i <= steps; ++i)  // trapezoid in ln n from 1e-7 to 10
      sum += (i == 0 || i == steps ? 0.5 : 1.0) * shape(law, 1e-7 * std::pow(1e8, static_cast<double>(i) / steps)) *
             std::log(1e8) / steps;
    EXPECT_NEAR(sum, 1.0 - std::pow(1.0 + 15.0 * a, -2.0 / 3.0), 1e-6);
  }
}

/// Kaimal's spectrum as a table.
SpectrumTable kaimal_table(Eigen::Index points) {
  const Eigen::VectorXd n = Eigen::pow(10.0, Eigen::ArrayXd::LinSpaced(points, -4.0, 3.0));
  return {n, n.unaryExpr([](double x) { return shape(SpectrumLaw::kaimal, x); })};
}

TEST(Spectrum, TableOfALawGivesThatLaw) {
  const Spectrum own = {SpectrumLaw::table, std::make_shared<const SpectrumTable>(kaimal_table(701))};
  const Spectrum law = {SpectrumLaw::kaimal, nullptr};
  for (const double f :
       {0.0, 1e-6, 1e-3, 0.0123, 0.7244, 3.0, 400.0, 1e4}) {  // below the first point, between points, above the last
    const double expected = law.at(Component::across, f, 1.5, 60.0, 19.1);
    // 100 points a decade: the error of a chord of ln S is 1/8 (0.01 ln 10)² times its curvature, which is below 0.5
    EXPECT_NEAR(own.at(Component::across, f, 1.5, 60.0, 19.1) / expected, 1.0, f <= 1e-6 || f > 100.0 ? 1e-3 : 5e-5) << f;
  }
}

TEST(Spectrum, TableKnowsItsVariance) {
  EXPECT_NEAR(kaimal_table(701).variance(), 1.0, 1e-4);
  // f S = 1 from n = 1 to e: S is constant below (1), falls as 1/n between (1), and as n^(-5/3) above: 3/2.
  EXPECT_NEAR(SpectrumTable(Eigen::Vector2d(1.0, std::exp(1.0)), Eigen::Vector2d(1.0, 1.0)).variance(), 3.5, 1e-12);
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
