#include "diagnosis/intervals.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"

namespace twindeck::diagnosis {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kProfilePoints = 25;        ///< of a profile; the trapezoidal rule is then far finer than the reported intervals
constexpr double kProfileReach = 4.0;     ///< [deviations] to either side of the best value: all but e^-8 of a Gaussian
constexpr double kLeastVariance = 1e-18;  ///< of a coordinate in the cause's own units, with ranges of order 1
constexpr double kEndOfPrior = 0.06;      ///< [-] of the range; an interval's end this near to a bound is set to it
constexpr double kLowerTail = 0.05, kUpperTail = 0.95;  ///< an interval of 90 %

/// Information of a fit on the coordinates of one of its causes.
struct CauseInformation {
  std::size_t which;    ///< position among the fit's causes
  Index first;          ///< position of its first coordinate among those of all causes
  MatrixXd scaled;      ///< L^-1 dg/da of all causes, scaled by prior deviations (n_train × n_coordinates)
  MatrixXd covariance;  ///< of all coordinates (n_coordinates × n_coordinates)
  double misfit;        ///< chi² per degree of freedom, at least 1
};

CauseInformation information_of(const Inference& inference, const Fit& fit, std::size_t which) {
  CauseInformation out;
  out.which = which;
  out.first = 0;
  for (std::size_t c = 0; c < which; ++c) out.first += fit.causes[c].a.size();
  // Sigma_tot of the fit includes the scatter of the causes. With it, their information is F = S'S (I - S'S)^-1 on prior scale.
  // Without it, Sigma_0 = Sigma_tot - D D' and the information is D0'D0, by the matrix inversion lemma.
  const MatrixXd& s = fit.cause_jacobian;
  VectorXd prior(s.cols());
  Index at = 0;
  for (const Cause& c : fit.causes)
    for (Index i = 0; i < c.a.size(); ++i, ++at) prior[at] = 2.0 * (c.candidate->high[i] - c.candidate->low[i]);
  out.scaled = s * prior.asDiagonal();
  const MatrixXd gram = out.scaled.transpose() * out.scaled;
  // Posterior covariance of prior-scaled coordinates is I - D' Sigma_tot^-1 D.
  out.covariance = MatrixXd::Identity(gram.rows(), gram.cols()) - gram;
  out.covariance = prior.asDiagonal() * out.covariance * prior.asDiagonal();
  // The remaining misfit widens the intervals as it reduces the odds (Birge 1932), because errors are larger than stated.
  out.misfit = std::max(1.0, fit.chi_squared / inference.dof());
  return out;
}

/// The causes with coordinate `i` of one of them at `value`; its other coordinates follow the ridge of the likelihood.
std::vector<Cause> moved_along_ridge(const Fit& fit, const CauseInformation& known, Index i, double value) {
  std::vector<Cause> causes = fit.causes;
  const Cause& cause = fit.causes[known.which];
  const Candidate& candidate = *cause.candidate;
  const MatrixXd& inside = known.covariance;
  const Index first = known.first;
  const double centre = cause.a[i];
  for (Index j = 0; j < cause.a.size(); ++j) {
    const double follow =
        j == i ? value
               : cause.a[j] + inside(first + j, first + i) / std::max(inside(first + i, first + i), 1e-300) * (value - centre);
    causes[known.which].a[j] = std::clamp(follow, candidate.low[j], candidate.high[j]);
  }
  causes[known.which].a[i] = value;
  return causes;
}

/// ln likelihood of a prediction relative to the fit. At the optimum the residual is orthogonal to the changes by the cause.
double log_likelihood_of(const Inference& inference, const Fit& fit, const CauseInformation& known, const Prediction& moved) {
  // x adapts too: Sigma_tot includes its scatter. The cause's own scatter is removed from it (Woodbury).
  const Index k = fit.causes[known.which].a.size();
  VectorXd change(static_cast<Index>(inference.training().size()));
  for (std::size_t r = 0; r < inference.training().size(); ++r)
    change[static_cast<Index>(r)] = moved.g[inference.training()[r]] - fit.all.g[inference.training()[r]];
  const VectorXd c = fit.total_factor.triangularView<Eigen::Lower>().solve(change);
  const MatrixXd own = known.scaled.middleCols(known.first, k);
  const MatrixXd capacity = MatrixXd::Identity(k, k) - own.transpose() * own;
  const VectorXd projected = own.transpose() * c;
  const double distance = c.squaredNorm() + projected.dot(capacity.ldlt().solve(projected));
  return -0.5 * distance / known.misfit;
}

/// Distribution of one coordinate from its profile likelihood.
class Profile {
 public:
  Profile(const Inference& inference, const Fit& fit, const CauseInformation& known, Index i) {
    const Cause& cause = fit.causes[known.which];
    const double low = cause.candidate->low[i], high = cause.candidate->high[i], centre = cause.a[i];
    const double deviation = std::sqrt(std::max(known.covariance(known.first + i, known.first + i), kLeastVariance));
    const double reach = std::min(kProfileReach * std::sqrt(known.misfit) * deviation, 1.0 * (high - low));
    const double from = std::max(low, centre - reach), to = std::min(high, centre + reach);
    std::vector<double> log_likelihood(kProfilePoints, -kNotFitted);
    value_.resize(kProfilePoints);
    parallel_for(kProfilePoints, [&](int p) {
      const double value = from + (to - from) * p / (kProfilePoints - 1);
      const Prediction moved = inference.map().predict(fit.base, moved_along_ridge(fit, known, i, value), false);
      value_[static_cast<std::size_t>(p)] = value;
      if (moved.valid) log_likelihood[static_cast<std::size_t>(p)] = log_likelihood_of(inference, fit, known, moved);
    });
    const double top = *std::max_element(log_likelihood.begin(), log_likelihood.end());
    cumulative_.assign(kProfilePoints, 0.0);
    for (std::size_t q = 1; q < value_.size(); ++q)
      cumulative_[q] = cumulative_[q - 1] + 0.5 * (std::exp(log_likelihood[q] - top) + std::exp(log_likelihood[q - 1] - top)) *
                                                (value_[q] - value_[q - 1]);
  }

  [[nodiscard]] double quantile(double level) const {
    const double target = level * cumulative_.back();
    for (std::size_t q = 1; q < value_.size(); ++q)
      if (cumulative_[q] >= target)
        return value_[q - 1] + (value_[q] - value_[q - 1]) * (target - cumulative_[q - 1]) /
                                   std::max(cumulative_[q] - cumulative_[q - 1], 1e-300);
    return value_.back();
  }

 private:
  std::vector<double> value_, cumulative_;
};

}  // namespace

std::vector<EffectParameter> effect_parameters(const Inference& inference, const Fit& fit, std::size_t which) {
  const Cause& cause = fit.causes[which];
  const Candidate& candidate = *cause.candidate;
  std::vector<EffectParameter> out;
  if (cause.a.size() == 0) return out;
  const CauseInformation known = information_of(inference, fit, which);
  for (Index i = 0; i < cause.a.size(); ++i) {
    const double low = candidate.low[i], high = candidate.high[i];
    const Profile profile(inference, fit, known, i);
    const UnknownSpec& spec = candidate.hypothesis->unknowns[static_cast<std::size_t>(i)];
    EffectParameter parameter{spec.name, spec.unit, candidate.physical(cause.a, i), 0.0, 0.0, false, false};
    VectorXd end = cause.a;
    // An end that the data do not determine is the prior's bound. The other end is then a one-sided limit.
    const double lower = profile.quantile(kLowerTail), upper = profile.quantile(kUpperTail);
    parameter.at_low_bound = lower < low + kEndOfPrior * (high - low);
    parameter.at_high_bound = upper > high - kEndOfPrior * (high - low);
    end[i] = parameter.at_low_bound ? low : lower;
    parameter.low = candidate.physical(end, i);
    end[i] = parameter.at_high_bound ? high : upper;
    parameter.high = candidate.physical(end, i);
    out.push_back(parameter);
  }
  return out;
}

void widen_sizes(std::vector<EffectParameter>& parameters, double deviation) {
  const double reach = kReachOfNinety * deviation;
  static const std::set<std::string> no_size = {"Hz", "deg", "degC", "C", "s", "m"};
  for (EffectParameter& p : parameters) {
    if (no_size.contains(p.unit)) continue;
    const bool factor = p.name == "factor";
    const auto size = [&](double v) { return factor ? std::log(v) : v; };
    const auto back = [&](double z) { return factor ? std::exp(z) : z; };
    const double z = size(p.value), low = std::min(size(p.low), z), high = std::max(size(p.high), z);
    if (!(z != 0.0) || !std::isfinite(z)) continue;
    const auto end = [&](double of, double side) {
      if (of * z > 0.0) return z * std::exp(std::copysign(std::hypot(std::log(of / z), reach), side * z));
      return z + side * std::hypot(of - z, reach * z);
    };
    if (!p.at_low_bound) p.low = back(end(low, -1.0));
    if (!p.at_high_bound) p.high = back(end(high, 1.0));
  }
}

}  // namespace twindeck::diagnosis
