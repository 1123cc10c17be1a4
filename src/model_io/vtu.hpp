#pragma once

#include <filesystem>

#include "dynamics/eigenmodes.hpp"
#include "fe/model.hpp"
#include "fe/parametric_system.hpp"

namespace twindeck::model_io {

/// Unstructured grid for ParaView: one point field per mode (vector, largest translation 1), one cell field `group`, `type`.
void write_vtu(const fe::Model& model, const fe::ParametricSystem& system, const dynamics::EigenModes& modes,
               const std::filesystem::path& file);

}  // namespace twindeck::model_io
