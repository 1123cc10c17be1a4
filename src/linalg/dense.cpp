#include "linalg/dense.hpp"

#include <algorithm>
#include <complex>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "linalg/one_thread.hpp"

// The Fortran interface, which every BLAS and LAPACK has.
extern "C" {
void dgemm_(const char* trans_a, const char* trans_b, const int* m, const int* n, const int* k, const double* alpha,
            const double* a, const int* lda, const double* b, const int* ldb, const double* beta, double* c, const int* ldc);
void dsyrk_(const char* uplo, const char* trans, const int* n, const int* k, const double* alpha, const double* a,
            const int* lda, const double* beta, double* c, const int* ldc);
void dsytrd_(const char* uplo, const int* n, double* a, const int* lda, double* d, double* e, double* tau, double* work,
             const int* lwork, int* info);
void dstedc_(const char* compz, const int* n, double* d, double* e, double* z, const int* ldz, double* work, const int* lwork,
             int* iwork, const int* liwork, int* info);
void dormtr_(const char* side, const char* uplo, const char* trans, const int* m, const int* n, const double* a, const int* lda,
             const double* tau, double* c, const int* ldc, double* work, const int* lwork, int* info);
void dgesdd_(const char* jobz, const int* m, const int* n, double* a, const int* lda, double* s, double* u, const int* ldu,
             double* vt, const int* ldvt, double* work, const int* lwork, int* iwork, int* info);
void dtrsm_(const char* side, const char* uplo, const char* trans_a, const char* diag, const int* m, const int* n,
            const double* alpha, const double* a, const int* lda, double* b, const int* ldb);
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void dpotri_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void zgesv_(const int* n, const int* nrhs, std::complex<double>* a, const int* lda, int* pivot, std::complex<double>* b,
            const int* ldb, int* info);
void dgesv_(const int* n, const int* nrhs, double* a, const int* lda, int* pivot, double* b, const int* ldb, int* info);
void dgeev_(const char* jobvl, const char* jobvr, const int* n, double* a, const int* lda, double* wr, double* wi, double* vl,
            const int* ldvl, double* vr, const int* ldvr, double* work, const int* lwork, int* info);
}

namespace twindeck::linalg {

using Eigen::Index;

namespace {

int as_int(Index n) { return static_cast<int>(n); }
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// c = factor a b + before c, or with aᵀ if `transposed`.
void add_product(double factor, const Eigen::Ref<const Eigen::MatrixXd>& a, bool transposed,
                 const Eigen::Ref<const Eigen::MatrixXd>& b, double before, Eigen::MatrixXd& c) {
  use_one_thread();
  const int m = as_int(c.rows()), n = as_int(c.cols()), k = as_int(b.rows());
  TWINDECK_ASSERT((transposed ? a.cols() : a.rows()) == m && (transposed ? a.rows() : a.cols()) == k && b.cols() == n);
  if (m == 0 || n == 0 || k == 0) return;
  const int lda = as_int(a.outerStride()), ldb = as_int(b.outerStride());
  dgemm_(transposed ? "T" : "N", "N", &m, &n, &k, &factor, a.data(), &lda, b.data(), &ldb, &before, c.data(), &m);
}

/// A⁻¹ B by LAPACK's GESV of the matrices' kind of number; not finite where A is singular.
template <typename Matrix, typename Gesv>
Matrix solved_by(Gesv gesv, Matrix a, Matrix b) {
  use_one_thread();
  TWINDECK_ASSERT(a.rows() == a.cols() && a.rows() == b.rows());
  int n = as_int(a.rows()), columns = as_int(b.cols()), info = 0;
  if (n == 0 || columns == 0) return b;
  Eigen::VectorXi pivot(n);
  gesv(&n, &columns, a.data(), &n, pivot.data(), b.data(), &n, &info);
  if (info != 0) b.setConstant(kNaN);
  return b;
}

/// Calls a LAPACK routine twice. The first call returns the needed size in the first number of `work`; the second computes.
template <typename Routine>
void with_room(Routine call) {
  double wanted = 0.0;
  int room = -1;
  call(&wanted, &room);
  Eigen::VectorXd work(room = static_cast<int>(wanted));
  call(work.data(), &room);
}

/// The `n` largest eigenpairs, descending, or those of values above `least` where n is 0. Divide and conquer (DSTEDC) solves
/// the whole tridiagonal form; only the wanted vectors are transformed back. DSYEVR would use bisection and inverse iteration,
/// which cost twice as much if more than a tenth of the pairs are wanted, and may fail on close values.
LeadingEigenpairs some_eigenpairs(Eigen::MatrixXd symmetric, Index n, double least) {
  use_one_thread();
  TWINDECK_ASSERT(symmetric.rows() == symmetric.cols());
  const int size = as_int(symmetric.rows()), int_room = 3 + 5 * size;
  if (size == 0) return {};
  Eigen::VectorXd values(size), beside(size), reflectors(size);
  Eigen::MatrixXd vectors(size, size);
  Eigen::VectorXi int_work(int_room);
  int info = 0;
  with_room([&](double* work, const int* room) {
    dsytrd_("L", &size, symmetric.data(), &size, values.data(), beside.data(), reflectors.data(), work, room, &info);
  });
  with_room([&](double* work, const int* room) {
    dstedc_("I", &size, values.data(), beside.data(), vectors.data(), &size, work, room, int_work.data(), &int_room, &info);
  });
  TWINDECK_ASSERT(info == 0);
  const int count = n > 0 ? as_int(n) : static_cast<int>((values.array() > least).count());
  Eigen::MatrixXd wanted = vectors.rightCols(count);
  with_room([&](double* work, const int* room) {
    dormtr_("L", "L", "N", &size, &count, symmetric.data(), &size, reflectors.data(), wanted.data(), &size, work, room, &info);
  });
  return {values.tail(count).reverse(), wanted.rowwise().reverse()};
}

}  // namespace

Eigen::MatrixXd product(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b,
                        bool transposed) {
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(transposed ? a.cols() : a.rows(), b.cols());
  add_product(1.0, a, transposed, b, 0.0, c);
  return c;
}

Eigen::MatrixXd square(const Eigen::Ref<const Eigen::MatrixXd>& a) {
  use_one_thread();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(a.rows(), a.rows());
  if (a.size() == 0) return out;
  const int n = as_int(a.rows()), k = as_int(a.cols()), lda = as_int(a.outerStride());
  const double one = 1.0, none = 0.0;
  dsyrk_("L", "N", &n, &k, &one, a.data(), &lda, &none, out.data(), &n);
  out.triangularView<Eigen::StrictlyUpper>() = out.transpose();
  return out;
}

void subtract_product(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b,
                      Eigen::MatrixXd& c) {
  add_product(-1.0, a, false, b, 1.0, c);
}

LeadingEigenpairs leading_eigenpairs(Eigen::MatrixXd symmetric, Index n) {
  TWINDECK_ASSERT(n >= 1 && n <= symmetric.rows());
  return some_eigenpairs(std::move(symmetric), n, 0.0);
}

LeadingEigenpairs eigenpairs_above(Eigen::MatrixXd symmetric, double least) {
  return some_eigenpairs(std::move(symmetric), 0, least);
}

ThinSvd thin_svd(Eigen::MatrixXd a) {
  use_one_thread();
  const int m = as_int(a.rows()), n = as_int(a.cols()), k = std::min(m, n);
  TWINDECK_ASSERT(k >= 1);
  ThinSvd svd{Eigen::MatrixXd(m, k), Eigen::VectorXd(k), Eigen::MatrixXd(k, n)};
  Eigen::VectorXi int_work(8 * k);
  int info = 0;
  with_room([&](double* work, const int* room) {
    dgesdd_("S", &m, &n, a.data(), &m, svd.values.data(), svd.u.data(), &m, svd.vt.data(), &k, work, room, int_work.data(),
            &info);
  });
  TWINDECK_ASSERT(info == 0);
  return svd;
}

Eigen::MatrixXd cholesky_factor(Eigen::MatrixXd a) {
  use_one_thread();
  int size = as_int(a.rows()), info = 0;
  if (size > 0) dpotrf_("L", &size, a.data(), &size, &info);
  if (info != 0) return {};
  a.triangularView<Eigen::StrictlyUpper>().setZero();
  return a;
}

Eigen::MatrixXd lower_solve(const Eigen::Ref<const Eigen::MatrixXd>& lower, Eigen::MatrixXd b, bool transposed) {
  use_one_thread();
  TWINDECK_ASSERT(lower.rows() == lower.cols() && lower.rows() == b.rows());
  const int m = as_int(b.rows()), n = as_int(b.cols()), lda = as_int(lower.outerStride());
  if (m == 0 || n == 0) return b;
  const double one = 1.0;
  dtrsm_("L", "L", transposed ? "T" : "N", "N", &m, &n, &one, lower.data(), &lda, b.data(), &m);
  return b;
}

Eigen::MatrixXd inverse_of_factored(Eigen::MatrixXd lower) {
  use_one_thread();
  const int size = as_int(lower.rows());
  int info = 0;
  if (size > 0) dpotri_("L", &size, lower.data(), &size, &info);
  TWINDECK_ASSERT(info == 0);
  lower.triangularView<Eigen::StrictlyUpper>() = lower.transpose();
  return lower;
}

Eigen::MatrixXcd solve(Eigen::MatrixXcd a, Eigen::MatrixXcd b) { return solved_by(zgesv_, std::move(a), std::move(b)); }

Eigen::MatrixXd solve(Eigen::MatrixXd a, Eigen::MatrixXd b) { return solved_by(dgesv_, std::move(a), std::move(b)); }

UnsymmetricEigen unsymmetric_eigen(Eigen::MatrixXd a, bool with_vectors) {
  use_one_thread();
  TWINDECK_ASSERT(a.rows() == a.cols());
  const int n = static_cast<int>(a.rows()), n_vectors = with_vectors ? n : 0;
  UnsymmetricEigen out{Eigen::VectorXcd::Constant(n, {kNaN, kNaN}),
                       Eigen::MatrixXcd::Constant(n_vectors, n_vectors, {kNaN, kNaN})};
  if (n == 0 || !a.allFinite()) return out;
  Eigen::VectorXd re(n), im(n);
  Eigen::MatrixXd packed(n, n_vectors);  // of a conjugate pair: real parts, then imaginary ones of the first
  double none = 0.0;
  int one = 1, info = 0;
  with_room([&](double* work, const int* room) {
    dgeev_("N", with_vectors ? "V" : "N", &n, a.data(), &n, re.data(), im.data(), &none, &one, packed.data(), &n, work, room,
           &info);
  });
  if (info != 0) return out;
  out.values = re + std::complex<double>(0.0, 1.0) * im;
  out.vectors = packed.cast<std::complex<double>>();
  for (Index j = 0; j + 1 < n_vectors; ++j) {
    if (!(im[j] > 0.0)) continue;  // the first of a pair has the positive imaginary part
    out.vectors.col(j).imag() = packed.col(j + 1);
    out.vectors.col(j + 1) = out.vectors.col(j).conjugate();
  }
  return out;
}

}  // namespace twindeck::linalg
