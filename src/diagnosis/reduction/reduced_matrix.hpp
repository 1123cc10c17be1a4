#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "diagnosis/reduction/compact_matrix.hpp"
#include "diagnosis/reduction/reduced_basis.hpp"

namespace twindeck::diagnosis {

/// V' S V of a symmetric matrix S. Only the needed parts are computed: for a thousand locations the whole matrices (r × r)
/// would be 10^10 numbers. Lists of columns have the c common ones first, then whole groups. Safe for several threads.
class ReducedMatrix {
 public:
  ReducedMatrix() = default;
  /// @param for_all  every state with own vectors of any location uses it: all groups are projected at once. A matrix of few
  ///                 degrees of freedom is multiplied out wherever it is used instead.
  ReducedMatrix(CompactMatrix s, std::shared_ptr<const ReducedBasis> basis, bool for_all);

  [[nodiscard]] Eigen::Index size() const { return basis_ == nullptr ? 0 : basis_->size(); }  ///< r; 0 where there is nothing
  [[nodiscard]] const Eigen::MatrixXd& common() const { return common_; }                     ///< (c × c)
  /// The submatrix of some columns (n × n).
  [[nodiscard]] Eigen::MatrixXd part(const std::vector<int>& columns) const;
  /// total += amount times the submatrix, its columns after the common ones (n × n_own).
  void add_own(double amount, const std::vector<int>& columns, Eigen::Ref<Eigen::MatrixXd> total) const;
  /// Whether S touches fewer degrees of freedom than there are common vectors. Then `add_image` costs less than a submatrix.
  [[nodiscard]] bool is_local() const { return local_; }
  /// force += amount S motion, over all degrees of freedom (n × m).
  void add_image(double amount, const Eigen::MatrixXd& motion, Eigen::MatrixXd& force) const;
  /// sum += amount V_c' S motion (n_columns × m). @param own (n × n_own) vectors behind the common ones @param motion (n × m)
  void add_product(double amount, const Eigen::MatrixXd& own, const Eigen::MatrixXd& motion,
                   Eigen::Ref<Eigen::MatrixXd> sum) const;
  /// Projects the groups that were added to the basis meanwhile.
  void follow_basis();
  /// Keeps the values for the location's own vectors. @param group  of the basis
  void keep(int group);
  [[nodiscard]] const ReducedBasis& basis() const { return *basis_; }

 private:
  /// Parts that were computed. Copies of a matrix share them.
  struct Known {
    std::mutex mutex;
    std::map<int, Eigen::MatrixXd> own;                    ///< by group
    std::map<std::pair<int, int>, Eigen::MatrixXd> cross;  ///< by groups, the lower one first
  };
  [[nodiscard]] Eigen::MatrixXd at_dofs(int group) const;  ///< vectors of a group where S is (n_dofs × count)
  /// V' S v for the vectors v of a group: rows of the common vectors, then of the group (c + count × count).
  [[nodiscard]] const Eigen::MatrixXd& own(int group) const;
  [[nodiscard]] const Eigen::MatrixXd& cross(int low, int high) const;
  /// A part, computed when first needed.
  template <typename Parts, typename Key, typename Compute>
  const Eigen::MatrixXd& known(Parts& parts, const Key& key, Compute compute) const {
    {
      const std::scoped_lock lock(known_->mutex);
      if (const auto at = parts.find(key); at != parts.end()) return at->second;
    }
    Eigen::MatrixXd part = compute();
    const std::scoped_lock lock(known_->mutex);
    return parts.try_emplace(key, std::move(part)).first->second;
  }
  [[nodiscard]] double entry(int row, int column) const;  ///< between two vectors after the common ones

  std::shared_ptr<const ReducedBasis> basis_;
  CompactMatrix s_;
  Eigen::MatrixXd common_;          ///< (c × c)
  Eigen::MatrixXd common_at_dofs_;  ///< (c × n_dofs), if S is local
  bool local_ = false, for_all_ = false;
  int own_group_ = -1;                ///< of the location that S belongs to
  Eigen::MatrixXd own_at_dofs_;       ///< its vectors (n_dofs × count), if S is local
  std::vector<Eigen::MatrixXd> all_;  ///< of every group, where `for_all`
  std::shared_ptr<Known> known_;
};

}  // namespace twindeck::diagnosis
