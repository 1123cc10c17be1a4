#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <numbers>

#include "diagnosis/prediction/predictor.hpp"

namespace twindeck::diagnosis {

namespace {

/// Horizontal direction normal to the structure's length: the weak principal axis of its nodes in plan; y where none are known.
Eigen::Vector2d normal_in_plan(const ReducedModel& model) {
  const auto nodes = model.sets.find("nodes");
  if (nodes == model.sets.end()) return Eigen::Vector2d::UnitY();
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  int count = 0;
  for (const ReducedPlace& node : nodes->second)
    if (node.x_m.allFinite()) {
      mean += node.x_m.head<2>();
      ++count;
    }
  if (count < 2) return Eigen::Vector2d::UnitY();
  mean /= count;
  for (const ReducedPlace& node : nodes->second)
    if (node.x_m.allFinite()) spread += (node.x_m.head<2>() - mean) * (node.x_m.head<2>() - mean).transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvectors().col(0);
}

}  // namespace

/// Quasi-steady buffeting on unit widths at the nodes (Davenport 1962), as far as it tells modes, speeds and directions apart:
///   S_F ~ V² |cos beta| (d² + l²) S(f L / V) J(f / V),  S(n) = 1 / (1 + 10.2 n)^(5/3),  J = 1 / (1 + c f B / V),
/// d, l the mode's motion along the wind and upwards. The level of each record is free.
double Predictor::wind_weight(const Condition& condition, const SolvedState& solved, Eigen::Index mode,
                              const std::string& label) const {
  if (!condition.wind_m_s || !(*condition.wind_m_s > 0.0)) return 1.0;
  const double v = *condition.wind_m_s;
  const double f = solved.modes.frequency_Hz(mode);
  double power = 0.0, skew = 1.0, drag = 1.0, lift = 1.0, length = 60.0, intensity = 1.0, coherence = 8.0, resonance = 1.0,
         lee = 1.0;
  const auto number = [](const Candidate& c, const Eigen::VectorXd& a, const ActionSpec& action, const char* name) {
    return c.value(action.number.at(name), a);
  };
  using A = const ActionSpec&;
  using C = const Candidate&;
  using V = const Eigen::VectorXd&;
  each_action("wind.speed_power", [&](C c, V a, A x) { power += number(c, a, x, "exponent"); });
  each_action("wind.skew_power", [&](C c, V a, A x) { skew += number(c, a, x, "exponent"); });
  each_action("wind.drag", [&](C c, V a, A x) { drag *= number(c, a, x, "factor"); });
  each_action("wind.lift", [&](C c, V a, A x) { lift *= number(c, a, x, "factor"); });
  each_action("wind.length_scale", [&](C c, V a, A x) { length *= number(c, a, x, "factor"); });
  each_action("wind.intensity", [&](C c, V a, A x) { intensity *= number(c, a, x, "factor"); });
  each_action("wind.coherence", [&](C c, V a, A x) { coherence *= number(c, a, x, "factor"); });
  each_action("wind.sheltered", [&](C c, V a, A x) { lee *= number(c, a, x, "factor"); });
  each_action("wind.resonance", [&](C c, V a, A x) {
    if (!c.mode.empty() && c.mode != label) return;
    const double at = number(c, a, x, "speed");
    resonance += number(c, a, x, "ratio") * std::exp(-0.5 * std::pow((v - at) / (0.15 * at), 2));
  });
  Eigen::Vector2d along = normal_in_plan(map_.model());
  double cosine = 1.0;
  if (condition.direction_deg) {
    const double angle = *condition.direction_deg * std::numbers::pi / 180.0;
    const Eigen::Vector2d wind(std::cos(angle), std::sin(angle));
    cosine = std::max(std::abs(wind.dot(along)), 0.05);
    along = wind;
  }
  double d2 = 0.0, l2 = 0.0;
  if (const auto nodes = map_.model().sets.find("nodes"); nodes != map_.model().sets.end()) {
    const Eigen::VectorXcd phi = solved.modes.shapes.col(mode);
    for (const ReducedPlace& node : nodes->second) {
      if (node.directions.cols() != 3) continue;
      const double shelter = node.x_m.allFinite() && node.x_m.head<2>().dot(along) > 0.0 ? lee : 1.0;
      std::array<std::complex<double>, 3> u{};
      for (int k = 0; k < 3; ++k) {
        const Eigen::VectorXd b = sliced(node.directions, k, solved.columns, phi.size());
        u[static_cast<std::size_t>(k)] = b.cast<Complex>().dot(phi);
      }
      d2 += shelter * std::norm(along.x() * u[0] + along.y() * u[1]);
      l2 += shelter * std::norm(u[2]);
    }
  }
  if (d2 + l2 == 0.0) d2 = 1.0;
  const double n = f * length / v;
  const double spectrum = length / v / std::pow(1.0 + 10.2 * n, 5.0 / 3.0);
  const double joint = 1.0 / (1.0 + coherence * f * 5.0 / v);
  return std::pow(v, 2.0 + 2.0 * power) * std::pow(cosine, 2.0 * skew) * intensity * intensity *
         (drag * drag * d2 + lift * lift * l2) * spectrum * joint * resonance;
}

}  // namespace twindeck::diagnosis
