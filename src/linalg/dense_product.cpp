#include "linalg/dense_product.hpp"

#include "core/error.hpp"
#include "linalg/one_thread.hpp"

extern "C" void dgemm_(const char* transpose_a, const char* transpose_b, const int* rows, const int* columns, const int* inner,
                       const double* alpha, const double* a, const int* stride_a, const double* b, const int* stride_b,
                       const double* beta, double* c, const int* stride_c);

namespace twindeck::linalg {

namespace {

using Eigen::MatrixXd;
using Block = Eigen::Ref<const MatrixXd>;

/// c = alpha op(A) B + beta c.
void gemm(char transpose_a, double alpha, const Block& a, const Block& b, double beta, MatrixXd& c) {
  const auto inner = static_cast<int>(transpose_a == 'T' ? a.rows() : a.cols());
  TWINDECK_ASSERT(b.rows() == inner && c.cols() == b.cols() && c.rows() == (transpose_a == 'T' ? a.cols() : a.rows()));
  if (c.size() == 0) return;
  if (inner == 0) {
    c *= beta;
    return;
  }
  use_one_thread();
  const auto rows = static_cast<int>(c.rows()), columns = static_cast<int>(c.cols());
  const auto stride_a = static_cast<int>(a.outerStride()), stride_b = static_cast<int>(b.outerStride());
  dgemm_(&transpose_a, "N", &rows, &columns, &inner, &alpha, a.data(), &stride_a, b.data(), &stride_b, &beta, c.data(), &rows);
}

}  // namespace

MatrixXd transposed_times(const Block& a, const Block& b) {
  MatrixXd c = MatrixXd::Zero(a.cols(), b.cols());
  gemm('T', 1.0, a, b, 0.0, c);
  return c;
}

MatrixXd times(const Block& a, const Block& b) {
  MatrixXd c = MatrixXd::Zero(a.rows(), b.cols());
  gemm('N', 1.0, a, b, 0.0, c);
  return c;
}

void subtract_product(const Block& a, const Block& b, MatrixXd& c) { gemm('N', -1.0, a, b, 1.0, c); }

}  // namespace twindeck::linalg
