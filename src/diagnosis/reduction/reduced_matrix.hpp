#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "diagnosis/reduction/structure.hpp"

namespace twindeck::diagnosis {

/// The vectors V that a structure is projected to: c common ones first, then groups of vectors that stand for causes at one
/// location each.
struct ReducedBasis {
  struct Group {
    Eigen::Index first = 0, count = 0;  ///< of the columns of V
  };
  Eigen::MatrixXd vectors;      ///< V (n × r)
  Eigen::MatrixXd common_rows;  ///< transpose of the common vectors (c × n): what is read of a degree of freedom lies together
  std::vector<Group> groups;
  std::vector<int> group_of;  ///< (r) position in `groups`, -1 for a common vector

  explicit ReducedBasis(Eigen::MatrixXd common);
  [[nodiscard]] Eigen::Index common() const { return common_rows.rows(); }
  [[nodiscard]] Eigen::Index size() const { return vectors.cols(); }
  /// Appends blocks of vectors (n × any), a group each; empty ones are left out. @return the columns of each block
  std::vector<std::vector<int>> append(const std::vector<Eigen::MatrixXd>& blocks);
  /// The vectors behind the common ones among some columns (n × n_own).
  [[nodiscard]] Eigen::MatrixXd own(const std::vector<int>& columns) const;
  /// V_c x of some columns (n × m). @param x (n_columns × m)
  [[nodiscard]] Eigen::MatrixXd motion(const std::vector<int>& columns, const Eigen::MatrixXd& x) const;
  /// V_c' f (n_columns × m). @param force (n × m)
  [[nodiscard]] Eigen::MatrixXd projected(const std::vector<int>& columns, const Eigen::MatrixXd& force) const;
};

/// V' S V of a symmetric matrix S, of which the parts that are asked for are computed: the whole (r × r) of a thousand places
/// would be 10^10 numbers. Lists of columns have the c common ones first, then whole groups. Safe for several threads.
class ReducedMatrix {
 public:
  ReducedMatrix() = default;
  /// @param for_all  every state with own vectors of any location uses it: all groups are projected at once. A matrix of few
  ///                 degrees of freedom is multiplied out wherever it is used instead.
  ReducedMatrix(const Symmetric& s, std::shared_ptr<const ReducedBasis> basis, bool for_all);

  [[nodiscard]] Eigen::Index size() const { return basis_ == nullptr ? 0 : basis_->size(); }  ///< r; 0 where there is nothing
  [[nodiscard]] const Eigen::MatrixXd& common() const { return common_; }                     ///< (c × c)
  /// The part of some columns (n × n).
  [[nodiscard]] Eigen::MatrixXd part(const std::vector<int>& columns) const;
  /// total += amount times the part's columns behind the common ones (n × n_own).
  void add_own(double amount, const std::vector<int>& columns, Eigen::Ref<Eigen::MatrixXd> total) const;
  /// Whether S holds fewer degrees of freedom than there are common vectors. Then `add_image` costs less than reading a part.
  [[nodiscard]] bool is_local() const { return local_; }
  /// force += amount S motion, over all degrees of freedom (n × m).
  void add_image(double amount, const Eigen::MatrixXd& motion, Eigen::MatrixXd& force) const;
  /// sum += amount V_c' S motion (n_columns × 1). @param motion (n)
  void add_product(double amount, const std::vector<int>& columns, const Eigen::VectorXd& motion,
                   Eigen::Ref<Eigen::VectorXd> sum) const;
  /// Projects the groups that the basis has got since.
  void follow_basis();
  [[nodiscard]] const ReducedBasis& basis() const { return *basis_; }

 private:
  /// Parts that were asked for. Copies of a matrix share them.
  struct Known {
    std::mutex mutex;
    std::map<int, Eigen::MatrixXd> own;                    ///< by group
    std::map<std::pair<int, int>, Eigen::MatrixXd> cross;  ///< by groups, the lower one first
  };
  [[nodiscard]] Eigen::MatrixXd at_dofs(Eigen::Index first, Eigen::Index count) const;  ///< (n_dofs × count) of V
  /// V' S v for the vectors v of a group: rows of the common vectors, then of the group (c + count × count).
  [[nodiscard]] const Eigen::MatrixXd& own(int group) const;
  [[nodiscard]] const Eigen::MatrixXd& cross(int low, int high) const;
  [[nodiscard]] double entry(int row, int column) const;  ///< between two vectors behind the common ones

  std::shared_ptr<const ReducedBasis> basis_;
  std::vector<int> dofs_;           ///< that S touches
  Symmetric compact_;               ///< S over them
  Eigen::MatrixXd common_;          ///< (c × c)
  Eigen::MatrixXd common_at_dofs_;  ///< (c × n_dofs), where S is local
  bool local_ = false, for_all_ = false;
  std::vector<Eigen::MatrixXd> all_;  ///< of every group, where `for_all`
  std::shared_ptr<Known> known_;
};

}  // namespace twindeck::diagnosis
