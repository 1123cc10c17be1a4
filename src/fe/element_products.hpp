#pragma once

#include <Eigen/Core>

#include "fe/shell_triangle.hpp"
#include "fe/triangle.hpp"

/// The products that element matrices are made of. They are compiled once, in element_products.cpp: each size of a product of
/// matrices takes the compiler about a third of a second in every source that writes it out.
namespace twindeck::fe {

/// Symmetric part of  scale · Tᵀ K T:  a matrix K over displacements T u, over the displacements u.
[[nodiscard]] Matrix12 congruence(const Matrix12& t, const Matrix12& k);
[[nodiscard]] Matrix18 congruence(const Matrix18& t, const Matrix18& k);
[[nodiscard]] Matrix24 congruence(const Matrix24& t, const Matrix24& k, double scale);

/// weight · Bᵀ B:  the part of a mass or geometric stiffness at one integration point, B from displacements to deflections.
[[nodiscard]] Matrix12 quadratic_form(double weight, const Eigen::Matrix<double, 2, 12>& b);

/// weight · Bᵀ D B:  the part of a stiffness at one integration point, B from displacements to strains or curvatures.
[[nodiscard]] Matrix12 quadratic_form(double weight, const Eigen::Matrix<double, 2, 12>& b, const Eigen::Matrix2d& d);
[[nodiscard]] Matrix12 quadratic_form(double weight, const Eigen::Matrix<double, 3, 12>& b, const Eigen::Matrix3d& d);
[[nodiscard]] triangle::Matrix9 quadratic_form(double weight, const Eigen::Matrix<double, 3, 9>& b, const Eigen::Matrix3d& d);

/// Bᵀ A⁻¹ B  for a symmetric, definite A.
[[nodiscard]] Matrix12 inverse_form(const Eigen::Matrix4d& a, const Eigen::Matrix<double, 4, 12>& b);

/// Aᵀ B.
[[nodiscard]] Eigen::MatrixXd transposed_product(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                                 const Eigen::Ref<const Eigen::MatrixXd>& b);

}  // namespace twindeck::fe
