#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>

namespace twindeck {

/// The samples of a record (n_samples × n_channels), one channel after the other, as a matrix of Eigen. Records outgrow the
/// memory: sixteen channels at 100 Hz are 12.8 GB in eleven days. Samples that take more than `kMostInMemory` therefore lie in
/// a file without a name, which is mapped into memory: the system keeps the parts in memory that are in use, and the values,
/// their order and with them every result are the same. The file is gone when the samples or the process end.
///
/// Its folder is that of the environment variable TMPDIR, else /var/tmp, which has room for large files where /tmp may itself
/// be memory.
class Samples : public Eigen::Map<Eigen::MatrixXd> {
 public:
  using Index = Eigen::Index;
  /// [bytes] Two or three of them exist at a time, so that a step stays within some gigabytes.
  static constexpr std::size_t kMostInMemory = std::size_t{1} << 30U;

  Samples() : Samples(0, 0) {}
  /// Values are not set. @param most_in_memory  [bytes] larger samples lie in a file
  /// @throws InputError  naming the folder if it has no room for the file
  Samples(Index rows, Index cols, std::size_t most_in_memory = kMostInMemory);
  /// A copy of a matrix, or the value of an expression.
  template <typename Derived>
  Samples(const Eigen::MatrixBase<Derived>& values) : Samples(values.rows(), values.cols()) {
    Base::operator=(values.derived());
  }
  Samples(const Samples& other) : Samples(static_cast<const Eigen::MatrixBase<Eigen::Map<Eigen::MatrixXd>>&>(other)) {}
  Samples(Samples&& other) noexcept;
  Samples& operator=(Samples other) noexcept;
  ~Samples() = default;

  /// Whether they lie in a file.
  [[nodiscard]] bool in_file() const { return values_ && values_.get_deleter().mapped > 0; }

 private:
  using Base = Eigen::Map<Eigen::MatrixXd>;
  struct Release {
    Release() : mapped(0) {}  // written out: a default argument would not be known yet where unique_ptr asks
    explicit Release(std::size_t bytes) : mapped(bytes) {}
    std::size_t mapped;  ///< [bytes] of the file; 0: from the heap
    void operator()(double* values) const;
  };
  /// Makes the matrix that of `values_`.
  void look_at(Index rows, Index cols);

  std::unique_ptr<double, Release> values_;
};

/// The record with each channel multiplied by its factor. @param factor (n_channels)
[[nodiscard]] Samples scaled_channels(const Samples& samples, const Eigen::VectorXd& factor);

}  // namespace twindeck
