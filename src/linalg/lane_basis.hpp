#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace twindeck::linalg {

/// Eight vectors side by side, (8 × n): the entries of one degree of freedom lie together, so that sparse and dense kernels
/// pass over them without copies. Lanes without a vector are zero.
using Lanes = Eigen::Matrix<double, 8, Eigen::Dynamic>;

/// A tall matrix V (n × size) that grows by its columns, kept as lanes. For products with eight columns: a library's matrix
/// product first copies both of its factors into an order of its own, which takes longer than so narrow a product.
class LaneBasis {
 public:
  struct Block {
    Lanes lanes;
    Eigen::Index first, columns;  ///< columns of V in it, 1 … 8 of them
  };

  explicit LaneBasis(Eigen::Index rows) : rows_(rows) {}
  /// @param columns (n × size)
  explicit LaneBasis(const Eigen::Ref<const Eigen::MatrixXd>& columns);

  [[nodiscard]] Eigen::Index rows() const { return rows_; }
  [[nodiscard]] Eigen::Index size() const { return size_; }
  [[nodiscard]] std::span<const Block> blocks() const { return blocks_; }
  /// The matrix, (n × size).
  [[nodiscard]] Eigen::MatrixXd dense() const;

  /// @param columns  1 … 8, the lanes in use
  void append(Lanes lanes, Eigen::Index columns);
  void append(LaneBasis more);
  /// One column (n), into a lane of the last block if one is free.
  void append(const Eigen::VectorXd& column);
  /// Appends the columns of W C. @param c (w.size() × any number)
  void append_product(const LaneBasis& w, const Eigen::MatrixXd& c);
  /// V -= W C. @param c (w.size() × size())
  void subtract_product(const LaneBasis& w, const Eigen::MatrixXd& c);
  /// Vᵀ X, (size() × x.size()).
  [[nodiscard]] Eigen::MatrixXd transposed_times(const LaneBasis& x) const;

 private:
  /// The blocks from `first` on += W C, of which C has the columns of these blocks.
  void add_product(std::size_t first, const LaneBasis& w, const Eigen::MatrixXd& c);

  Eigen::Index rows_, size_ = 0;
  std::vector<Block> blocks_;
};

}  // namespace twindeck::linalg
