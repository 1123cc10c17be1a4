#include "sensors/search.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <string>

#include "core/error.hpp"

namespace twindeck::sensors {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

bool chosen(const std::vector<Index>& rows, Index candidate) { return std::find(rows.begin(), rows.end(), candidate) != rows.end(); }

double worth_of(const MatrixXd& phi, const std::vector<Index>& rows, const Worth& worth) { return worth(MatrixXd(phi(rows, Eigen::all))); }

/// An exchange must gain more than rounding, or two layouts of the same worth could change places for ever.
constexpr double kGain = 1e-12;

/// The best exchange of one sensor; false if none helps.
bool exchange_one(const MatrixXd& phi, const Worth& worth, Layout& layout) {
  double best = layout.worth;
  std::size_t out = 0;
  Index in = -1;
  for (std::size_t i = 0; i < layout.rows.size(); ++i) {
    std::vector<Index> rows = layout.rows;
    for (Index candidate = 0; candidate < phi.rows(); ++candidate) {
      if (chosen(layout.rows, candidate)) continue;
      rows[i] = candidate;
      const double found = worth_of(phi, rows, worth);
      if (found > best + kGain) {
        best = found;
        out = i;
        in = candidate;
      }
    }
  }
  if (in < 0) return false;
  layout.rows[out] = in;
  layout.worth = best;
  ++layout.exchanges;
  return true;
}

}  // namespace

Layout effective_independence(const Eigen::Ref<const MatrixXd>& phi, Index count) {
  if (count < phi.cols() || count > phi.rows()) {
    throw InputError({"", 0, "channels"},
                     "is " + std::to_string(count) + ", expected from " + std::to_string(phi.cols()) + " (one a mode) to " +
                         std::to_string(phi.rows()) + " (candidates)",
                     "ask for another number of sensors");
  }
  Layout layout;
  for (Index i = 0; i < phi.rows(); ++i) layout.rows.push_back(i);
  while (true) {
    const MatrixXd kept = phi(layout.rows, Eigen::all);
    const Eigen::LLT<MatrixXd> factor(kept.transpose() * kept);
    if (factor.info() != Eigen::Success) {
      throw InputError({"", 0, "candidates"}, "can't tell the modes apart: their shapes at the candidates depend on each other",
                       "add points or directions");
    }
    const MatrixXd half = factor.matrixL().solve(kept.transpose());
    layout.worth = 2.0 * MatrixXd(factor.matrixL()).diagonal().array().log().sum();
    if (std::ssize(layout.rows) == count) return layout;
    Index least = 0;
    half.colwise().squaredNorm().minCoeff(&least);
    layout.rows.erase(layout.rows.begin() + least);
  }
}

Layout greedy_exchange(const Eigen::Ref<const MatrixXd>& phi, Index count, const Worth& worth, const std::vector<Index>& start) {
  TWINDECK_ASSERT(count > 0 && count <= phi.rows() && std::ssize(start) <= count);
  const MatrixXd all = phi;
  Layout layout;
  layout.rows = start;
  while (std::ssize(layout.rows) < count) {
    double best = -std::numeric_limits<double>::infinity();
    Index next = -1;
    std::vector<Index> rows = layout.rows;
    rows.push_back(0);
    for (Index candidate = 0; candidate < all.rows(); ++candidate) {
      if (chosen(layout.rows, candidate)) continue;
      rows.back() = candidate;
      const double found = worth_of(all, rows, worth);
      if (next < 0 || found > best) {
        best = found;
        next = candidate;
      }
    }
    layout.rows.push_back(next);
  }
  layout.worth = worth_of(all, layout.rows, worth);
  while (exchange_one(all, worth, layout)) {
  }
  std::sort(layout.rows.begin(), layout.rows.end());
  return layout;
}

}  // namespace twindeck::sensors
