#include "reliability/form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <optional>
#include <string>

#include "core/distributions.hpp"
#include "core/random.hpp"

namespace twindeck::reliability {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Design points whose directions agree better than this are one.
constexpr double kSamePointCosine = 0.99;
/// Share of the sufficient decrease that a step has to give (Armijo), and the halvings that are tried.
constexpr double kArmijo = 1e-4;
constexpr int kHalvings = 30;
/// Weight of |g| in the merit, in units of the least that makes the step a descent (Zhang and Der Kiureghian 1995, Eq. 23).
constexpr double kPenalty = 2.0;
/// Radius of the test's sphere over beta, in units of the distance at which a further point has the asked importance (tau of
/// the reference).
constexpr double kTestAccuracy = 2.0;

/// A kink: a move shorter than kShortMove [-] changes the slope by more than the share kJump of |g(0)|, kJumps times in one
/// search.
constexpr double kShortMove = 0.05, kJump = 0.25;
constexpr int kJumps = 3;

class Search {
 public:
  Search(const LimitState& g, Index n, const FormOptions& options) : g_(g), n_(n), options_(options) {
    origin_ = value(VectorXd::Zero(n));
    scale_ = std::max(std::abs(origin_), 1e-12);
  }

  double value(const VectorXd& u) {
    ++calls;
    const double g = g_(u);
    return std::isfinite(g) ? g : -scale_;
  }

  std::optional<DesignPoint> from(VectorXd u) {
    double g = value(u), moved = 0.0;
    VectorXd before_slope;
    int jumps = 0;
    for (int k = 0; k < options_.iterations; ++k) {
      const VectorXd slope = gradient(u);
      const double steepness = slope.norm();
      if (!(steepness > 1e-12 * scale_)) return std::nullopt;
      const VectorXd down = -slope / steepness;  // towards the limit
      jumps += k > 0 && moved < kShortMove && (slope - before_slope).norm() > kJump * scale_ ? 1 : 0;
      before_slope = slope;
      const VectorXd target = down * (down.dot(u) + g / steepness);
      const double aside = (u - down * down.dot(u)).norm();
      if (aside < std::max(options_.tolerance, 1e-6) * std::max(1.0, u.norm()) && std::abs(g) < options_.tolerance * scale_)
        return point(u, down);
      const bool far = std::abs(g) > options_.tolerance * scale_;
      const double penalty =
          kPenalty * std::max(u.norm() / steepness, far ? 0.5 * target.squaredNorm() / std::abs(g) : 1e-12 / steepness);
      const auto merit = [&](const VectorXd& at, double g_at) { return 0.5 * at.squaredNorm() + penalty * std::abs(g_at); };
      const VectorXd move = target - u;
      const double before = merit(u, g);
      const double decrease = u.dot(move) + penalty * (g > 0.0 ? 1.0 : -1.0) * slope.dot(move);
      double step = 1.0;
      VectorXd next = target;
      double g_next = value(next);
      for (int i = 0; i < kHalvings && merit(next, g_next) > before + kArmijo * step * std::min(decrease, 0.0); ++i) {
        step *= 0.5;
        next = u + step * move;
        g_next = value(next);
      }
      if ((next - u).norm() < 1e-14 * std::max(1.0, u.norm())) break;
      moved = (next - u).norm();
      u = next;
      g = g_next;
    }
    kinks += jumps >= kJumps ? 1 : 0;
    return std::nullopt;
  }

  int calls = 0;
  int kinks = 0;  ///< searches that ended at a kink of g, without a design point

 private:
  VectorXd gradient(const VectorXd& u) {
    VectorXd slope(n_);
    VectorXd at = u;
    for (Index i = 0; i < n_; ++i) {
      at[i] = u[i] + options_.step;
      const double above = value(at);
      at[i] = u[i] - options_.step;
      slope[i] = (above - value(at)) / (2.0 * options_.step);
      at[i] = u[i];
    }
    return slope;
  }

  DesignPoint point(const VectorXd& u, const VectorXd& down) const {
    return DesignPoint{.u = u, .beta = (origin_ > 0.0 ? 1.0 : -1.0) * u.norm(), .alpha = down};
  }

  const LimitState& g_;
  Index n_;
  const FormOptions& options_;
  double origin_ = 0.0, scale_ = 1.0;
};

VectorXd direction(Index n, std::uint64_t seed, std::uint64_t stream) {
  VectorXd u(n);
  for (Index i = 0; i < n; ++i) u[i] = normal_number(seed, stream, static_cast<std::uint64_t>(i));
  return u / u.norm();
}

void add(std::vector<DesignPoint>& points, const DesignPoint& found) {
  for (DesignPoint& known : points) {
    if (known.u.dot(found.u) > kSamePointCosine * known.u.norm() * found.u.norm()) {
      if (found.u.norm() < known.u.norm()) known = found;
      return;
    }
  }
  points.push_back(found);
}

bool away_from(const std::vector<DesignPoint>& points, const VectorXd& on_sphere) {
  return std::ranges::none_of(points, [&](const DesignPoint& p) {
    return p.u.dot(on_sphere) > p.u.squaredNorm();  // beyond its tangent plane
  });
}

/// Strong-maximum test: a point of the sphere starts a search if it exceeds the limit and lies beyond no known design point's
/// tangent plane.
void look_for_further_points(Search& search, Index n, const FormOptions& options, FormResult& result) {
  const double beta = result.points.front().u.norm();
  const double further = std::sqrt(1.0 - 2.0 * std::log(options.importance_level) / (beta * beta)) - 1.0;
  const double radius = beta * (1.0 + kTestAccuracy * further);
  // Share of the sphere beyond the tangent plane of a point at beta (1 + further): a cap of half angle acos(cosine).
  const double cosine = (1.0 + further) / (1.0 + kTestAccuracy * further);
  const double cap = n == 1 ? 0.5 : 0.5 * boost::math::ibeta(0.5 * (static_cast<double>(n) - 1.0), 0.5, 1.0 - cosine * cosine);
  const double wanted = std::log(1.0 - options.test_level) / std::log1p(-std::min(cap, 0.999));
  const int points = static_cast<int>(std::clamp(std::ceil(wanted), 1.0, static_cast<double>(options.largest_test)));
  result.level_reached = 1.0 - std::pow(1.0 - cap, points);
  const auto important =
      std::ranges::count_if(result.points, [&](const DesignPoint& p) { return p.u.norm() < beta * (1.0 + further); });
  result.strong_maximum = important == 1;
  int searches = 0;
  for (int k = 0; k < points; ++k) {
    const VectorXd at = radius * direction(n, options.seed + 1, static_cast<std::uint64_t>(k));
    if (!away_from(result.points, at) || (search.value(at) <= 0.0) != (result.points.front().beta > 0.0)) continue;
    result.strong_maximum = false;
    if (++searches > options.starts) break;
    if (const auto found = search.from(at)) add(result.points, *found);
  }
}

std::string not_converged(const Search& search, int starts) {
  if (search.kinks == 0) return fmt::format("FORM found no point of the limit from {} starts", starts);
  return fmt::format(
      "FORM does not converge: {} of {} searches end at a kink of the limit state, where its slope jumps; subset simulation "
      "needs no slope",
      search.kinks, starts);
}

}  // namespace

FormResult form(const LimitState& g, Index n, const FormOptions& options) {
  TWINDECK_ASSERT(n >= 1 && options.starts >= 0);
  FormResult result;
  Search search(g, n, options);
  for (int start = 0; start <= options.starts; ++start) {
    const VectorXd u = start == 0 ? VectorXd(VectorXd::Zero(n))
                                  : VectorXd(3.0 * direction(n, options.seed, static_cast<std::uint64_t>(start)));
    if (const auto found = search.from(u)) add(result.points, *found);
  }
  const auto nearer = [](const DesignPoint& a, const DesignPoint& b) { return a.u.norm() < b.u.norm(); };
  if (result.points.empty()) {
    result.status = {false, not_converged(search, options.starts + 1)};
  } else {
    std::ranges::sort(result.points, nearer);
    look_for_further_points(search, n, options, result);
    std::ranges::sort(result.points, nearer);
    result.probability = normal_tail(result.points.front().beta);
  }
  result.calls = search.calls;
  return result;
}

}  // namespace twindeck::reliability
