#pragma once

#include <Eigen/Dense>

/// Eigen's dense solvers of real matrices of any size, compiled once for the whole product (dense_instances.cpp) rather than in
/// every file that calls one: these declarations tell the compiler that the code exists elsewhere. The code is the same, so are
/// the numbers. A file that uses one of them includes this header in place of <Eigen/Dense>; it saves a third of such a file's
/// compile time. TWINDECK_INSTANCE is empty in the one file that makes them.
#ifndef TWINDECK_INSTANCE
#define TWINDECK_INSTANCE extern
#endif

namespace Eigen {

TWINDECK_INSTANCE template class SelfAdjointEigenSolver<MatrixXd>;
TWINDECK_INSTANCE template SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(
    const EigenBase<MatrixXd>&, int);
TWINDECK_INSTANCE template class GeneralizedSelfAdjointEigenSolver<MatrixXd>;
TWINDECK_INSTANCE template class HessenbergDecomposition<MatrixXd>;
TWINDECK_INSTANCE template class RealSchur<MatrixXd>;
TWINDECK_INSTANCE template RealSchur<MatrixXd>& RealSchur<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);
TWINDECK_INSTANCE template class EigenSolver<MatrixXd>;
TWINDECK_INSTANCE template EigenSolver<MatrixXd>& EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);
TWINDECK_INSTANCE template class PartialPivLU<MatrixXd>;
TWINDECK_INSTANCE template class LLT<MatrixXd>;
TWINDECK_INSTANCE template LLT<MatrixXd>& LLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);
TWINDECK_INSTANCE template class LDLT<MatrixXd>;
TWINDECK_INSTANCE template LDLT<MatrixXd>& LDLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);
TWINDECK_INSTANCE template class HouseholderQR<MatrixXd>;
TWINDECK_INSTANCE template class ColPivHouseholderQR<MatrixXd>;
TWINDECK_INSTANCE template class CompleteOrthogonalDecomposition<MatrixXd>;

namespace internal {

TWINDECK_INSTANCE template struct partial_lu_impl<double, ColMajor, int, Dynamic>;
// The products of two matrices, plain or transposed, and triangular solves.
TWINDECK_INSTANCE template struct general_matrix_matrix_product<Index, double, ColMajor, false, double, ColMajor, false,
                                                                ColMajor, 1>;
TWINDECK_INSTANCE template struct general_matrix_matrix_product<Index, double, RowMajor, false, double, ColMajor, false,
                                                                ColMajor, 1>;
TWINDECK_INSTANCE template struct general_matrix_matrix_product<Index, double, ColMajor, false, double, RowMajor, false,
                                                                ColMajor, 1>;
TWINDECK_INSTANCE template struct general_matrix_matrix_product<Index, double, RowMajor, false, double, RowMajor, false,
                                                                ColMajor, 1>;
TWINDECK_INSTANCE template struct triangular_solve_matrix<double, Index, OnTheLeft, Lower, false, ColMajor, ColMajor, 1>;
TWINDECK_INSTANCE template struct triangular_solve_matrix<double, Index, OnTheLeft, UnitLower, false, ColMajor, ColMajor, 1>;
TWINDECK_INSTANCE template struct triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, ColMajor, ColMajor, 1>;

}  // namespace internal
}  // namespace Eigen
