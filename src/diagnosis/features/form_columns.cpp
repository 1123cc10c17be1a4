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

constexpr int kLowestModes = 12;     // number of lowest modes that a shape may mix with
constexpr double kLeastGap = 0.05;   // relative, between frequencies; nearer modes do not mix more
constexpr double kKink = 0.25;       // of a shape's norm at one channel, per unit of the form error
constexpr double kRotation = 0.012;  // [rad] rotation of two shapes, times the relative gap of their frequencies …
constexpr double kCovered = 0.06, kFarthest = 0.12;  // … for relative gaps between these

constexpr double kAtRest = 1e-6;  // of the largest motion of the channels in any mode; smaller motions are rounding

/// Factor between the mass-normalised shape and the rows; 0 for a mode that moves no channel.
double size_of(const PairedMode& mode, const ModelModes& modes, const VectorXd& predicted) {
  double along = 0.0, norm = 0.0;
  for (std::size_t k = 0; k < mode.shape_rows.size(); ++k) {
    const double phi = modes.shapes(mode.shape_channels[k], mode.own_mode);
    along += phi * predicted[mode.shape_rows[k]];
    norm += phi * phi;
  }
  const double largest = modes.shapes.colwise().squaredNorm().maxCoeff();
  return norm > kAtRest * kAtRest * largest ? along / norm : 0.0;
}

/// Change of a mode's shape if the stiffness couples it to base mode k. It is a sum over the other modes psi_n of its
/// structure, each with its part C_kn of base mode k over the distance of the squared frequencies. Column k is sum_n C_kn psi_n
/// / (w_q² - w_n²), q the mode itself (n_channels × n_modes of the base).
MatrixXd taken_up(const ModelModes& modes, Index own) {
  MatrixXd out = MatrixXd::Zero(modes.shapes.rows(), modes.along.rows());
  for (Index n = 0; n < modes.omega_rad_s.size(); ++n)
    if (n != own)
      out += turning(modes.omega_rad_s[own], modes.omega_rad_s[n]) * modes.shapes.col(n) * modes.along.col(n).transpose();
  return out;
}

}  // namespace

double turning(double wi, double wj) {
  const double mean = std::sqrt(wi * wj);
  if (!(mean > 0.0)) return 0.0;
  const double gap = (wi - wj) / mean;
  return 1.0 / (std::copysign(std::max(std::abs(gap), kLeastGap), gap) * (wi + wj) * mean);
}

FormColumns form_columns(const std::vector<ModelModes>& structures, const std::vector<PairedMode>& paired,
                         const VectorXd& predicted) {
  const VectorXd omega = structures.empty() ? VectorXd() : structures.front().omega_rad_s;  // of the base
  const int lowest = std::min<int>(kLowestModes, static_cast<int>(omega.size()));
  std::set<int> known;
  std::map<std::pair<int, int>, Index> pairs;  // (i, j), i < j
  std::map<std::pair<int, int>, Index> kinks;  // (base mode, channel)
  for (const PairedMode& mode : paired) {
    if (mode.model_mode < 0) continue;
    known.insert(mode.model_mode);
    if (mode.shape_rows.empty()) continue;
    for (int j = 0; j < lowest; ++j)
      if (j != mode.model_mode) pairs.try_emplace(std::minmax(mode.model_mode, j), std::ssize(pairs));
    for (const int channel : mode.shape_channels) kinks.try_emplace({mode.model_mode, channel}, std::ssize(kinks));
  }
  const Index n = predicted.size();
  const std::vector<int> single(known.begin(), known.end());
  FormColumns out{MatrixXd::Zero(n, std::ssize(single)), MatrixXd::Zero(n, std::ssize(pairs)),
                  MatrixXd::Zero(n, std::ssize(kinks))};
  for (const PairedMode& mode : paired) {
    if (mode.model_mode < 0) continue;
    const ModelModes& modes = structures[static_cast<std::size_t>(mode.structure)];
    const VectorXd part = modes.along.col(mode.own_mode);
    const double square = modes.omega_rad_s[mode.own_mode] * modes.omega_rad_s[mode.own_mode];
    const double size = size_of(mode, modes, predicted);
    const MatrixXd turned = mode.shape_rows.empty() ? MatrixXd() : taken_up(modes, mode.own_mode);
    /// Column of a stiffness change M (phi_i phi_j' + phi_j phi_i') M, per unit of w_i w_j.
    const auto add = [&](int i, int j, MatrixXd& columns, Index column) {
      const double unit = omega[i] * omega[j];
      if (mode.frequency_row >= 0 && square > 0.0) columns(mode.frequency_row, column) = unit * part[i] * part[j] / square;
      for (std::size_t k = 0; k < mode.shape_rows.size(); ++k) {
        const int channel = mode.shape_channels[k];
        columns(mode.shape_rows[k], column) = size * unit * (part[j] * turned(channel, i) + part[i] * turned(channel, j));
      }
    };
    for (std::size_t k = 0; k < single.size(); ++k) add(single[k], single[k], out.frequency, static_cast<Index>(k));
    for (const auto& [pair, column] : pairs) add(pair.first, pair.second, out.shape, column);
    double norm = 0.0;
    for (const int row : mode.shape_rows) norm += predicted[row] * predicted[row];
    for (std::size_t k = 0; k < mode.shape_rows.size(); ++k)
      for (const int i : single)
        if (const auto kink = kinks.find({i, mode.shape_channels[k]}); kink != kinks.end())
          out.kinks(mode.shape_rows[k], kink->second) = kKink * std::sqrt(norm) * part[i];
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
  if (key == "temperature_C")  // the zero of a temperature is arbitrary
    for (const double v : known) from += v / static_cast<double>(known.size());
  Contrast out{key, VectorXd::Zero(std::ssize(values))};
  for (std::size_t c = 0; c < values.size(); ++c)
    if (values[c]) out.weight[static_cast<Index>(c)] = *values[c] - from;
  out.weight /= out.weight.cwiseAbs().maxCoeff();
  return out;
}

}  // namespace twindeck::diagnosis
