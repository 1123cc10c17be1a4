#pragma once

#include <string>

#include "model_io/matrix_model.hpp"
#include "model_io/read_model.hpp"
#include "model_io/write_matrix_model.hpp"
#include "model_io/write_model.hpp"

namespace twindeck::model_io {

/// Meaning, unit, range and default of each key of a model folder's model.toml.
[[nodiscard]] std::string describe_model_toml();

}  // namespace twindeck::model_io
