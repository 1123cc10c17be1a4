#pragma once

#include <string>
#include <vector>

#include "fe/parametric_system.hpp"
#include "linalg/sparse.hpp"

/// Checks of K and M. A structure has finite K and M (below 1e40), a positive semidefinite M, and a positive definite K (for a
/// free structure semidefinite). With other matrices a modal solver gives wrong modes or none.
namespace twindeck::fe {

/// @param lower  lower triangle of K or M (n × n)
/// @param what   "stiffness" or "mass"
/// @throws InputError  with the degree of freedom, for an entry that is not finite or above 1e40, or if the largest is below
///         1e-40: quotients and products of such numbers leave the range of doubles
void check_sizes(const linalg::SparseMatrix& lower, const std::vector<DofLabel>& dofs, const std::string& source,
                 const char* what);

/// @param lower   lower triangle of M (n × n)
/// @param source  model that the message names
/// @throws InputError  naming the degree of freedom: a size as above, a negative mass, a coupling that is larger than
///         the masses it couples, a matrix that is indefinite in another way; or no mass at all. Degrees of freedom without
///         mass are allowed. So is a negative part of at most 1e-6 of the diagonal, which arises if a singular matrix is
///         written with six digits; it affects only modes a thousand times above those of the structure
/// @param sum_of_squares  true: M is known to be semidefinite (see below), and only its entries and the total are checked.
///         false: the check costs a factorisation
void check_mass(const linalg::SparseMatrix& lower, const std::vector<DofLabel>& dofs, const std::string& source,
                bool sum_of_squares);

/// True if no element can reduce the mass. M then needs no check, because elements, point masses and links add squares.
[[nodiscard]] bool mass_is_a_sum_of_squares(const Model& model);

/// @param lower    lower triangle of K (n × n)
/// @param context  ends the first words of the message (" under its prestress"), may be empty
/// @throws InputError  naming a node and the directions in which it moves most: a size as above, a stiffness that is negative
/// by
///         more than 1e-11 of the diagonal
void refuse_negative_stiffness(const linalg::SparseMatrix& lower, const std::vector<DofLabel>& dofs, const std::string& source,
                               const std::string& context);

}  // namespace twindeck::fe
