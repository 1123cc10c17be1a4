#include "diagnosis/visibility.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace twindeck::diagnosis {

namespace {

using Eigen::VectorXd;

constexpr double kNatsForAName = 5.0;   ///< a name needs 1/2 s² + ln(prior) - 2 > 3, with 2 nats for its unknowns
constexpr double kVisibleSigma = 1.0;   ///< standard deviations; a shorter signature is below the noise
constexpr double kNoSignature = 1e-6;   ///< standard deviations; an entry below it has no effect here
constexpr int kMagnitudeHalvings = 12;  ///< of a magnitude's range, to 1 part in 4096

/// The strongest signature among an entry's trial magnitudes.
struct Seen {
  const Candidate* candidate;
  VectorXd a, signature;
};

std::vector<Seen> strongest_signatures(const Inference& inference, const Fit& base) {
  std::vector<Seen> seen;
  for (const auto& candidate : inference.candidates()) {
    Seen best{candidate.get(), {}, {}};
    for (const VectorXd& a : candidate->starts) {
      const VectorXd s = inference.signature(base, *candidate, a);
      if (s.size() > 0 && (best.signature.size() == 0 || s.norm() > best.signature.norm())) {
        best.a = a;
        best.signature = s;
      }
    }
    if (best.signature.size() > 0) seen.push_back(best);
  }
  return seen;
}

/// Smallest magnitude of the first unknown whose signature has the length `needed`, by bisection between no effect (a factor of
/// 1, else the lower bound) and the trial magnitude.
double smallest_magnitude(const Inference& inference, const Fit& base, const Seen& one, double needed) {
  const Candidate& candidate = *one.candidate;
  const bool factor = candidate.hypothesis->unknowns[0].name == "factor";
  const double neutral =
      factor && candidate.low[0] < 0.0 && candidate.high[0] > 0.0 ? 0.0 : (candidate.log[0] ? candidate.low[0] : 0.0);
  double near = factor && candidate.log[0] ? 0.0 : neutral, far = one.a[0];
  for (int i = 0; i < kMagnitudeHalvings; ++i) {
    VectorXd a = one.a;
    a[0] = 0.5 * (near + far);
    const VectorXd s = inference.signature(base, candidate, a);
    (s.size() > 0 && s.norm() > needed ? far : near) = a[0];
  }
  VectorXd a = one.a;
  a[0] = far;
  return candidate.physical(a, 0);
}

/// The nearest entry of another family, and the part of the signature that it cannot imitate, in standard deviations.
std::pair<std::string, double> best_imitation(const Seen& one, const std::vector<Seen>& seen) {
  const double sigma = one.signature.norm();
  double separation = sigma;
  std::string imitation;
  for (const Seen& other : seen) {
    if (other.candidate->hypothesis == one.candidate->hypothesis || other.signature.norm() < kNoSignature) continue;
    const double along = one.signature.dot(other.signature) / other.signature.norm();
    const double rest = std::sqrt(std::max(sigma * sigma - along * along, 0.0));
    if (rest < separation) {
      separation = rest;
      imitation = other.candidate->id();
    }
  }
  return {imitation, separation};
}

}  // namespace

std::vector<Visibility> visibility(const Inference& inference) {
  const Fit base = inference.fit({}, {});
  const std::vector<Seen> seen = strongest_signatures(inference, base);
  std::vector<Visibility> out;
  for (const Seen& one : seen) {
    const bool has_size = !one.candidate->hypothesis->unknowns.empty();
    const double needed = std::sqrt(2.0 * (kNatsForAName - one.candidate->log_prior));
    Visibility of{one.candidate, {}, one.signature.norm(), "", 0.0, "visible"};
    if (of.sigma < kVisibleSigma)
      of.status = "these data cannot see it";
    else if (has_size && of.sigma < needed)
      of.status = "too small at the tried magnitude";
    else if (has_size)
      of.smallest = smallest_magnitude(inference, base, one, needed);
    std::tie(of.imitation, of.separation) = best_imitation(one, seen);
    out.push_back(std::move(of));
  }
  return out;
}

}  // namespace twindeck::diagnosis
