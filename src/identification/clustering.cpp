#include "identification/clustering.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/lists.hpp"
#include "core/statistics.hpp"
#include "modal/mac.hpp"

namespace twindeck::identification {
namespace {

bool within(const Pole& pole, const PoleLimits& limits) {
  return pole.frequency_Hz >= limits.lowest_Hz && pole.frequency_Hz <= limits.highest_Hz && pole.damping_ratio > 0.0 &&
         pole.damping_ratio < limits.largest_damping;
}

// Shapes have unit norm.
double mac_of(const Pole& p, const Pole& q) { return std::norm(p.shape.dot(q.shape)); }

void judge(DiagramPole& candidate, const std::vector<Pole>& before, const StabilisationCriteria& criteria) {
  const Pole& pole = candidate.pole;
  const Pole* partner = nullptr;
  for (const Pole& other : before) {
    if (std::abs(pole.frequency_Hz - other.frequency_Hz) >= criteria.frequency * pole.frequency_Hz) continue;
    if (partner == nullptr || mac_of(pole, other) > mac_of(pole, *partner)) partner = &other;
  }
  if (partner == nullptr) return;
  candidate.stable_frequency = true;
  candidate.stable_damping = std::abs(pole.damping_ratio - partner->damping_ratio) < criteria.damping;
  candidate.stable_shape = mac_of(pole, *partner) >= criteria.mac;
}

std::vector<std::size_t> stable_poles(const std::vector<DiagramPole>& diagram) {
  std::vector<std::size_t> stable;
  for (std::size_t i = 0; i < diagram.size(); ++i)
    if (diagram[i].stable() && diagram[i].pole.shape.norm() > 0.0) stable.push_back(i);
  return stable;
}

/// Eq. (3) (n × n), with the frequencies' agreement.
Eigen::MatrixXd affinity(const std::vector<DiagramPole>& diagram, const std::vector<std::size_t>& stable,
                         const CleaningRule& rule) {
  const auto n = static_cast<Index>(stable.size());
  if (n == 0) return {};
  Eigen::MatrixXcd shapes(diagram[stable.front()].pole.shape.size(), n);
  Eigen::VectorXd frequency(n);
  for (Index i = 0; i < n; ++i) {
    shapes.col(i) = diagram[stable[static_cast<std::size_t>(i)]].pole.shape;
    frequency[i] = diagram[stable[static_cast<std::size_t>(i)]].pole.frequency_Hz;
  }
  Eigen::MatrixXd a = modal::mac(shapes, shapes);
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i) {
      const bool same =
          a(i, j) >= rule.mac && std::abs(frequency[i] - frequency[j]) < rule.frequency * std::max(frequency[i], frequency[j]);
      a(i, j) = same ? 1.0 : 0.0;
    }
  }
  return a;
}

double deviation(const std::vector<double>& values) {
  const Eigen::Map<const Eigen::ArrayXd> v(values.data(), static_cast<Index>(values.size()));
  return v.size() < 2 ? 0.0 : std::sqrt((v - v.mean()).square().sum() / static_cast<double>(v.size() - 1));
}

bool recurs(const std::vector<DiagramPole>& diagram, const std::vector<std::size_t>& members, const std::vector<int>& orders,
            const CleaningRule& rule) {
  const auto n = static_cast<double>(members.size());
  return n > rule.recursion && n >= rule.share * static_cast<double>(possible_orders(diagram, members, orders));
}

}  // namespace

std::vector<DiagramPole> stabilisation_diagram(const std::vector<std::vector<Pole>>& poles,
                                               const StabilisationCriteria& criteria, const PoleLimits& limits) {
  std::vector<DiagramPole> diagram;
  std::vector<Pole> before;
  for (const std::vector<Pole>& of_order : poles) {
    std::vector<Pole> kept;
    for (const Pole& pole : of_order)
      if (within(pole, limits)) kept.push_back(pole);
    for (const Pole& pole : kept) {
      diagram.push_back({pole});
      judge(diagram.back(), before, criteria);
    }
    before = std::move(kept);
  }
  return diagram;
}

using Eigen::Index;

Cluster summarise(const std::vector<DiagramPole>& diagram, std::vector<std::size_t> members) {
  Cluster cluster;
  std::ranges::sort(members);
  std::vector<double> frequency, damping;
  for (const std::size_t i : members) {
    frequency.push_back(diagram[i].pole.frequency_Hz);
    damping.push_back(diagram[i].pole.damping_ratio);
  }
  cluster.frequency_Hz = median(frequency);
  cluster.damping_ratio = median(damping);
  cluster.frequency_scatter_Hz = deviation(frequency);
  cluster.damping_ratio_scatter = deviation(damping);
  const auto distance = [&](std::size_t k) {
    return std::hypot(
        (frequency[k] - cluster.frequency_Hz) / std::max(cluster.frequency_scatter_Hz, 1e-12 * cluster.frequency_Hz),
        (damping[k] - cluster.damping_ratio) / std::max(cluster.damping_ratio_scatter, 1e-12));
  };
  // Two members are at equal distance from their median. The first one is the representative, independent of rounding.
  constexpr double kNearer = 1.0 - 1e-9;
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < members.size(); ++k)
    if (distance(k) < kNearer * distance(nearest)) nearest = k;
  cluster.representative = members[nearest];
  const Eigen::VectorXcd& reference = diagram[cluster.representative].pole.shape;
  // Median of each component, so that a single order with a split pole does not matter.
  std::vector<std::vector<double>> real(static_cast<std::size_t>(reference.size())), imag = real;
  for (const std::size_t i : members) {
    const Eigen::VectorXcd& shape = diagram[i].pole.shape;
    const std::complex<double> turn = std::polar(1.0, std::arg(shape.dot(reference)));
    for (std::size_t c = 0; c < real.size(); ++c) {
      const std::complex<double> value = shape[static_cast<Index>(c)] * turn;
      real[c].push_back(value.real());
      imag[c].push_back(value.imag());
    }
  }
  cluster.shape.resize(reference.size());
  for (std::size_t c = 0; c < real.size(); ++c) cluster.shape[static_cast<Index>(c)] = {median(real[c]), median(imag[c])};
  cluster.shape = normalised_shape(cluster.shape);
  cluster.members = std::move(members);
  return cluster;
}

std::vector<std::size_t> one_an_order(const std::vector<DiagramPole>& diagram, const std::vector<std::size_t>& members,
                                      std::size_t seed) {
  const Eigen::VectorXcd& reference = diagram[seed].pole.shape;
  std::map<int, std::size_t> best;
  for (const std::size_t i : members) {
    const auto [at, is_new] = best.try_emplace(diagram[i].pole.order, i);
    if (!is_new && std::norm(reference.dot(diagram[i].pole.shape)) > std::norm(reference.dot(diagram[at->second].pole.shape)))
      at->second = i;
  }
  return each_of(best, [](const auto& entry) { return entry.second; });
}

std::size_t possible_orders(const std::vector<DiagramPole>& diagram, const std::vector<std::size_t>& members,
                            const std::vector<int>& orders) {
  int first = orders.back();
  for (const std::size_t i : members) first = std::min(first, diagram[i].pole.order);
  return static_cast<std::size_t>(std::ranges::count_if(orders, [&](int order) { return order >= first; }));
}

void number_clusters(std::vector<DiagramPole>& diagram, std::vector<Cluster>& clusters) {
  std::ranges::sort(clusters, {}, &Cluster::frequency_Hz);
  for (std::size_t m = 0; m < clusters.size(); ++m)
    for (const std::size_t i : clusters[m].members) diagram[i].mode = static_cast<int>(m);
}

std::vector<Cluster> identify_clusters(std::vector<DiagramPole>& diagram, const std::vector<int>& orders,
                                       const CleaningRule& rule) {
  const std::vector<std::size_t> stable = stable_poles(diagram);
  Eigen::MatrixXd a = affinity(diagram, stable, rule);
  std::vector<Cluster> clusters;
  Eigen::VectorXd index = stable.empty() ? Eigen::VectorXd() : Eigen::VectorXd(a.rowwise().sum());
  Index seed = 0;
  while (index.size() > 0 && index.maxCoeff(&seed) > rule.recursion) {
    std::vector<std::size_t> members;
    const Eigen::VectorXd row = a.row(seed);
    for (Index j = 0; j < row.size(); ++j) {
      if (row[j] == 0.0) continue;
      members.push_back(stable[static_cast<std::size_t>(j)]);
      index -= a.col(j);
      a.row(j).setZero();
      a.col(j).setZero();
      index[j] = 0.0;
    }
    members = one_an_order(diagram, members, stable[static_cast<std::size_t>(seed)]);
    if (recurs(diagram, members, orders, rule)) clusters.push_back(summarise(diagram, std::move(members)));
  }
  number_clusters(diagram, clusters);
  return clusters;
}

}  // namespace twindeck::identification
