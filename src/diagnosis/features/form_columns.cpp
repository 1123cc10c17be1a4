#include "diagnosis/features/form_columns.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "diagnosis/features/shape_turn.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kLowestModes = 12;     // that a paired mode's shape may take up
constexpr double kLeastGap = 0.05;   // relative, between frequencies: nearer modes turn no further into each other
constexpr double kKink = 0.25;       // of a shape's norm, per unit of the form error
constexpr double kRotation = 0.012;  // radians of a rotation times the relative gap …
constexpr double kCovered = 0.06, kFarthest = 0.12;  // … for gaps between these

/// w_i w_j / (w_i² - w_j²), the relative gap held at kLeastGap.
double mixing(double wi, double wj) {
  const double mean = std::sqrt(wi * wj);
  if (!(mean > 0.0)) return 0.0;
  const double gap = (wi - wj) / mean;
  return 1.0 / (std::copysign(std::max(std::abs(gap), kLeastGap), gap) * (wi + wj) / mean);
}

constexpr double kAtRest = 1e-6;  // of the largest motion of the channels in any mode: less is rounding

/// Factor from the mass-normalised shape to what the rows hold; 0 for a mode that moves none of the channels.
double size_of(const PairedMode& mode, const ModelModes& modes, const VectorXd& predicted) {
  double along = 0.0, norm = 0.0;
  for (std::size_t k = 0; k < mode.shape_rows.size(); ++k) {
    const double phi = modes.shapes(mode.shape_channels[k], mode.model_mode);
    along += phi * predicted[mode.shape_rows[k]];
    norm += phi * phi;
  }
  const double largest = modes.shapes.colwise().squaredNorm().maxCoeff();
  return norm > kAtRest * kAtRest * largest ? along / norm : 0.0;
}

}  // namespace

FormColumns form_columns(const ModelModes& modes, const std::vector<PairedMode>& paired, const VectorXd& predicted) {
  std::map<int, Index> frequency;              // by model mode
  std::map<std::pair<int, int>, Index> pairs;  // (i, j), i < j
  std::map<std::pair<int, int>, Index> kinks;  // (model mode, channel)
  const int lowest = std::min<int>(kLowestModes, static_cast<int>(modes.omega_rad_s.size()));
  for (const PairedMode& mode : paired) {
    if (mode.model_mode < 0) continue;
    frequency.try_emplace(mode.model_mode, std::ssize(frequency));
    if (mode.shape_rows.empty()) continue;
    for (int j = 0; j < lowest; ++j)
      if (j != mode.model_mode) pairs.try_emplace(std::minmax(mode.model_mode, j), std::ssize(pairs));
    for (const int channel : mode.shape_channels) kinks.try_emplace({mode.model_mode, channel}, std::ssize(kinks));
  }
  const Index n = predicted.size();
  FormColumns out{MatrixXd::Zero(n, std::ssize(frequency)), MatrixXd::Zero(n, std::ssize(pairs)),
                  MatrixXd::Zero(n, std::ssize(kinks))};
  for (const PairedMode& mode : paired) {
    const int i = mode.model_mode;
    if (i < 0) continue;
    if (mode.frequency_row >= 0) out.frequency(mode.frequency_row, frequency.at(i)) = 1.0;
    const double size = size_of(mode, modes, predicted);
    double norm = 0.0;
    for (const int row : mode.shape_rows) norm += predicted[row] * predicted[row];
    for (std::size_t k = 0; k < mode.shape_rows.size(); ++k) {
      const int row = mode.shape_rows[k], channel = mode.shape_channels[k];
      out.kinks(row, kinks.at({i, channel})) = kKink * std::sqrt(norm);
      for (int j = 0; j < lowest; ++j)
        if (j != i)
          out.shape(row, pairs.at(std::minmax(i, j))) =
              size * mixing(modes.omega_rad_s[i], modes.omega_rad_s[j]) * modes.shapes(channel, j);
    }
  }
  return out;
}

MatrixXd close_rotations(const std::vector<PairedMode>& paired, const std::vector<double>& frequency_Hz,
                         const VectorXd& values) {
  std::vector<VectorXd> columns;
  for (std::size_t a = 0; a < paired.size(); ++a) {
    for (std::size_t b = 0; b < paired.size(); ++b) {
      const PairedMode &low = paired[a], &high = paired[b];
      if (low.condition != high.condition || !(frequency_Hz[a] > 0.0) || !(frequency_Hz[a] < frequency_Hz[b])) continue;
      const double gap = frequency_Hz[b] / frequency_Hz[a] - 1.0;
      if (gap <= kCovered || gap > kFarthest || low.shape_rows.empty() || high.shape_rows.empty()) continue;
      const ShapeTurn turn =
          turn_of_shapes({low.shape_rows, low.shape_channels}, {high.shape_rows, high.shape_channels}, values);
      if (turn.together.squaredNorm() > 0.0) columns.push_back(kRotation / gap * turn.together);
      for (Index r = 0; r < values.size(); ++r)
        if (turn.alone[r] > 0.0) columns.push_back(kRotation / gap * turn.alone[r] * VectorXd::Unit(values.size(), r));
    }
  }
  MatrixXd out(values.size(), std::ssize(columns));
  for (std::size_t c = 0; c < columns.size(); ++c) out.col(static_cast<Index>(c)) = columns[c];
  return out;
}

std::optional<Contrast> contrast_of(const std::string& key, const std::vector<std::optional<double>>& values) {
  std::set<double> known;
  for (const auto& v : values)
    if (v) known.insert(*v);
  if (known.size() < 2) return std::nullopt;
  double from = 0.0;
  if (key == "temperature_C")  // it has no zero of its own: what all conditions share is the form error's
    for (const double v : known) from += v / static_cast<double>(known.size());
  Contrast out{key, VectorXd::Zero(std::ssize(values))};
  for (std::size_t c = 0; c < values.size(); ++c)
    if (values[c]) out.weight[static_cast<Index>(c)] = *values[c] - from;
  out.weight /= out.weight.cwiseAbs().maxCoeff();
  return out;
}

}  // namespace twindeck::diagnosis
