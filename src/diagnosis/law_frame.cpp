#include "diagnosis/law_frame.hpp"

#include <cmath>
#include <set>

#include "core/error.hpp"
#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kUnit = 0.01;          // [-] scale of every class: about what a carefully fitted model is off
constexpr double kWideScale = 10.0;     // [-] of a shape, relative: wide enough to cost nothing
constexpr double kLargestColumn = 1e6;  // deviations of a row: beyond, 16 digits do not hold the unknowns' own variance

/// Columns of unknowns side by side.
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

/// Columns of the same law D D' that are no more than the rows.
MatrixXd no_more_than_rows(MatrixXd columns) {
  if (columns.cols() <= columns.rows()) return columns;
  const linalg::ThinSvd svd = linalg::thin_svd(std::move(columns));
  return svd.u * svd.values.asDiagonal();
}

/// A change that starts where the contrast is nil and has independent increments along it, a Wiener process: smooth changes are
/// among them, and those that turn. One block of columns for each increment; what all conditions share is the form error's.
MatrixXd changes_along(const Contrast& contrast, const MatrixXd& errors, const FeatureSet& features,
                       const std::vector<int>& rows) {
  VectorXd weight(std::ssize(rows));
  for (Index r = 0; r < weight.size(); ++r)
    weight[r] = contrast.weight[features.rows[static_cast<std::size_t>(rows[static_cast<std::size_t>(r)])].condition];
  const double from = weight.minCoeff() > 0.0 ? weight.minCoeff() : 0.0;
  std::vector<MatrixXd> blocks;
  for (const double side : {1.0, -1.0}) {
    const std::set<double> reached(weight.begin(), weight.end());
    std::set<double> levels;
    for (const double w : reached)
      if (side * w > from) levels.insert(side * w);
    double before = from;
    for (const double level : levels) {
      const VectorXd beyond = ((side * weight).array() >= level).cast<double>();
      blocks.emplace_back(std::sqrt(level - before) * (beyond.asDiagonal() * errors));
      before = level;
    }
  }
  return no_more_than_rows(beside(blocks, weight.size()));
}

}  // namespace

LawSystem law_system(const Inference& plain, const Fit& fit, const std::vector<Contrast>& contrasts, std::size_t tested) {
  TWINDECK_ASSERT(fit.made() && tested <= fit.causes.size());
  const FeatureMap& map = plain.map();
  const std::vector<int>& rows = plain.training();
  const MatrixXd& j = fit.map.jacobian;
  Index asked = 0;
  for (std::size_t c = fit.causes.size() - tested; c < fit.causes.size(); ++c) asked += fit.causes[c].a.size();
  const auto n = static_cast<Index>(map.nuisances().size());
  std::vector<int> known, gains;
  for (Index k = 0; k < n; ++k)
    (map.nuisances()[static_cast<std::size_t>(k)].kind == Nuisance::Kind::gain ? gains : known).push_back(static_cast<int>(k));
  for (Index k = n; k < j.cols() - asked; ++k) known.push_back(static_cast<int>(k));
  const FormModes modes = map.form_modes(fit.base, fit.causes);
  const FormColumns form = form_columns(modes.modes, modes.paired, fit.all.g);
  std::vector<double> frequency_Hz;
  for (const MeasuredMode& mode : map.measured_modes()) frequency_Hz.push_back(mode.frequency_Hz);
  const MatrixXd rotations = close_rotations(modes.paired, frequency_Hz, map.values());
  const MatrixXd fixed =
      beside({j(Eigen::all, known), kWideScale * fit.map.scales, rotations(rows, Eigen::all)}, std::ssize(rows));
  LawSystem out;
  out.sigma = plain.covariance() + linalg::product(fixed, fixed.transpose());
  MatrixXd gain(std::ssize(rows), std::ssize(gains));
  for (Index k = 0; k < gain.cols(); ++k) {
    const auto position = static_cast<std::size_t>(gains[static_cast<std::size_t>(k)]);
    gain.col(k) = kUnit / map.nuisances()[position].deviation * j.col(gains[static_cast<std::size_t>(k)]);
  }
  out.classes = {kUnit * form.frequency(rows, Eigen::all), no_more_than_rows(kUnit * form.shape(rows, Eigen::all)),
                 no_more_than_rows(kUnit * form.kinks(rows, Eigen::all)), std::move(gain)};
  const MatrixXd all = beside({out.classes[kFrequencies], out.classes[kShapes], out.classes[kKinks]}, std::ssize(rows));
  for (const Contrast& contrast : contrasts) out.classes.push_back(changes_along(contrast, all, map.features(), rows));
  VectorXd x = fit.map.x;
  x.tail(asked).setZero();
  out.residual = map.values()(rows) - fit.map.g + j * x;
  out.signatures = j.rightCols(asked);
  Index column = 0;
  for (std::size_t c = fit.causes.size() - tested; c < fit.causes.size(); ++c) {
    const Candidate& candidate = *fit.causes[c].candidate;  // the fit has magnitudes in units of twice their range
    for (Index k = 0; k < candidate.low.size(); ++k, ++column)
      out.signatures.col(column) /= 2.0 * (candidate.high[k] - candidate.low[k]);
  }
  return out;
}

bool can_be_weighed(const LawSystem& system) {
  if (!system.sigma.allFinite() || !system.residual.allFinite()) return false;
  const VectorXd deviation = system.sigma.diagonal().cwiseSqrt();
  const auto sound = [&](const MatrixXd& m) {
    return m.size() == 0 ||
           (m.allFinite() && (m.cwiseAbs().rowwise().maxCoeff().array() < kLargestColumn * deviation.array()).all());
  };
  return sound(system.signatures) && std::all_of(system.classes.begin(), system.classes.end(), sound);
}

}  // namespace twindeck::diagnosis
