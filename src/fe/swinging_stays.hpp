#pragma once

#include <vector>

#include "fe/model.hpp"

namespace twindeck::fe {

/// A stay that shall vibrate.
struct SwingingStay {
  int element = -1;      ///< position in Model::elements
  double force_N = 0.0;  ///< cable force that determines its frequencies
};

/// The model with vibrating stays. Each stay keeps its element, with its stiffness between the ends, its cable force, its name
/// and its parameters. A matrix element "cable_NE8" of group "cables" is added over both ends and `pieces - 1` new nodes
/// between them (fe/cable.hpp). Statics and prestress do not change, and the modes are those of a cable in several elements.
/// The result can be written as a model folder.
///
/// New nodes follow those of the model; their numbers begin at the next full million, so that they cannot match a sensor by
/// accident.
/// @throws InputError  for a stay without force
[[nodiscard]] Model with_swinging_stays(Model model, const std::vector<SwingingStay>& stays, int pieces);

/// Name of a stay: as in elements.csv, else its number.
[[nodiscard]] std::string stay_name(const Element& stay);

}  // namespace twindeck::fe
