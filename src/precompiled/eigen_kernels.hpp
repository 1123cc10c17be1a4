// No #pragma once: the file that compiles these includes the list a second time, with TWINDECK_INSTANCE empty.
#include "precompiled/eigen_aliases.hpp"

/// Eigen's kernels of dense products and triangular solves, of real and of complex numbers, compiled once for the whole product
/// (eigen_kernels.cpp) rather than in every file that multiplies two matrices: these declarations tell the compiler that the
/// code exists elsewhere. The code is the same, so are the numbers. TWINDECK_INSTANCE is empty in the one file that makes them.
#ifndef TWINDECK_INSTANCE
#define TWINDECK_INSTANCE extern
#endif

namespace Eigen::internal {

// Blocks of a product of matrices, and the copies into the order in which these read.
TWINDECK_INSTANCE template struct gebp_kernel<double, double, Index, instances::Result<double>, instances::RealBlocks::mr,
                                              instances::RealBlocks::nr, false, false>;
TWINDECK_INSTANCE template struct gemm_pack_lhs<double, Index, instances::Columns<double>, instances::RealBlocks::mr,
                                                instances::RealBlocks::LhsProgress, instances::RealBlocks::LhsPacket4Packing,
                                                ColMajor>;
TWINDECK_INSTANCE template struct gemm_pack_lhs<double, Index, instances::Rows<double>, instances::RealBlocks::mr,
                                                instances::RealBlocks::LhsProgress, instances::RealBlocks::LhsPacket4Packing,
                                                RowMajor>;
TWINDECK_INSTANCE template struct gemm_pack_rhs<double, Index, instances::Columns<double>, instances::RealBlocks::nr, ColMajor>;
TWINDECK_INSTANCE template struct gemm_pack_rhs<double, Index, instances::Rows<double>, instances::RealBlocks::nr, RowMajor>;
TWINDECK_INSTANCE template void evaluateProductBlockingSizesHeuristic<double, double, 1, Index>(Index&, Index&, Index&, Index);
TWINDECK_INSTANCE template void evaluateProductBlockingSizesHeuristic<double, double, 4, Index>(Index&, Index&, Index&, Index);

TWINDECK_INSTANCE template struct gebp_kernel<instances::Complex, instances::Complex, Index,
                                              instances::Result<instances::Complex>, instances::ComplexBlocks::mr,
                                              instances::ComplexBlocks::nr, false, false>;
TWINDECK_INSTANCE template struct gebp_kernel<instances::Complex, instances::Complex, Index,
                                              instances::Result<instances::Complex>, instances::ComplexBlocks::mr,
                                              instances::ComplexBlocks::nr, true, false>;
TWINDECK_INSTANCE template struct gemm_pack_lhs<instances::Complex, Index, instances::Columns<instances::Complex>,
                                                instances::ComplexBlocks::mr, instances::ComplexBlocks::LhsProgress,
                                                instances::ComplexBlocks::LhsPacket4Packing, ColMajor>;
TWINDECK_INSTANCE template struct gemm_pack_lhs<instances::Complex, Index, instances::Rows<instances::Complex>,
                                                instances::ComplexBlocks::mr, instances::ComplexBlocks::LhsProgress,
                                                instances::ComplexBlocks::LhsPacket4Packing, RowMajor>;
TWINDECK_INSTANCE template struct gemm_pack_rhs<instances::Complex, Index, instances::Columns<instances::Complex>,
                                                instances::ComplexBlocks::nr, ColMajor>;
TWINDECK_INSTANCE template struct gemm_pack_rhs<instances::Complex, Index, instances::Rows<instances::Complex>,
                                                instances::ComplexBlocks::nr, RowMajor>;
TWINDECK_INSTANCE template void evaluateProductBlockingSizesHeuristic<instances::Complex, instances::Complex, 1, Index>(Index&,
                                                                                                                        Index&,
                                                                                                                        Index&,
                                                                                                                        Index);
TWINDECK_INSTANCE template void evaluateProductBlockingSizesHeuristic<instances::Complex, instances::Complex, 4, Index>(Index&,
                                                                                                                        Index&,
                                                                                                                        Index&,
                                                                                                                        Index);

// A matrix, or its transpose or adjoint, times a vector.
TWINDECK_INSTANCE template struct general_matrix_vector_product<Index, double, instances::Columns<double>, ColMajor, false,
                                                                double, instances::Rows<double>, false>;
TWINDECK_INSTANCE template struct general_matrix_vector_product<Index, double, instances::Columns<double>, ColMajor, false,
                                                                double, instances::Columns<double>, false>;
TWINDECK_INSTANCE template struct general_matrix_vector_product<Index, double, instances::Rows<double>, RowMajor, false, double,
                                                                instances::Columns<double>, false>;
TWINDECK_INSTANCE template struct general_matrix_vector_product<Index, instances::Complex,
                                                                instances::Columns<instances::Complex>, ColMajor, false,
                                                                instances::Complex, instances::Rows<instances::Complex>, false>;
TWINDECK_INSTANCE template struct general_matrix_vector_product<Index, instances::Complex, instances::Rows<instances::Complex>,
                                                                RowMajor, false, instances::Complex,
                                                                instances::Columns<instances::Complex>, false>;
TWINDECK_INSTANCE template struct general_matrix_vector_product<Index, instances::Complex, instances::Rows<instances::Complex>,
                                                                RowMajor, true, instances::Complex,
                                                                instances::Columns<instances::Complex>, false>;
TWINDECK_INSTANCE template struct selfadjoint_matrix_vector_product<double, Index, ColMajor, Lower, false, false>;
TWINDECK_INSTANCE template struct triangular_matrix_vector_product<Index, UnitLower, double, false, double, false, ColMajor, 0>;
TWINDECK_INSTANCE template struct triangular_matrix_vector_product<Index, Upper, double, false, double, false, ColMajor, 0>;
TWINDECK_INSTANCE template struct triangular_matrix_vector_product<Index, UnitUpper, double, false, double, false, RowMajor, 0>;
TWINDECK_INSTANCE template struct triangular_matrix_vector_product<Index, Upper, double, false, double, false, RowMajor, 0>;

// Triangular solves.
TWINDECK_INSTANCE template struct triangular_solve_matrix<double, Index, OnTheLeft, Lower, false, ColMajor, ColMajor, 1>;
TWINDECK_INSTANCE template struct triangular_solve_matrix<double, Index, OnTheLeft, UnitLower, false, ColMajor, ColMajor, 1>;
TWINDECK_INSTANCE template struct triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, ColMajor, ColMajor, 1>;
TWINDECK_INSTANCE template struct triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, RowMajor, ColMajor, 1>;
TWINDECK_INSTANCE template struct triangular_solve_matrix<double, Index, OnTheLeft, UnitUpper, false, RowMajor, ColMajor, 1>;
TWINDECK_INSTANCE template struct triangular_solve_matrix<double, Index, OnTheRight, Upper, false, RowMajor, ColMajor, 1>;
TWINDECK_INSTANCE template struct triangular_solve_matrix<instances::Complex, Index, OnTheLeft, UnitLower, false, ColMajor,
                                                          ColMajor, 1>;
TWINDECK_INSTANCE template struct triangular_solve_matrix<instances::Complex, Index, OnTheLeft, Upper, false, ColMajor,
                                                          ColMajor, 1>;
TWINDECK_INSTANCE template struct triangular_solve_vector<double, double, Index, OnTheLeft, Lower, false, ColMajor>;
TWINDECK_INSTANCE template struct triangular_solve_vector<double, double, Index, OnTheLeft, UnitLower, false, ColMajor>;
TWINDECK_INSTANCE template struct triangular_solve_vector<double, double, Index, OnTheLeft, Upper, false, ColMajor>;
TWINDECK_INSTANCE template struct triangular_solve_vector<double, double, Index, OnTheLeft, Upper, false, RowMajor>;
TWINDECK_INSTANCE template struct triangular_solve_vector<double, double, Index, OnTheLeft, UnitUpper, false, RowMajor>;
TWINDECK_INSTANCE template struct triangular_solve_vector<instances::Complex, instances::Complex, Index, OnTheLeft, UnitLower,
                                                          false, ColMajor>;
TWINDECK_INSTANCE template struct triangular_solve_vector<instances::Complex, instances::Complex, Index, OnTheLeft, Upper,
                                                          false, ColMajor>;

}  // namespace Eigen::internal

#undef TWINDECK_INSTANCE
