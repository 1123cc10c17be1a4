#include "linalg/unsymmetric_eigen.hpp"

#include <limits>

#include "core/error.hpp"
#include "linalg/one_thread.hpp"

extern "C" {
void dgeev_(const char* jobvl, const char* jobvr, const int* n, double* a, const int* lda, double* wr, double* wi, double* vl,
            const int* ldvl, double* vr, const int* ldvr, double* work, const int* lwork, int* info);
}

namespace twindeck::linalg {

using Eigen::Index;

UnsymmetricEigen unsymmetric_eigen(Eigen::MatrixXd a) {
  use_one_thread();
  TWINDECK_ASSERT(a.rows() == a.cols());
  const auto n = static_cast<int>(a.rows());
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  UnsymmetricEigen out{Eigen::VectorXcd::Constant(n, {nan, nan}), Eigen::MatrixXcd::Constant(n, n, {nan, nan})};
  if (n == 0 || !a.allFinite()) return out;
  Eigen::VectorXd re(n), im(n), work(1);
  Eigen::MatrixXd packed(n, n);  // of a conjugate pair: real parts, then imaginary ones of the first
  double none = 0.0;
  const int one = 1;
  int info = 0, room = -1;
  for (const bool ask : {true, false}) {
    dgeev_("N", "V", &n, a.data(), &n, re.data(), im.data(), &none, &one, packed.data(), &n, work.data(), &room, &info);
    if (!ask) break;
    room = static_cast<int>(work[0]);
    work.resize(room);
  }
  if (info != 0) return out;
  out.values.real() = re;
  out.values.imag() = im;
  for (Index j = 0; j < n; ++j) {
    out.vectors.col(j).real() = packed.col(j);
    out.vectors.col(j).imag().setZero();
    if (im[j] == 0.0 || j + 1 == n) continue;
    out.vectors.col(j).imag() = packed.col(j + 1);
    out.vectors.col(j + 1) = out.vectors.col(j).conjugate();
    ++j;
  }
  return out;
}

}  // namespace twindeck::linalg
