#include "matching/assignment.hpp"

#include <limits>

namespace twindeck::matching {

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
