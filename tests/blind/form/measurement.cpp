#include "blind/form/measurement.hpp"

#include <array>
#include <cmath>

namespace twindeck::blind::form {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSameMode = 0.3;  ///< least MAC of a mode in two conditions of one state

double mac_of(const VectorXd& a, const VectorXd& b) { return std::pow(a.dot(b), 2) / (a.squaredNorm() * b.squaredNorm()); }

MatrixXd with_fault(MatrixXd shapes, const SensorFault& fault) {
  if (fault.what == SensorFault::What::reversed) shapes.row(fault.channel) *= -1.0;
  if (fault.what == SensorFault::What::exchanged) shapes.row(fault.channel).swap(shapes.row(fault.other));
  if (fault.what == SensorFault::What::scaled) shapes.row(fault.channel) *= fault.factor;
  return shapes;
}

MatrixXd largest_is_one(MatrixXd shapes) {
  for (Index m = 0; m < shapes.cols(); ++m) {
    Index at = 0;
    shapes.col(m).cwiseAbs().maxCoeff(&at);
    shapes.col(m) /= shapes(at, m);
  }
  return shapes;
}

/// Modes of a state that have names already, as they were when they got them.
struct Named {
  std::vector<std::string> names;
  std::vector<VectorXd> shapes;
  std::vector<double> frequency_Hz;
};

/// Names of a condition's modes: the most alike pair first, by shape and frequency, each name once. A mode that is like none
/// gets the next number.
std::vector<std::string> labels_like(Named& known, const MatrixXd& shapes, const VectorXd& frequency_Hz) {
  const auto n = static_cast<Index>(known.names.size());
  MatrixXd alike(shapes.cols(), n);
  for (Index m = 0; m < shapes.cols(); ++m)
    for (Index k = 0; k < n; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const double mac = mac_of(known.shapes[at], shapes.col(m));
      alike(m, k) = mac < kSameMode ? -1e9 : mac - std::abs(std::log(frequency_Hz[m] / known.frequency_Hz[at]));
    }
  std::vector<std::string> out(static_cast<std::size_t>(shapes.cols()));
  for (Index round = 0; round < std::min(shapes.cols(), n); ++round) {
    Index m = 0, k = 0;
    if (alike.maxCoeff(&m, &k) < -1e8) break;
    out[static_cast<std::size_t>(m)] = known.names[static_cast<std::size_t>(k)];
    alike.row(m).setConstant(-1e9);
    alike.col(k).setConstant(-1e9);
  }
  for (Index m = 0; m < shapes.cols(); ++m) {
    std::string& name = out[static_cast<std::size_t>(m)];
    if (!name.empty()) continue;
    name = std::to_string(known.names.size() + 1);
    known.names.push_back(name);
    known.shapes.emplace_back(shapes.col(m));
    known.frequency_Hz.push_back(frequency_Hz[m]);
  }
  return out;
}

/// Puts a condition into the second state, where features know states; the first has the name that a condition has by itself.
template <typename Condition>
void set_after(Condition& condition) {
  if constexpr (requires { condition.state; }) condition.state = "after";
}

}  // namespace

Measured measure(const Truth& truth, const Hidden& hidden) {
  Measured out;
  std::array<Named, 2> known;  // of each state
  for (const TestCondition& condition : hidden.conditions) {
    out.modes.push_back(measurable_modes(truth, condition.change));
    out.shapes.push_back(largest_is_one(with_fault(at_channels(truth.layout, out.modes.back().at_nodes), hidden.fault)));
    out.labels.push_back(labels_like(known[condition.after ? 1 : 0], out.shapes.back(), out.modes.back().frequency_Hz));
  }
  return out;
}

double visibility(const Truth& truth, const Hidden& hidden) {
  const SeenModes sound = measurable_modes(truth, {});
  const MatrixXd before = largest_is_one(at_channels(truth.layout, sound.at_nodes));
  const Measured measured = measure(truth, hidden);
  double sum = 0.0;
  for (std::size_t c = 0; c < measured.modes.size(); ++c) {
    const SeenModes& now = measured.modes[c];
    for (Index m = 0; m < std::min(sound.frequency_Hz.size(), now.frequency_Hz.size()); ++m) {
      sum += std::pow(std::log(now.frequency_Hz[m] / sound.frequency_Hz[m]) / kFrequencyError, 2);
      const VectorXd shape = measured.shapes[c].col(m);  // scaled to the sound one
      const double scale = shape.dot(before.col(m)) / shape.squaredNorm();
      sum += (scale * shape - before.col(m)).squaredNorm() / (kShapeError * kShapeError);
    }
  }
  return std::sqrt(sum);
}

diagnosis::FeatureSet rows_of(const Layout& layout, const Hidden& hidden, const Measured& measured, Stream& random) {
  using diagnosis::RowType;
  diagnosis::FeatureSet f;
  const Eigen::Vector3d direction = layout.direction == 0 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  for (std::size_t c = 0; c < layout.channel_nodes.size(); ++c) {
    f.channels.push_back(channel_name(layout, static_cast<int>(c)));
    f.direction.push_back(direction);
  }
  for (std::size_t c = 0; c < hidden.conditions.size(); ++c) {
    const TestCondition& test = hidden.conditions[c];
    diagnosis::Condition condition;
    condition.name = test.name;
    condition.temperature_C = test.temperature_C;
    condition.amplitude_m = test.amplitude_m;
    if (test.amplitude_m) condition.amplitude_channel = f.channels[f.channels.size() / 2];
    if (test.after) set_after(condition);
    f.conditions.push_back(condition);
    const MatrixXd& shapes = measured.shapes[c];
    for (Index m = 0; m < shapes.cols(); ++m) {
      const std::string& label = measured.labels[c][static_cast<std::size_t>(m)];
      const double hertz = measured.modes[c].frequency_Hz[m] * (1.0 + kFrequencyError * random.normal());
      f.rows.push_back({RowType::frequency, label, -1, "", static_cast<int>(c), hertz, kFrequencyError * hertz, false});
      for (Index channel = 0; channel < shapes.rows(); ++channel)
        f.rows.push_back({RowType::shape, label, static_cast<int>(channel), "", static_cast<int>(c),
                          shapes(channel, m) + kShapeError * random.normal(), kShapeError, false});
    }
  }
  return f;
}

}  // namespace twindeck::blind::form
