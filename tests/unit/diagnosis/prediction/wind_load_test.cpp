// Oracles: masses on springs of their own, of which each channel sees one mode, so that the square of its RMS is
// omega / zeta · S_F / m with the header's S_F written out; ratios of two speeds and two directions; single primitives, each of
// which is one factor.
#include <gtest/gtest.h>

#include "hand_made.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::RowType;
using Eigen::Index;
using Eigen::VectorXd;

constexpr double kExact = 1e-9;  // sums of logarithms, to rounding of the eigenproblem
constexpr double kUsualDamping_pct = 0.5;
constexpr double kSpeed = 12.0;

/// Two nodes, ten metres apart on a line that makes an angle with x. Each translation has a frequency of its own.
class TwoNodes {
 public:
  explicit TwoNodes(double angle = 0.0) {
    std::vector<fe::DofLabel> dofs;
    for (const double side : {-5.0, 5.0})
      for (int d = 0; d < 3; ++d)
        dofs.push_back(
            {side < 0.0 ? "left" : "right", d, Eigen::Vector3d(side * std::cos(angle), side * std::sin(angle), 0.0)});
    for (Index i = 0; i < 6; ++i) {
      hertz[i] = 0.4 + 0.17 * static_cast<double>(i);
      mass[i] = i < 3 ? 900.0 : 1600.0;
    }
    const VectorXd stiffness = mass.cwiseProduct((2.0 * std::numbers::pi * hertz).cwiseAbs2());
    model = std::make_unique<Predicted>(dofs, stiffness.asDiagonal(), mass.asDiagonal());
    model->features.conditions[0].wind_m_s = kSpeed;
  }
  void measure_records() {
    for (int c = 0; c < 6; ++c) model->add_row(RowType::rms, "", c, 0.01, 0.001);
  }
  /// ln RMS of the six channels.
  [[nodiscard]] VectorXd records(const std::vector<diagnosis::Cause>& causes = {}) const {
    const auto p = model->predict(causes);
    EXPECT_TRUE(p.valid);
    return p.g.tail(6);
  }
  /// What a primitive adds to ln RMS.
  [[nodiscard]] VectorXd change(const std::string& kind, const std::map<std::string, double>& numbers) const {
    const HandMade made(kind, numbers);
    return records({made.cause()}) - records();
  }
  /// ln RMS under white excitation, whose S_F is 1.
  [[nodiscard]] double white(Index i) const {
    return 0.5 * std::log(2.0 * std::numbers::pi * hertz[i] / kUsualDamping_pct / mass[i]);
  }

  VectorXd hertz{6}, mass{6};
  std::unique_ptr<Predicted> model;
};

/// S(f L / V) L / V and J(f / V) of the header, with L = 60 m, c = 8 and B = 5 m.
double spectrum(double f, double v, double length = 60.0, double coherence = 8.0) {
  return length / v / std::pow(1.0 + 10.2 * f * length / v, 5.0 / 3.0) / (1.0 + coherence * f * 5.0 / v);
}

TEST(WindLoad, WithoutWindTheExcitationIsWhite) {
  TwoNodes two;
  two.measure_records();
  for (const std::optional<double> speed : {std::optional<double>{}, std::optional<double>{0.0}}) {
    two.model->features.conditions[0].wind_m_s = speed;
    const VectorXd found = two.records();
    for (Index i = 0; i < 6; ++i) EXPECT_NEAR(found[i], two.white(i), kExact) << i;
  }
}

TEST(WindLoad, IsTheSpectrumOfTheHeader) {
  // Nodes on x: wind acts along y and upwards. Mass-normalised motion of a mode is 1/sqrt(m).
  TwoNodes two;
  two.measure_records();
  const VectorXd found = two.records();
  for (const Index i : {1, 2, 4, 5}) {
    const double force = kSpeed * kSpeed / two.mass[i] * spectrum(two.hertz[i], kSpeed);
    EXPECT_NEAR(found[i], two.white(i) + 0.5 * std::log(force), kExact) << i;
  }
}

TEST(WindLoad, ActsAcrossTheLengthOfTheStructure) {
  // Of a line at 30 degrees the normal is at 120 degrees: motion in x counts with sin² 30, in y with cos² 30, z wholly.
  TwoNodes two(std::numbers::pi / 6.0);
  two.measure_records();
  const VectorXd found = two.records();
  const double part[] = {0.25, 0.75, 1.0};
  for (Index i = 0; i < 6; ++i) {
    const double force = part[i % 3] * kSpeed * kSpeed / two.mass[i] * spectrum(two.hertz[i], kSpeed);
    EXPECT_NEAR(found[i], two.white(i) + 0.5 * std::log(force), 1e-8) << i;
  }
}

TEST(WindLoad, ObliqueWindActsByItsCosine) {
  // RMS ~ |cos beta| of the angle with the normal (y), at least 0.05 of it; vertical motion does not see the direction else.
  TwoNodes two;
  two.measure_records();
  const auto vertical = [&](double degrees) {
    two.model->features.conditions[0].direction_deg = degrees;
    return two.records()[2];
  };
  const double normal = vertical(90.0);
  EXPECT_NEAR(vertical(30.0) - normal, std::log(0.5), kExact);
  EXPECT_NEAR(vertical(-150.0) - normal, std::log(0.5), kExact);
  EXPECT_NEAR(vertical(0.0) - normal, std::log(0.05), kExact);
}

TEST(WindLoad, ObliqueWindMovesAlongItself) {
  // At 30 degrees the squares of motion in x and y count with cos² 30 = 3/4 and sin² 30 = 1/4, beside |cos beta| = 1/2.
  TwoNodes two;
  two.measure_records();
  two.model->features.conditions[0].direction_deg = 30.0;
  const VectorXd found = two.records();
  const double part[] = {0.75, 0.25};
  for (Index i = 0; i < 2; ++i) {
    const double force = 0.25 * part[i] * kSpeed * kSpeed / two.mass[i] * spectrum(two.hertz[i], kSpeed);
    EXPECT_NEAR(found[i], two.white(i) + 0.5 * std::log(force), kExact) << i;
  }
}

TEST(WindLoad, PowersAddTheirExponents) {
  TwoNodes two;
  two.measure_records();
  two.model->features.conditions[0].direction_deg = 30.0;
  const VectorXd speed = two.change("wind.speed_power", {{"exponent", 0.7}});
  const VectorXd skew = two.change("wind.skew_power", {{"exponent", 0.7}});
  for (Index i = 0; i < 6; ++i) {
    EXPECT_NEAR(speed[i], 0.7 * std::log(kSpeed), kExact) << i;
    EXPECT_NEAR(skew[i], 0.7 * std::log(0.5), kExact) << i;
  }
}

TEST(WindLoad, FactorsActOnTheirMotion) {
  TwoNodes two;
  two.measure_records();
  const VectorXd drag = two.change("wind.drag", {{"factor", 1.8}}), lift = two.change("wind.lift", {{"factor", 1.8}}),
                 intensity = two.change("wind.intensity", {{"factor", 1.8}});
  for (const Index i : {1, 2, 4, 5}) {
    const bool vertical = i % 3 == 2;
    EXPECT_NEAR(drag[i], vertical ? 0.0 : std::log(1.8), kExact) << i;
    EXPECT_NEAR(lift[i], vertical ? std::log(1.8) : 0.0, kExact) << i;
    EXPECT_NEAR(intensity[i], std::log(1.8), kExact) << i;
  }
}

TEST(WindLoad, LengthAndCoherenceBendTheSpectrum) {
  TwoNodes two;
  two.measure_records();
  const VectorXd length = two.change("wind.length_scale", {{"factor", 1.5}}),
                 coherence = two.change("wind.coherence", {{"factor", 1.5}});
  for (const Index i : {1, 2, 4, 5}) {
    const double f = two.hertz[i], base = spectrum(f, kSpeed);
    EXPECT_NEAR(length[i], 0.5 * std::log(spectrum(f, kSpeed, 90.0) / base), kExact) << i;
    EXPECT_NEAR(coherence[i], 0.5 * std::log(spectrum(f, kSpeed, 60.0, 12.0) / base), kExact) << i;
  }
}

TEST(WindLoad, ShelterActsOnTheLeeSide) {
  // Wind towards +y from nodes on a line at 30 degrees: the right one lies at y = +2.5 m.
  TwoNodes two(std::numbers::pi / 6.0);
  two.measure_records();
  two.model->features.conditions[0].direction_deg = 90.0;
  const VectorXd found = two.change("wind.sheltered", {{"factor", 0.4}});
  for (const Index i : {1, 2}) EXPECT_NEAR(found[i], 0.0, kExact) << i;
  for (const Index i : {4, 5}) EXPECT_NEAR(found[i], 0.5 * std::log(0.4), kExact) << i;
}

TEST(WindLoad, ResonanceIsABellOfSpeeds) {
  // 1 + ratio at its speed; exp(-1/2) of the ratio 15 % beside it.
  TwoNodes two;
  two.measure_records();
  EXPECT_NEAR(two.change("wind.resonance", {{"speed", kSpeed}, {"ratio", 3.0}})[2], 0.5 * std::log(4.0), kExact);
  const VectorXd beside = two.change("wind.resonance", {{"speed", kSpeed / 1.15}, {"ratio", 3.0}});
  EXPECT_NEAR(beside[2], 0.5 * std::log(1.0 + 3.0 * std::exp(-0.5)), kExact);
}

TEST(WindLoad, ResonanceOfAModeIsItsAlone) {
  TwoNodes two;
  two.model->add_frequencies(two.hertz);
  two.measure_records();
  HandMade made("wind.resonance", {{"speed", kSpeed}, {"ratio", 3.0}});
  made.candidate.mode = "3";
  const VectorXd found = two.records({made.cause()}) - two.records();
  for (Index i = 0; i < 6; ++i) EXPECT_NEAR(found[i], i == 2 ? 0.5 * std::log(4.0) : 0.0, kExact) << i;
}

TEST(WindLoad, DampingByTheWindQuietsAMode) {
  // The square of RMS goes by 1/zeta: 0.5 % of structure and 0.1 % per m/s at 12 m/s.
  TwoNodes two;
  two.measure_records();
  const VectorXd found = two.change("wind.damping", {{"rate", 0.001}});
  for (Index i = 0; i < 6; ++i) EXPECT_NEAR(found[i], -0.5 * std::log(1.7 / 0.5), kExact) << i;
}

}  // namespace
}  // namespace twindeck::tests
