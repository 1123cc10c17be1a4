#pragma once

#include <Eigen/Dense>

/// Short names of Eigen's own types for the lists of eigen_kernels.hpp and eigen_decompositions.hpp.
namespace Eigen::internal::instances {

using Complex = std::complex<double>;
using RealBlocks = gebp_traits<double, double>;
using ComplexBlocks = gebp_traits<Complex, Complex>;

// Matrices as the kernels read and write them.
template <class Scalar>
using Columns = const_blas_data_mapper<Scalar, Index, ColMajor>;
template <class Scalar>
using Rows = const_blas_data_mapper<Scalar, Index, RowMajor>;
template <class Scalar>
using Result = blas_data_mapper<Scalar, Index, ColMajor, Unaligned, 1>;

// Parts of a matrix that Householder reflections are kept in and applied to.
using Part = Block<MatrixXd, Dynamic, Dynamic, false>;
using Tail = Block<const MatrixXd, Dynamic, 1, false>;       // the lower part of a column
using Factors = VectorBlock<const VectorXd, Dynamic>;        // of a row of reflections
using FactorsOf = Block<const VectorXd, Dynamic, 1, false>;  // the same, as Eigen's own sequences have it
using RowMajorMatrix = Matrix<double, Dynamic, Dynamic, RowMajor>;

}  // namespace Eigen::internal::instances
