// No #pragma once: the file that compiles these includes the list a second time, with TWINDECK_INSTANCE empty.
#include "precompiled/eigen_aliases.hpp"

/// The rest of eigen_decompositions.hpp: what identification, wind, updating and diagnosis need and step 1 does not. It is a
/// library of its own (twindeck_precompiled_more), so that `make look` need not wait for it.
#ifndef TWINDECK_INSTANCE
#define TWINDECK_INSTANCE extern
#endif

namespace Eigen {

TWINDECK_INSTANCE template SelfAdjointEigenSolver<Matrix2d>& SelfAdjointEigenSolver<Matrix2d>::compute(
    const EigenBase<Matrix2d>&, int);
TWINDECK_INSTANCE template RealSchur<MatrixXd>& RealSchur<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);
TWINDECK_INSTANCE template EigenSolver<MatrixXd>& EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);
TWINDECK_INSTANCE template MatrixXcd EigenSolver<MatrixXd>::eigenvectors() const;
TWINDECK_INSTANCE template void PartialPivLU<MatrixXcd>::compute();
TWINDECK_INSTANCE template LDLT<MatrixXd>& LDLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);
TWINDECK_INSTANCE template void LDLT<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
TWINDECK_INSTANCE template void HouseholderQR<MatrixXd>::computeInPlace();
TWINDECK_INSTANCE template JacobiSVD<MatrixXd>& JacobiSVD<MatrixXd>::compute(const MatrixXd&, unsigned int);

}  // namespace Eigen

#undef TWINDECK_INSTANCE
