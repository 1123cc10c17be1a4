/// Oracles: the definition H H* = S; properties of a coherence; closed form of two points.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "two_arcs.hpp"
#include "wind/spectrum.hpp"

namespace twindeck::wind {
namespace {

/// sqrt(S_j) drift_j of each point.
Eigen::VectorXcd of_points(const FieldDefinition& field, double f_Hz) {
  return spectra(field, f_Hz).cwiseSqrt().cwiseProduct(drift(field, f_Hz));
}

/// S(f) of Eq. (13), Hermitian.
Eigen::MatrixXcd cross_spectrum(const FieldDefinition& field, double f_Hz) {
  const Eigen::VectorXcd point = of_points(field, f_Hz);
  return point.asDiagonal() * coherence(field, f_Hz) * point.conjugate().asDiagonal();
}

TEST(Field, FactorTimesItsAdjointIsTheCrossSpectrum) {
  for (const Component c : components) {
    for (const bool frozen : {false, true}) {
      FieldDefinition field = test::two_arcs(c);
      field.frozen = frozen;
      for (const double f : {1.0 / 600.0, 0.01, 0.1, 0.7244, 3.0, 8.0}) {
        const Eigen::MatrixXcd s = cross_spectrum(field, f), h = of_points(field, f).asDiagonal() * coherence_factor(field, f);
        EXPECT_LT((h * h.adjoint() - s).cwiseAbs().maxCoeff() / s.cwiseAbs().maxCoeff(), 1e-10) << f;
        EXPECT_EQ(h.triangularView<Eigen::StrictlyUpper>().toDenseMatrix().cwiseAbs().maxCoeff(), 0.0);
      }
    }
  }
}

TEST(Field, TwoPointsFollowEquation17) {
  FieldDefinition field = test::two_arcs(Component::along, 1);
  field.position_m << 0.0, 0.0, 12.0, 5.0, 12.0, 14.0;
  const double f = 0.3, v = 19.1;
  const double expected =
      std::exp(-f * std::sqrt(std::pow(3.0 * 5.0, 2) + std::pow(10.0 * 12.0, 2) + std::pow(10.0 * 2.0, 2)) / v);
  EXPECT_NEAR(coherence(field, f)(1, 0), expected, 1e-15);
  const Eigen::MatrixXcd s = cross_spectrum(field, f);
  // point 2 lies 5 m downwind: what passes point 1 reaches it 5/V later
  EXPECT_NEAR(std::arg(s(1, 0)), -2.0 * 3.14159265358979 * f * 5.0 / v, 1e-12);
  EXPECT_NEAR(std::abs(s(1, 0)), expected * von_karman_spectrum(Component::along, f, field.sigma_m_s[0], 103.0, v), 1e-12);
}

TEST(Field, RefusesWhatIsNoField) {
  FieldDefinition twice = test::two_arcs(Component::vertical, 2);
  twice.position_m.row(3) = twice.position_m.row(1);
  try {
    (void)coherence_factor(twice, 0.5);
    FAIL() << "two points that coincide have a singular coherence";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("not positive definite at 0.5 Hz (found at point 4 of 4)"), std::string::npos)
        << error.what();
  }
  FieldDefinition still = test::two_arcs(Component::vertical, 2);
  still.speed_m_s[2] = 0.0;
  EXPECT_THROW(check(still), InputError);
  still.speed_m_s.resize(3);
  EXPECT_THROW(check(still), InputError);
}

}  // namespace
}  // namespace twindeck::wind
