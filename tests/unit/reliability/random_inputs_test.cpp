/// Oracles: mean and deviation of each law by quadrature over standard normal space, closed forms of cut laws, a sampled
/// correlation.
#include "reliability/random_inputs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/distributions.hpp"
#include "core/error.hpp"
#include "core/random.hpp"

namespace twindeck::reliability {
namespace {

RandomInput input_of(LawKind kind, double mean, double deviation) {
  RandomInput input;
  input.name = "x";
  input.kind = kind;
  input.mean = mean;
  input.deviation = deviation;
  return input;
}

/// Mean and deviation of one input, by the midpoint rule in z from -9 to 9.
std::pair<double, double> moments_of(const RandomInput& input) {
  const RandomVector vector({input});
  double mean = 0.0, square = 0.0;
  constexpr int n = 40000;
  for (int i = 0; i < n; ++i) {
    const double z = -9.0 + 18.0 * (i + 0.5) / n,
                 weight = 18.0 / n * std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
    const double x = vector.values(Eigen::VectorXd::Constant(1, z))[0];
    mean += weight * x;
    square += weight * x * x;
  }
  return {mean, std::sqrt(square - mean * mean)};
}

TEST(RandomInputs, HaveTheStatedMeanAndDeviation) {
  for (const LawKind kind : {LawKind::normal, LawKind::lognormal, LawKind::uniform, LawKind::gumbel, LawKind::weibull}) {
    const auto [mean, deviation] = moments_of(input_of(kind, 12.0, 3.0));
    EXPECT_NEAR(mean, 12.0, 1e-5) << law_name(kind);
    EXPECT_NEAR(deviation, 3.0, 1e-4) << law_name(kind);
  }
}

TEST(RandomInputs, ACutNormalLawIsTheClosedForm) {
  RandomInput input = input_of(LawKind::normal, 0.0, 1.0);
  input.low = -1.0;
  input.high = 2.0;
  const auto [mean, deviation] = moments_of(input);
  const auto density = [](double u) { return std::exp(-0.5 * u * u) / std::sqrt(2.0 * std::numbers::pi); };
  const double inside = normal_probability(2.0) - normal_probability(-1.0), expected = (density(-1.0) - density(2.0)) / inside;
  EXPECT_NEAR(mean, expected, 1e-6);
  const double variance = 1.0 + (-1.0 * density(-1.0) - 2.0 * density(2.0)) / inside - expected * expected;
  EXPECT_NEAR(deviation, std::sqrt(variance), 1e-6);
}

TEST(RandomInputs, FarTailsKeepTheirDigits) {
  // Gumbel: P(X > x) = 1 - exp(-exp(-y)); at z = 8 the tail is Phi(-8) = 6.22e-16, which no difference from 1 holds.
  const RandomVector vector({input_of(LawKind::gumbel, 0.0, std::numbers::pi / std::sqrt(6.0))});
  const double y = vector.values(Eigen::VectorXd::Constant(1, 8.0))[0] + std::numbers::egamma;
  EXPECT_NEAR(-std::expm1(-std::exp(-y)) / normal_tail(8.0), 1.0, 1e-9);
}

TEST(RandomInputs, AreCorrelatedAsStated) {
  Eigen::Matrix3d correlation;
  correlation << 1.0, 0.0, 0.6, 0.0, 1.0, 0.0, 0.6, 0.0, 1.0;
  const RandomVector vector(
      {input_of(LawKind::normal, 1.0, 2.0), input_of(LawKind::normal, 7.0, 0.0), input_of(LawKind::normal, 0.0, 1.0)},
      correlation);
  ASSERT_EQ(vector.dimension(), 2);
  double sum = 0.0;
  constexpr int n = 40000;
  for (std::uint64_t i = 0; i < n; ++i) {
    const Eigen::VectorXd x = vector.values(Eigen::Vector2d(normal_number(1, 0, i), normal_number(1, 1, i)));
    EXPECT_EQ(x[1], 7.0);
    sum += (x[0] - 1.0) / 2.0 * x[2];
  }
  EXPECT_NEAR(sum / n, 0.6, 0.025);  // four deviations of the mean of 40,000 products
}

TEST(RandomInputs, RefuseWhatIsNoLaw) {
  EXPECT_THROW(RandomVector({input_of(LawKind::normal, 1.0, -0.1)}), InputError);
  EXPECT_THROW(RandomVector({input_of(LawKind::lognormal, -1.0, 0.1)}), InputError);
  RandomInput outside = input_of(LawKind::normal, 0.0, 1.0);
  outside.low = 50.0;
  EXPECT_THROW(RandomVector({outside}), InputError);
  Eigen::Matrix2d correlation;
  correlation << 1.0, 1.2, 1.2, 1.0;
  EXPECT_THROW(RandomVector({input_of(LawKind::normal, 0.0, 1.0), input_of(LawKind::normal, 0.0, 1.0)}, correlation),
               InputError);
}

}  // namespace
}  // namespace twindeck::reliability
