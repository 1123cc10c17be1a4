#pragma once

#include "model_io/nastran_parts.hpp"

/// Inside of the library: grids and coordinate systems. The members of Parts that find them are defined here too.
namespace twindeck::model_io::nastran {

void index_card(Parts& parts, const Card& card);  ///< what others refer to

}  // namespace twindeck::model_io::nastran
