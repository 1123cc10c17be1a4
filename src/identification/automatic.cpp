#include "identification/automatic.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace twindeck::identification {

using Eigen::Index;

double phase_collinearity(const Eigen::VectorXcd& shape) {
  Eigen::Matrix2d s;
  s << shape.real().squaredNorm(), shape.real().dot(shape.imag()), shape.real().dot(shape.imag()), shape.imag().squaredNorm();
  if (!(s.trace() > 0.0)) return 0.0;
  const Eigen::Vector2d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(s, Eigen::EigenvaluesOnly).eigenvalues();
  return std::pow((values[1] - values[0]) / values.sum(), 2);
}

Eigen::VectorXcd one_quantity(Eigen::VectorXcd shape, const std::vector<int>& derivatives) {
  const std::complex<double> quarter[] = {{1.0, 0.0}, {0.0, -1.0}, {-1.0, 0.0}, {0.0, 1.0}};
  for (std::size_t c = 0; c < derivatives.size(); ++c) shape[static_cast<Index>(c)] *= quarter[derivatives[c] % 4];
  return shape;
}

namespace {

using Members = std::vector<std::size_t>;

double distance(const Pole& p, const Pole& q) {
  return std::abs(p.frequency_Hz - q.frequency_Hz) / std::max(p.frequency_Hz, q.frequency_Hz) + 1.0 -
         std::norm(p.shape.dot(q.shape));
}

/// Distance to the nearest pole of the next smaller order; infinite at the first order.
std::vector<double> distances_to_smaller_order(const std::vector<DiagramPole>& diagram, const std::vector<int>& orders) {
  std::map<int, Members> of_order;
  for (std::size_t i = 0; i < diagram.size(); ++i) of_order[diagram[i].pole.order].push_back(i);
  std::vector<double> nearest(diagram.size(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 1; k < orders.size(); ++k)
    for (const std::size_t i : of_order[orders[k]])
      for (const std::size_t j : of_order[orders[k - 1]])
        nearest[i] = std::min(nearest[i], distance(diagram[i].pole, diagram[j].pole));
  return nearest;
}

/// Boundary of the two populations of ln d by 2-means, started at its quartiles.
double split(const std::vector<double>& logs) {
  std::vector<double> sorted = logs;
  std::ranges::sort(sorted);
  double low = sorted[sorted.size() / 4], high = sorted[3 * sorted.size() / 4];
  for (int iteration = 0; iteration < 100; ++iteration) {
    double sums[2] = {0.0, 0.0}, counts[2] = {0.0, 0.0};
    for (const double x : sorted) {
      const int side = std::abs(x - low) <= std::abs(x - high) ? 0 : 1;
      sums[side] += x;
      counts[side] += 1.0;
    }
    const double new_low = counts[0] > 0.0 ? sums[0] / counts[0] : low, new_high = counts[1] > 0.0 ? sums[1] / counts[1] : high;
    if (new_low == low && new_high == high) break;
    low = new_low;
    high = new_high;
  }
  return 0.5 * (low + high);
}

/// Sets of poles connected by distances below the cut; average linkage never joins across them.
std::vector<Members> connected(const std::vector<DiagramPole>& diagram, Members candidates, double cut) {
  std::ranges::sort(candidates,
                    [&](std::size_t a, std::size_t b) { return diagram[a].pole.frequency_Hz < diagram[b].pole.frequency_Hz; });
  Members root(candidates.size());
  std::iota(root.begin(), root.end(), 0U);
  const auto find = [&](std::size_t a) {
    while (root[a] != a) a = root[a] = root[root[a]];
    return a;
  };
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Pole& p = diagram[candidates[i]].pole;
    for (std::size_t j = i + 1; j < candidates.size(); ++j) {
      const Pole& q = diagram[candidates[j]].pole;
      if (q.frequency_Hz - p.frequency_Hz > cut * q.frequency_Hz) break;
      if (distance(p, q) < cut) root[std::max(find(i), find(j))] = std::min(find(i), find(j));
    }
  }
  std::map<std::size_t, Members> sets;
  for (std::size_t i = 0; i < candidates.size(); ++i) sets[find(i)].push_back(candidates[i]);
  std::vector<Members> result;
  for (auto& [at, members] : sets) result.push_back(std::move(members));
  return result;
}

/// Average linkage within one connected set.
std::vector<Members> agglomerate(const std::vector<DiagramPole>& diagram, const Members& set, double cut) {
  const auto n = static_cast<Index>(set.size());
  Eigen::MatrixXd d = Eigen::MatrixXd::Constant(n, n, std::numeric_limits<double>::infinity());
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < i; ++j) {
      const Pole &p = diagram[set[static_cast<std::size_t>(i)]].pole, &q = diagram[set[static_cast<std::size_t>(j)]].pole;
      if (p.order != q.order) d(i, j) = distance(p, q);
    }
  }
  std::vector<Members> clusters;
  for (const std::size_t i : set) clusters.push_back({i});
  const auto at = [&](Index i, Index j) -> double& { return i > j ? d(i, j) : d(j, i); };
  for (Index i = 0, j = 0; n > 1 && d.minCoeff(&i, &j) < cut;) {
    Members &kept = clusters[static_cast<std::size_t>(j)], &joined = clusters[static_cast<std::size_t>(i)];
    const auto a = static_cast<double>(kept.size()), b = static_cast<double>(joined.size());
    for (Index k = 0; k < n; ++k) {
      if (k == i || k == j || clusters[static_cast<std::size_t>(k)].empty()) continue;
      at(j, k) = (a * at(j, k) + b * at(i, k)) / (a + b);
    }
    kept.insert(kept.end(), joined.begin(), joined.end());
    joined.clear();
    d.row(i).setConstant(std::numeric_limits<double>::infinity());
    d.col(i).setConstant(std::numeric_limits<double>::infinity());
  }
  std::erase_if(clusters, [](const Members& c) { return c.empty(); });
  return clusters;
}

/// The member with the smallest mean distance to the others.
std::size_t centre(const std::vector<DiagramPole>& diagram, const Members& members) {
  const auto spread = [&](std::size_t i) {
    double sum = 0.0;
    for (const std::size_t j : members) sum += distance(diagram[i].pole, diagram[j].pole);
    return sum;
  };
  return *std::ranges::min_element(members, [&](std::size_t a, std::size_t b) { return spread(a) < spread(b); });
}

/// The group, with the poles of its missing orders that lie within `reach` of its centre.
Members with_neighbours(const std::vector<DiagramPole>& diagram, const Members& group, const std::vector<bool>& claimed,
                        std::size_t middle, double reach) {
  std::set<int> present;
  for (const std::size_t i : group) present.insert(diagram[i].pole.order);
  Members members = group;
  for (std::size_t i = 0; i < diagram.size(); ++i)
    if (!claimed[i] && !present.contains(diagram[i].pole.order) && distance(diagram[i].pole, diagram[middle].pole) < reach)
      members.push_back(i);
  return members;
}

int first_order(const std::vector<DiagramPole>& diagram, const Cluster& cluster) {
  return diagram[cluster.members.front()].pole.order;
}

/// Whether the nearest pole of the next order to the cluster's last pole is the first pole of the other cluster.
bool goes_on(const std::vector<DiagramPole>& diagram, const std::vector<int>& orders, const Cluster& cluster,
             const Cluster& other, double cut) {
  const DiagramPole& last = diagram[cluster.members.back()];
  const auto next = std::upper_bound(orders.begin(), orders.end(), last.pole.order);
  if (next == orders.end() || first_order(diagram, other) != *next) return false;
  const auto to_last = [&](std::size_t i) { return distance(diagram[i].pole, last.pole); };
  const std::size_t first = other.members.front();
  for (std::size_t i = 0; i < diagram.size(); ++i)
    if (diagram[i].pole.order == *next && to_last(i) < to_last(first)) return false;
  return to_last(first) < cut;
}

/// Drops each cluster that continues as another one. Both are one mode. At its smaller orders the mode is mixed with a
/// neighbour that has no pole yet, so the cluster at the higher orders is kept.
std::vector<Cluster> whole_chains(const std::vector<DiagramPole>& diagram, const std::vector<int>& orders,
                                  const std::vector<Cluster>& clusters, double cut) {
  std::vector<Cluster> whole;
  for (const Cluster& cluster : clusters) {
    const bool unfinished = std::ranges::any_of(
        clusters, [&](const Cluster& other) { return &other != &cluster && goes_on(diagram, orders, cluster, other, cut); });
    if (!unfinished) whole.push_back(cluster);
  }
  return whole;
}

/// [-] Largest share of a mixture's orders at which both neighbours have poles of their own.
constexpr double kMixtureBeside = 0.49;

/// Part of a unit-norm shape, squared, outside the span of two others.
double outside_span(const Eigen::VectorXcd& shape, const Eigen::VectorXcd& first, const Eigen::VectorXcd& second) {
  const Eigen::VectorXcd a = first.normalized();
  Eigen::VectorXcd b = second - a * a.dot(second);
  constexpr double kParallel = 1e-6;  // smaller second shapes are parallel to the first
  b = b.norm() > kParallel ? Eigen::VectorXcd(b.normalized()) : Eigen::VectorXcd::Zero(b.size());
  return std::max(0.0, 1.0 - (std::norm(a.dot(shape)) + std::norm(b.dot(shape))) / shape.squaredNorm());
}

/// Largest residual outside the span that still counts as inside. A random real shape of n channels has a residual below r with
/// probability r^((n - 2)/2).
double largest_residual(Index channels, const AutomaticRule& rule) {
  if (channels <= 2) return 0.0;
  return std::min(rule.mixture_residual, std::pow(rule.mixture_chance, 2.0 / static_cast<double>(channels - 2)));
}

/// Whether one of the two neighbours has no pole at the cluster's orders, except for the stated share of them, and both
/// continue above its last order.
bool gives_way(const std::vector<DiagramPole>& diagram, const Cluster& cluster, const Cluster& low, const Cluster& high,
               double share_beside) {
  const auto last = [&](const Cluster& c) { return diagram[c.members.back()].pole.order; };
  if (last(low) <= last(cluster) || last(high) <= last(cluster)) return false;
  const auto is_at = [&](const Cluster& c, int order) {
    return std::ranges::any_of(c.members, [&](std::size_t i) { return diagram[i].pole.order == order; });
  };
  const auto both = std::ranges::count_if(cluster.members, [&](std::size_t i) {
    const int order = diagram[i].pole.order;
    return is_at(low, order) && is_at(high, order);
  });
  return static_cast<double>(both) <= share_beside * static_cast<double>(cluster.members.size());
}

/// Whether both clusters have poles at the same orders, in the stated share of all orders.
bool is_beside(const std::vector<DiagramPole>& diagram, const std::vector<int>& orders, const Cluster& cluster,
               const Cluster& other, const AutomaticRule& rule) {
  std::set<int> present;
  for (const std::size_t i : other.members) present.insert(diagram[i].pole.order);
  const auto both =
      std::ranges::count_if(cluster.members, [&](std::size_t i) { return present.contains(diagram[i].pole.order); });
  return static_cast<double>(both) >= rule.share_beside * static_cast<double>(orders.size());
}

/// Drops a cluster that repeats a larger one: nearer than half the bandwidth, with the same shape. Two such clusters with poles
/// at most orders are two modes.
/// @param clusters  the largest first
std::vector<Cluster> distinct_clusters(const std::vector<DiagramPole>& diagram, const std::vector<int>& orders,
                                       std::vector<Cluster> clusters, const AutomaticRule& rule) {
  std::vector<Cluster> distinct;
  for (Cluster& cluster : clusters) {
    const bool again = std::ranges::any_of(distinct, [&](const Cluster& larger) {
      const double half_bandwidth = larger.damping_ratio * larger.frequency_Hz;
      return std::abs(cluster.frequency_Hz - larger.frequency_Hz) < half_bandwidth &&
             std::norm(cluster.shape.dot(larger.shape)) > 0.8 && !is_beside(diagram, orders, cluster, larger, rule);
    });
    if (!again) distinct.push_back(std::move(cluster));
  }
  return distinct;
}

}  // namespace

std::vector<bool> mixtures(const std::vector<DiagramPole>& diagram, const std::vector<Cluster>& clusters,
                           const AutomaticRule& rule, double share_beside) {
  std::vector<bool> is_mixture;
  for (const Cluster& cluster : clusters) {
    const double f = cluster.frequency_Hz, residual = largest_residual(cluster.shape.size(), rule);
    std::vector<const Cluster*> below, above;
    for (const Cluster& other : clusters) {
      if (other.members.size() <= cluster.members.size() || std::abs(other.frequency_Hz - f) > rule.mixture_reach * f) continue;
      (other.frequency_Hz < f ? below : above).push_back(&other);
    }
    is_mixture.push_back(std::ranges::any_of(below, [&](const Cluster* low) {
      return std::ranges::any_of(above, [&](const Cluster* high) {
        return gives_way(diagram, cluster, *low, *high, share_beside) &&
               outside_span(cluster.shape, low->shape, high->shape) < residual;
      });
    }));
  }
  return is_mixture;
}

std::vector<Cluster> automatic_clusters(std::vector<DiagramPole>& diagram, const std::vector<int>& orders,
                                        const AutomaticRule& rule) {
  const std::vector<double> nearest = distances_to_smaller_order(diagram, orders);
  Members candidates;
  std::vector<double> logs;
  for (std::size_t i = 0; i < diagram.size(); ++i) {
    if (!std::isfinite(nearest[i]) ||
        phase_collinearity(one_quantity(diagram[i].pole.shape, rule.derivatives)) < rule.collinearity)
      continue;
    candidates.push_back(i);
    logs.push_back(std::log(std::max(nearest[i], 1e-12)));
  }
  if (candidates.empty()) return {};
  const double boundary = std::max(split(logs), std::log(rule.smallest_cut));
  std::vector<double> physical_distances;
  std::erase_if(candidates, [&](std::size_t i) {
    const double d = std::max(nearest[i], 1e-12);
    if (std::log(d) > boundary) return true;
    physical_distances.push_back(d);
    return false;
  });
  if (candidates.empty()) return {};
  std::ranges::sort(physical_distances);
  const double quantile = physical_distances[(physical_distances.size() - 1) * 95 / 100];
  const double cut = std::clamp(quantile, rule.smallest_cut, rule.largest_cut);

  std::vector<Members> groups;
  for (const Members& set : connected(diagram, candidates, cut))
    for (Members& group : agglomerate(diagram, set, cut)) groups.push_back(std::move(group));
  // The largest group first: if a mode has fallen apart, its larger part collects the poles, and the rest is too small to
  // count.
  std::ranges::stable_sort(groups, [](const Members& a, const Members& b) { return a.size() > b.size(); });
  std::vector<Cluster> clusters;
  std::vector<bool> claimed(diagram.size(), false);
  for (Members& group : groups) {
    std::erase_if(group, [&](std::size_t i) { return claimed[i]; });
    if (group.empty()) continue;
    const std::size_t middle = centre(diagram, group);
    const Members members = one_an_order(diagram, with_neighbours(diagram, group, claimed, middle, 2.0 * cut), middle);
    const double found = static_cast<double>(members.size());
    const double needed = std::max({rule.share * static_cast<double>(possible_orders(diagram, members, orders)),
                                    rule.share_of_all * static_cast<double>(orders.size()), 4.0});
    if (found < needed) continue;
    for (const std::size_t i : members) claimed[i] = true;
    clusters.push_back(summarise(diagram, members));
  }
  clusters = distinct_clusters(diagram, orders, std::move(clusters), rule);
  clusters = whole_chains(diagram, orders, clusters, cut);
  const std::vector<bool> is_mixture = mixtures(diagram, clusters, rule, kMixtureBeside);
  std::vector<Cluster> modes;
  for (std::size_t m = 0; m < clusters.size(); ++m)
    if (!is_mixture[m]) modes.push_back(std::move(clusters[m]));
  number_clusters(diagram, modes);
  return modes;
}

}  // namespace twindeck::identification
