#pragma once

#include "fe/assembly_elements.hpp"

namespace twindeck::fe {

/// What the modes of the structure see of an element given by matrices. Its own unknowns z follow statically, z = -K_zz⁻¹ K_zu
/// u, so that with T = [1; -K_zz⁻¹ K_zu] its stiffness is Tᵀ K T and its mass Tᵀ M T (Guyan 1965); of each the symmetric part
/// is taken, which is the part that derives from an energy.
struct ConservativePart {
  ElementMatrix stiffness, mass;
};
[[nodiscard]] ConservativePart conservative_part(const MatrixElement& element);

/// The sizes fit, the numbers are finite, K_zz is regular where there are own unknowns.
/// @throws InputError that names the element
void validate_matrix_elements(const Model& model);

}  // namespace twindeck::fe
