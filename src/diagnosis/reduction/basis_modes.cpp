#include "diagnosis/reduction/basis_modes.hpp"

#include <algorithm>

#include "diagnosis/reduction/reduction_options.hpp"
#include "dynamics/eigenmodes.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;

/// Times the highest measured frequency: causes and parameters may lower a mode by a third into the measured band, as a change
/// of stiffness by 0.44 does, and modes above the band carry a part of what static vectors leave of those in it.
constexpr double kReach = 1.5;

/// Of a basis, as the setting `modes`: the time of a search grows with the third power of its size.
constexpr int kMostModes = 200;

double highest_measured(const FeatureSet& features) {
  double highest = 0.0;
  for (const Row& row : features.rows)
    if (row.type == RowType::frequency) highest = std::max(highest, row.value);
  return highest;
}

int count_up_to(const Eigen::VectorXd& ascending_Hz, double highest_Hz) {
  return static_cast<int>((ascending_Hz.array() <= highest_Hz).count());
}

}  // namespace

BasisModes modes_of_basis(const Structure& structure, const FeatureSet& features, int least) {
  BasisModes out{least, 0, kReach * highest_measured(features), true, {}};
  const auto dofs = static_cast<int>(structure.system->size());
  if (!(out.reach_Hz > 0.0) || dofs <= ReductionOptions{}.full_below) return out;
  dynamics::ModalSolver solver(*structure.system);
  for (int asked = least;; asked = std::min(2 * asked, kMostModes)) {
    out.frequency_Hz = solver.solve_available(structure.theta, std::min(asked, dofs)).frequency_Hz;
    const int inside = count_up_to(out.frequency_Hz, out.reach_Hz);
    if (inside < out.frequency_Hz.size() || out.frequency_Hz.size() < std::min(asked, dofs)) {
      out.modes = std::max(least, inside + 1);  // with the first beyond
      if (out.modes > least) out.in_band = count_up_to(out.frequency_Hz, out.reach_Hz / kReach);
      return out;
    }
    if (asked >= std::min(kMostModes, dofs)) break;
  }
  out.enough = out.frequency_Hz.size() >= dofs;
  out.modes = static_cast<int>(out.frequency_Hz.size());
  return out;
}

}  // namespace twindeck::diagnosis
