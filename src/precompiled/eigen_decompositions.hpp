// No #pragma once: the file that compiles these includes the list a second time, with TWINDECK_INSTANCE empty.
#include "precompiled/eigen_aliases.hpp"

/// The members of Eigen's dense solvers that do the work, compiled once for the whole product (eigen_decompositions.cpp), as in
/// eigen_kernels.hpp.
#ifndef TWINDECK_INSTANCE
#define TWINDECK_INSTANCE extern
#endif

namespace Eigen {

TWINDECK_INSTANCE template SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(
    const EigenBase<MatrixXd>&, int);
TWINDECK_INSTANCE template GeneralizedSelfAdjointEigenSolver<MatrixXd>& GeneralizedSelfAdjointEigenSolver<MatrixXd>::compute(
    const MatrixXd&, const MatrixXd&, int);
TWINDECK_INSTANCE template void PartialPivLU<MatrixXd>::compute();
TWINDECK_INSTANCE template LLT<MatrixXd>& LLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);
TWINDECK_INSTANCE template void LLT<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
TWINDECK_INSTANCE template void ColPivHouseholderQR<MatrixXd>::computeInPlace();
TWINDECK_INSTANCE template void ColPivHouseholderQR<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;

namespace internal {

// What a solver of an expression, rather than of a matrix, calls.
TWINDECK_INSTANCE template void tridiagonalization_inplace(MatrixXd&, VectorXd&, VectorXd&, VectorXd&, bool);
TWINDECK_INSTANCE template ComputationInfo computeFromTridiagonal_impl(VectorXd&, VectorXd&, Index, bool, MatrixXd&);
TWINDECK_INSTANCE template void make_block_householder_triangular_factor(instances::RowMajorMatrix&, const instances::Part&,
                                                                         const instances::Factors&);
TWINDECK_INSTANCE template void make_block_householder_triangular_factor(instances::RowMajorMatrix&, const instances::Part&,
                                                                         const instances::FactorsOf&);
TWINDECK_INSTANCE template void apply_block_householder_on_the_left(instances::Part&, const instances::Part&,
                                                                    const instances::Factors&, bool);

}  // namespace internal

TWINDECK_INSTANCE template void MatrixBase<internal::instances::Part>::applyHouseholderOnTheLeft(
    const internal::instances::Tail&, const double&, double*);
TWINDECK_INSTANCE template void MatrixBase<internal::instances::Part>::applyHouseholderOnTheRight(
    const internal::instances::Tail&, const double&, double*);

}  // namespace Eigen

#undef TWINDECK_INSTANCE
