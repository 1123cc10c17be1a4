#include "diagnosis/law_openings.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Covariance of the rows of a mode that is none of the model's.
struct Opening {
  MatrixXd covariance;
  double log_prior = 0.0;
};

/// A mode that may be none of the model's. Within a state a label is one mode: it is the model's in all its conditions or in
/// none.
struct OpenMode {
  std::vector<int> modes;        ///< measured ones
  std::vector<int> rows;         ///< positions among the training rows
  std::vector<double> spurious;  ///< variance of each row if the mode is spurious
  bool is_open = false;
  bool may_change = false;  ///< conditions differ: it may be missing only where it may be spurious
  Opening now;              ///< present opening in the system
  std::vector<Opening> openings;
};

/// Shapes at the channels of the structure under forces of any distribution at the frequency of a measured mode: modes weighted
/// by their distance in frequency (n_channels × n_modes). A part that the model lacks forces the structure into such a shape.
/// An unpaired mode within the measured band is left out, because the measured mode could be that mode itself.
MatrixXd forced_shapes(const FeatureMap& map, const FitSystem& system, std::size_t measured) {
  const int structure = system.modes.paired[measured].structure;
  const ModelModes& modes = system.modes.structures[static_cast<std::size_t>(structure)];
  std::set<int> taken;
  for (std::size_t m = 0; m < system.modes.paired.size(); ++m)
    if (system.modes.paired[m].structure == structure && !system.unpaired[m] &&
        map.measured_modes()[m].label != map.measured_modes()[measured].label)
      taken.insert(system.modes.paired[m].own_mode);
  MatrixXd out = modes.shapes;
  for (Index j = 0; j < out.cols(); ++j) {
    const bool is_free = !taken.empty() && j < *taken.rbegin() && !taken.contains(static_cast<int>(j));
    out.col(j) *=
        is_free ? 0.0 : turning(modes.omega_rad_s[j], 2.0 * std::numbers::pi * map.measured_modes()[measured].frequency_Hz);
  }
  return out;
}

/// Covariance of the rows of a mode that the model lacks. The real parts are one forced shape, with a size and a sign for each
/// record; ln f is one number. Each record has a small variance of its own. Damping and imaginary parts are as uncertain as
/// those of a spurious mode.
MatrixXd of_a_missing_mode(const FeatureMap& map, const FitSystem& system, const OpenMode& open,
                           const std::vector<int>& training) {
  const MatrixXd shapes = forced_shapes(map, system, static_cast<std::size_t>(open.modes.front()));
  VectorXd reference = VectorXd::Zero(shapes.rows()), own = VectorXd::Ones(map.values().size());
  MatrixXd columns = MatrixXd::Zero(map.values().size(), shapes.cols() + 1);
  for (const int m : open.modes) {
    const MeasuredMode& mode = map.measured_modes()[static_cast<std::size_t>(m)];
    const VectorXd values = map.values()(mode.real_rows);
    const MatrixXd here = shapes(mode.real_channels, Eigen::all);
    const double sign = values.dot(reference(mode.real_channels)) < 0.0 ? -1.0 : 1.0, norm = here.norm();
    if (norm > 0.0) columns(mode.real_rows, Eigen::seq(0, Eigen::last - 1)) = sign * values.norm() / norm * here;
    reference(mode.real_channels) += sign * values;
    own(mode.real_rows).setConstant(kUnitOfClasses * kUnitOfClasses);
    if (mode.frequency < 0) continue;
    own[mode.frequency] = kUnitOfClasses * kUnitOfClasses;
    columns(mode.frequency, columns.cols() - 1) = std::sqrt(variance_of_open(map, mode)[mode.frequency]);
  }
  std::vector<int> rows;
  for (const int at : open.rows) rows.push_back(training[static_cast<std::size_t>(at)]);
  MatrixXd out = linalg::square(MatrixXd(columns(rows, Eigen::all)));
  out.diagonal() += own(rows).cwiseProduct(Eigen::Map<const VectorXd>(open.spurious.data(), std::ssize(open.spurious)));
  return out;
}

std::vector<OpenMode> modes_that_may_open(const Inference& plain, const FitSystem& system) {
  const FeatureMap& map = plain.map();
  std::map<std::tuple<std::string, std::string, bool>, OpenMode> by_name;  // state, label, whether the pairing left it open
  const VectorXd sigma = system.sigma.diagonal();
  for (std::size_t m = 0; m < map.measured_modes().size(); ++m) {
    const MeasuredMode& mode = map.measured_modes()[m];
    if (mode.real_rows.size() < 2) continue;  // without a shape it cannot be distinguished
    const VectorXd variance = variance_of_open(map, mode);
    OpenMode here;
    bool is_aside = true;  // true if all its rows are excluded; free scales make single rows of any shape as wide
    for (std::size_t at = 0; at < plain.training().size(); ++at) {
      const double open = variance[plain.training()[at]];
      if (open <= 0.0) continue;
      here.rows.push_back(static_cast<int>(at));
      here.spurious.push_back(open);
      is_aside = is_aside && sigma[static_cast<Index>(at)] > open;
    }
    const bool is_open = system.unpaired[m];
    if (here.rows.empty() || (is_aside && !is_open)) continue;
    OpenMode& open = by_name[{map.features().condition_of(mode).state, mode.label, is_open}];
    open.is_open = is_open;
    open.modes.push_back(static_cast<int>(m));
    open.rows.insert(open.rows.end(), here.rows.begin(), here.rows.end());
    open.spurious.insert(open.spurious.end(), here.spurious.begin(), here.spurious.end());
  }
  // If states differ, a changing shape may come from a cause.
  const bool may_be_missing = states_of(map.features()).size() == 1 && !system.modes.structures.empty();
  const bool may_change = !contrasts_of(map.features()).empty();
  std::vector<OpenMode> out;
  for (auto& [name, open] : by_name) {
    const auto n = std::ssize(open.rows);
    open.openings = {{Eigen::Map<const VectorXd>(open.spurious.data(), n).asDiagonal(),
                      static_cast<double>(open.modes.size()) * log_prior_of_open()}};
    open.now = open.is_open ? open.openings.front() : Opening{MatrixXd::Zero(n, n)};
    open.may_change = may_change;
    if (may_be_missing) open.openings.push_back({of_a_missing_mode(map, system, open, plain.training()), log_prior_of_open()});
    out.push_back(std::move(open));
  }
  return out;
}

double log_density(const VectorXd& e, const MatrixXd& covariance) {
  const MatrixXd lower = linalg::cholesky_factor(covariance);
  if (lower.size() == 0) return -1e300;
  return -0.5 * linalg::lower_solve(lower, e).squaredNorm() - lower.diagonal().array().log().sum();
}

struct BetterOpening {
  double nats = 0.0;
  std::size_t mode = 0, opening = 0;
};

/// Gain of each mode by another opening at these scales, the best first, without those that gain nothing. The rows of a mode
/// are compared with their prediction from all other rows.
std::vector<BetterOpening> gains_of_opening(const LawSystem& system, const LawHypothesis& hypothesis, const LawEvidence& at,
                                            const std::vector<OpenMode>& modes) {
  const MatrixXd lower = linalg::cholesky_factor(covariance_at(system, at.tau));
  std::vector<BetterOpening> out;
  if (lower.size() == 0) return out;
  const MatrixXd precision = linalg::inverse_of_factored(lower);
  Index best = 0;
  at.weight.maxCoeff(&best);
  VectorXd left = hypothesis.left.col(best);
  if (hypothesis.slopes.cols() > 0) left -= hypothesis.slopes * at.shift;
  const VectorXd weighed = precision * left;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const OpenMode& open = modes[k];
    const auto n = std::ssize(open.rows);
    const MatrixXd covariance = precision(open.rows, open.rows).ldlt().solve(MatrixXd::Identity(n, n));
    const VectorXd e = covariance * weighed(open.rows);
    const double now = log_density(e, covariance) + open.now.log_prior;
    BetterOpening most;
    for (std::size_t o = 0; o < open.openings.size(); ++o) {
      if (o > 0 && open.may_change && !open.is_open && most.nats <= 0.0) break;
      const Opening& opening = open.openings[o];
      const double nats = log_density(e, covariance - open.now.covariance + opening.covariance) + opening.log_prior - now;
      if (nats > most.nats) most = {nats, k, o};
    }
    if (most.nats > 0.0) out.push_back(most);
  }
  std::ranges::sort(out, std::greater{}, &BetterOpening::nats);
  return out;
}

}  // namespace

FeatureMap with_open(FeatureMap map, const std::vector<int>& modes) {
  VectorXd variance = VectorXd::Zero(map.values().size());
  for (const int m : modes) variance += variance_of_open(map, map.measured_modes()[static_cast<std::size_t>(m)]);
  map.add_covariance(variance.asDiagonal());
  return map;
}

Fit fit_with_open(const Inference& inference, const std::vector<int>& modes, const std::vector<Cause>& causes,
                  const VectorXd& start) {
  const FeatureMap map = with_open(inference.map(), modes);
  return Inference(map, inference.candidates()).fit(causes, start);
}

OpenedEvidence scored_with_openings(const Inference& plain, FitSystem& system, const LawHypothesis& hypothesis,
                                    const VectorXd& start) {
  OpenedEvidence out{OneLaw(system).scored(hypothesis, start), {}};
  std::vector<OpenMode> modes = modes_that_may_open(plain, system);
  bool more = out.evidence.weight.size() > 0;
  while (more) {
    more = false;
    const std::vector<BetterOpening> gains = gains_of_opening(system, hypothesis, out.evidence, modes);
    // First all modes that gain singly; if that does not help, only the best: two modes that explain each other need not both
    // be open.
    for (std::size_t count = gains.size(); count > 0 && !more; count = count > 1 ? 1 : 0) {
      LawSystem changed = system;
      for (std::size_t k = 0; k < count; ++k) {
        const OpenMode& open = modes[gains[k].mode];
        const Opening& opening = open.openings[gains[k].opening];
        changed.sigma(open.rows, open.rows) += opening.covariance - open.now.covariance;
        changed.log_prior += opening.log_prior - open.now.log_prior;
      }
      LawEvidence evidence = OneLaw(changed).scored(hypothesis, out.evidence.tau);
      more = evidence.weight.size() > 0 && evidence.log_evidence > out.evidence.log_evidence;
      if (!more) continue;
      static_cast<LawSystem&>(system) = std::move(changed);
      out.evidence = std::move(evidence);
      for (std::size_t k = 0; k < count; ++k) {
        OpenMode& open = modes[gains[k].mode];
        if (!open.is_open) out.opened.insert(out.opened.end(), open.modes.begin(), open.modes.end());
        open.is_open = true;
        open.now = open.openings[gains[k].opening];
      }
    }
  }
  return out;
}

}  // namespace twindeck::diagnosis
