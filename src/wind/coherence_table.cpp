#include "wind/coherence_table.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"

namespace twindeck::wind {

CoherenceTable::CoherenceTable(Eigen::VectorXd x, Eigen::VectorXd gamma) : x_(std::move(x)), gamma_(std::move(gamma)) {
  TWINDECK_ASSERT(x_.size() >= 2 && x_.size() == gamma_.size() && x_[0] == 0.0 && gamma_[0] == 1.0);
}

double CoherenceTable::at(double x) const {
  if (x > x_[x_.size() - 1]) return 0.0;
  const Eigen::Index i = std::min<Eigen::Index>(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin(), x_.size() - 1);
  const double share = (x - x_[i - 1]) / (x_[i] - x_[i - 1]);
  return (1.0 - share) * gamma_[i - 1] + share * gamma_[i];
}

}  // namespace twindeck::wind
