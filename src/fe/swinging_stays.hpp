#pragma once

#include <vector>

#include "fe/model.hpp"

namespace twindeck::fe {

/// A stay that is to swing.
struct SwingingStay {
  int element = -1;      ///< position in Model::elements
  double force_N = 0.0;  ///< that its frequencies go by
};

/// The model with stays that swing. Each stay keeps its element, with its stiffness between the ends, its pull, its name and
/// its parameters. Beside it stands a matrix element "cable_NE8" of group "cables" over both ends and `pieces - 1` new nodes
/// between them (fe/cable.hpp), so that statics and prestress are what they were and the modes are those of a cable in several
/// elements. The result can be written as a model folder.
///
/// New nodes follow those of the model; their numbers begin at the next full million, which no sensor is named by accident.
/// @throws InputError  for a stay without force
[[nodiscard]] Model with_swinging_stays(Model model, const std::vector<SwingingStay>& stays, int pieces);

/// Name of a stay: as in elements.csv, else its number.
[[nodiscard]] std::string stay_name(const Element& stay);

}  // namespace twindeck::fe
