#pragma once

#include "model_io/nastran_parts.hpp"

/// Inside of the library: the static subcase that STATSUB names. Its loads (LOAD, TEMPERATURE(LOAD), movements of SPC and SPCD)
/// become the stage about which modes are computed; Nastran adds the differential stiffness of that subcase likewise.
namespace twindeck::model_io::nastran {

/// Call it when nodes have their final order, before the model is turned into SI.
/// @throws InputError  for a load card of the chosen sets that is not carried, by its name
void read_stage(Parts& parts);

}  // namespace twindeck::model_io::nastran
