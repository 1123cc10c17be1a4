#pragma once

#include <Eigen/Core>
#include <Eigen/Sparse>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace twindeck::diagnosis {

/// Basis V of the reduced structure: c common vectors, then one group of vectors for the causes at each location. A vector has
/// an entry for each degree of freedom of the structure. The vectors of recently used groups are kept. Others are computed
/// again when needed, with the same bits. Safe for several threads.
class ReducedBasis {
 public:
  struct Group {
    Eigen::Index first = 0, count = 0;  ///< of the columns of V
  };
  /// Vectors of a location (n × any).
  struct Block {
    std::shared_ptr<const Eigen::MatrixXd> vectors;
    std::function<Eigen::MatrixXd()> again;  ///< computes them
  };
  static constexpr std::size_t kKept = 512;  ///< groups of vectors that are kept

  explicit ReducedBasis(Eigen::MatrixXd common);
  [[nodiscard]] Eigen::Index common() const { return common_rows_.rows(); }
  [[nodiscard]] Eigen::Index size() const { return std::ssize(group_of_); }
  [[nodiscard]] const Eigen::MatrixXd& common_vectors() const { return common_vectors_; }  ///< (n × c)
  /// Transpose of the common vectors (c × n), so that the values of one degree of freedom are adjacent.
  [[nodiscard]] const Eigen::MatrixXd& common_rows() const { return common_rows_; }
  [[nodiscard]] const std::vector<Group>& groups() const { return groups_; }
  /// Group of a column after the common ones, and the position within the group.
  [[nodiscard]] std::pair<int, Eigen::Index> place_of(int column) const;
  /// Appends blocks, a group each; empty ones are left out. @return the columns of each block
  std::vector<std::vector<int>> append(const std::vector<Block>& blocks);
  [[nodiscard]] std::shared_ptr<const Eigen::MatrixXd> vectors(int group) const;  ///< (n × count)
  /// The vectors after the common ones, among some columns (n × n_own).
  [[nodiscard]] Eigen::MatrixXd own(const std::vector<int>& columns) const;
  /// V_c x of some columns (n × m). @param own  of these columns @param x (n_columns × m)
  [[nodiscard]] Eigen::MatrixXd motion(const Eigen::MatrixXd& own, const Eigen::MatrixXd& x) const;
  /// V_c' f (n_columns × m). @param own  of these columns @param force (n × m)
  [[nodiscard]] Eigen::MatrixXd projected(const Eigen::MatrixXd& own, const Eigen::MatrixXd& force) const;

 private:
  void keep(int group, std::shared_ptr<const Eigen::MatrixXd> vectors) const;  ///< under the mutex

  Eigen::MatrixXd common_vectors_, common_rows_;
  std::vector<Group> groups_;
  std::vector<int> group_of_;                            ///< (r) position in `groups`, -1 for a common vector
  std::vector<std::function<Eigen::MatrixXd()>> again_;  ///< by group
  mutable std::mutex mutex_;
  mutable std::vector<std::shared_ptr<const Eigen::MatrixXd>> kept_;  ///< by group; null if not kept
  mutable std::deque<int> order_;                                     ///< groups that are kept, the oldest first
};

/// Unit forces of a location in reduced coordinates, V' b. The values for the common vectors and for the location's own are
/// kept; those for vectors of other locations are computed when a fit combines causes at both locations.
class ReducedDirections {
 public:
  ReducedDirections() = default;
  /// @param b        (n × k)
  /// @param for_all  every state uses them: the values for all vectors are kept
  ReducedDirections(Eigen::SparseMatrix<double> b, std::shared_ptr<const ReducedBasis> basis, bool for_all);

  [[nodiscard]] Eigen::Index cols() const { return b_.cols(); }                           ///< k
  [[nodiscard]] bool is_zero(Eigen::Index d) const { return b_.col(d).nonZeros() == 0; }  ///< it cannot move so
  /// Direction `d` in some coordinates, the common ones first (n_columns).
  [[nodiscard]] Eigen::VectorXd part(Eigen::Index d, const std::vector<int>& columns) const;
  /// Keeps the values for the location's own vectors. @param group  of the basis
  void keep(int group);
  /// Computes the values for vectors added to the basis meanwhile, if `for_all`.
  void follow_basis();

 private:
  [[nodiscard]] Eigen::MatrixXd at(int group) const { return basis_->vectors(group)->transpose() * b_; }

  Eigen::SparseMatrix<double> b_;
  std::shared_ptr<const ReducedBasis> basis_;
  Eigen::MatrixXd common_;  ///< (c × k)
  bool for_all_ = false;
  int first_ = 0;                      ///< group of the first entry of `kept_`
  std::vector<Eigen::MatrixXd> kept_;  ///< (count × k) of one group after another
};

}  // namespace twindeck::diagnosis
