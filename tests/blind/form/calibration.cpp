#include "blind/form/calibration.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

namespace twindeck::blind::form {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFrequencyWeight = 0.01, kShapeWeight = 0.05;  ///< deviations in the fit: about what a coarse model leaves
constexpr double kLeastMac = 0.6;  ///< a mode without a counterpart in the model is not a form error but a mode that it lacks
constexpr int kFitSteps = 8;
constexpr int kModelModes = 12;  ///< further modes of the model that a measured one may be paired with
constexpr double kWithin = 0.1;  ///< of the level
constexpr int kDraws = 12, kHalvings = 9;
constexpr double kMostSeverity = 8.0;

/// Modes of the coarse model in its own unknowns (all that have mass), and at the nodes as SeenModes has them.
struct ModelModes {
  VectorXd omega2;
  MatrixXd shapes, at_nodes;
};

ModelModes model_modes(const fe::ParametricSystem& system, const VectorXd& theta, Index nodes) {
  constexpr double kMassless = 1e-9;                                     // of the largest 1/omega²
  const MatrixXd k(system.stiffness(theta)), m(system.mass(theta));      // lower triangles, which the solver takes
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(m, k);  // as in PlaneFrame: point masses have no inertia
  const Index n = k.rows();
  Index kept = 0;
  while (kept < n && eigen.eigenvalues()[n - 1 - kept] > kMassless * eigen.eigenvalues()[n - 1]) ++kept;
  ModelModes out{VectorXd(kept), MatrixXd(n, kept), MatrixXd::Zero(2 * nodes, kept)};
  for (Index i = 0; i < kept; ++i) {
    const double inverse = eigen.eigenvalues()[n - 1 - i];
    out.omega2[i] = 1.0 / inverse;
    out.shapes.col(i) = eigen.eigenvectors().col(n - 1 - i) / std::sqrt(inverse);
  }
  for (std::size_t d = 0; d < system.dofs.size(); ++d) {
    const int direction = system.dofs[d].direction;
    if (direction == 0 || direction == 2)
      out.at_nodes.row(2 * (std::stol(system.dofs[d].node) - 1) + direction / 2) = out.shapes.row(static_cast<Index>(d));
  }
  return out;
}

/// For each seen mode the model's most alike, each once: the best pair of all first.
std::vector<Index> pair_up(const MatrixXd& seen, const MatrixXd& model) {
  MatrixXd mac(seen.cols(), model.cols());
  for (Index i = 0; i < seen.cols(); ++i)
    for (Index j = 0; j < model.cols(); ++j)
      mac(i, j) = std::pow(seen.col(i).dot(model.col(j)), 2) /
                  (seen.col(i).squaredNorm() * std::max(model.col(j).squaredNorm(), 1e-300));
  std::vector<Index> partner(static_cast<std::size_t>(seen.cols()), -1);
  for (Index round = 0; round < std::min(seen.cols(), model.cols()); ++round) {
    Index i = 0, j = 0;
    mac.maxCoeff(&i, &j);
    partner[static_cast<std::size_t>(i)] = j;
    mac.row(i).setConstant(-1.0);
    mac.col(j).setConstant(-1.0);
  }
  return partner;
}

}  // namespace

namespace {

/// Residuals and derivatives of a model at one theta, against seen modes: ln f, then shapes at the channels.
struct Linearised {
  VectorXd left;      ///< (n_rows) weighted
  MatrixXd jacobian;  ///< (n_rows × n_parameters) with respect to factors
  SimpleFit fit;
};

/// d shape_i / d factor_p and d ln f_i / d factor_p of a model mode, by the expansion in all its modes.
struct Slopes {
  VectorXd frequency;  ///< (n_parameters)
  MatrixXd shape;      ///< (2 n_nodes × n_parameters)
};

Slopes slopes_of(const fe::ParametricSystem& system, const VectorXd& theta, const ModelModes& model, Index i) {
  constexpr double kLeastGap = 0.01;  // relative, between omega²: nearer modes turn no faster into each other
  const auto n = static_cast<Index>(system.parameters.size());
  const VectorXd initial = system.initial(), shape = model.shapes.col(i);
  Slopes out{VectorXd(n), MatrixXd(model.at_nodes.rows(), n)};
  for (Index p = 0; p < n; ++p) {
    const int parameter = static_cast<int>(p);
    const VectorXd force = (system.stiffness_derivative_times(theta, parameter, shape) -
                            model.omega2[i] * system.mass_derivative_times(theta, parameter, shape)) *
                           initial[p];
    VectorXd along = model.shapes.transpose() * force;
    out.frequency[p] = 0.5 * along[i] / model.omega2[i];
    for (Index j = 0; j < along.size(); ++j) {
      const double gap = model.omega2[i] - model.omega2[j];
      along[j] = j == i ? 0.0 : along[j] / std::copysign(std::max(std::abs(gap), kLeastGap * model.omega2[i]), gap);
    }
    out.shape.col(p) = model.at_nodes * along;
  }
  return out;
}

Linearised linearise(const fe::ParametricSystem& system, const Layout& layout, const SeenModes& seen, const VectorXd& theta) {
  const auto n = static_cast<Index>(system.parameters.size()), modes = seen.frequency_Hz.size();
  const ModelModes model = model_modes(system, theta, static_cast<Index>(layout.nodes.size()));
  const Index candidates = std::min<Index>(modes + kModelModes, model.omega2.size());
  const std::vector<Index> partner = pair_up(seen.at_nodes, model.at_nodes.leftCols(candidates));
  const MatrixXd seen_shapes = at_channels(layout, seen.at_nodes), model_shapes = at_channels(layout, model.at_nodes);
  const Index channels = seen_shapes.rows();
  Linearised out{VectorXd(modes * (1 + channels)), MatrixXd(modes * (1 + channels), n), {theta}};
  double frequencies = 0.0, shapes = 0.0;
  for (Index i = 0; i < modes; ++i) {
    const Index j = partner[static_cast<std::size_t>(i)];
    const Slopes slopes = slopes_of(system, theta, model, j);
    const double left = std::log(seen.frequency_Hz[i] * 2.0 * EIGEN_PI / std::sqrt(model.omega2[j]));
    out.left[i] = left / kFrequencyWeight;
    out.jacobian.row(i) = slopes.frequency.transpose() / kFrequencyWeight;
    frequencies += left * left;
    const VectorXd t = seen_shapes.col(i) / seen_shapes.col(i).cwiseAbs().maxCoeff(), m = model_shapes.col(j);
    const double own = std::max(m.squaredNorm(), 1e-300),
                 scale = t.dot(m) / own;  // the model's shape in the size of the seen one
    const MatrixXd slope = scale * at_channels(layout, slopes.shape);
    out.left.segment(modes + i * channels, channels) = (t - scale * m) / kShapeWeight;
    out.jacobian.middleRows(modes + i * channels, channels) = (slope - m * (m.transpose() * slope) / own) / kShapeWeight;
    shapes += (t - scale * m).squaredNorm();
    out.fit.least_mac = std::min(out.fit.least_mac, std::pow(t.dot(m), 2) / (t.squaredNorm() * own));
  }
  out.fit.rms = std::sqrt(frequencies / static_cast<double>(modes));
  out.fit.shape_rms = std::sqrt(shapes / static_cast<double>(modes * channels));
  return out;
}

}  // namespace

SimpleFit simple_fit(const fe::ParametricSystem& system, const Layout& layout, const SeenModes& seen) {
  const auto n = static_cast<Index>(system.parameters.size());
  const VectorXd initial = system.initial();
  VectorXd low(n), high(n), deviation(n);
  for (Index p = 0; p < n; ++p) {
    const fe::Parameter& parameter = system.parameters[static_cast<std::size_t>(p)];
    low[p] = parameter.lower / initial[p];
    high[p] = parameter.upper / initial[p];
    deviation[p] = (high[p] - low[p]) / std::sqrt(12.0);
  }
  VectorXd factors = VectorXd::Ones(n);
  Linearised at = linearise(system, layout, seen, initial);
  for (int step = 0; step < kFitSteps; ++step) {
    MatrixXd normal = at.jacobian.transpose() * at.jacobian;
    normal.diagonal() += deviation.array().square().inverse().matrix();
    const VectorXd pull = (VectorXd::Ones(n) - factors).cwiseQuotient(deviation.cwiseAbs2());
    factors += normal.ldlt().solve(at.jacobian.transpose() * at.left + pull);
    factors = factors.cwiseMax(low).cwiseMin(high);
    at = linearise(system, layout, seen, initial.cwiseProduct(factors));
  }
  return at.fit;
}

namespace {

/// What a severity leaves.
SimpleFit fit_at(const fe::ParametricSystem& system, Truth truth, double severity) {
  truth.form.severity = severity;
  return simple_fit(system, truth.layout, measurable_modes(truth, {}));
}

struct AtSeverity {
  double severity = 0.0;
  SimpleFit fit;
};

/// Severity at which one form leaves the level, or the nearest to it that was tried.
AtSeverity severity_for(const fe::ParametricSystem& system, const Truth& truth, double level) {
  double low = 0.0, high = 0.25;
  AtSeverity best{0.0, fit_at(system, truth, 0.0)};
  const auto tried = [&](double severity) {
    const SimpleFit fit = fit_at(system, truth, severity);
    if (std::abs(fit.rms - level) < std::abs(best.fit.rms - level)) best = {severity, fit};
    return fit.rms;
  };
  while (tried(high) < level && high < kMostSeverity) {
    low = high;
    high *= 2.0;
  }
  for (int i = 0; i < kHalvings && std::abs(best.fit.rms - level) > 0.5 * kWithin * level; ++i) {
    const double middle = 0.5 * (low + high);
    (tried(middle) < level ? low : high) = middle;
  }
  return best;
}

}  // namespace

Calibrated calibrate(const fe::ParametricSystem& system, const Truth& without_form, double level, Stream& random) {
  Calibrated best;
  double distance = 1e300;  // from what is asked for
  for (int draw = 1; draw <= kDraws; ++draw) {
    Truth truth = without_form;
    truth.form = draw_form(truth.layout, random);
    const AtSeverity at = severity_for(system, truth, level);
    const double off = std::abs(at.fit.rms - level) / level, lacking = std::max(kLeastMac - at.fit.least_mac, 0.0);
    if (off + lacking < distance) {
      distance = off + lacking;
      best = {truth.form, at.fit.rms, at.fit.shape_rms, at.fit.least_mac, draw};
      best.form.severity = at.severity;
    }
    best.draws = draw;
    if (off <= kWithin && lacking == 0.0) break;
  }
  return best;
}

double rms_of_feature_alone(const fe::ParametricSystem& system, Truth truth, int feature) {
  truth.form.only = feature;
  return simple_fit(system, truth.layout, measurable_modes(truth, {})).rms;
}

}  // namespace twindeck::blind::form
