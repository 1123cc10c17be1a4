#pragma once

#include <string>

#include "diagnosis/diagnose.hpp"
#include "diagnosis/full_check.hpp"

namespace twindeck::diagnosis {

/// The winner in the reduced basis against the full model, as the structure is in a state: in the modes that those measured in
/// that state are paired with, or in the lowest one where none is. What acts in other states alone is left out.
[[nodiscard]] FullCheck check_paired_modes(const Structure& structure, const Places& places, const FeatureMap& map,
                                           const Diagnosis& result, const std::string& state);

/// Error of the basis in frequencies up to which it is behind what is not known anyway [%].
[[nodiscard]] double allowed_basis_error_pct(const Diagnosis& result);

}  // namespace twindeck::diagnosis
