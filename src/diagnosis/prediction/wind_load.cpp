#include <Eigen/Eigenvalues>
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

/// Parameters of the wind, with the changes by causes.
struct Predictor::WindNumbers {
  double power = 0.0, skew = 1.0, drag = 1.0, lift = 1.0, length = 60.0, intensity = 1.0, coherence = 8.0, resonance = 1.0,
         lee = 1.0;
};

Predictor::WindNumbers Predictor::wind_numbers(const Condition& condition, const std::string& label) const {
  WindNumbers w;
  const auto number = [](const Candidate& c, const Eigen::VectorXd& a, const ActionSpec& action, const char* name) {
    return c.value(action.number.at(name), a);
  };
  using A = const ActionSpec&;
  using C = const Candidate&;
  using V = const Eigen::VectorXd&;
  each_action(Primitive::wind_speed_power, condition, [&](C c, V a, A x) { w.power += number(c, a, x, "exponent"); });
  each_action(Primitive::wind_skew_power, condition, [&](C c, V a, A x) { w.skew += number(c, a, x, "exponent"); });
  each_action(Primitive::wind_drag, condition, [&](C c, V a, A x) { w.drag *= number(c, a, x, "factor"); });
  each_action(Primitive::wind_lift, condition, [&](C c, V a, A x) { w.lift *= number(c, a, x, "factor"); });
  each_action(Primitive::wind_length_scale, condition, [&](C c, V a, A x) { w.length *= number(c, a, x, "factor"); });
  each_action(Primitive::wind_intensity, condition, [&](C c, V a, A x) { w.intensity *= number(c, a, x, "factor"); });
  each_action(Primitive::wind_coherence, condition, [&](C c, V a, A x) { w.coherence *= number(c, a, x, "factor"); });
  each_action(Primitive::wind_sheltered, condition, [&](C c, V a, A x) { w.lee *= number(c, a, x, "factor"); });
  each_action(Primitive::wind_resonance, condition, [&](C c, V a, A x) {
    if (!c.mode.empty() && c.mode != label) return;
    const double at = number(c, a, x, "speed");
    w.resonance += number(c, a, x, "ratio") * std::exp(-0.5 * std::pow((*condition.wind_m_s - at) / (0.15 * at), 2));
  });
  return w;
}

/// Squares of a mode's motion along the wind (d²) and upwards (l²), and their changes with the unknowns (n_changes).
struct Predictor::MotionInWind {
  double d2 = 0.0, l2 = 0.0;
  Eigen::VectorXd dd2, dl2;
};

Predictor::MotionInWind Predictor::motion_in_wind(const Eigen::Vector2d& along, double lee, SolvedState& solved,
                                                  Eigen::Index mode) {
  MotionInWind out;
  if (with_jacobian_) out.dd2 = out.dl2 = Eigen::VectorXd::Zero(std::ssize(changes(solved).position));
  if (const auto nodes = map_.model().sets.find("nodes"); nodes != map_.model().sets.end()) {
    const Eigen::VectorXcd phi = solved.modes.shapes.col(mode);
    for (const ReducedPlace& node : nodes->second) {
      if (node.directions.cols() != 3) continue;
      const double shelter = node.x_m.allFinite() && node.x_m.head<2>().dot(along) > 0.0 ? lee : 1.0;
      const auto direction = [&](int k) { return sliced(node.directions, k, solved.columns, phi.size()); };
      const auto add = [&](const Eigen::VectorXd& b, double& square, Eigen::VectorXd& change) {
        const Complex u = b.cast<Complex>().dot(phi);
        square += shelter * std::norm(u);
        if (!with_jacobian_) return;
        const ModeDerivative& d = derivative(solved, mode);
        const Eigen::VectorXcd du = d.shapes.transpose() * b.cast<Complex>() + u * d.along;
        change += 2.0 * shelter * (std::conj(u) * du).real();
      };
      add(along.x() * direction(0) + along.y() * direction(1), out.d2, out.dd2);
      add(direction(2), out.l2, out.dl2);
    }
  }
  if (out.d2 + out.l2 == 0.0) out.d2 = 1.0;
  return out;
}

/// Quasi-steady buffeting on unit widths at the nodes (Davenport 1962), for its differences between modes, speeds and
/// directions:
///   S_F ~ V² cos² beta (d² + l²) S(f L / V) L / V J(f / V),  S(n) = 1 / (1 + 10.2 n)^(5/3),  J = 1 / (1 + c f B / V),
/// d, l the mode's motion along the wind and upwards. The level of each record is free.
Predictor::ExcitedMode Predictor::wind_load(const Condition& condition, SolvedState& solved, Eigen::Index mode,
                                            const std::string& label) {
  ExcitedMode out;
  if (with_jacobian_) out.slope = Eigen::VectorXd::Zero(std::ssize(map_.nuisances()));
  if (!condition.wind_m_s || !(*condition.wind_m_s > 0.0)) return out;
  const double v = *condition.wind_m_s, f = solved.modes.frequency_Hz(mode);
  const WindNumbers w = wind_numbers(condition, label);
  Eigen::Vector2d along = normal_in_plan(map_.model());
  double cosine = 1.0;
  if (condition.direction_deg) {
    const double angle = *condition.direction_deg * std::numbers::pi / 180.0;
    const Eigen::Vector2d wind(std::cos(angle), std::sin(angle));
    cosine = std::max(std::abs(wind.dot(along)), 0.05);
    along = wind;
  }
  const MotionInWind m = motion_in_wind(along, w.lee, solved, mode);
  const double n = f * w.length / v;
  const double spectrum = w.length / v / std::pow(1.0 + 10.2 * n, 5.0 / 3.0);
  const double joint = 1.0 / (1.0 + w.coherence * f * 5.0 / v);
  const double force = w.drag * w.drag * m.d2 + w.lift * w.lift * m.l2;
  out.weight = std::pow(v, 2.0 + 2.0 * w.power) * std::pow(cosine, 2.0 * w.skew) * w.intensity * w.intensity * force *
               spectrum * joint * w.resonance;
  if (!with_jacobian_ || !(force > 0.0)) return out;
  const double by_frequency = -5.0 / 3.0 * 10.2 * n / (1.0 + 10.2 * n) - (1.0 - joint);  // d ln(S J) / d ln f
  const ModeDerivative& d = derivative(solved, mode);
  const auto& position = changes(solved).position;
  for (Eigen::Index j = 0; j < std::ssize(position); ++j)
    out.slope[position[static_cast<std::size_t>(j)]] = by_frequency * (d.s[j] / solved.modes.s[mode]).real() +
                                                       (w.drag * w.drag * m.dd2[j] + w.lift * w.lift * m.dl2[j]) / force;
  return out;
}

}  // namespace twindeck::diagnosis
