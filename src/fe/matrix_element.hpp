#pragma once

#include "fe/assembly_elements.hpp"

namespace twindeck::fe {

/// Stiffness and mass for the modes of the structure, of an element given by matrices. Its own unknowns z are condensed
/// statically, z = -K_zz⁻¹ K_zu u. With T = [1; -K_zz⁻¹ K_zu] its stiffness is Tᵀ K T and its mass Tᵀ M T (Guyan 1965). The
/// symmetric part of each is used, which is the part that derives from an energy.
struct ConservativePart {
  ElementMatrix stiffness, mass;
};
[[nodiscard]] ConservativePart conservative_part(const MatrixElement& element);

/// Checks that the sizes match, that all numbers are finite, and that K_zz is regular if there are own unknowns.
/// @throws InputError that names the element
void validate_matrix_elements(const Model& model);

}  // namespace twindeck::fe
