#pragma once

#include "model_io/nastran_parts.hpp"

/// Inside of the library: properties of bars and beams.
namespace twindeck::model_io::nastran {

[[nodiscard]] MemberProperty bar_property(Parts& parts, const Card& element, long id);   ///< PBAR, PBARL
[[nodiscard]] MemberProperty beam_property(Parts& parts, const Card& element, long id);  ///< PBEAM, PBEAML

}  // namespace twindeck::model_io::nastran
