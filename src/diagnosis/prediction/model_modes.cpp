#include <algorithm>

#include "diagnosis/prediction/predictor.hpp"

/// Modes of the model without dampers, which its form errors are made of, and which of them each measured mode is.
namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kFurtherModes = 12;     // beyond those that were measured: shapes turn into unmeasured neighbours too
constexpr double kLeastLikeness = 0.3;  // MAC: a mode of a damper or an oscillator is none of the structure's

}  // namespace

FormModes Predictor::form_modes() {
  FormModes out;
  const Prediction prediction = run();
  if (!prediction.valid || map_.modes_.empty()) return out;
  const SolvedState& first = solved(map_.modes_.front().condition);
  const UndampedModes& all = undamped_.of(first.state.stiffness, first.state.mass);
  const Index count = std::min<Index>((all.mu.array() > 0.0).count(), first.modes.s.size() + kFurtherModes);
  const auto n = static_cast<Index>(first.columns.size());
  MatrixXd shapes = all.shapes.leftCols(count);
  out.modes.omega_rad_s.resize(count);
  for (Index j = 0; j < count; ++j) {
    out.modes.omega_rad_s[j] = std::sqrt(std::max(all.eigenvalue(j), 0.0));
    shapes.col(j) /= std::sqrt(all.mu[j]);
  }
  out.columns = first.columns;
  out.coordinates = shapes.topRows(n);
  out.modes.shapes = channel_factor_.asDiagonal() * channel_rows(first.columns) * shapes.topRows(n);
  // Alike in the coordinates that every state has. Shapes are mass-normalised with everything that moves in them, so that an
  // oscillator's own mode, in which the structure hardly does, is like none of the structure's.
  const Index c = map_.model().common;
  const MatrixXd weighted = base_.common_mass * shapes.topRows(c);
  for (std::size_t m = 0; m < map_.modes_.size(); ++m) {
    const MeasuredMode& measured = map_.modes_[m];
    PairedMode mode{-1, measured.condition, measured.frequency, measured.real_rows, measured.real_channels};
    if (prediction.paired[m] < 0) {
      out.paired.push_back(mode);
      continue;
    }
    const SolvedState& state = solved(measured.condition);
    const VectorXd re = state.modes.shapes.col(prediction.paired[m]).head(c).real(),
                   im = state.modes.shapes.col(prediction.paired[m]).head(c).imag();
    const double own = re.dot(base_.common_mass * re) + im.dot(base_.common_mass * im);
    double best = kLeastLikeness;
    for (Index j = 0; j < count; ++j) {
      const double along = std::pow(weighted.col(j).dot(re), 2) + std::pow(weighted.col(j).dot(im), 2);
      const double mac = own > 0.0 ? along / own : 0.0;
      if (mac <= best) continue;
      best = mac;
      mode.model_mode = static_cast<int>(j);
    }
    out.paired.push_back(mode);
  }
  return out;
}

FormModes FeatureMap::form_modes(const Base& base, const std::vector<Cause>& causes) const {
  return Predictor(*this, base, causes, false).form_modes();
}

void FeatureMap::add_covariance(const MatrixXd& further) { covariance_ += further; }

}  // namespace twindeck::diagnosis
