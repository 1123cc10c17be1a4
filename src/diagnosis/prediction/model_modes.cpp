#include <algorithm>
#include <map>
#include <utility>

#include "diagnosis/prediction/predictor.hpp"

/// Modes of the model without dampers, for its form errors, and their pairs with measured modes.
namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kFurtherModes = 12;     // modes above the number measured, because shapes mix with unmeasured neighbours too
constexpr double kLeastLikeness = 0.3;  // MAC below which a mode belongs to a damper or oscillator, not to the structure

}  // namespace

FormModes Predictor::form_modes() {
  FormModes out;
  const Prediction prediction = run();
  if (!prediction.valid || map_.modes_.empty()) return out;
  // Likeness in the coordinates that all states have. Shapes are mass-normalised with all moving masses. So the mode of an
  // oscillator, in which the structure hardly moves, resembles no mode of the structure.
  const Index c = map_.model().common;
  std::map<std::pair<const UndampedModes*, const Reading*>, int> known;
  std::vector<MatrixXd> common;  // modes of each structure (c × n_modes)
  MatrixXd weighted;             // modes of the base, times the mass
  const auto structure_of = [&](const SolvedState& state, const Reading& read) {
    const UndampedModes& all = undamped_.of(state.state.stiffness, state.state.mass);
    const auto [at, is_new] = known.try_emplace({&all, &read}, static_cast<int>(std::ssize(out.structures)));
    if (!is_new) return at->second;
    const Index count = std::min<Index>((all.mu.array() > 0.0).count(), state.modes.s.size() + kFurtherModes);
    ModelModes modes{VectorXd(count), {}, {}};
    MatrixXd shapes = all.shapes.leftCols(count);
    for (Index j = 0; j < count; ++j) {
      modes.omega_rad_s[j] = std::sqrt(std::max(all.eigenvalue(j), 0.0));
      shapes.col(j) /= std::sqrt(all.mu[j]);
    }
    modes.shapes = read.factor.asDiagonal() * channel_rows(read, state.columns) * shapes.topRows(std::ssize(state.columns));
    if (out.structures.empty()) weighted = base_.common_mass * shapes.topRows(c);
    modes.along =
        out.structures.empty() ? MatrixXd::Identity(count, count) : MatrixXd(weighted.transpose() * shapes.topRows(c));
    common.push_back(shapes.topRows(c));
    out.structures.push_back(std::move(modes));
    return at->second;
  };
  for (std::size_t m = 0; m < map_.modes_.size(); ++m) {
    const MeasuredMode& measured = map_.modes_[m];
    PairedMode mode{-1, measured.condition, measured.frequency, measured.real_rows, measured.real_channels, 0, 0};
    const SolvedState& state = solved(measured.condition);
    mode.structure = structure_of(state, reading(measured.condition));
    if (prediction.paired[m] >= 0) {
      const VectorXd re = base_.common_mass * state.modes.shapes.col(prediction.paired[m]).head(c).real(),
                     im = base_.common_mass * state.modes.shapes.col(prediction.paired[m]).head(c).imag();
      const auto most_like = [&](const MatrixXd& shapes) {
        Index at = 0;
        const double along =
            ((shapes.transpose() * re).array().square() + (shapes.transpose() * im).array().square()).maxCoeff(&at);
        return std::pair(static_cast<int>(at), along);
      };
      const double own = state.modes.shapes.col(prediction.paired[m]).head(c).real().dot(re) +
                         state.modes.shapes.col(prediction.paired[m]).head(c).imag().dot(im);
      mode.own_mode = most_like(common[static_cast<std::size_t>(mode.structure)]).first;
      const auto [base, along] = most_like(common.front());
      if (along > kLeastLikeness * own) mode.model_mode = base;
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
