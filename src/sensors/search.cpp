#include "sensors/search.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <limits>
#include <string>

#include "core/error.hpp"

namespace twindeck::sensors {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

bool chosen(const std::vector<Index>& rows, Index candidate) {
  return std::find(rows.begin(), rows.end(), candidate) != rows.end();
}

double worth_of(const MatrixXd& phi, const std::vector<Index>& rows, const Worth& worth) {
  return worth(MatrixXd(phi(rows, Eigen::all)));
}

/// A choice must gain more than rounding: mirror images on a symmetric structure are worth the same, and two layouts of the
/// same worth could change places for ever. Of equals the first stays.
constexpr double kGain = 1e-12;
/// The same for leverages, which are between 0 and 1.
constexpr double kSameLeverage = 1e-9;

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
    // Leverages are the squared rows of Q; the normal equations would square the condition.
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(kept);
    if (qr.rank() < kept.cols()) {
      throw InputError({"", 0, "candidates"}, "can't tell the modes apart: their shapes at the candidates depend on each other",
                       "add points or directions");
    }
    layout.worth = 2.0 * qr.matrixR().diagonal().head(kept.cols()).cwiseAbs().array().log().sum();
    if (std::ssize(layout.rows) == count) return layout;
    const MatrixXd q = qr.householderQ() * MatrixXd::Identity(kept.rows(), kept.cols());
    const VectorXd leverage = q.rowwise().squaredNorm();
    const double smallest = leverage.minCoeff();
    Index least = 0;
    while (leverage[least] > smallest + kSameLeverage) ++least;
    layout.rows.erase(layout.rows.begin() + least);
  }
}

Layout greedy_exchange(const Eigen::Ref<const MatrixXd>& phi, Index count, const Worth& worth,
                       const std::vector<Index>& start) {
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
      if (next < 0 || found > best + kGain) {
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
