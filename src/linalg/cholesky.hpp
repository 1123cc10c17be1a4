#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/error.hpp"
#include "linalg/sparse.hpp"

namespace twindeck::linalg {

/// Sparse LDL' or Cholesky factorisation of a symmetric matrix by CHOLMOD, supernodal where that is faster. It uses one thread,
/// so that results do not depend on the number of threads. The symbolic factorisation is made once per pattern: `factorize`
/// may be called again with new values.
class Cholesky {
 public:
  Cholesky();
  ~Cholesky();
  Cholesky(Cholesky&&) noexcept;

  /// @param lower  lower triangle (n × n). If the matrix is not positive definite, the status says so and
  /// `failed_column()` gives the row of the matrix at which the factorisation failed (the location of a mechanism).
  Status factorize(const SparseMatrix& lower);
  [[nodiscard]] Eigen::Index failed_column() const;
  /// Solves A X = B; several threads may solve with one factor. @param b (n × m) @return (n × m)
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace twindeck::linalg
