#include "diagnosis/law_frame.hpp"

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

/// Weight of each training row in a contrast.
VectorXd weight_of_rows(const Contrast& contrast, const FeatureSet& features, const std::vector<int>& rows) {
  VectorXd out(std::ssize(rows));
  for (Index r = 0; r < out.size(); ++r)
    out[r] = contrast.weight[features.rows[static_cast<std::size_t>(rows[static_cast<std::size_t>(r)])].condition];
  return out;
}

}  // namespace

LawSystem law_system(const Inference& plain, const Fit& fit, const std::vector<Contrast>& contrasts, std::size_t tested) {
  TWINDECK_ASSERT(fit.made() && tested <= fit.causes.size());
  const FeatureMap& map = plain.map();
  const std::vector<int>& rows = plain.training();
  const auto n = static_cast<Index>(map.nuisances().size());
  const MatrixXd& j = fit.map.jacobian;
  Index asked = 0;
  for (std::size_t c = fit.causes.size() - tested; c < fit.causes.size(); ++c) asked += fit.causes[c].a.size();
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
  for (const Contrast& contrast : contrasts)
    out.classes.push_back(no_more_than_rows(weight_of_rows(contrast, map.features(), rows).asDiagonal() * all));
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
