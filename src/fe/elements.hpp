#pragma once

#include "fe/bar.hpp"
#include "fe/beam.hpp"
#include "fe/shell_quad.hpp"

/// The catalogue of beams, bars and shells. Element matrices are pure functions: geometry and properties in, matrices in global
/// axes out.
