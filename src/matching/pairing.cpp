#include "matching/pairing.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/error.hpp"
#include "modal/mac.hpp"

namespace twindeck::matching {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// [-] Weight of a pair's own MAC beside the subspace MAC. All members of a cluster have the same subspace MAC, so the own MAC
/// decides between them.
constexpr double nearer_shape = 1e-3;

/// [-] Weight of the nearness in frequency. It decides between equal MACs only: it is far above rounding and far below the
/// differences of measured MACs.
constexpr double nearer_frequency = 1e-9;

/// Runs of modes whose neighbours in frequency are closer than `gap`; runs of one are left out.
std::vector<std::vector<Index>> clusters(const Eigen::VectorXd& frequency, double gap) {
  const std::vector<Index> order = lowest_first(frequency);
  std::vector<std::vector<Index>> runs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && frequency[order[i]] - frequency[order[i - 1]] < gap * frequency[order[i]])
      runs.back().push_back(order[i]);
    else
      runs.push_back({order[i]});
  }
  std::erase_if(runs, [](const auto& run) { return run.size() < 2; });
  return runs;
}

/// |f_N - f_X|/f_X [-] (n_X × n_N).
MatrixXd relative_error(const Eigen::VectorXd& frequency_x, const Eigen::VectorXd& frequency_n) {
  return ((-frequency_x).replicate(1, frequency_n.size()).rowwise() + frequency_n.transpose()).cwiseAbs().array() /
         frequency_x.replicate(1, frequency_n.size()).array();
}

/// Share of `x` that lies in the span of the columns of `basis`. Makes x orthogonal to the columns by modified Gram-Schmidt,
/// the longest column first; the part of x that is left lies outside the span. Columns of rounding size are skipped.
double subspace_mac(Eigen::MatrixXcd basis, const Eigen::MatrixXcd& x) {
  const double rounding = std::numeric_limits<double>::epsilon() * static_cast<double>(basis.cols()) * basis.norm();
  Eigen::VectorXcd rest = x;
  for (Index done = 0; done < basis.cols(); ++done) {
    Index longest = 0;
    for (Index j = 1; j < basis.cols(); ++j)
      if (basis.col(j).norm() > basis.col(longest).norm()) longest = j;
    const double length = basis.col(longest).norm();
    if (length <= rounding) break;
    const Eigen::VectorXcd q = basis.col(longest) / length;
    basis.col(longest).setZero();
    for (Index j = 0; j < basis.cols(); ++j) basis.col(j) -= q.dot(basis.col(j)) * q;
    rest -= q.dot(rest) * q;
  }
  return std::max(0.0, 1.0 - rest.squaredNorm() / x.squaredNorm());
}

}  // namespace

bool has_a_shape(const Eigen::Ref<const Eigen::VectorXcd>& measured) {
  constexpr std::size_t fewest_components = 2;
  return modal::measured_rows(measured).size() >= fewest_components;
}

std::vector<Index> lowest_first(const Eigen::VectorXd& frequency) {
  std::vector<Index> order(static_cast<std::size_t>(frequency.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, [&](Index a, Index b) { return frequency[a] < frequency[b]; });
  return order;
}

std::vector<int> follow_modes(const Eigen::Ref<const MatrixXd>& mac_matrix) { return best_assignment(mac_matrix); }

Likeness likeness_of(const Eigen::VectorXd& frequency_x, const Eigen::MatrixXcd& phi_x, const Eigen::VectorXd& frequency_n,
                     const Eigen::MatrixXcd& phi_n, const PairingOptions& options) {
  const Index n_x = frequency_x.size(), n_n = frequency_n.size();
  const bool shapes = phi_x.rows() > 0;
  TWINDECK_ASSERT(!shapes || (phi_x.cols() == n_x && phi_n.cols() == n_n));
  Likeness out;
  out.value = MatrixXd::Constant(n_x, n_n, std::numeric_limits<double>::quiet_NaN());
  out.clustered.setConstant(n_x, n_n, false);
  const MatrixXd nearness = (options.maximum_frequency_error - relative_error(frequency_x, frequency_n).array()).max(0.0);
  out.gain = nearness;
  if (!shapes) return out;
  const MatrixXd mac = modal::mac_where_measured(phi_n, phi_x).transpose();
  for (Index i = 0; i < n_x; ++i) {
    if (!has_a_shape(phi_x.col(i))) continue;
    out.value.row(i) = mac.row(i);
    out.gain.row(i) = mac.row(i) + nearer_frequency * nearness.row(i);
  }
  for (const std::vector<Index>& run : clusters(frequency_n, options.cluster_gap)) {
    // With no more sensors than close modes, any shape lies in their span, so the subspace MAC has no meaning.
    for (Index i = 0; i < n_x; ++i) {
      const std::vector<Index> rows = modal::measured_rows(phi_x.col(i));
      if (run.size() >= rows.size()) continue;
      const double share = subspace_mac(phi_n(rows, run), phi_x(rows, Eigen::seqN(i, 1)));
      // A shape that resembles one member has not rotated within the span. It keeps its own MACs.
      if (share < options.cluster_mac || out.value(i, run).maxCoeff() >= options.cluster_mac) continue;
      for (const Index j : run) {
        out.gain(i, j) = share + nearer_shape * out.value(i, j) + nearer_frequency * nearness(i, j);
        out.value(i, j) = share;
        out.clustered(i, j) = true;
      }
    }
  }
  return out;
}

std::vector<ModePair> pair_by_likeness(const Eigen::VectorXd& frequency_x, const Eigen::VectorXd& frequency_n,
                                       const Likeness& like, const PairingOptions& options) {
  const Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> admissible =
      relative_error(frequency_x, frequency_n).array() <= options.maximum_frequency_error;
  const MatrixXd gain = (admissible && !(like.value.array() < options.minimum_mac))
                            .select(like.gain, 0.0);  // left-out pairs must not displace others

  std::vector<ModePair> pairs;
  const std::vector<int> column = best_assignment(gain);
  for (Index i = 0; i < frequency_x.size(); ++i) {
    const Index j = column[static_cast<std::size_t>(i)];
    if (j < 0 || !admissible(i, j) || like.value(i, j) < options.minimum_mac) continue;
    pairs.push_back({i, j, like.value(i, j), like.clustered(i, j)});
  }
  return pairs;
}

std::vector<int> best_assignment(const Eigen::Ref<const Eigen::MatrixXd>& gain) {
  const auto rows = static_cast<int>(gain.rows()), columns = static_cast<int>(gain.cols());
  std::vector<int> result(static_cast<std::size_t>(rows), -1);
  if (rows == 0 || columns == 0) return result;
  if (rows > columns) {
    const Eigen::MatrixXd turned = gain.transpose();
    const std::vector<int> row_of = best_assignment(turned);
    for (int j = 0; j < columns; ++j) result[static_cast<std::size_t>(row_of[static_cast<std::size_t>(j)])] = j;
    return result;
  }
  // Shortest augmenting paths with potentials u, v of rows and columns; column 0 stands for the row that is being
  // assigned.
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto width = static_cast<std::size_t>(columns) + 1;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(rows + 1), v = Eigen::VectorXd::Zero(columns + 1);
  std::vector<int> row_at(width, 0), previous(width, 0);
  for (int row = 1; row <= rows; ++row) {
    row_at[0] = row;
    int at = 0;
    Eigen::VectorXd slack = Eigen::VectorXd::Constant(columns + 1, kInfinity);
    std::vector<bool> visited(width, false);
    do {
      visited[static_cast<std::size_t>(at)] = true;
      const int i = row_at[static_cast<std::size_t>(at)];
      double delta = kInfinity;
      int next = 0;
      for (int j = 1; j <= columns; ++j) {
        if (visited[static_cast<std::size_t>(j)]) continue;
        const double reduced = -gain(i - 1, j - 1) - u[i] - v[j];
        if (reduced < slack[j]) {
          slack[j] = reduced;
          previous[static_cast<std::size_t>(j)] = at;
        }
        if (slack[j] < delta) {
          delta = slack[j];
          next = j;
        }
      }
      for (int j = 0; j <= columns; ++j) {
        if (visited[static_cast<std::size_t>(j)]) {
          u[row_at[static_cast<std::size_t>(j)]] += delta;
          v[j] -= delta;
        } else {
          slack[j] -= delta;
        }
      }
      at = next;
    } while (row_at[static_cast<std::size_t>(at)] != 0);
    while (at != 0) {
      const int before = previous[static_cast<std::size_t>(at)];
      row_at[static_cast<std::size_t>(at)] = row_at[static_cast<std::size_t>(before)];
      at = before;
    }
  }
  for (int j = 1; j <= columns; ++j) {
    const int row = row_at[static_cast<std::size_t>(j)];
    if (row > 0) result[static_cast<std::size_t>(row - 1)] = j - 1;
  }
  return result;
}

}  // namespace twindeck::matching
