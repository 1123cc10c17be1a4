#include "identification/stabilisation.hpp"

#include <cmath>

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

}  // namespace

std::vector<DiagramPole> stabilisation_diagram(const std::vector<std::vector<Pole>>& poles,
                                               const StabilisationCriteria& criteria, const PoleLimits& limits) {
  std::vector<DiagramPole> diagram;
  std::vector<Pole> before;
  for (const std::vector<Pole>& of_order : poles) {
    std::vector<Pole> kept;
    for (const Pole& pole : of_order) {
      if (within(pole, limits)) kept.push_back(pole);
    }
    for (const Pole& pole : kept) {
      diagram.push_back({pole});
      judge(diagram.back(), before, criteria);
    }
    before = std::move(kept);
  }
  return diagram;
}

}  // namespace twindeck::identification
