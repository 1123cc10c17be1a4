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

constexpr double kFrequencyWeight = 0.005;  ///< deviation of a frequency in the fit, ln: what users give an updating
constexpr int kFitSteps = 8;
constexpr int kModelModes = 12;  ///< further modes of the model that a measured one may be paired with
constexpr double kWithin = 0.1;  ///< of the level
constexpr int kDraws = 6, kHalvings = 9;
constexpr double kMostSeverity = 8.0;

/// Modes of the coarse model in its own unknowns and at the nodes as SeenModes has them.
struct ModelModes {
  VectorXd omega2;
  MatrixXd shapes, at_nodes;
};

ModelModes model_modes(const fe::ParametricSystem& system, const VectorXd& theta, Index nodes, int count) {
  const MatrixXd k(system.stiffness(theta)), m(system.mass(theta));      // lower triangles, which the solver takes
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(m, k);  // as in PlaneFrame: point masses have no inertia
  const Index n = k.rows(), kept = std::min<Index>(count, n);
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

SimpleFit simple_fit(const fe::ParametricSystem& system, const Layout& layout, const SeenModes& seen) {
  const auto n = static_cast<Index>(system.parameters.size()), modes = seen.frequency_Hz.size();
  const VectorXd initial = system.initial();
  VectorXd low(n), high(n), deviation(n);
  for (Index p = 0; p < n; ++p) {
    const fe::Parameter& parameter = system.parameters[static_cast<std::size_t>(p)];
    low[p] = parameter.lower / initial[p];
    high[p] = parameter.upper / initial[p];
    deviation[p] = (high[p] - low[p]) / std::sqrt(12.0);
  }
  SimpleFit fit{initial, 0.0};
  VectorXd factors = VectorXd::Ones(n), left(modes);
  for (int step = 0; step <= kFitSteps; ++step) {
    fit.theta = initial.cwiseProduct(factors);
    const ModelModes model =
        model_modes(system, fit.theta, static_cast<Index>(layout.nodes.size()), static_cast<int>(modes) + kModelModes);
    const std::vector<Index> partner = pair_up(seen.at_nodes, model.at_nodes);
    MatrixXd jacobian(modes, n);
    for (Index i = 0; i < modes; ++i) {
      const Index j = partner[static_cast<std::size_t>(i)];
      const VectorXd shape = model.shapes.col(j);
      left[i] = std::log(seen.frequency_Hz[i] * 2.0 * EIGEN_PI / std::sqrt(model.omega2[j]));
      for (Index p = 0; p < n; ++p) {
        const int parameter = static_cast<int>(p);
        const double slope = shape.dot(system.stiffness_derivative_times(fit.theta, parameter, shape).col(0)) -
                             model.omega2[j] * shape.dot(system.mass_derivative_times(fit.theta, parameter, shape).col(0));
        jacobian(i, p) = 0.5 * slope / model.omega2[j] * initial[p];
      }
    }
    fit.rms = std::sqrt(left.squaredNorm() / static_cast<double>(modes));
    if (step == kFitSteps) break;
    const double weight = 1.0 / (kFrequencyWeight * kFrequencyWeight);
    MatrixXd normal = weight * jacobian.transpose() * jacobian;
    normal.diagonal() += deviation.array().square().inverse().matrix();
    const VectorXd pull = (VectorXd::Ones(n) - factors).cwiseQuotient(deviation.cwiseAbs2());
    factors += normal.ldlt().solve(weight * jacobian.transpose() * left + pull);
    factors = factors.cwiseMax(low).cwiseMin(high);
  }
  return fit;
}

namespace {

/// What a severity leaves.
double rms_at(const fe::ParametricSystem& system, Truth truth, double severity) {
  truth.form.severity = severity;
  return simple_fit(system, truth.layout, measurable_modes(truth, {})).rms;
}

/// Severity at which one form leaves the level, or the nearest to it that was tried.
std::pair<double, double> severity_for(const fe::ParametricSystem& system, const Truth& truth, double level) {
  double low = 0.0, high = 0.25;
  std::pair<double, double> best{0.0, rms_at(system, truth, 0.0)};
  const auto tried = [&](double severity) {
    const double rms = rms_at(system, truth, severity);
    if (std::abs(rms - level) < std::abs(best.second - level)) best = {severity, rms};
    return rms;
  };
  while (tried(high) < level && high < kMostSeverity) {
    low = high;
    high *= 2.0;
  }
  for (int i = 0; i < kHalvings && std::abs(best.second - level) > 0.5 * kWithin * level; ++i) {
    const double middle = 0.5 * (low + high);
    (tried(middle) < level ? low : high) = middle;
  }
  return best;
}

}  // namespace

Calibrated calibrate(const fe::ParametricSystem& system, const Truth& without_form, double level, Stream& random) {
  Calibrated best;
  for (int draw = 1; draw <= kDraws; ++draw) {
    Truth truth = without_form;
    truth.form = draw_form(truth.layout, random);
    const auto [severity, rms] = severity_for(system, truth, level);
    if (draw == 1 || std::abs(rms - level) < std::abs(best.reached - level)) {
      best.form = truth.form;
      best.form.severity = severity;
      best.reached = rms;
    }
    best.draws = draw;
    if (std::abs(best.reached - level) <= kWithin * level) break;
  }
  return best;
}

double rms_of_feature_alone(const fe::ParametricSystem& system, Truth truth, int feature) {
  truth.form.only = feature;
  return simple_fit(system, truth.layout, measurable_modes(truth, {})).rms;
}

}  // namespace twindeck::blind::form
