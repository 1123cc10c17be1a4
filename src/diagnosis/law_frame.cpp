#include "diagnosis/law_frame.hpp"

#include <cmath>
#include <set>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNoneOfTheModels = 0.05;  // of measured modes: spurious, doubled, or of a part that the model lacks
constexpr double kOpenFrequency = 0.5, kOpenDamping = 1.0;  // deviation of ln f and ln zeta of such a mode
constexpr double kWideScale = 10.0;     // [-] relative deviation of a shape's scale; wide enough to have no influence
constexpr double kLargestColumn = 1e6;  // deviations of a row; with larger columns, 16 digits lose the unknowns' own variance

MatrixXd beside(const std::vector<MatrixXd>& parts, Index rows) {
  Index columns = 0;
  for (const MatrixXd& part : parts) columns += part.cols();
  MatrixXd out(rows, columns);
  Index at = 0;
  for (const MatrixXd& part : parts) {
    out.middleCols(at, part.cols()) = part;
    at += part.cols();
  }
  return out;
}

/// Variance of the rows that a prediction leaves open, and ln prior of the number of open modes.
std::pair<VectorXd, double> open_modes(const FeatureMap& map, const Prediction& prediction) {
  VectorXd variance = VectorXd::Zero(map.values().size());
  double log_prior = 0.0;
  for (std::size_t m = 0; m < map.measured_modes().size(); ++m) {
    if (prediction.paired[m] < 0) log_prior += log_prior_of_open();
    variance = variance.cwiseMax(variance_of_open(map, map.measured_modes()[m]));
  }
  const std::set<int> open(prediction.open.begin(), prediction.open.end());
  for (Index r = 0; r < variance.size(); ++r)
    if (!open.contains(static_cast<int>(r))) variance[r] = 0.0;
  return {variance, log_prior};
}

/// The class of a contrast: changes with independent increments, a Wiener process that starts at zero contrast. It allows
/// smooth changes and changes of direction. The part common to all conditions belongs to the form error.
/// @param lasting (n_rows × n_rows) covariance of the errors that change
ErrorColumns along(const Contrast& contrast, const FeatureSet& features, const std::vector<int>& rows, MatrixXd lasting) {
  VectorXd weight(std::ssize(rows));
  for (Index r = 0; r < weight.size(); ++r)
    weight[r] = contrast.weight[features.rows[static_cast<std::size_t>(rows[static_cast<std::size_t>(r)])].condition];
  weight.array() -= std::max(weight.minCoeff(), 0.0);
  if (weight.isZero(0.0)) return {};
  for (Index i = 0; i < lasting.rows(); ++i)
    for (Index j = 0; j < lasting.cols(); ++j)
      lasting(i, j) *= weight[i] * weight[j] > 0.0 ? std::min(std::abs(weight[i]), std::abs(weight[j])) : 0.0;
  return ErrorColumns::of_covariance(std::move(lasting));
}

}  // namespace

VectorXd variance_of_open(const FeatureMap& map, const MeasuredMode& mode) {
  VectorXd out = VectorXd::Zero(map.values().size());
  if (mode.frequency >= 0) out[mode.frequency] = kOpenFrequency * kOpenFrequency;
  if (mode.damping >= 0) out[mode.damping] = kOpenDamping * kOpenDamping;
  if (mode.real_rows.empty()) return out;
  const double square = map.values()(mode.real_rows).squaredNorm() / static_cast<double>(mode.real_rows.size());
  for (const auto* rows : {&mode.real_rows, &mode.imag_rows})
    for (const int row : *rows) out[row] = square;
  return out;
}

double log_prior_of_open() { return std::log(kNoneOfTheModels); }

FitSystem law_system(const Inference& plain, const Fit& fit, const std::vector<Contrast>& contrasts, std::size_t tested) {
  TWINDECK_ASSERT(fit.made() && tested <= fit.causes.size());
  const FeatureMap& map = plain.map();
  const std::vector<int>& rows = plain.training();
  const MatrixXd& j = fit.map.jacobian;
  Index asked = 0;
  for (std::size_t c = fit.causes.size() - tested; c < fit.causes.size(); ++c) asked += fit.causes[c].a.size();
  const auto n = static_cast<Index>(map.nuisances().size());
  std::vector<int> known, gains, elements;
  for (Index k = 0; k < n; ++k) {
    const Nuisance::Kind kind = map.nuisances()[static_cast<std::size_t>(k)].kind;
    const bool is_of_elements = kind == Nuisance::Kind::place && !contrasts.empty();
    (kind == Nuisance::Kind::gain ? gains : is_of_elements ? elements : known).push_back(static_cast<int>(k));
  }
  for (Index k = n; k < j.cols() - asked; ++k) known.push_back(static_cast<int>(k));
  FitSystem out;
  out.modes = map.form_modes(fit.base, fit.causes);
  for (const int mode : fit.all.paired) out.unpaired.push_back(mode < 0);
  const std::vector<PairedMode>& paired = out.modes.paired;
  const FormColumns form = form_columns(out.modes.structures, paired, fit.all.g);
  const auto frequency_Hz = each_of(map.measured_modes(), &MeasuredMode::frequency_Hz);
  const MatrixXd rotations = close_rotations(paired, frequency_Hz, map.values());
  const MatrixXd fixed =
      beside({j(Eigen::all, known), kWideScale * fit.map.scales, rotations(rows, Eigen::all)}, std::ssize(rows));
  out.sigma = plain.covariance() + linalg::square(fixed);
  const auto [variance, log_prior] = open_modes(map, fit.all);
  out.sigma.diagonal() += variance(rows);
  out.log_prior = log_prior;
  MatrixXd gain(std::ssize(rows), std::ssize(gains));
  for (Index k = 0; k < gain.cols(); ++k) {
    const auto position = static_cast<std::size_t>(gains[static_cast<std::size_t>(k)]);
    gain.col(k) = kUnitOfClasses / map.nuisances()[position].deviation * j.col(gains[static_cast<std::size_t>(k)]);
  }
  for (const MatrixXd* columns : {&form.frequency, &form.shape, &form.kinks})
    out.classes.push_back(ErrorColumns::of_columns(kUnitOfClasses * (*columns)(rows, Eigen::all)));
  MatrixXd lasting = MatrixXd::Zero(std::ssize(rows), std::ssize(rows));
  for (const ErrorColumns& c : out.classes)
    if (!c.empty()) lasting += c.covariance;
  out.classes.push_back(ErrorColumns::of_columns(std::move(gain)));
  out.classes.push_back(ErrorColumns::of_columns(j(Eigen::all, elements)));
  for (const Contrast& contrast : contrasts) out.classes.push_back(along(contrast, map.features(), rows, lasting));
  VectorXd x = fit.map.x;
  x.tail(asked).setZero();
  out.residual = map.values()(rows) - fit.map.g + j * x;
  out.signatures = j.rightCols(asked);
  Index column = 0;
  for (std::size_t c = fit.causes.size() - tested; c < fit.causes.size(); ++c) {
    const Candidate& candidate = *fit.causes[c].candidate;  // the fit's magnitudes are in units of twice their range
    for (Index k = 0; k < candidate.low.size(); ++k, ++column)
      out.signatures.col(column) /= 2.0 * (candidate.high[k] - candidate.low[k]);
  }
  return out;
}

bool can_be_weighed(const LawSystem& system) {
  if (!system.sigma.allFinite() || !system.residual.allFinite()) return false;
  const VectorXd deviation = system.sigma.diagonal().cwiseSqrt();
  const MatrixXd& s = system.signatures;
  const bool sound = s.size() == 0 ||
                     (s.allFinite() && (s.cwiseAbs().rowwise().maxCoeff().array() < kLargestColumn * deviation.array()).all());
  const auto is_small = [&](const ErrorColumns& c) {
    return c.empty() || (c.covariance.allFinite() &&
                         (c.covariance.diagonal().cwiseSqrt().array() < kLargestColumn * deviation.array()).all());
  };
  return sound && std::ranges::all_of(system.classes, is_small);
}

}  // namespace twindeck::diagnosis
