#pragma once

#include "model_io/export_matrices.hpp"
#include "model_io/model_tables.hpp"
#include "model_io/modes_io.hpp"
#include "model_io/vtu.hpp"

/// What is written of a model for people and other programs: matrices, modes, a grid for ParaView.
